#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "joint_support.h"

/// Springs of hinges, sliders and wheels that pull to another place than the one at which the joint was made.

namespace swept::test {
namespace {

enum class Kind : std::uint8_t { hinge, slider, wheel };
constexpr Kind kKinds[] = {Kind::hinge, Kind::slider, Kind::wheel};

const DVec2 kAnchor{0.6, 0.1};
const DVec2 kAxis{0.8, 0.6};

/// Two bodies on a joint, the first one fixed unless told otherwise. @param placed  of B, along the joint: where it is
/// as the joint is made
struct Tied {
    Tied(Kind given, const WorldSettings& settings, const Spring& spring, double placed, double target,
         std::optional<AngleLimits> limits, bool isFree)
        : kind(given), world(makeWorld(settings)) {
        a = addBody(world, bodyAt(isFree ? BodyType::dynamic : BodyType::fixed, {}), box(0.3, 0.2));
        const bool turns = kind == Kind::hinge;
        const DVec2 place = turns ? kAnchor + turned(kCenter - kAnchor, placed) : kCenter + placed * kAxis;
        BodyDef def = bodyAt(BodyType::dynamic, place, turns ? placed : 0);
        b = addBody(world, def, box(0.3, 0.25));
        const DVec2 anchor = turns ? kAnchor : kAnchor + placed * kAxis;
        if (turns) {
            const RevoluteJointDef hinge{.base = between(a, b),
                                         .anchor = anchor,
                                         .limits = limits,
                                         .spring = spring,
                                         .springTarget = real(target)};
            joint = must(world.createJoint(hinge));
            return;
        }
        std::optional<TranslationLimits> room;
        if (limits) { room = TranslationLimits{limits->lower, limits->upper}; }
        if (kind == Kind::slider) {
            PrismaticJointDef slider{.base = between(a, b), .anchor = anchor, .axis = kAxis, .limits = room};
            slider.spring = spring;
            slider.springTarget = real(target);
            joint = must(world.createJoint(slider));
        } else {
            WheelJointDef wheel{.base = between(a, b), .anchor = anchor, .axis = kAxis, .limits = room};
            wheel.spring = spring;
            wheel.springTarget = real(target);
            joint = must(world.createJoint(wheel));
        }
    }

    double place() const {
        return kind == Kind::hinge ? world.jointAngle(joint) : static_cast<double>(world.jointTranslation(joint));
    }

