#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "joint_support.h"

/// Limits and lengths that calls move in every step take along what they hold, as the motor of a lift does.

namespace swept::test {
namespace {

enum class Hold { lowerLimit, bothLimits, rods, ropes };
constexpr std::array kHolds{Hold::lowerLimit, Hold::bothLimits, Hold::rods, Hold::ropes};

const char* nameOf(Hold hold) {
    constexpr std::array kNames{"slider on its lower limit", "slider between limits", "rods", "ropes"};
    return kNames[static_cast<std::size_t>(hold)];
}

/// A body that joints hold at a height that calls set.
class Hoist {
public:
    static constexpr double kHigh = 60;  ///< where rods and ropes hang

    Hoist(World& world, Hold hold, BodyId platform, double halfWidth) : world_(world), hold_(hold) {
        const BodyId base = anchorOf(world);
        if (hold == Hold::lowerLimit || hold == Hold::bothLimits) {
            PrismaticJointDef def;
            def.base = between(base, platform);
            def.anchor = world.position(platform);
            def.axis = {0, 1};
            def.limits = limitsAt(0);
            joints_.push_back(must(world.createJoint(def)));
            return;
        }
        for (const double side : {-halfWidth, halfWidth}) {
            DistanceJointDef def;
            def.base = between(base, platform);
            def.anchorB = world.position(platform) + DVec2{side, 0};
            def.anchorA = {side, kHigh};
            if (hold == Hold::ropes) { def.limits = LengthLimits{0, real(kHigh)}; }
            joints_.push_back(must(world.createJoint(def)));
        }
    }
    void setHeight(double height) {
        for (const JointId joint : joints_) {
            const Real length = real(kHigh - height);
            switch (hold_) {
                case Hold::lowerLimit:
                case Hold::bothLimits:
                    must(world_.setTranslationLimits(joint, limitsAt(height)));
                    break;
                case Hold::rods:
                    must(world_.setLength(joint, length));
                    break;
                case Hold::ropes:
                    must(world_.setLengthLimits(joint, LengthLimits{0, length}));
                    break;
            }
        }
    }
    /// Upwards, on the body, N.
    double force() const {
        double sum = 0;
        for (const JointId joint : joints_) { sum += static_cast<double>(world_.jointForce(joint).y); }
        return sum;
    }

private:
    TranslationLimits limitsAt(double height) const {
        return {real(height), hold_ == Hold::bothLimits ? real(height) : Real(1000)};
    }

