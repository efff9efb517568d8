#include "joint_support.h"

#include "../../solver/softness.h"
#include "../support/random.h"

/// Joints whose anchor is far from the body that they hold, against its own size. What holds such a body and what turns
/// it are strongly coupled: m·L²/I is 2·10¹⁰ for the longest arm here.

namespace swept::test {
namespace {

constexpr Real kLeverRadius = Real(0.2);
constexpr double kLeverArms[] = {0.2, 0.5, 1, 2, 4, 8, 16, 64, 256, 1000, 20000};

/// What holds a disc at the end of an arm along x, by its anchor at the origin. Nothing here gives energy.
struct LeverCase {
    const char* name;
    JointId (*make)(World&, BodyId ground, BodyId disc, double arm);
};

Real strongEnough(const World& world, BodyId disc, double arm) {
    return static_cast<Real>(3 * world.mass(disc) * kGravity * arm);
}

/// A joint of the ground and the disc.
template <class Def, class Fill>
JointId leverJoin(World& world, BodyId ground, BodyId disc, Fill&& fill) {
    Def def;
    def.base = between(ground, disc);
    fill(def);
    return must(world.createJoint(def));
}

/// A slider aslant.
template <class Fill>
JointId leverSlider(World& world, BodyId ground, BodyId disc, Fill&& fill) {
    return leverJoin<PrismaticJointDef>(world, ground, disc, [&](PrismaticJointDef& def) {
        def.axis = {1, -0.96};
        fill(def);
    });
}

JointId withLeverMotor(World& world, BodyId ground, BodyId disc, double arm) {
    return leverJoin<RevoluteJointDef>(world, ground, disc, [&](RevoluteJointDef& def) {
        def.motor = AngularMotor{0, strongEnough(world, disc, arm)};
    });
}

constexpr LeverCase kLevers[] = {
    {"hinge with a motor", withLeverMotor},
    {"hinge with limits",
     [](World& w, BodyId ground, BodyId disc, double) {
         return leverJoin<RevoluteJointDef>(w, ground, disc, [](auto& def) {
             def.limits = AngleLimits{Real(-0.3), Real(0.3)};
         });
     }},
    {"hinge with a spring",
     [](World& w, BodyId ground, BodyId disc, double) {
         return leverJoin<RevoluteJointDef>(w, ground, disc, [](auto& def) { def.spring = Spring{5, Real(0.7)}; });
     }},
    {"slider with limits",
     [](World& w, BodyId ground, BodyId disc, double) {
         return leverSlider(w, ground, disc, [](auto& def) { def.limits = TranslationLimits{-1, 1}; });
     }},
    {"slider with a motor",
     [](World& w, BodyId ground, BodyId disc, double) {
         return leverSlider(w, ground, disc, [&](auto& def) { def.motor = LinearMotor{0, strongEnough(w, disc, 1)}; });
     }},
    {"slider with a spring",
     [](World& w, BodyId ground, BodyId disc, double) {
         return leverSlider(w, ground, disc, [](auto& def) { def.spring = Spring{2, Real(0.5)}; });
     }},
    {"weld whose angle is a spring",
     [](World& w, BodyId ground, BodyId disc, double) {
         return leverJoin<WeldJointDef>(w, ground, disc, [](auto& def) { def.angularSpring = Spring{2, Real(0.1)}; });
     }},
    {"weld whose point is a spring",
     [](World& w, BodyId ground, BodyId disc, double) {
         return leverJoin<WeldJointDef>(w, ground, disc, [](auto& def) { def.linearSpring = Spring{4, 1}; });
     }},
    {"frame on a wheel with a motor",
     [](World& w, BodyId ground, BodyId disc, double arm) {
         return leverJoin<WheelJointDef>(w, disc, ground, [&](auto& def) {
             def.motor = AngularMotor{0, strongEnough(w, disc, arm)};
             def.spring = Spring{2, Real(0.7)};
             def.limits = TranslationLimits{-1, 1};
         });
     }},
};

struct LeverRun {
    double gain = 0;      ///< largest E − E₀, J
    double jointGap = 0;  ///< largest after a second, m; of a point that is no spring
};

/// A disc that is thrown down, or slides to what stops it, for five seconds.
LeverRun throwAt(const LeverCase& lever, double arm, Profile profile, bool hasFloor) {
    WorldSettings settings = awakeSettings(profile);
    World world = makeWorld(settings);
    const BodyId ground = must(world.createBody(bodyAt(BodyType::fixed, {})));
    if (hasFloor) { addStatic(world, box(50, 0.5), {}, {0, -0.05 - static_cast<double>(kLeverRadius) - 0.5}); }
    const BodyId disc = addBody(world, dynamicAt({arm, 0}, vec(1, -4)), circle(kLeverRadius));
    const JointId joint = lever.make(world, ground, disc, arm);
    const auto energy = [&] { return energyOf(world, std::span(&disc, 1), kGravity); };
    const double start = energy();
    LeverRun result;
    for (int i = 0; i < 300; ++i) {
        must(world.step(kStep));
        result.gain = std::max(result.gain, energy() - start);
        if (i > 60) { result.jointGap = std::max(result.jointGap, static_cast<double>(world.jointError(joint))); }
    }
    return result;
}

/// @return  largest E − E₀, over what the disc has above its lowest place
double gainOfThrow(Profile profile, double radii, int seed) {
    Random random(static_cast<std::uint64_t>(seed));
    WorldSettings settings = awakeSettings(profile);
    World world = makeWorld(settings);
    const BodyId ground = anchorOf(world);
    const double arm = radii * static_cast<double>(kLeverRadius);
    if (seed % 2 == 1) { must(world.addShape(ground, must(makeBox(vec(20 * arm, 1), vec(0, -arm / 2 - 1))))); }
    const double angle = random.range(0, 2 * kPi);
    const DVec2 side{std::cos(angle), std::sin(angle)};
    const double along = random.range(-10, 10);
    const double across = random.range(-10, 10);
    const BodyId disc = addBody(
        world, dynamicAt(arm * side, toReal(along * side + across * DVec2{-side.y, side.x}), random.range(-5, 5)),
        circle(kLeverRadius));
    const double hertz = random.range(0.5, 20);
    const auto lower = static_cast<Real>(random.range(-1, 0));
    const auto upper = static_cast<Real>(random.range(0, 1));
    RevoluteJointDef hinge;
    hinge.base = between(ground, disc);
    const int kind = seed / 2 % 6;  // each with ground and without
    const bool hasSpring = kind == 1 || kind == 2;
    if (kind == 0 || kind == 2 || kind == 4) { hinge.limits = AngleLimits{lower, upper}; }
    if (hasSpring) { hinge.spring = Spring{static_cast<Real>(hertz), static_cast<Real>(random.range(0, 1))}; }
    if (kind == 3 || kind == 4) { hinge.motor = AngularMotor{0, static_cast<Real>(random.range(0, 500))}; }
    const JointId joint = must(world.createJoint(hinge));
    const double stiffness =
        hasSpring ? std::pow(2 * kPi * hertz, 2) * (world.inertia(disc) + world.mass(disc) * std::pow(arm, 2)) : 0;
    const auto energy = [&] {
        return energyOf(world, std::span(&disc, 1), kGravity) + 0.5 * stiffness * std::pow(world.jointAngle(joint), 2);
    };
    const double start = energy();
    const double lowest = -world.mass(disc) * kGravity * arm;
    double gain = 0;
    for (int i = 0; i < 300; ++i) {
        must(world.step(kStep));
        gain = std::max(gain, (energy() - start) / (start - lowest));
    }
    return gain;
}

/// (Softness took back its part of the held rows before limits, motors and springs were solved, whose answer brought
/// back m·L²/I times as much: 10¹⁶ m/s from an arm of eight metres on, and what did not fly apart sagged by 14 mm at
/// two. Later springs and limits did so from twenty metres on, for lack of digits: see `Spin` in pin.h.)
TEST(JointLever, GivesNoEnergyAndHolds) {
    for (const LeverCase& lever : kLevers) {
        for (const double arm : kLeverArms) {
            for (const Profile profile : {Profile::accurate, Profile::fast}) {
                for (const bool hasFloor : {false, true}) {
                    const LeverRun result = throwAt(lever, arm, profile, hasFloor);
                    const testing::Message what = testing::Message()
                                                  << lever.name << ", arm " << arm << " m, " << profileName(profile)
                                                  << (hasFloor ? ", floor" : "");
                    EXPECT_LE(result.gain, 0.02) << what;
                    EXPECT_LE(result.jointGap, 0.002 + 2 * static_cast<double>(kEpsilon) * arm) << what;
                }
            }
        }
    }
}

/// Hinges with any parts, anywhere, that are thrown with whatever speed along their arms and across; of some the ground
/// is in the way. What is stored in a spring counts as energy.
TEST(JointLever, OfAnyLengthThrownAnyhowGivesNoEnergy) {
    constexpr int kSeeds = 24;
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double radii : {10.0, 60.0, 150.0, 500.0, 1500.0, 6000.0, 20000.0}) {
            for (int seed = 0; seed < kSeeds; ++seed) {
                EXPECT_LE(gainOfThrow(profile, radii, seed), 0.005)
                    << (profile == Profile::fast ? "fast, " : "accurate, ") << radii << " radii, seed " << seed;
            }
        }
    }
}

