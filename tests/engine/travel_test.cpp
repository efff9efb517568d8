#include <swept/shapes/distance.h>

#include <random>
#include <set>

#include "world_support.h"

/// Contacts that are known to be apart are not looked at: none of those that have points may be missed by that,
/// whatever happened to the bodies in between. The oracle measures the distance of every pair of shapes before each
/// step.

namespace swept::test {
namespace {

struct Piece {
    BodyId body;
    ShapeId shape;
    Polygon polygon;
    Real extent;
};

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Pair pairOf(ShapeId a, ShapeId b) { return {std::min(a.index, b.index), std::max(a.index, b.index)}; }

Polygon boxAt(double halfX, double halfY, double x, double y) { return must(makeBox(vec(halfX, halfY), vec(x, y))); }

/// Bodies in a pit, which change in many ways.
struct Pit {
    World world;
    std::vector<Piece> pieces;
    std::mt19937 random{7};

    explicit Pit(const WorldSettings& settings) : world(makeWorld(settings)) {
        const BodyId walls = must(world.createBody(bodyAt(BodyType::fixed, {0, 0})));
        for (const Polygon& wall : {boxAt(4, 0.5, 0, -0.5), boxAt(0.5, 6, -4.5, 5), boxAt(0.5, 6, 4.5, 5)}) {
            add(walls, wall);
        }
        for (int i = 0; i < 40; ++i) {
            const DVec2 place{-3 + 1.2 * (i % 6) + 0.1 * (i / 6 % 2), 0.6 + 1.05 * (i / 6)};
            const BodyId body = must(world.createBody(dynamicAt(place, {}, 0.3 * i)));
            add(body, i % 3 == 0 ? circle(0.4) : (i % 3 == 1 ? box(0.4, 0.3) : box(0.2, 0.5)));
            if (i % 5 == 0) {
                add(body, boxAt(0.15, 0.15, 0.45, 0));
            }
        }
    }
    void add(BodyId body, const Polygon& polygon) {
        pieces.push_back({body, must(world.addShape(body, polygon, material(0.4))), polygon, extentOf(polygon)});
    }
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
    WorldTransform poseOf(const Piece& piece) const {
        return {world.position(piece.body), rotationFromAngle(world.angle(piece.body))};
    }
    BodyId anyBody() { return pieces[3 + random() % (pieces.size() - 3)].body; }

    /// What a game may do between two steps.
    void disturb(int step) {
        if (step % 11 == 3) {
            must(world.setVelocity(anyBody(), vec(number(-3, 3), number(0, 4)), real(number(-4, 4))));
        }
        if (step % 17 == 5) {
            must(world.setAwake(anyBody(), false));
        }
        if (step % 23 == 7) {
            must(world.setPose(anyBody(), {number(-3, 3), number(5, 8)}, number(-3, 3)));
        }
        if (step % 41 == 9 && step < 200) {
            add(anyBody(), boxAt(0.1, 0.1, number(-0.5, 0.5), number(-0.5, 0.5)));
        }
    }

    /// Pairs of dynamic bodies that touch, or nearly do.
    std::set<Pair> pairsThatTouch() const {
        constexpr double kNear = 1.0 / 512;  // contacts last beyond that
        std::set<Pair> close;
        for (std::size_t i = 3; i < pieces.size(); ++i) {
            for (std::size_t j = i + 1; j < pieces.size(); ++j) {
                const Piece& a = pieces[i];
                const Piece& b = pieces[j];
                if (a.body == b.body || (!world.isAwake(a.body) && !world.isAwake(b.body))) {
                    continue;
                }
                const double gap = distance(a.polygon, b.polygon, relativeTransform(poseOf(a), poseOf(b))).distance;
                const auto extent = static_cast<double>(std::min(a.extent, b.extent));
                if (gap < kNear * extent) {
                    close.insert(pairOf(a.shape, b.shape));
                }
            }
        }
        return close;
    }
    std::set<Pair> pairsFound() const {
        std::set<Pair> found;
        world.visitContacts([&found](const ContactView& view) { found.insert(pairOf(view.shapeA, view.shapeB)); });
        return found;
    }
};

TEST(Travel, NoContactIsMissed) {
    WorldSettings settings;
    settings.gravity = vec(0, -kGravity);
    settings.continuous = ContinuousMode::off;  // impacts within the step would leave manifolds of later poses
    Pit pit(settings);
    std::size_t seen = 0;
    std::size_t notLookedAt = 0;
    for (int step = 0; step < 300; ++step) {
        pit.disturb(step);
        const std::set<Pair> close = pit.pairsThatTouch();
        must(pit.world.step(step % 50 < 40 ? kStep : kStep / 3));
        const std::set<Pair> found = pit.pairsFound();
        for (const Pair& pair : close) {
            EXPECT_TRUE(found.contains(pair)) << "step " << step << ", shapes " << pair.first << " and " << pair.second;
        }
        if (HasFailure()) {
            return;
        }
        seen += close.size();
        notLookedAt +=
            pit.world.counters().contacts - std::min(pit.world.counters().contacts, pit.world.counters().manifolds);
    }
    EXPECT_GT(seen, 10'000U) << "too few contacts to prove anything";
    EXPECT_GT(notLookedAt, 3'000U) << "too few were told to be apart";
}

}  // namespace
}  // namespace swept::test
