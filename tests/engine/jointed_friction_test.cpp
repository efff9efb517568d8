#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "joint_support.h"

/// What friction holds on bodies whose joints are solved all at once, while contacts are solved one by one: it stays.

namespace swept::test {
namespace {

constexpr int kStepsPerSecond = 60;  // steps

World accurateWorld() { return makeWorld(awakeSettings(Profile::accurate)); }

// --- a rope around a post

constexpr double kPost = 1;           ///< radius, m
constexpr double kRopeRadius = 0.05;  ///< of its links
constexpr double kOnPost = kPost + 0.06;
constexpr double kHanging = 2;  ///< of each of its ends, m
constexpr int kRopeLinks = 40;
constexpr double kRopeLength = 2 * kHanging + std::numbers::pi * kOnPost;
constexpr double kRopeFriction = 0.3;  ///< holds e^(μπ) = 2.57 times the load
constexpr double kLightLoad = 10;      ///< kg

/// Along the rope, the post at the origin.
DVec2 placeOnRope(double way) {
    if (way < kHanging) { return {-kOnPost, way - kHanging}; }
    const double turned = (way - kHanging) / kOnPost;
    if (turned < std::numbers::pi) { return {-kOnPost * std::cos(turned), kOnPost * std::sin(turned)}; }
    return {kOnPost, kHanging + std::numbers::pi * kOnPost - way};
}

struct Capstan {
    World world = accurateWorld();
    BodyId heavy{};

    /// @param ratio  of the load at one end to that at the other
    explicit Capstan(double ratio) {
        addStatic(world, circle(kPost), material(kRopeFriction));
        std::vector<BodyId> links;
        for (int i = 0; i < kRopeLinks; ++i) {
            const DVec2 begin = placeOnRope(i * kRopeLength / kRopeLinks);
            const DVec2 way = placeOnRope((i + 1) * kRopeLength / kRopeLinks) - begin;
            links.push_back(addBody(world, bodyAt(BodyType::dynamic, begin + 0.5 * way, std::atan2(way.y, way.x)),
                                    capsule(0.5 * length(way), kRopeRadius), material(kRopeFriction)));
            if (i > 0) { hinge(links[links.size() - 2], links.back(), begin); }
        }
        hang(links.front(), placeOnRope(0), kLightLoad);
        heavy = hang(links.back(), placeOnRope(kRopeLength), ratio * kLightLoad);
    }
    double height() const { return world.position(heavy).y; }

private:
    void hinge(BodyId a, BodyId b, DVec2 anchor) {
        must(world.createJoint(RevoluteJointDef{.base = between(a, b), .anchor = anchor}));
    }
    BodyId hang(BodyId link, DVec2 end, double mass) {
        BodyDef def = dynamicAt(end - DVec2{0, 0.4});
        def.mass = real(mass);
        const BodyId load = addBody(world, def, box(0.4, 0.4));
        hinge(link, load, end);
        return load;
    }
};

/// (It crept by millimetres a second.)
TEST(JointedFriction, ARopeAroundAPostHoldsTwiceItsLoad) {
    Capstan capstan(2);
    run(capstan.world, 2 * kStepsPerSecond);
    const double before = capstan.height();
    run(capstan.world, kStepsPerSecond);
    EXPECT_NEAR(capstan.height(), before, 2e-4);
}

TEST(JointedFriction, ARopeAroundAPostSlipsUnderMore) {
    Capstan capstan(3);
    run(capstan.world, 2 * kStepsPerSecond);
    EXPECT_LT(capstan.height(), -kHanging - 1);
}

// --- a crate between two fingers

/// Motors of 400 N·m press light fingers on a crate of 80 N; they hang on a heavy head that brakes hold, as a crane
/// does.
struct Grip {
    World world = accurateWorld();
    BodyId crate{};