/// About its anchor such a body turns as its mass asks for, and alone with the inertia that is its own, whether shapes
/// come before its joints or after them.
TEST(JointLever, LeavesABodyItsInertia) {
    for (const bool isLate : {false, true}) {
        World world = makeWorld(awakeSettings(0));
        const double arm = 1000 * static_cast<double>(kLeverRadius);
        BodyDef def = dynamicAt({arm, 0});
        def.mass = 2;
        const BodyId disc = must(world.createBody(def));
        const auto addDisc = [&] { must(world.addShape(disc, circle(kLeverRadius))); };
        if (!isLate) { addDisc(); }
        RevoluteJointDef hinge;
        hinge.base = between(anchorOf(world), disc);
        const JointId joint = must(world.createJoint(hinge));
        if (isLate) { addDisc(); }
        const double inertia = 0.5 * 2 * static_cast<double>(kLeverRadius * kLeverRadius);
        EXPECT_NEAR(world.inertia(disc) / inertia, 1, 1e-6);
        must(world.applyImpulse(disc, vec(0, 10)));
        for (int i = 0; i < 60; ++i) { must(world.step(kStep)); }
        EXPECT_NEAR(spinOf(world, disc) * 2 * arm / 10, 1, 2e-5);
        expectAtMost("gap", static_cast<double>(world.jointError(joint)), 1e-4);
        must(world.destroyJoint(joint));
        const double before = spinOf(world, disc);
        must(world.applyAngularImpulse(disc, Real(0.1)));
        EXPECT_NEAR((spinOf(world, disc) - before) * inertia / 0.1, 1, 1e-5);
    }
}

