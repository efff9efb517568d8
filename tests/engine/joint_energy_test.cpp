#include "../support/random.h"
#include "../support/some_of.h"
#include "joint_support.h"

#include <cmath>
#include <vector>

/// Joints without motors and springs make no energy, whatever they and contacts do to each other.

namespace swept::test {
namespace {

/// Largest energy above that of the start, J.
double gainOf(World& world, const std::vector<BodyId>& bodies, double dt, double seconds) {
    const double start = energyOf(world, bodies, kGravity);
    double gain = 0;
    const int steps = static_cast<int>(std::lround(seconds / dt));
    for (int i = 0; i < steps; ++i) {
        must(world.step(dt));
        gain = std::max(gain, energyOf(world, bodies, kGravity) - start);
    }
    return gain;
}

WorldSettings settingsInProfile(Profile profile) {
    WorldSettings settings = awakeSettings(profile);
    return settings;
}

void hingeAt(World& world, BodyId a, BodyId b, DVec2 anchor) {
    RevoluteJointDef def;
    def.base = between(a, b);
    def.anchor = anchor;
    must(world.createJoint(def));
}

/// A rope without damping cracks like a whip, again and again. (Sub-steps that follow the motion gave it 1.1 times the
/// energy of its fall in forty seconds, and after four minutes 4000 times.)
TEST(JointEnergy, OfARopeThatIsLetGo) {
    struct Rope {
        int links = 0;
        double angle = 0;  ///< rad, above the level
    };
    constexpr double kLength = 10;
    for (const Rope& rope : {Rope{20, 0}, Rope{16, 1.5}}) {
        World world = makeWorld(settingsInProfile(Profile::accurate));
        const double link = kLength / rope.links;
        const DVec2 along{std::cos(rope.angle), std::sin(rope.angle)};
        std::vector<BodyId> links;
        BodyId before = anchorOf(world);
        for (int i = 0; i < rope.links; ++i) {
            ShapeDef surface;
            surface.filter.mask = 0;
            BodyDef def = dynamicAt((i + 0.5) * link * along);
            def.angle = rope.angle;
            links.push_back(addBody(world, def, capsule(0.4 * link, 0.06), surface));
            hingeAt(world, before, links.back(), i * link * along);
            before = links.back();
        }
        const double start = energyOf(world, links, kGravity);
        double fall = 0;
        for (const BodyId body : links) { fall += world.mass(body) * kGravity * kLength / 2; }
        double most = 0;
        for (int step = 0; step < 40 * 60; ++step) {
            must(world.step(1.0 / 60));
            most = std::max(most, std::fabs(energyOf(world, links, kGravity) - start));
        }
        expectAtMost(std::to_string(rope.links) + " links", most / fall, 0.02);
    }
}

/// A box falls on a straight row of planks between two posts. (Passes over contacts and joints that took turns threw it
/// up with 7242 J from a row of six, and with 19 kJ from one of forty.)
TEST(JointEnergy, OfATautBridgeThatABoxFallsOn) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const int planks : {4, 6, 12, 20}) {
            for (const double rate : {60.0, 120.0}) {
                World world = makeWorld(settingsInProfile(profile));
                const BodyId ground = anchorOf(world);
                std::vector<BodyId> bodies;
                BodyId before = ground;
                for (int i = 0; i < planks; ++i) {
                    bodies.push_back(addBody(world, dynamicAt({i + 0.5, 0}), box(0.5, 0.05), material(0.6, 0, 20)));
                    hingeAt(world, before, bodies.back(), {1.0 * i, 0});
                    before = bodies.back();
                }
                hingeAt(world, before, ground, {1.0 * planks, 0});
                const double height = 2;
                bodies.push_back(addBody(world, dynamicAt({0.5 * planks + 0.1, 0.35 + height}), box(0.3, 0.3),
                                         material(0.6, 0, 20)));
                const double fall = world.mass(bodies.back()) * kGravity * height;
                // What closes the gaps of a taut row lifts it.
                EXPECT_LE(gainOf(world, bodies, 1 / rate, 6), 0.25 * fall)
                    << planks << " planks, " << rate << " Hz, " << profileName(profile);
            }
        }
    }
}