    World& world_;
    Hold hold_;
    std::vector<JointId> joints_;
};

constexpr double kThin = 0.1;    ///< half of a platform
constexpr double kCrate = 0.15;  ///< half of a crate

/// A crate of 0.3 m on a platform that is raised. (It fell through from 0.5 m/s on in `accurate`, beside other places
/// of it, from 2 m/s on in any, and from 5 m/s on in `fast`; and the platform stood still as it rose.)
TEST(DrivenLimits, CarryWhatStandsOnThemUp) {
    for (const Profile profile : kProfiles) {
        for (const Hold hold : kHolds) {
            for (const double speed : {0.1, 0.5, 2.0, 5.0}) {
                World world = makeWorld(profile);
                const BodyId platform = addBody(world, dynamicAt({0, 0}), box(1, kThin));
                const BodyId crate = addBody(world, dynamicAt({0.2, kThin + kCrate}), box(kCrate, kCrate));
                Hoist hoist(world, hold, platform, 0.9);
                run(world, 30);
                constexpr int kSteps = 150;
                double lowest = 0;
                for (int i = 1; i <= kSteps; ++i) {
                    hoist.setHeight(speed * i * kStep);
                    run(world, 1);
                    const double above = world.position(crate).y - world.position(platform).y - kThin - kCrate;
                    lowest = std::min(lowest, above);
                }
                const double above = world.position(crate).y - world.position(platform).y - kThin - kCrate;
                const auto who = [&] {
                    return profileName(profile) + ", " + nameOf(hold) + ", " + std::to_string(speed) + " m/s";
                };
                EXPECT_GT(lowest, -0.05) << who();
                EXPECT_NEAR(above, 0, 0.002) << who();
                EXPECT_NEAR(velocityOf(world, crate).y, speed, 0.01 * speed) << who();
                EXPECT_NEAR(velocityOf(world, platform).y, speed, 0.01 * speed) << who();
                EXPECT_NEAR(world.position(platform).y, speed * kSteps * kStep, 0.001) << who();
            }
        }
    }
}

/// What is let down goes along as well: it falls until it has caught up, and then hangs by its weight. (It was caught
/// in every few steps, at 1 m/s with 13 times that.)
TEST(DrivenLimits, LetDownWithoutJerks) {
    for (const Profile profile : kProfiles) {
        for (const Hold hold : kHolds) {
            for (const double speed : {0.1, 1.0, 3.0}) {
                World world = makeWorld(profile);
                const BodyId load = addBody(world, dynamicAt({0, 0}), box(0.4, 0.4));
                Hoist hoist(world, hold, load, 0.3);
                run(world, 30);
                const double weight = world.mass(load) * kGravity;
                double least = weight;
                double most = weight;
                for (int i = 1; i <= 180; ++i) {
                    hoist.setHeight(-speed * i * kStep);
                    run(world, 1);
                    if (i * kStep < 2.5 * speed / kGravity + 0.1) { continue; }
                    least = std::min(least, hoist.force());
                    most = std::max(most, hoist.force());
                }
                EXPECT_LT(most, 1.05 * weight)
                    << profileName(profile) << ", " << nameOf(hold) << ", " << speed << " m/s";
                EXPECT_GT(least, 0.95 * weight)
                    << profileName(profile) << ", " << nameOf(hold) << ", " << speed << " m/s";
                EXPECT_NEAR(velocityOf(world, load).y, -speed, 0.01 * speed)
                    << profileName(profile) << ", " << nameOf(hold);
                EXPECT_NEAR(world.position(load).y, -3 * speed, 0.001) << profileName(profile) << ", " << nameOf(hold);
            }
        }
    }
}

/// A crane: its hook goes along a beam while the cable is wound up, and let out again. It hangs by little more than its
/// weight, and swings little more than one that stays where it is on its cable.
TEST(DrivenLimits, WindUpTheCableOfACrane) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        BodyDef trolley = bodyAt(BodyType::kinematic, {0, 10});
        const BodyId beam = must(world.createBody(trolley));
        const BodyId load = addBody(world, dynamicAt({0, 2}), box(0.5, 0.5));
        DistanceJointDef def;
        def.base = between(beam, load);
        def.anchorA = {0, 10};
        def.anchorB = {0, 2.5};
        def.limits = LengthLimits{0, real(7.5)};
        const JointId cable = must(world.createJoint(def));
        run(world, 30);
        const double weight = world.mass(load) * kGravity;
        double cableLength = 7.5;
        double pace = 0;
        double most = 0;
        double least = weight;
        for (int i = 0; i < 480; ++i) {
            const double wanted = i < 180 ? -1.5 : (i < 420 ? 1.0 : 0.0);
            pace += std::clamp(wanted - pace, -0.04, 0.04);  // at 2.4 m/s²
            cableLength += pace * kStep;
            must(world.setVelocity(beam, vec(i < 240 ? 0.5 : 0, 0), 0));
            must(world.setLengthLimits(cable, LengthLimits{0, real(cableLength)}));
            run(world, 1);
            const double force = length(toDouble(world.jointForce(cable)));
            most = std::max(most, force);
            least = std::min(least, force);
        }
        EXPECT_LT(most, 1.5 * weight) << profileName(profile);
        EXPECT_GT(least, 0.5 * weight) << profileName(profile);
        const DVec2 hook = apply(world.transform(load), vec(0, 0.5));
        EXPECT_NEAR(length(hook - world.position(beam)), cableLength, 0.002) << profileName(profile);
        EXPECT_LT(length(velocityOf(world, load)), 1) << profileName(profile);
    }
}

