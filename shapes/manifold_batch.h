#pragma once

#include "manifold.h"
#include "wide_pairs.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether pairs of such polygons may be collided in batches: no two neighbouring faces nearly parallel, coordinates
/// neither so small nor so large that products of them are lost.
bool collidesInBatches(const Polygon& polygon);

/// What may be in a batch together.
enum class PairKind : std::uint8_t {
    sharp,  ///< two polygons without radius, of three vertices at least
    round,  ///< any others
};
inline bool isSharp(const Polygon& polygon) { return polygon.count > 2 && !(polygon.radius > 0); }
inline PairKind pairKindOf(const Polygon& a, const Polygon& b) {
    return isSharp(a) && isSharp(b) ? PairKind::sharp : PairKind::round;
}

/// Whether this machine, and this build, have registers for batches. Without them `collide` does as well.
bool canCollideInBatches();

/// Manifolds of as many pairs at once as there are lanes: bit for bit those of `collide` without a memory, at less than
/// half the cost.
class ManifoldBatch {
public:
    static constexpr std::size_t kPairs = WidePairs::kPairs;

    explicit ManifoldBatch(PairKind kind) : kind_(kind) {}

    std::size_t size() const { return size_; }
    bool isFull() const { return size_ == kPairs; }
    /// What a batch asks of two polygons beside vertices and normals, of who has it at hand.
    struct Sizes {
        Real radiusA = 0;
        Real radiusB = 0;
        std::uint8_t verticesA = 0;
        std::uint8_t verticesB = 0;
    };

    /// @pre not full; of the kind; `collidesInBatches` both, which stay where they are until the batch is cleared
    void add(const Polygon& a, const Polygon& b, const Sizes& sizes, const Transform& bInA, ManifoldReach reach);
    void add(const Polygon& a, const Polygon& b, const Transform& bInA, ManifoldReach reach) {
        const auto vertices = [](const Polygon& polygon) { return static_cast<std::uint8_t>(polygon.count); };
        add(a, b, {a.radius, b.radius, vertices(a), vertices(b)}, bInA, reach);
    }
    /// Whether a pair was too doubtful for the batch, and is collided by itself. @pre collided
    bool isLeft(std::size_t pair) const {
        return kind_ == PairKind::round && ((pairs_.plain | pairs_.apart) >> pair & 1U) == 0;
    }
    /// All that were added. @pre there is one; `canCollideInBatches`
    void collide();
    /// @param memory    of the two shapes; keeps how far apart they are, where they are
    /// @param manifold  as made; what becomes of it. (Not returned: a copy of what was just written has to wait for
    /// it.)
    /// @pre collided
    void takeManifold(std::size_t pair, ManifoldMemory& memory, Manifold& manifold) const;
    void clear() { size_ = 0; }

private:
    void copyPoints(std::size_t pair, Manifold& manifold) const;
    Manifold otherManifold(std::size_t pair, ManifoldMemory& memory) const;

    WidePairs pairs_;
    std::size_t size_ = 0;
    PairKind kind_;
};

}  // namespace swept::inline SWEPT_PRECISION
