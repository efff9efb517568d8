#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "world_support.h"

/// What lies with a face on a large circle: planets, hills, boulders.

namespace swept::test {
namespace {

struct Lying {
    std::string name;
    Polygon shape;  ///< half as high as `kHalf`
};
constexpr double kHalf = 0.25;

std::vector<Lying> lyingShapes() {
    return {{"box", box(kHalf, kHalf)},
            {"rounded box", must(makeBox(vec(0.2, 0.2), {}, 0, real(0.05)))},
            {"plank", box(1.5, kHalf)},
            {"capsule", capsule(0.5, kHalf)}};
}

/// One upon the other on top of a circle, the lowest of which begins to turn.
struct Hill {
    World world;
    std::vector<BodyId> bodies;

    Hill(Profile profile, double radius, const Polygon& shape, int count, double friction) {
        WorldSettings settings = awakeSettings(profile);
        settings.sleep = true;
        world = makeWorld(settings);
        addStatic(world, circle(radius), material(friction), {0, -radius});
        for (int i = 0; i < count; ++i) {
            bodies.push_back(addBody(world, dynamicAt({0, kHalf * (2 * i + 1)}), shape, material(friction)));
        }
    }
    double fastestSpin(double seconds, double rate) {
        double most = 0;
        for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
            must(world.step(1 / rate));
            for (const BodyId body : bodies) { most = std::max(most, std::fabs(spinOf(world, body))); }
        }
        return most;
    }
    bool sleeps() const {
        return std::none_of(bodies.begin(), bodies.end(), [this](BodyId body) { return world.isAwake(body); });
    }
};

/// The point where it touched ran along the face, while its contact stayed where it was for a step: a box went from
/// 0.05 to 1 rad/s in four seconds, and rocked on for ever.
TEST(RoundGround, LetsWhatRocksComeToRest) {
    for (const Profile profile : kProfiles) {
        for (const double radius : {1.0, 10.0, 1000.0}) {
            for (const Lying& lying : lyingShapes()) {
                for (const double spin : {0.05, 0.5}) {
                    Hill hill(profile, radius, lying.shape, 1, 0.8);
                    must(hill.world.setVelocity(hill.bodies[0], {}, real(spin)));
                    const std::string name = profileName(profile) + ", radius " + std::to_string(radius) + ", " +
                                             lying.name + " at " + std::to_string(spin) + " rad/s: ";
                    expectAtMost(name + "spin", hill.fastestSpin(12, kRate), 1.05 * spin);
                    EXPECT_TRUE(hill.sleeps() || spin > 0.1) << name;
                    expectAtMost(name + "spin in the end", hill.fastestSpin(kStep, kRate), 0.001);
                }
            }
        }
    }
}

TEST(RoundGround, BearsTowers) {
    for (const Profile profile : kProfiles) {
        Hill hill(profile, 10, box(kHalf, kHalf), 3, 0.8);
        must(hill.world.setVelocity(hill.bodies[0], {}, real(0.05)));
        (void)hill.fastestSpin(8, kRate);
        EXPECT_TRUE(hill.sleeps()) << profileName(profile);
        EXPECT_NEAR(hill.world.position(hill.bodies[2]).y, 5 * kHalf, 0.02) << profileName(profile);
    }
}

/// Without friction a small body leaves a sphere where it has come down by a third of the radius.
TEST(RoundGround, LetsGoWhereItFallsAwayFaster) {
    constexpr double kHillRadius = 10;
    for (const Profile profile : kProfiles) {
        Hill hill(profile, kHillRadius, box(kHalf, kHalf), 1, 0);
        must(hill.world.setVelocity(hill.bodies[0], vec(1, 0), 0));
        const double path = kHillRadius + kHalf;  // of its middle
        const double start = 0.5 + kGravity * path;
        double left = 0;
        for (int i = 0; i < 400 && left == 0; ++i) {
            must(hill.world.step(kStep));
            const DVec2 place = hill.world.position(hill.bodies[0]) + DVec2{0, kHillRadius};
            const double energy =
                kineticEnergy(hill.world, hill.bodies[0]) / hill.world.mass(hill.bodies[0]) + kGravity * place.y;
            EXPECT_NEAR(energy, start, 0.0075 * start) << profileName(profile) << ", step " << i;
            if (length(place) > path + 0.01) { left = place.y; }
        }
        const double expected = path * (2.0 / 3 + 1.0 / (3 * kGravity * path));  // v² = g·y there
        EXPECT_NEAR(left, expected, 0.08 * path) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test
