#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checks.h"

namespace swept {
namespace {

/// Way of its fastest point in a step, by its start and its motors alone, metres. What falls from high up is as fast
/// only where it arrives, and mostly falls beside others that do, too.
double wayOf(const PlacedScene& placed, const PlacedBody& body) {
    return std::max(body.speed, body.drive) * placed.scene->settings.dt;
}

/// What no bullet is among, and may pass others within a step: no longer than half of both together, it leaves an
/// overlap that the next step finds.
bool mayPass(const PlacedScene& placed, const PlacedBody& fast, const PlacedBody& other) {
    return other.isDynamic() && other.index != fast.index && other.extent > 0 && !isBullet(placed, other) &&
           wayOf(placed, fast) > 0.5 * (fast.extent + other.extent);
}

class Passing {
public:
    explicit Passing(const PlacedScene& placed) : placed_(placed), jointed_(jointedPairs(placed)) {
        firstPiece_.resize(placed.bodies.size() + 1);
        for (const PlacedPiece& piece : placed.pieces) { ++firstPiece_[static_cast<std::size_t>(piece.body) + 1]; }
        for (std::size_t i = 1; i < firstPiece_.size(); ++i) { firstPiece_[i] += firstPiece_[i - 1]; }
    }

    /// The first body that this one may pass; null: there is none.
    const PlacedBody* passedBy(const PlacedBody& fast) const {
        const bool isFast = wayOf(placed_, fast) > 0.5 * fast.extent;
        if (!fast.isDynamic() || fast.extent == 0 || isBullet(placed_, fast) || !isFast) { return nullptr; }
        const auto found = std::find_if(placed_.bodies.begin(), placed_.bodies.end(), [&](const PlacedBody& other) {
            return mayPass(placed_, fast, other) && collide(fast, other);
        });
        return found == placed_.bodies.end() ? nullptr : &*found;
    }

private:
    bool collide(const PlacedBody& a, const PlacedBody& b) const {
        if (jointed_.contains({std::min(a.index, b.index), std::max(a.index, b.index)})) { return false; }
        const auto begin = [this](const PlacedBody& body, std::size_t more) {
            return firstPiece_[static_cast<std::size_t>(body.index) + more];
        };
        for (std::size_t i = begin(a, 0); i < begin(a, 1); ++i) {
            for (std::size_t k = begin(b, 0); k < begin(b, 1); ++k) {
                if (mayCollide(placed_, placed_.pieces[i], placed_.pieces[k])) { return true; }
            }
        }
        return false;
    }

    const PlacedScene& placed_;
    std::set<std::pair<int, int>> jointed_;
    std::vector<std::size_t> firstPiece_;  ///< of each body; pieces are in the order of bodies
};

}  // namespace

void checkPassing(const PlacedScene& placed, std::vector<Finding>& findings) {
    const Passing passing(placed);
    const PlacedBody* first = nullptr;
    const PlacedBody* passed = nullptr;
    int more = 0;
    for (const PlacedBody& body : placed.bodies) {
        const PlacedBody* const other = passing.passedBy(body);
        if (other == nullptr) { continue; }
        more += first == nullptr ? 0 : 1;
        passed = first == nullptr ? other : passed;
        first = first == nullptr ? &body : first;
    }
    if (first == nullptr) { return; }
    findings.push_back({Severity::warning, "passing", pointerOf(*first),
                        first->name + " may move " + metres(wayOf(placed, *first)) + " in a step; it is " +
                            metres(first->extent) + " thick, " + passed->name + " " + metres(passed->extent) +
                            ": they may pass through each other, as neither is a bullet" +
                            (more > 0 ? " (and so may " + std::to_string(more) + " more)" : ""),
                        "\"bullet\": true on the fast ones, or a shorter step"});
}

}  // namespace swept