/// A load at rest on soft rows: γ·m·g·h/m is the speed they give way with, and β times the gap what closes it.
TEST(JointLever, OfAMotorSagsAsMuchAsWithoutALever) {
    constexpr double kSubStep = kStep / 4;
    const Softness softness = softnessOfSubStep(kJointCycles, kJointDampingRatio, static_cast<Real>(kSubStep));
    const double compliance = static_cast<double>(softness.impulseScale / softness.massScale);
    const double expected = compliance * kGravity * kSubStep / static_cast<double>(softness.biasRate);
    for (const double arm : std::span(kLeverArms).first(7)) {  // of longer ones float does not tell it
        WorldSettings settings = awakeSettings(Profile::fast);
        World world = makeWorld(settings);
        const BodyId disc = addBody(world, dynamicAt({arm, 0}), circle(kLeverRadius));
        const JointId joint = withLeverMotor(world, anchorOf(world), disc, arm);
        for (int i = 0; i < 120; ++i) { must(world.step(kStep)); }
        EXPECT_NEAR(static_cast<double>(world.jointError(joint)) / expected, 1, 0.02) << "arm " << arm << " m";
    }
}

/// A disc on a long rigid arm that is thrown at the floor: the weld stops it, and nothing else may come of it.
/// (Softness that was taken back of the point first fed the angle, and the disc was at 10¹² m after a step.)
TEST(JointLever, OfAWeldStopsWhatIsThrown) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double arm : {1.0, 2.0, 3.0, 5.0}) {
            for (const double gap : {0.0, 0.05}) {
                for (const double speed : {5.0, 20.0, 100.0}) {
                    WorldSettings settings = awakeSettings(profile, 0);
                    World world = makeWorld(settings);
                    const BodyId base = addStatic(world, box(50, 0.5), {}, {0, -gap - 0.2 - 0.5});
                    const BodyId disc = addBody(world, dynamicAt({arm, 0}, vec(0, -speed)), circle(0.2));
                    WeldJointDef weld;
                    weld.base.bodyA = base;
                    weld.base.bodyB = disc;
                    weld.anchor = {0, 0};
                    must(world.createJoint(weld));
                    const testing::Message what = testing::Message()
                                                  << arm << " m, " << gap << " m, " << speed << " m/s";
                    for (int i = 0; i < 120; ++i) {
                        must(world.step(kStep));
                        ASSERT_LE(length(velocityOf(world, disc)), 1.01 * speed) << what << ", step " << i;
                    }
                    expectAtMost("off its place", length(world.position(disc) - DVec2{arm, 0}), 0.01);
                }
            }
        }
    }
}

