#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../support/random.h"
#include "world_support.h"

/// Whole steps, and after them what is left of a frame, which is mostly a small part of one: what rests in steps of one
/// length does in these, too.

namespace swept::test {
namespace {

/// What hangs or lies there, and the farthest that it may have moved from where it was made, metres.
struct Still {
    World world;
    std::vector<BodyId> bodies;
    std::vector<JointId> joints;

    explicit Still(Profile profile) {
        WorldSettings settings;
        settings.profile = profile;
        world = makeWorld(settings);
    }
    BodyId add(DVec2 place, const Polygon& shape) {
        bodies.push_back(addBody(world, dynamicAt(place), shape));
        return bodies.back();
    }
    void hinge(BodyId a, BodyId b, DVec2 anchor) {
        joints.push_back(must(world.createJoint(RevoluteJointDef{.base = {.bodyA = a, .bodyB = b}, .anchor = anchor})));
    }
    double widestGap() const {
        double widest = 0;
        for (const JointId joint : joints) { widest = std::max(widest, static_cast<double>(world.jointError(joint))); }
        return widest;
    }
    bool isAnyAwake() const {
        return std::any_of(bodies.begin(), bodies.end(), [this](BodyId body) { return world.isAwake(body); });
    }
};

/// A crate of 4 kg on a chain of 15 links, 0.5 kg in all.
Still hangingCrate(Profile profile) {
    Still still(profile);
    BodyId last = must(still.world.createBody({}));
    for (int i = 0; i < 15; ++i) {
        const BodyId link = still.add({0, -0.5 * i - 0.25}, box(0.06, 0.25));
        still.hinge(last, link, {0, -0.5 * i});
        last = link;
    }
    still.hinge(last, still.add({0, -8.5}, box(1, 1)), {0, -7.5});
    return still;
}

/// Eight bars, welded end to end, out of a wall.
Still beam(Profile profile) {
    Still still(profile);
    BodyId last = must(still.world.createBody({}));
    for (int i = 0; i < 8; ++i) {
        const BodyId bar = still.add({i + 0.5, 0}, box(0.5, 0.125));
        still.joints.push_back(must(still.world.createJoint(
            WeldJointDef{.base = {.bodyA = last, .bodyB = bar}, .anchor = {static_cast<double>(i), 0}})));
        last = bar;
    }
    return still;
}

Still pyramid(Profile profile) {
    Still still(profile);
    addStatic(still.world, box(40, 1), {}, {0, -1});
    for (int row = 0; row < 10; ++row) {
        for (int i = row; i < 10; ++i) { still.add({(i - 0.5 * row) * 1.05, 1.02 * row + 0.6}, box(0.5, 0.5)); }
    }
    return still;
}

/// Twelve chains of six planks that fall into a pit.
Still heapOfChains(Profile profile) {
    Still still(profile);
    addStatic(still.world, box(40, 1), {}, {0, -1});
    for (const double x : {-5.0, 5.0}) { addStatic(still.world, box(0.5, 10), {}, {x, 8}); }
    Random random(5);
    for (int i = 0; i < 12; ++i) {
        BodyId last;
        const double y = 1 + 0.6 * i;
        for (int k = 0; k < 6; ++k) {
            const BodyId plank = still.add({k - 3 + random.range(0, 0.3), y}, box(0.45, 0.12));
            if (k > 0) { still.hinge(last, plank, {k - 3.5, y}); }
            last = plank;
        }
    }
    return still;
}

/// Frames that differ by so many seconds at most, each of one whole step if that fits in, and the rest; or, without
/// any, a rest of 0.1 ms after each.
void runFrames(World& world, double seconds, double spread) {
    Random random(7);
    for (double time = 0; time < seconds;) {
        const double frame = spread > 0 ? kStep + spread * random.range(-1, 1) : kStep + 1e-4;
        must(world.step(std::min(frame, kStep)));
        if (frame > kStep) { must(world.step(frame - kStep)); }
        time += frame;
    }
}

struct Case {
    std::string name;
    Still (*make)(Profile);
    double gap;  ///< the widest that is allowed, metres
};

TEST(RemainderSteps, LeaveAtRestWhatRests) {
    const std::vector<Case> cases = {{"crate on a chain", hangingCrate, 1e-6},
                                     {"beam", beam, 1e-6},
                                     {"pyramid", pyramid, 0},
                                     {"chains in a heap", heapOfChains, 0.01}};
    for (const Profile profile : kProfiles) {
        for (const Case& one : cases) {
            for (const double spread : {0.0, 3e-4, 3e-3}) {
                const std::string name =
                    one.name + ", " + profileName(profile) + ", frames differ by " + std::to_string(spread) + " s";
                Still still = one.make(profile);
                runFrames(still.world, 15, spread);
                EXPECT_FALSE(still.isAnyAwake()) << name;
                expectAtMost(name + ", gap", still.widestGap(), one.gap);
            }
        }
    }
}

/// A pile of two crates comes down within what is left of a frame, after a part of that, and then frames go on.
/// @return  the fastest that one of them rises, m/s
double fastestRise(Profile profile, double speed, double rest, double part) {
    World world = makeWorld(awakeSettings(profile));
    addStatic(world, box(20, 0.5), {}, {0, -0.5});
    const double height = speed * rest * part;
    const BodyId lower = addBody(world, dynamicAt({0, 0.5 + height}, vec(0, -speed)), box(0.5, 0.5));
    const BodyId upper = addBody(world, dynamicAt({0, 1.5 + height}, vec(0, -speed)), box(0.5, 0.5));
    addBody(world, dynamicAt({9, 0.5}), box(0.5, 0.5));
    world.visitBodies([&](BodyId body) { must(world.setEnabled(body, body != lower && body != upper)); });
    must(world.step(kStep));
    for (const BodyId body : {lower, upper}) { must(world.setEnabled(body, true)); }
    double fastest = 0;
    for (int i = 0; i < 20; ++i) {
        must(world.step(i % 2 == 0 ? rest : kStep));
        for (const BodyId body : {lower, upper}) {
            fastest = std::max(fastest, static_cast<double>(velocityOf(world, body).y));
        }
    }
    return fastest;
}

/// A blow that falls into what is left of a frame is none that the next frame repeats, however much longer that is.
TEST(RemainderSteps, BlowsInThemAreNotRepeated) {
    for (const Profile profile : kProfiles) {
        for (const double rest : {1e-3, 1e-4}) {
            for (const double speed : {0.1, 0.5, 2.0}) {
                double fastest = 0;
                for (int k = 0; k < 20; ++k) {
                    fastest = std::max(fastest, fastestRise(profile, speed, rest, (k + 0.5) / 20));
                }
                expectAtMost(profileName(profile) + ", rest of " + std::to_string(rest) + " s, " +
                                 std::to_string(speed) + " m/s, rises with",
                             fastest, 0.05);
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
