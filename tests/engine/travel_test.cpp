#include <swept/shapes/distance.h>
#include <swept/shapes/manifold.h>

#include <map>
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

using ShapePair = std::pair<std::uint32_t, std::uint32_t>;

ShapePair pairOf(ShapeId a, ShapeId b) { return {std::min(a.index, b.index), std::max(a.index, b.index)}; }

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
            if (i % 5 == 0) { add(body, boxAt(0.15, 0.15, 0.45, 0)); }
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
        if (step % 17 == 5) { must(world.setAwake(anyBody(), false)); }
        if (step % 23 == 7) { must(world.setPose(anyBody(), {number(-3, 3), number(5, 8)}, number(-3, 3))); }
        if (step % 41 == 9 && step < 200) { add(anyBody(), boxAt(0.1, 0.1, number(-0.5, 0.5), number(-0.5, 0.5))); }
    }

    /// Pairs of dynamic bodies that touch, or nearly do.
    std::set<ShapePair> pairsThatTouch() const {
        constexpr double kNear = 1.0 / 512;  // contacts last beyond that
        std::set<ShapePair> close;
        for (std::size_t i = 3; i < pieces.size(); ++i) {
            for (std::size_t j = i + 1; j < pieces.size(); ++j) {
                const Piece& a = pieces[i];
                const Piece& b = pieces[j];
                if (a.body == b.body || (!world.isAwake(a.body) && !world.isAwake(b.body))) { continue; }
                const double gap = distance(a.polygon, b.polygon, relativeTransform(poseOf(a), poseOf(b))).distance;
                const auto extent = static_cast<double>(std::min(a.extent, b.extent));
                if (gap < kNear * extent) { close.insert(pairOf(a.shape, b.shape)); }
            }
        }
        return close;
    }
    std::set<ShapePair> pairsFound() const {
        std::set<ShapePair> found;
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
        const std::set<ShapePair> close = pit.pairsThatTouch();
        must(pit.world.step(step % 50 < 40 ? kStep : kStep / 3));
        const std::set<ShapePair> found = pit.pairsFound();
        for (const ShapePair& pair : close) {
            EXPECT_TRUE(found.contains(pair)) << "step " << step << ", shapes " << pair.first << " and " << pair.second;
        }
        if (HasFailure()) { return; }
        seen += close.size();
        notLookedAt +=
            pit.world.counters().contacts - std::min(pit.world.counters().contacts, pit.world.counters().manifolds);
    }
    EXPECT_GT(seen, 10'000U) << "too few contacts to prove anything";
    EXPECT_GT(notLookedAt, 3'000U) << "too few were told to be apart";
}

/// A pyramid that stands or settles; poses before the step.
struct Pyramid {
    static constexpr double kHalf = 0.5;
    World world = makeWorld();
    std::vector<Piece> pieces;

    Pyramid() {
        const BodyId floor = must(world.createBody(bodyAt(BodyType::fixed, {0, -1})));
        const Polygon ground = box(20, 1);
        pieces.push_back({floor, must(world.addShape(floor, ground, material(0.6))), ground, extentOf(ground)});
        for (int row = 0; row < 6; ++row) {
            for (int i = row; i < 6; ++i) {
                const DVec2 place{1.05 * i - 0.525 * row, kHalf + 1.01 * row};
                const BodyId body = must(world.createBody(dynamicAt(place)));
                const Polygon brick = box(kHalf, kHalf);
                pieces.push_back({body, must(world.addShape(body, brick, material(0.6))), brick, extentOf(brick)});
            }
        }
    }
    const Piece& pieceOf(ShapeId shape) const {
        return *std::find_if(pieces.begin(), pieces.end(), [&](const Piece& piece) { return piece.shape == shape; });
    }
    std::vector<WorldTransform> poses() const {
        std::vector<WorldTransform> all;
        for (const Piece& piece : pieces) {
            all.push_back({world.position(piece.body), rotationFromAngle(world.angle(piece.body))});
        }
        return all;
    }
};

TEST(Travel, KeptManifoldsAreThoseOfNow) {
    Pyramid pyramid;
    // A few roundings of the coordinates, and twice the motion up to which points stay where they are.
    const double rounding = 64 * static_cast<double>(kEpsilon);
    const double stays = kIsDouble ? 0x1p-25 : 0x1p-11;
    int compared = 0;
    for (int step = 0; step < 200; ++step) {
        const std::vector<WorldTransform> poses = pyramid.poses();
        must(pyramid.world.step(kStep));
        std::map<ShapePair, std::vector<ContactView>> contacts;
        pyramid.world.visitContacts(
            [&](const ContactView& view) { contacts[pairOf(view.shapeA, view.shapeB)].push_back(view); });
        for (const auto& [pair, views] : contacts) {
            const Piece& a = pyramid.pieceOf(views[0].shapeA);
            const Piece& b = pyramid.pieceOf(views[0].shapeB);
            const WorldTransform& poseA = poses[static_cast<std::size_t>(&a - pyramid.pieces.data())];
            const WorldTransform& poseB = poses[static_cast<std::size_t>(&b - pyramid.pieces.data())];
            const Manifold now = collide(a.polygon, b.polygon, relativeTransform(poseA, poseB), real(0.01));
            if (now.count != 2 || views.size() != 2) { continue; }
            const Rotation rotationNow = rotationFromAngle(pyramid.world.angle(a.body));  // views are of after the step
            const double turned = std::abs(cross(views[0].normal, rotate(rotationNow, now.normal)));
            // Two faces may both be the reference: then normals differ by the angle between them.
            const auto tilt = static_cast<double>(std::abs((inverse(poseA.rotation) * poseB.rotation).s));
            EXPECT_LE(turned, tilt + rounding) << "step " << step;
            const Vec2 first = unrotate(rotationNow, toReal(views[0].point - pyramid.world.position(a.body)));
            // The other face as reference gives the other order.
            const bool isSwapped = length(first - now.points[1].point) < length(first - now.points[0].point);
            for (std::size_t i = 0; i < 2; ++i) {
                const auto separation = static_cast<double>(now.points[isSwapped ? 1 - i : i].separation);
                EXPECT_NEAR(static_cast<double>(views[i].separation), separation,
                            tilt * (stays + tilt + std::abs(separation)) + rounding)
                    << "step " << step;
            }
            ++compared;
        }
        if (HasFailure()) { return; }
    }
    EXPECT_GT(compared, 6'000) << "too few contacts to prove anything";
}

}  // namespace
}  // namespace swept::test