/// A chain with a load swings down over the corner of the box that it hangs on. (The load came back with up to fifteen
/// times the energy of its fall. What closes the gaps of joints still lifts it.)
TEST(JointEnergy, OfAChainThatIsBentOverACorner) {
    for (const int links : {2, 3, 6}) {
        for (const double load : {10.0, 100.0}) {
            for (int i = 0; i < someOf(10); ++i) {
                const double length = 0.27;
                const double off = 0.012 * i;
                World world = makeWorld(settingsInProfile(Profile::accurate));
                const BodyId post = addStatic(world, box(0.2, 0.2), material(0.6), {0, 12});
                std::vector<BodyId> bodies;
                BodyId before = post;
                for (int k = 0; k < links; ++k) {
                    const double mass = 1 / (length * 0.08);
                    ShapeDef shape = material(0.6, 0, mass);
                    shape.filter.group = k == 0 ? -1 : 0;  // the first one hangs inside of the post
                    bodies.push_back(
                        addBody(world, dynamicAt({off + length * (k + 0.5), 12}), box(length / 2, 0.04), shape));
                    hingeAt(world, before, bodies.back(), {off + length * k, 12});
                    before = bodies.back();
                }
                ShapeDef heavy = material(0.6, 0, load / (kPi * 0.16));
                heavy.filter.group = -1;
                bodies.push_back(addBody(world, dynamicAt({off + length * links, 12}), circle(0.4), heavy));
                hingeAt(world, before, bodies.back(), {off + length * links, 12});
                const double fall = load * kGravity * length * links;
                EXPECT_LE(gainOf(world, bodies, kStep, 6), 2.5 * fall)
                    << links << " links, " << load << " kg, off " << off << " m";
            }
        }
    }
}

/// A chain that tumbles down stairs, and lies on itself. (Of 24 such three had a step that gained up to 0.8 of it all.)
TEST(JointEnergy, OfAChainThatFallsDownStairs) {
    for (int run = 0; run < someOf(8); ++run) {
        World world = makeWorld(settingsInProfile(Profile::accurate));
        for (int i = 0; i < 12; ++i) { addStatic(world, box(0.5, 0.25), material(0.6), {0.7 * i, -0.5 * i}); }
        std::vector<BodyId> bodies;
        BodyId before{};
        for (int i = 0; i < 20; ++i) {
            const double x = -2 + 0.02 * run + 0.27 * i;
            bodies.push_back(addBody(world, dynamicAt({x, 3}), box(0.15, 0.04), material(0.6, 0, 1 / 0.024)));
            if (i > 0) { hingeAt(world, before, bodies.back(), {x - 0.135, 3}); }
            before = bodies.back();
        }
        EXPECT_LE(gainOf(world, bodies, kStep, 5), 1) << "run " << run;
    }
}

/// Three boxes two metres apart on two sliders, thrown, that nothing holds. @return the largest gain, parts of the
/// kinetic energy at the start
double gainOfFreeSliders(std::uint64_t seed, double gravity) {
    Random random(seed);
    WorldSettings settings = awakeSettings(Profile::fast, gravity);
    World world = makeWorld(settings);
    ShapeDef shape;
    shape.filter.group = -1;
    std::vector<BodyId> bodies;
    for (int i = 0; i < 3; ++i) { bodies.push_back(addBody(world, dynamicAt({2.0 * i, 0}), box(0.3, 0.2), shape)); }
    for (std::size_t i = 0; i < 2; ++i) {
        const double angle = random.range(-kPi, kPi);
        PrismaticJointDef slider;
        slider.base = between(bodies[i], bodies[i + 1]);
        slider.anchor = {2.0 * static_cast<double>(i) + 1, 0};
        slider.axis = {std::cos(angle), std::sin(angle)};
        must(world.createJoint(slider));
    }
    must(world.setVelocity(bodies[0], vec(random.range(-1, 1), random.range(-1, 1)), real(random.range(-1, 1))));
    const double start = energyOf(world, bodies, gravity);
    double most = 0;
    for (int i = 0; i < 600; ++i) {
        must(world.step(kStep));
        most = std::max(most, energyOf(world, bodies, gravity) - start);
    }
    return most / start;
}