    static constexpr DVec2 kCenter{1.2, 0};
    Kind kind;
    World world;
    BodyId a;
    BodyId b;
    JointId joint;
};

std::string targetCase(Kind kind, Profile profile, bool isFree) {
    return "kind " + std::to_string(static_cast<int>(kind)) + ' ' + profileName(profile) + (isFree ? " free" : "");
}

/// One that was made where its spring pulls to, and put back from there, moves alike.
void expectAsIfMadeThere(Kind kind, Profile profile, bool isFree) {
    const std::string name = targetCase(kind, profile, isFree);
    const WorldSettings settings = awakeSettings(profile, isFree ? 0 : kGravity);
    const Spring spring{2, real(0.3)};
    const double target = 0.5;
    const AngleLimits limits{real(-0.75), real(0.625)};
    const AngleLimits fromTarget{limits.lower - real(target), limits.upper - real(target)};
    Tied aimed(kind, settings, spring, 0, target, limits, isFree);
    Tied made(kind, settings, spring, target, 0, fromTarget, isFree);
    must(made.world.setPose(made.b, Tied::kCenter, 0));
    double farthest = 0;
    for (int i = 0; i < 120; ++i) {
        must(aimed.world.step(kStep));
        must(made.world.step(kStep));
        farthest = std::max(farthest, length(aimed.world.position(aimed.b) - made.world.position(made.b)));
        farthest = std::max(farthest, std::abs(aimed.world.angle(aimed.b) - made.world.angle(made.b)));
    }
    expectAtMost(name, farthest, 1e-4);
    expectAtMost(name + " place", std::abs(aimed.place() - made.place() - target), 1e-4);
    if (isFree) { expectAtMost(name + " rest", std::abs(aimed.place() - target), 0.05); }
}

TEST(SpringTargets, AreAsIfTheJointHadBeenMadeThere) {
    for (const Profile profile : kProfiles) {
        for (const Kind kind : kKinds) {
            expectAsIfMadeThere(kind, profile, false);
            // That of a wheel has its hertz with the arms that its free bodies have as the joint is made.
            if (kind != Kind::wheel) { expectAsIfMadeThere(kind, profile, true); }
        }
    }
}

/// A target that jumps is work, and from then on nothing is gained or lost: the spring swings as far beyond it.
TEST(SpringTargets, JumpsLetUndampedSpringsSwing) {
    for (const Profile profile : kProfiles) {
        for (const Kind kind : kKinds) {
            const std::string name = targetCase(kind, profile, false);
            Tied tied(kind, awakeSettings(profile, 0), {1, 0}, 0, 0, std::nullopt, false);
            run(tied.world, 10);
            expectAtMost(name + " before", std::abs(tied.place()), 1e-6);
            must(tied.world.setSpringTarget(tied.joint, real(0.3)));
            double farthest = 0;
            double back = 1;
            for (int i = 0; i < 600; ++i) {
                must(tied.world.step(kStep));
                farthest = std::max(farthest, tied.place());
                if (i > 300) { back = std::min(back, tied.place()); }
            }
            expectAtMost(name + " farthest", std::abs(farthest - 0.6), 0.012);
            expectAtMost(name + " back", std::abs(back), 0.012);
        }
    }
}

/// As many as fill blocks of the wide kernels, each with another target, beyond the limits of some.
TEST(SpringTargets, OfManyAtOnce) {
    for (const Profile profile : kProfiles) {
        for (const Kind kind : kKinds) {
            World world = makeWorld(profile, 0);
            std::vector<JointId> joints;
            std::vector<double> wanted;
            for (int i = 0; i < 40; ++i) {
                const DVec2 place{4.0 * i, 0};
                const BodyId a = addBody(world, dynamicAt(place), box(0.5, 0.5));
                const BodyId b = addBody(world, dynamicAt(place + DVec2{1.5, 0}), box(0.4, 0.3));
                const double target = -0.6 + 0.03 * i;
                wanted.push_back(std::min(target, 0.375));
                const Spring spring{2, 1};
                if (kind == Kind::hinge) {
                    RevoluteJointDef def{.base = between(a, b), .anchor = place + DVec2{0.75, 0}, .spring = spring};
                    def.limits = AngleLimits{-1, real(0.375)};
                    def.springTarget = real(target);
                    joints.push_back(must(world.createJoint(def)));
                } else if (kind == Kind::slider) {
                    PrismaticJointDef def{.base = between(a, b), .anchor = place, .axis = {0.1, 1}, .spring = spring};
                    def.limits = TranslationLimits{-1, real(0.375)};
                    def.springTarget = real(target);
                    joints.push_back(must(world.createJoint(def)));
                } else {
                    WheelJointDef def{.base = between(a, b), .anchor = place + DVec2{1.5, 0}, .axis = {0.1, 1}};
                    def.limits = TranslationLimits{-1, real(0.375)};
                    def.spring = spring;
                    def.springTarget = real(target);
                    joints.push_back(must(world.createJoint(def)));
                }
            }
            runFor(world, 4);
            double off = 0;
            for (std::size_t i = 0; i < joints.size(); ++i) {
                const double place = kind == Kind::hinge ? world.jointAngle(joints[i])
                                                         : static_cast<double>(world.jointTranslation(joints[i]));
                off = std::max(off, std::abs(place - wanted[i]));
            }
            expectAtMost(targetCase(kind, profile, true), off, 0.003);
        }
    }
}

TEST(SpringTargets, AreSetReadAndRefused) {
    Tied tied(Kind::slider, {}, {2, 1}, 0, 0.25, std::nullopt, false);
    const auto targetNow = [&] { return std::get<PrismaticJointDef>(tied.world.definition(tied.joint)).springTarget; };
    EXPECT_EQ(targetNow(), real(0.25));
    runFor(tied.world, 20);
    EXPECT_FALSE(tied.world.isAwake(tied.b));
    must(tied.world.setSpringTarget(tied.joint, real(0.5)));
    EXPECT_TRUE(tied.world.isAwake(tied.b));
    EXPECT_EQ(targetNow(), real(0.5));

    World other = tied.world;
    auto def = std::get<PrismaticJointDef>(tied.world.definition(tied.joint));
    def.springTarget = real(-0.5);
    must(tied.world.redefine(tied.joint, def));
    must(other.setSpringTarget(tied.joint, real(-0.5)));
    run(tied.world, 30);
    run(other, 30);
    EXPECT_EQ(tied.world.stateHash(), other.stateHash());

    const Real nan = std::numeric_limits<Real>::quiet_NaN();
    EXPECT_EQ(tied.world.setSpringTarget(tied.joint, nan).code, StatusCode::notFinite);
    EXPECT_STREQ(tied.world.setSpringTarget(tied.joint, nan).field, "springTarget");
    def.springTarget = std::numeric_limits<Real>::max();
    EXPECT_EQ(tied.world.redefine(tied.joint, def).code, StatusCode::outOfRange);
    EXPECT_EQ(tied.world.createJoint(def).status().code, StatusCode::outOfRange);
    const JointId rod =
        must(tied.world.createJoint(DistanceJointDef{.base = between(tied.a, tied.b), .anchorB = {1.2, 0}}));
    EXPECT_EQ(tied.world.setSpringTarget(rod, 1).code, StatusCode::wrongJointType);
    EXPECT_EQ(tied.world.setSpringTarget({}, 1).code, StatusCode::staleId);
    EXPECT_EQ(targetNow(), real(-0.5));
}

/// A rod on another one, on a body that is led down into the ground and along it. No spring is between the rods.
struct Led {
    Led(Kind kind, Profile profile) : world(makeWorld(awakeSettings(profile))) {
        addBody(world, bodyAt(BodyType::fixed, {0, -0.5}), box(20, 0.5));
        leader = addBody(world, bodyAt(BodyType::kinematic, {0, 3}), box(0.2, 0.2));
        const BodyId near = addBody(world, dynamicAt({1, 3}), box(0.9, 0.1));
        const BodyId far = addBody(world, dynamicAt({2.8, 3}), box(0.9, 0.1));
        must(world.createJoint(RevoluteJointDef{.base = between(leader, near), .anchor = {0.1, 3}}));
        const DVec2 anchor{1.9, 3};
        if (kind == Kind::hinge) {
            joint = must(world.createJoint(RevoluteJointDef{.base = between(near, far), .anchor = anchor}));
        } else if (kind == Kind::slider) {
            const TranslationLimits room{real(-0.5), real(0.5)};
            joint = must(world.createJoint(
                PrismaticJointDef{.base = between(near, far), .anchor = anchor, .axis = {1, 0}, .limits = room}));
        } else {
            const TranslationLimits room{real(-0.5), real(0.5)};
            joint = must(world.createJoint(
                WheelJointDef{.base = between(near, far), .anchor = anchor, .axis = {0, 1}, .limits = room}));
        }
    }
    void step() {
        if (world.position(leader).y < -1) { speed = {3, 0}; }
        must(world.setVelocity(leader, speed, 0));
        must(world.step(kStep));
    }