/// A drawbridge with a crate on it, by the lower limit of its hinge.
TEST(DrivenLimits, RaiseAndLowerADrawbridge) {
    for (const Profile profile : kProfiles) {
        for (const double rate : {0.2, 1.0}) {
            World world = makeWorld(profile);
            const BodyId bridge = addBody(world, dynamicAt({2, 0}), box(2, kThin));
            const BodyId crate = addBody(world, dynamicAt({3, kThin + kCrate}), box(kCrate, kCrate), material(0.9));
            RevoluteJointDef def;
            def.base = between(anchorOf(world), bridge);
            def.anchor = {0, 0};
            def.limits = AngleLimits{0, real(1.5)};
            const JointId hinge = must(world.createJoint(def));
            run(world, 30);
            const int steps = static_cast<int>(0.4 / rate * kRate);
            const auto heightOfCrate = [&] {
                const double angle = world.angle(bridge);
                return cross(DVec2{std::cos(angle), std::sin(angle)}, world.position(crate)) - kThin - kCrate;
            };
            double lowest = 0;
            for (int i = 1; i <= steps; ++i) {
                must(world.setAngleLimits(hinge, AngleLimits{real(rate * i * kStep), real(1.5)}));
                run(world, 1);
                lowest = std::min(lowest, heightOfCrate());
            }
            EXPECT_GT(lowest, -0.05) << profileName(profile) << ", " << rate << " rad/s";
            EXPECT_NEAR(heightOfCrate(), 0, 0.05) << profileName(profile) << ", " << rate << " rad/s";
            EXPECT_NEAR(world.angle(bridge), rate * steps * kStep, 0.001) << profileName(profile);
            EXPECT_NEAR(spinOf(world, bridge), rate, 0.01 * rate) << profileName(profile);
            run(world, 60);
            const double holding = std::abs(static_cast<double>(world.jointTorque(hinge)));
            double most = 0;
            const double down = std::min(rate, 0.5);
            const int stepsDown = static_cast<int>(0.4 / down * kRate);
            for (int i = stepsDown; i-- > 0;) {
                must(world.setAngleLimits(hinge, AngleLimits{real(down * i * kStep), real(1.5)}));
                run(world, 1);
                if (i < stepsDown / 3) {
                    most = std::max(most, std::abs(static_cast<double>(world.jointTorque(hinge))));
                }
            }
            EXPECT_LT(most, 1.5 * holding) << profileName(profile) << ", " << rate << " rad/s";
            EXPECT_NEAR(spinOf(world, bridge), -down, 0.02 * down) << profileName(profile);
        }
    }
}

/// The frame of a car on its wheels' limits.
TEST(DrivenLimits, LiftTheFrameOfACar) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        addStatic(world, box(20, 0.5), material(0.8), {0, -0.5});
        const BodyId frame = addBody(world, dynamicAt({0, 1}), box(1.5, 0.2));
        std::vector<JointId> axles;
        for (const double side : {-1.0, 1.0}) {
            const BodyId wheel = addBody(world, dynamicAt({side, 0.3}), circle(0.3), material(0.8));
            WheelJointDef def;
            def.base = between(frame, wheel);
            def.anchor = {side, 0.3};
            def.axis = {0, -1};
            def.limits = TranslationLimits{0, 0};
            axles.push_back(must(world.createJoint(def)));
        }
        run(world, 60);
        const double before = world.position(frame).y;
        for (int i = 1; i <= 30; ++i) {
            for (const JointId axle : axles) {
                must(world.setTranslationLimits(axle, TranslationLimits{real(i * kStep), real(i * kStep)}));
            }
            run(world, 1);
        }
        EXPECT_NEAR(world.position(frame).y - before, 0.5, 0.005) << profileName(profile);
        EXPECT_NEAR(velocityOf(world, frame).y, 1, 0.02) << profileName(profile);
    }
}

/// What is set elsewhere once, near or far, is put there: it draws its bodies, and gives them no speed. So is what goes
/// farther in each step than they are wide.
TEST(DrivenLimits, ThatJumpFlingNothing) {
    for (const Profile profile : kProfiles) {
        for (const Hold hold : kHolds) {
            for (const double by : {0.03, 0.3, 5.0}) {
                for (const int times : {1, 2}) {
                    if (times == 2 && by < 5) { continue; }
                    World world = makeWorld(profile);
                    const BodyId platform = addBody(world, dynamicAt({0, 0}), box(1, kThin));
                    Hoist hoist(world, hold, platform, 0.9);
                    run(world, 30);
                    double fastest = 0;
                    double highest = 0;
                    for (int i = 1; i <= 120; ++i) {
                        if (i <= times) { hoist.setHeight(i * by); }
                        run(world, 1);
                        fastest = std::max(fastest, length(velocityOf(world, platform)));
                        highest = std::max(highest, world.position(platform).y);
                    }
                    EXPECT_LT(fastest, 1) << profileName(profile) << ", " << nameOf(hold) << " by " << by;
                    EXPECT_LT(highest, times * by + 0.01)
                        << profileName(profile) << ", " << nameOf(hold) << " by " << by;
                }
            }
        }
    }
}