    explicit Grip(double headDensity) {
        constexpr Filter kNothing{.category = 2, .mask = 0};
        const BodyId ground = anchorOf(world);
        const ShapeDef heavy{.density = real(headDensity), .filter = kNothing};
        const BodyId trolley = addBody(world, dynamicAt({0, 9}), box(0.5, 0.2), heavy);
        const BodyId head = addBody(world, dynamicAt({0, 7.5}), box(0.5, 0.15), heavy);
        slide(ground, trolley, {0, 9}, {1, 0}, 5000);
        slide(trolley, head, {0, 7.5}, {0, 1}, 10000);
        BodyDef def = dynamicAt({0, 6.5});
        def.mass = real(8);
        crate = addBody(world, def, box(0.4, 0.4), material(0.6));
        for (const int side : {-1, 1}) {
            const DVec2 anchor{side * 0.5, 7.4};
            const BodyId finger = addBody(world, dynamicAt({side * 0.6, 6.95}), box(0.06, 0.45), material(0.9, 0, 40));
            RevoluteJointDef joint{.base = between(head, finger), .anchor = anchor};
            joint.motor = AngularMotor{.speed = real(-1.5 * side), .maxTorque = 400};
            must(world.createJoint(joint));
        }
    }

private:
    void slide(BodyId a, BodyId b, DVec2 anchor, DVec2 axis, double force) {
        PrismaticJointDef joint{.base = between(a, b), .anchor = anchor, .axis = axis};
        joint.motor = LinearMotor{.speed = 0, .maxForce = real(force)};
        must(world.createJoint(joint));
    }
};

/// (It climbed by 1.8 mm/s.)
TEST(JointedFriction, ACrateStaysBetweenTheFingersOfAHeavyCrane) {
    for (const double density : {150.0, 400.0, 1500.0}) {
        Grip grip(density);
        run(grip.world, 2 * kStepsPerSecond);
        const double before = grip.world.position(grip.crate).y;
        run(grip.world, 3 * kStepsPerSecond);
        EXPECT_NEAR(grip.world.position(grip.crate).y, before, 5e-5) << density;
    }
}

// --- a crate on a beam

struct LoadedBeam {
    World world = accurateWorld();
    JointId root{};
    BodyId tip{};
    BodyId crate{};
    DVec2 along;        ///< the beam
    double torque = 0;  ///< at the root, by statics

    static constexpr double kBarMass = 10;

    /// Bars of 1 m, welded to each other and to the ground, and a crate over the tip.
    LoadedBeam(int bars, double ratio, double slope) : along{std::cos(slope), std::sin(slope)} {
        const DVec2 across{-along.y, along.x};
        BodyId before = anchorOf(world);
        const auto carry = [this](DVec2 place, double mass) { torque += mass * kGravity * place.x; };
        for (int i = 0; i < bars; ++i) {
            const DVec2 place = (i + 0.5) * along;
            tip = addBody(world, bodyAt(BodyType::dynamic, place, slope), box(0.5, 0.1),
                          {.density = real(kBarMass / 0.2), .friction = real(0.5)});
            const JointId weld =
                must(world.createJoint(WeldJointDef{.base = between(before, tip), .anchor = double(i) * along}));
            if (i == 0) { root = weld; }
            carry(place, kBarMass);
            before = tip;
        }
        const DVec2 top = (bars - 0.5) * along + 0.3 * across;
        BodyDef def = bodyAt(BodyType::dynamic, top, slope);
        def.mass = real(ratio * kBarMass);
        crate = addBody(world, def, box(0.2, 0.2), material(0.5));
        carry(top, ratio * kBarMass);
    }
    double slid() const { return dot(world.position(crate) - world.position(tip), along); }
};

/// (It slid by up to 2.5 mm/s to either side, and the torque at the root was off by a sixth for a crate of ten times
/// the mass of a bar, by a third for one of a hundred times.)
TEST(JointedFriction, ACrateOnABeamStaysAndIsWeighed) {
    for (const int bars : {4, 12}) {
        for (const double ratio : {10.0, 100.0}) {
            for (const double slope : {0.0, 0.4}) {
                const std::string what =
                    std::to_string(bars) + " bars, ratio " + std::to_string(ratio) + ", slope " + std::to_string(slope);
                LoadedBeam beam(bars, ratio, slope);
                run(beam.world, 2 * kStepsPerSecond);
                const double before = beam.slid();
                double farthest = 0;
                for (int i = 0; i < kStepsPerSecond; ++i) {
                    run(beam.world, 1);
                    const auto torque = static_cast<double>(beam.world.jointTorque(beam.root));
                    farthest = std::max(farthest, std::fabs(std::fabs(torque) - beam.torque));
                }
                EXPECT_NEAR(beam.slid(), before, 1e-4) << what;
                EXPECT_LT(farthest, 2e-3 * beam.torque) << what;
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