/// (Of thirty such throws half gained energy without end, up to bodies of 1000 m/s: without gravity nothing was
/// watched, and what falls had a part of the energy of its fall to gain.)
TEST(JointEnergy, OfSlidersThatNothingHolds) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        for (const double gravity : {0.0, kGravity}) {
            EXPECT_LE(gainOfFreeSliders(seed, gravity), 0.1) << "seed " << seed << ", gravity " << gravity;
        }
    }
}

/// Boxes hang one below the other on sliders with limits; the first one is made easier, or harder, to turn. (They rose
/// by 11 m, and half a metre: what lifted them cost nothing, and what they fell was given to them. Closing the gaps
/// still lifts those that hang on levers of a hundred radii of gyration.)
TEST(JointEnergy, OfWhatHangsOnLimitsAndIsChanged) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double factor : {1e-3, 1e-2, 0.1, 10.0, 1000.0}) {
            World world = makeWorld(settingsInProfile(profile));
            BodyId before = must(world.createBody(bodyAt(BodyType::fixed, {0, 20})));
            std::vector<BodyId> bodies;
            for (int i = 0; i < 5; ++i) {
                bodies.push_back(addBody(world, dynamicAt({0, 19.2 - 0.8 * i}), box(0.2, 0.2)));
                PrismaticJointDef slider;
                slider.base = between(before, bodies.back());
                slider.anchor = {0, 19.6 - 0.8 * i};
                slider.axis = {0, 1};
                slider.limits = TranslationLimits{0, real(0.3)};
                must(world.createJoint(slider));
                before = bodies.back();
            }
            runFor(world, 2);
            BodyDef changed = world.definition(bodies[0]);
            changed.inertia = real(factor * static_cast<double>(world.inertia(bodies[0])));
            must(world.redefine(bodies[0], changed));
            double mass = 0;
            for (const BodyId id : bodies) { mass += static_cast<double>(world.mass(id)); }
            const double lift = factor < 1e-2 ? 1 : 0.05;
            EXPECT_LE(gainOf(world, bodies, kStep, 15), lift * mass * kGravity) << factor;
        }
    }
}

/// Two boxes, pinned twice on their common face: one of four rows is there twice.
struct TwoPins {
    World world;
    std::vector<BodyId> boxes;
    std::vector<JointId> pins;

    TwoPins(Profile profile, Random& random, double height, Vec2 velocity)
        : world(makeWorld(settingsInProfile(profile))) {
        const double angle = random.range(0, 2 * kPi);
        const double spin = random.range(-5, 5);
        for (const double side : {-0.5, 0.5}) {
            const DVec2 place = turned({side, 0}, angle);
            const Vec2 along = velocity + vec(-spin * place.y, spin * place.x);
            BodyDef def = dynamicAt(DVec2{0, height} + place, along, spin);
            def.angle = angle;
            boxes.push_back(addBody(world, def, box(0.5, 0.25)));
        }
        for (const double side : {-0.25, 0.25}) {
            RevoluteJointDef def;
            def.base = between(boxes[0], boxes[1]);
            def.anchor = DVec2{0, height} + turned({0, side}, angle);
            pins.push_back(must(world.createJoint(def)));
        }
    }
};

/// Forces that cancel each other were kept from sub-step to sub-step, and grew to 6e8 N.
TEST(JointEnergy, TwoPinsOnOneFaceBearWhatOneWould) {
    Random random(3);
    for (int i = 0; i < 40; ++i) {
        TwoPins pair(Profile::accurate, random, 0, {});
        double most = 0;
        for (int step = 0; step < 120; ++step) {
            must(pair.world.step(kStep));
            for (const JointId pin : pair.pins) {
                most = std::max(most, static_cast<double>(length(pair.world.jointForce(pin))));
            }
        }
        const double spin = static_cast<double>(pair.world.angularVelocity(pair.boxes[0]));
        const double mass = pair.world.mass(pair.boxes[0]);
        EXPECT_LT(most, 0.5 * mass * spin * spin + 0.1 * mass * kGravity) << "throw " << i << ", " << spin << " rad/s";
    }
}

