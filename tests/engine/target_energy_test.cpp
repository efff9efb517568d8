#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../support/random.h"
#include "joint_support.h"

/// What follows a target (mouse joints, motor joints that seek a pose) gives its bodies no more than its force times
/// the way that it pushed them, however the solver takes it from there.

namespace swept::test {
namespace {

/// A row of boxes on sliders whose first one a mouse joint drags to and fro, for 10 s. @return the fastest one's speed
double fastestDragged(Profile profile, int boxes, bool haveLimits, const MouseJointDef& mouse) {
    World world = makeWorld(profile, 0);
    const std::vector<BodyId> bodies = addSliderRow(world, boxes, [haveLimits](PrismaticJointDef& slider, int) {
        if (haveLimits) { slider.limits = TranslationLimits{.lower = real(-1.2), .upper = real(1.2)}; }
    });
    MouseJointDef def = mouse;
    def.base = between(anchorOf(world), bodies.front());
    const JointId hand = must(world.createJoint(def));
    double fastest = 0;
    for (int i = 0; i < 600; ++i) {
        const double time = i * kStep;
        must(world.setTarget(hand, {2 * std::sin(time), std::sin(1.7 * time)}));
        must(world.step(kStep));
        for (const BodyId body : bodies) { fastest = std::max(fastest, length(velocityOf(world, body))); }
    }
    return fastest;
}

/// In `fast` they went at 100 m/s with limits, without at 10 000.
TEST(TargetEnergy, SlidersThatAMouseJointDragsStaySlow) {
    const MouseJointDef hands[] = {{.maxForce = real(5)},
                                   {.spring = Spring{.hertz = 5, .dampingRatio = real(0.7)}, .maxForce = real(50)},
                                   {.spring = Spring{.hertz = 2, .dampingRatio = real(0.7)}}};
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const bool haveLimits : {true, false}) {
            for (const int boxes : {4, 8}) {
                for (const MouseJointDef& hand : hands) {
                    const std::string name = profileName(profile) + ", " + std::to_string(boxes) +
                                             (haveLimits ? " with limits" : " without") +
                                             (hand.spring ? ", sprung" : ", rigid") + ", fastest";
                    expectAtMost(name, fastestDragged(profile, boxes, haveLimits, hand), 12);
                }
            }
        }
    }
}

/// Three to seven boxes without gravity in loops of hinges, sliders and motor joints that seek their poses.
struct SeekingLoop {
    World world;
    std::vector<BodyId> bodies;
    std::vector<DVec2> places;

    SeekingLoop(Profile profile, std::uint32_t seed) : world(makeWorld(profile, 0)) {
        Random random(seed);
        const int count = random.integer(3, 7);
        for (int i = 0; i < count; ++i) { addBox(random, i); }
        for (int i = 1; i < count; ++i) { tie(random, i - 1, i); }
        const int more = random.integer(1, 3);
        for (int i = 0; i < more; ++i) {
            const int a = random.integer(0, count - 1);
            const int b = random.integer(0, count - 1);
            if (a != b) { tie(random, a, b); }
        }
    }
    double energy() const {
        double sum = 0;
        for (const BodyId body : bodies) { sum += kineticEnergy(world, body); }
        return sum;
    }

private:
    void addBox(Random& random, int i) {
        places.push_back({1.2 * i, random.range(-0.5, 0.5)});
        const double vx = random.range(-1, 1);
        const double vy = random.range(-1, 1);
        const double spin = random.range(-2, 2);
        const double width = random.range(0.15, 0.5);
        const double height = random.range(0.1, 0.3);
        ShapeDef def{.density = real(std::exp(random.range(-1.5, 1.5)))};
        def.filter.mask = 0;
        bodies.push_back(addBody(world, dynamicAt(places.back(), vec(vx, vy), spin), box(width, height), def));
    }
    void tie(Random& random, int i, int j) {
        const auto a = static_cast<std::size_t>(i);
        const auto b = static_cast<std::size_t>(j);
        const DVec2 middle = 0.5 * (places[a] + places[b]);
        const int kind = random.integer(0, 2);
        const double which = random.range(0, 1);
        const double force = std::exp(random.range(-1, 6));
        const double torque = std::exp(random.range(-1, 6));
        const double angle = random.range(0, 2 * kPi);
        if (kind == 0) {
            must(world.createJoint(RevoluteJointDef{.base = between(bodies[a], bodies[b]), .anchor = middle}));
        } else if (kind == 1) {
            PrismaticJointDef slider;
            slider.base = between(bodies[a], bodies[b]);
            slider.anchor = middle;
            slider.axis = {std::cos(angle), std::sin(angle)};
            must(world.createJoint(slider));
        } else {
            MotorJointDef motor;
            motor.base = between(bodies[a], bodies[b]);
            if (which < 0.7) { motor.drive.maxForce = real(force); }
            if (which > 0.3) { motor.drive.maxTorque = real(torque); }
            must(world.createJoint(motor));
        }
    }
};

TEST(TargetEnergy, LoopsThatSeekTheirPosesStayTogether) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        int gainers = 0;
        for (std::uint32_t seed = 1; seed <= 30; ++seed) {
            SeekingLoop loop(profile, seed);
            const double before = loop.energy();
            double most = 0;
            for (int i = 0; i < 600; ++i) {
                must(loop.world.step(kStep));
                most = std::max(most, loop.energy() / before);
            }
            if (!(most < 1.5)) { ++gainers; }
            EXPECT_LT(most, 20) << profileName(profile) << ", seed " << seed;
        }
        EXPECT_LE(gainers, profile == Profile::fast ? 0 : 2) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test
