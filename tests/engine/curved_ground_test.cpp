#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "world_support.h"

/// What slides or rolls in a bowl or a pipe, by itself: nothing drives it, so it never gets higher than it began.

namespace swept::test {
namespace {

constexpr double kHalfWidth = 2;
constexpr double kRadius = 0.1;
const Profile kProfiles[] = {Profile::fast, Profile::accurate};

/// y = steepness · x² / half width, half as wide again.
struct Bowl {
    double steepness = 0;
    int segments = 0;
    double friction = 0;

    double at(double x) const { return steepness * x * x / kHalfWidth; }
    void addTo(World& world) const {
        std::vector<Vec2> points;
        for (int i = segments; i >= 0; --i) {
            const double x = 1.5 * kHalfWidth * (2.0 * i / segments - 1);
            points.push_back(vec(x, at(x)));
        }
        const BodyId ground = must(world.createBody({}));
        must(world.addChain(ground, points, false, material(friction)));
    }
};

/// How high it turns above the lowest place, as parts of where it was let go.
struct Swings {
    double highest = 0;
    double last = 0;
    int count = 0;

    Swings(Profile profile, const Bowl& bowl, const Polygon& shape, double seconds, double hertz = 60) {
        World world = makeWorld(profile);
        bowl.addTo(world);
        const double x = -0.8 * kHalfWidth;
        const double slope = 2 * bowl.steepness * x / kHalfWidth;
        const double scale = std::hypot(1, slope);
        const BodyDef def{.type = BodyType::dynamic,
                          .position = {x - slope / scale * kRadius, bowl.at(x) + kRadius / scale},
                          .angle = std::atan(slope)};
        const BodyId body = addBody(world, def, shape, material(bowl.friction));
        const double start = world.position(body).y - kRadius;
        double before = 0;
        for (int i = 0; i < seconds * hertz; ++i) {
            must(world.step(1 / hertz));
            const double now = velocityOf(world, body).x;
            if (before * now < 0) {
                last = (world.position(body).y - kRadius) / start;
                highest = std::max(highest, last);
                ++count;
            }
            before = now;
        }
    }
};

struct BowlCase {
    Bowl bowl;
    double hertz = 60;
    double least = 0;  ///< of its height, that is left after 20 s
};

void expectNoGain(const std::string& name, const Swings& swings, double least) {
    EXPECT_GE(swings.count, 4) << name;
    expectAtMost(name + "highest", swings.highest, 1);
    EXPECT_GE(swings.last, least) << name;
}

TEST(CurvedGround, NeverLiftsABall) {
    const BowlCase cases[] = {
        {{.steepness = 0.15, .segments = 800}, 60, 0.9},  {{.steepness = 0.15, .segments = 800}, 240, 0.97},
        {{.steepness = 0.5, .segments = 800}, 60, 0.7},   {{.steepness = 1, .segments = 800}, 60, 0.6},
        {{.steepness = 0.15, .segments = 100}, 60, 0.85}, {{.steepness = 0.5, .segments = 8000}, 60, 0.7}};
    for (const Profile profile : kProfiles) {
        for (const BowlCase& c : cases) {
            for (const double friction : {0.0, 0.6}) {
                Bowl bowl = c.bowl;
                bowl.friction = friction;
                const std::string name = profileName(profile) + ", steepness " + std::to_string(bowl.steepness) + ", " +
                                         std::to_string(bowl.segments) + " segments, friction " +
                                         std::to_string(friction) + ", " + std::to_string(c.hertz) + " Hz: ";
                expectNoGain(name, Swings(profile, bowl, circle(kRadius), 20, c.hertz), c.least);
            }
        }
    }
}

/// A ramp for skaters, without friction.
TEST(CurvedGround, NeverLiftsABox) {
    for (const Profile profile : kProfiles) {
        for (const double steepness : {0.15, 0.5}) {
            const std::string name = profileName(profile) + ", steepness " + std::to_string(steepness) + ": ";
            const Bowl bowl{.steepness = steepness, .segments = 400};
            expectNoGain(name + "box, ", Swings(profile, bowl, box(kRadius, kRadius), 20), 0.5);
        }
    }
}

/// In a round pipe of 1 m: let go half way up, or so fast at the bottom that it goes round. What it has in energy, of
/// which it never gets more, after ten seconds.
double leftInPipe(Profile profile, double friction, double speed, const std::string& name) {
    World world = makeWorld(profile);
    std::vector<Vec2> points;
    for (int i = 0; i < 128; ++i) {
        const double angle = -2 * kPi * i / 128;
        points.push_back(vec(std::cos(angle), std::sin(angle)));
    }
    must(world.addChain(must(world.createBody({})), points, true, material(friction)));
    const DVec2 start = speed > 0 ? DVec2{0, -1 + kRadius} : DVec2{1 - kRadius, 0};
    const BodyId ball = addBody(world, dynamicAt(start, vec(speed, 0), friction > 0 ? speed / kRadius : 0),
                                circle(kRadius), material(friction));
    const auto energy = [&] {
        const double height = world.position(ball).y + 1 - kRadius;
        return kineticEnergy(world, ball) + static_cast<double>(world.mass(ball)) * kGravity * height;
    };
    const double before = energy();
    double most = 0;
    for (int i = 0; i < 600; ++i) {
        must(world.step(kStep));
        most = std::max(most, energy() / before);
    }
    expectAtMost(name + "most", most, 1.01);
    return energy() / before;
}

TEST(CurvedGround, OfAPipeMakesNoEnergy) {
    for (const Profile profile : kProfiles) {
        for (const double friction : {0.0, 0.6}) {
            for (const double speed : {0.0, 7.0}) {
                const std::string name = profileName(profile) + ", friction " + std::to_string(friction) + ", " +
                                         std::to_string(speed) + " m/s: ";
                EXPECT_GE(leftInPipe(profile, friction, speed, name), friction > 0 ? 0.1 : 0.25) << name;
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