/// A step that goes from impact to impact moves its limits as far as one in one piece: bullets strike the platform, and
/// pegs knock the crates off that stand out over its edges.
TEST(DrivenLimits, GoOnFromImpactToImpact) {
    for (const Profile profile : kProfiles) {
        for (const double speed : {2.0, 8.0}) {
            World world = makeWorld(profile);
            const BodyId platform = addBody(world, dynamicAt({0, 0}), box(1, kThin), material(0.5, 0, 100));
            for (const double side : {-1.0, 1.0}) {
                addBody(world, dynamicAt({0.95 * side, kThin + kCrate}), box(kCrate, kCrate));
                addStatic(world, circle(0.02), {}, {1.09 * side, side < 0 ? 3.0 : 5.0});
            }
            for (int i = 0; i < 5; ++i) {
                BodyDef ball = dynamicAt({-0.4 + 0.2 * i, 3.0 + i}, vec(0, -40));
                ball.bullet = true;
                addBody(world, ball, circle(0.05), material(0.5, 0.9));
            }
            Hoist hoist(world, Hold::bothLimits, platform, 0.9);
            run(world, 5);
            for (int i = 1; speed * i * kStep < 8; ++i) {
                hoist.setHeight(speed * i * kStep);
                run(world, 1);
                if (i < 3) { continue; }
                EXPECT_NEAR(world.position(platform).y, speed * i * kStep, 0.005)
                    << profileName(profile) << ", step " << i;
                EXPECT_NEAR(velocityOf(world, platform).y, speed, 0.2) << profileName(profile) << ", step " << i;
            }
        }
    }
}

/// A ceiling stops what is raised against it, as fast as that may go.
TEST(DrivenLimits, PassNoCeiling) {
    for (const Profile profile : kProfiles) {
        for (const Hold hold : kHolds) {
            for (const double speed : {1.0, 5.0, 20.0}) {
                World world = makeWorld(profile);
                const BodyId platform = addBody(world, dynamicAt({0, 0}), box(1, kThin));
                addStatic(world, segment(-5, 2, 5, 2));
                Hoist hoist(world, hold, platform, 0.9);
                for (int i = 1; speed * i * kStep < 3; ++i) {
                    hoist.setHeight(speed * i * kStep);
                    run(world, 1);
                    EXPECT_LT(world.position(platform).y, 2)
                        << profileName(profile) << ", " << nameOf(hold) << ", " << speed;
                }
                run(world, 60);
                EXPECT_LT(world.position(platform).y, 2)
                    << profileName(profile) << ", " << nameOf(hold) << ", " << speed;
            }
        }
    }
}

/// The shortest length of a spring moves, far from where the spring holds what is on it at rest. (Its rest length went
/// along, and came back with each step: at 1 m/s it pushed by 8 mm.)
TEST(DrivenLimits, LeaveTheSpringBetweenThemAlone) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(awakeSettings(profile, 0));
        const BodyId level = must(world.createBody({}));
        const BodyId body = addBody(world, dynamicAt({3, 0}), box(kCrate, kCrate), material(0));
        DistanceJointDef spring;
        spring.base = {.bodyA = level, .bodyB = body};
        spring.anchorB = {3, 0};
        spring.spring = Spring{.hertz = 3, .dampingRatio = 0};
        spring.limits = LengthLimits{real(0.1), 10};
        const JointId joint = must(world.createJoint(spring));
        for (int i = 1; i <= 60; ++i) {
            must(world.setLengthLimits(joint, LengthLimits{real(0.1 + i * kStep), 10}));
            run(world, 1);
            expectAtMost("step " + std::to_string(i), std::abs(world.position(body).x - 3), 1e-6);
        }
    }
}

}  // namespace
}  // namespace swept::test