/// What a blow left at rest, a little below its place, is brought back there. (Its energy was below none, and the root
/// of a quotient of zeros was its speed.)
TEST(JointLever, OfAWeldRestsAfterABlow) {
    World world = makeWorld();
    const BodyId base = addStatic(world, box(50, 0.5), {}, {0, -1.05});
    const BodyId disc = addBody(world, dynamicAt({0.5, 0}, vec(0, -5)), circle(0.5));
    WeldJointDef weld;
    weld.base = between(base, disc);
    must(world.createJoint(weld));
    for (int i = 0; i < 120; ++i) {
        must(world.step(kStep));
        ASSERT_EQ(world.counters().putBack, 0U) << "step " << i;
    }
    expectAtMost("off its place", length(world.position(disc) - DVec2{0.5, 0}), 1e-6);
}

/// A light sign on a long arm, a wall behind it: no ball that is shot at it comes back faster than it was.
TEST(JointLever, ASignThatIsStruckGivesNoEnergy) {
    for (const bool slides : {false, true}) {
        for (const double arm : {0.5, 1.0, 2.0}) {
            for (const double gap : {0.0, 0.01, 0.05, 0.3}) {
                for (const double speed : {10.0, 30.0, 60.0}) {
                    for (const double mass : {0.2, 1.0, 5.0}) {
                        WorldSettings settings = awakeSettings(0);
                        World world = makeWorld(settings);
                        const BodyId wall = addStatic(world, box(0.5, 10), {}, {0.05 + gap + 0.5, 0});
                        const BodyId sign = addBody(world, dynamicAt({0, -arm}), box(0.05, 0.4));
                        if (slides) {
                            PrismaticJointDef def;
                            def.base = between(wall, sign);
                            def.limits = TranslationLimits{Real(-0.05), Real(0.05)};
                            must(world.createJoint(def));
                        } else {
                            WeldJointDef def;
                            def.base = between(wall, sign);
                            must(world.createJoint(def));
                        }
                        const ShapeDef heavy = material(0.6, 0, mass / (kPi * 0.04));
                        const BodyId ball =
                            addBody(world, dynamicAt({-3, -arm - 0.1}, vec(speed, 0)), circle(0.2), heavy);
                        const BodyId both[] = {sign, ball};
                        const double start = energyOf(world, both, 0);
                        for (int i = 0; i < 60; ++i) {
                            must(world.step(kStep));
                            ASSERT_LE(energyOf(world, both, 0), 1.05 * start)
                                << (slides ? "slider, " : "weld, ") << arm << " m, gap " << gap << " m, " << speed
                                << " m/s, " << mass << " kg, step " << i;
                        }
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