/// With those forces whoever met the floor began to be iterated: half of the drops gained up to 10⁷ times their energy.
TEST(JointEnergy, OfTwoPinsOnOneFaceThatFall) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        Random random(4);
        for (int i = 0; i < someOf(60); ++i) {
            const double height = random.range(2, 4);
            TwoPins pair(profile, random, height, vec(random.range(-5, 5), random.range(-8, 0)));
            addStatic(pair.world, box(100, 0.5), material(0.6), {0, -0.5});
            const double start = energyOf(pair.world, pair.boxes, kGravity);
            EXPECT_LE(gainOf(pair.world, pair.boxes, kStep, 5), 0.05 * start) << "drop " << i;
        }
    }
}

/// Two discs on a hinge with limits, 30 : 1, seven radii apart, that fall. Where they met the floor within the last
/// 1/256 of a step what was left of it was a part of its own, in which gaps were closed as if it had been as long as
/// others: one drop of seventeen gained up to 10¹² times its energy.
TEST(JointEnergy, OfPartsThatEndShortlyAfterAnImpact) {
    for (int i = 0; i < someOf(300); ++i) {
        const double lift = 0.001 * i;
        World world = makeWorld();
        addStatic(world, box(20, 0.5), material(0.6), {0, -5});
        std::vector<BodyId> discs{
            addBody(world, dynamicAt({0.4573, 2.3143 + lift}), must(makeCircle({}, real(0.666))))};
        discs.push_back(addBody(world, dynamicAt({3.3628, -1.442 + lift}, vec(-2.438, -4.1786), 3.1755),
                                must(makeCircle({}, real(0.2327))), material(0.6, 0, 0.273)));
        RevoluteJointDef hinge;
        hinge.base = between(discs[1], discs[0]);
        hinge.anchor = {3.3628, -1.442 + lift};
        hinge.limits = AngleLimits{real(-0.726), real(0.445)};
        must(world.createJoint(hinge));
        const double above = 5 * kGravity * (world.mass(discs[0]) + world.mass(discs[1]));
        const double start = energyOf(world, discs, kGravity) + above;
        EXPECT_LE(gainOf(world, discs, kStep, 4), 0.5 * start) << "lifted by " << lift;
    }
}

/// Two discs, masses up to 100 : 1, on a hinge and a second hinge, a weld or a rod, thrown onto the ground. With arms
/// that bent by the spin of a blow 85 of these 300 gained, up to 10⁵ times their energy; 8 as long as contacts and
/// joints took turns.
TEST(JointEnergy, OfDiscsJointedTwiceThatFall) {
    int gaining = 0;
    constexpr int kDrops = 300;
    for (int i = 0; i < someOf(kDrops); ++i) {
        Random random(static_cast<std::uint64_t>(1000 + i));
        World world = makeWorld();
        addStatic(world, box(100, 0.5), material(0.6), {0, -4});
        const auto disc = [&](DVec2 place, double density) {
            const Vec2 velocity = vec(random.range(-5, 5), random.range(-5, 5));
            return addBody(world, dynamicAt(place, velocity, random.range(-10, 10)),
                           must(makeCircle({}, real(random.range(0.1, 0.6)))), material(0.6, 0, density));
        };
        const DVec2 place{random.range(-2, 2), random.range(-2, 2)};
        const std::vector<BodyId> discs{disc({0, 0}, 1), disc(place, std::pow(10.0, random.range(-1, 1.3)))};
        hingeAt(world, discs[0], discs[1], place);
        if (i % 3 == 0) {
            hingeAt(world, discs[1], discs[0], {0, 0});
        } else if (i % 3 == 1) {
            WeldJointDef weld;
            weld.base = between(discs[0], discs[1]);
            weld.anchor = 0.5 * place;
            must(world.createJoint(weld));
        } else {
            DistanceJointDef rod;
            rod.base = between(discs[0], discs[1]);
            rod.anchorA = {0, 0.3};
            rod.anchorB = place + DVec2{0, 0.3};
            must(world.createJoint(rod));
        }
        const double above = 4 * kGravity * (world.mass(discs[0]) + world.mass(discs[1]));
        const double start = energyOf(world, discs, kGravity) + above;
        gaining += gainOf(world, discs, kStep, 5) > 0.05 * start ? 1 : 0;
    }
    EXPECT_EQ(gaining, 0);
}

}  // namespace
}  // namespace swept::test
