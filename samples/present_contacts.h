#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "../broadphase/broadphase.h"
#include "../shapes/chain.h"
#include "world_builder.h"

namespace swept::inline SWEPT_PRECISION {

/// A point at which two bodies touch, or nearly do, where they are now.
struct PresentContact {
    int bodyA = 0;  ///< index in the scene
    int bodyB = 0;
    DVec2 point;  ///< world, half way between the two surfaces
    Vec2 normal;  ///< unit, from A to B
    Real separation = 0;
};

/// What the bodies of a scene touch at the poses that they have now. A step finds contacts as it begins, and moves
/// bodies then: the world's own list is that of a moment ago, and does not know what was met since.
///
/// Whether who came through a chain from its back passes it, or stands in it, poses cannot tell. So contacts with
/// chains are those which the last step had, too.
class PresentContacts {
public:
    /// Separation up to which shapes count as touching, as a part of the smaller extent: that at which the engine ends
    /// contacts.
    static constexpr Real kTouchRatio = Real(1) / 256;

    /// @param built  the world of the scene, whose shapes stay; must outlive this, as the scene must
    PresentContacts(const SceneDescription& scene, const SceneWorld& built);

    /// Of all bodies. @param hasStepped  whether the world knows contacts yet
    const std::vector<PresentContact>& all(bool hasStepped);
    /// Of those that the last step moved.
    const std::vector<PresentContact>& ofMoved();

private:
    struct Piece {
        std::size_t body = 0;
        ShapeId shape{};
        Filter filter;
        Polygon polygon;
        Real extent = 0;
        ProxyId proxy{};
        std::optional<ChainSegment> segment;
    };
    struct Placed {
        WorldTransform pose;
        std::size_t firstPiece = 0;
        std::size_t endPiece = 0;
        bool isDynamic = false;
        bool isAsked = false;  ///< what it touches
    };
    using BodyPair = std::pair<std::size_t, std::size_t>;       ///< lower index first
    using ShapePair = std::pair<std::uint32_t, std::uint32_t>;  ///< a chain and another shape, slots

    void addBody(std::size_t body, const BodyDescription& description);
    void addShape(std::size_t body, ShapeId shape, const ShapeDescription& description);
    void place(std::size_t body);
    void listChainPairs();
    void collideAsked(bool hasStepped);
    void collideWithOthers(std::size_t piece);
    void collidePair(const Piece& a, const Piece& b);
    bool isA(const Piece& a, const Piece& b) const;
    bool mayMeet(const Piece& a, const Piece& b) const;

    const SceneWorld& built_;
    std::vector<Placed> bodies_;
    std::vector<Piece> pieces_;  ///< by their proxies
    std::unique_ptr<Broadphase> tree_;
    std::multimap<BodyPair, std::size_t> jointed_;  ///< joints that keep their bodies apart
    bool hasChains_ = false;
    bool knowsChainPairs_ = false;
    std::vector<ShapePair> chainPairs_;  ///< that the last step had contacts of, sorted
    std::vector<std::size_t> others_;
    std::vector<PresentContact> contacts_;
};

}  // namespace swept::inline SWEPT_PRECISION