    World world;
    Vec2 speed{0, -2};
    BodyId leader;
    JointId joint;
};

/// No more than a call that wakes: it moves nothing that holds the bodies.
TEST(SpringTargets, ThatAreSetWithoutASpringDoNothing) {
    for (const Profile profile : kProfiles) {
        for (const Kind kind : kKinds) {
            Led set(kind, profile);
            Led left(kind, profile);
            for (int i = 0; i < 240; ++i) {
                must(set.world.setSpringTarget(set.joint, real(i % 2)));
                set.step();
                left.step();
            }
            EXPECT_EQ(set.world.stateHash(), left.world.stateHash()) << targetCase(kind, profile, true);
        }
    }
}

/// A rod on a body that is led, which limits and a spring turn or slide together, against a crate.
std::uint64_t hashOfTurned(Kind kind, Profile profile, double rate, bool isTargetFirst) {
    World world = makeWorld(awakeSettings(profile));
    addBody(world, bodyAt(BodyType::fixed, {0, -3}), box(20, 0.5));
    const BodyId hub = addBody(world, bodyAt(BodyType::kinematic, {}), box(0.2, 0.2));
    const BodyId rod = addBody(world, dynamicAt({1.2, 0}), box(1, 0.1));
    addBody(world, dynamicAt({2, 0.6}), box(0.3, 0.3));
    addBody(world, bodyAt(BodyType::fixed, {0.5, 1.5}), box(0.3, 0.3));
    const DVec2 anchor{0.1, 0};
    const Spring spring{3, 1};
    JointId joint;
    if (kind == Kind::hinge) {
        joint =
            must(world.createJoint(RevoluteJointDef{.base = between(hub, rod), .anchor = anchor, .spring = spring}));
    } else if (kind == Kind::slider) {
        joint = must(world.createJoint(
            PrismaticJointDef{.base = between(hub, rod), .anchor = anchor, .axis = {0, 1}, .spring = spring}));
    } else {
        joint = must(world.createJoint(
            WheelJointDef{.base = between(hub, rod), .anchor = anchor, .axis = {0, 1}, .spring = spring}));
    }
    for (int i = 0; i < 120; ++i) {
        const double place = rate * i * kStep;
        const Real lower = real(place - 0.1);
        const Real upper = real(place + 0.1);
        const auto aim = [&] { must(world.setSpringTarget(joint, real(place + 0.05))); };
        if (isTargetFirst) { aim(); }
        if (kind == Kind::hinge) {
            must(world.setAngleLimits(joint, AngleLimits{lower, upper}));
        } else {
            must(world.setTranslationLimits(joint, TranslationLimits{lower, upper}));
        }
        if (!isTargetFirst) { aim(); }
        must(world.step(kStep));
    }
    return world.stateHash();
}

/// Whichever of the two is set first.
TEST(SpringTargets, AndLimitsAreSetInAnyOrder) {
    for (const Profile profile : kProfiles) {
        for (const Kind kind : kKinds) {
            for (const double rate : {0.3, 3.0, 10.0, 20.0}) {
                EXPECT_EQ(hashOfTurned(kind, profile, rate, true), hashOfTurned(kind, profile, rate, false))
                    << targetCase(kind, profile, true) << ' ' << rate;
            }
        }
    }
}

/// Without a spring it does nothing.
TEST(SpringTargets, WithoutASpringAreNone) {
    for (const Kind kind : kKinds) {
        Tied with(kind, {}, {2, 1}, 0, 0.25, AngleLimits{real(-0.5), real(0.5)}, false);
        Tied without(kind, {}, {2, 1}, 0, 0, AngleLimits{real(-0.5), real(0.5)}, false);
        must(with.world.setSpring(with.joint, std::nullopt));
        must(without.world.setSpring(without.joint, std::nullopt));
        run(with.world, 60);
        run(without.world, 60);
        EXPECT_EQ(with.world.stateHash(), without.world.stateHash());
    }
}

}  // namespace
}  // namespace swept::test
