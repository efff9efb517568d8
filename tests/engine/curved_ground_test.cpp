#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "world_support.h"

/// What slides or rolls in a bowl or a pipe, by itself or with others: nothing drives it, so it never gets higher than
/// it began.

namespace swept::test {
namespace {

constexpr double kGroundHalf = 2;
constexpr double kWheelRadius = 0.1;
/// y = steepness · x² / half width, half as wide again.
struct Bowl {
    double steepness = 0;
    int segments = 0;
    double friction = 0;

    double at(double x) const { return steepness * x * x / kGroundHalf; }
    void addTo(World& world) const {
        std::vector<Vec2> points;
        for (int i = segments; i >= 0; --i) {
            const double x = 1.5 * kGroundHalf * (2.0 * i / segments - 1);
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
        const double x = -0.8 * kGroundHalf;
        const double slope = 2 * bowl.steepness * x / kGroundHalf;
        const double scale = std::hypot(1, slope);
        const BodyDef def{.type = BodyType::dynamic,
                          .position = {x - slope / scale * kWheelRadius, bowl.at(x) + kWheelRadius / scale},
                          .angle = std::atan(slope)};
        const BodyId body = addBody(world, def, shape, material(bowl.friction));
        const double start = world.position(body).y - kWheelRadius;
        double before = 0;
        for (int i = 0; i < seconds * hertz; ++i) {
            must(world.step(1 / hertz));
            const double now = velocityOf(world, body).x;
            if (before * now < 0) {
                last = (world.position(body).y - kWheelRadius) / start;
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
                expectNoGain(name, Swings(profile, bowl, circle(kWheelRadius), 20, c.hertz), c.least);
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
            expectNoGain(name + "box, ", Swings(profile, bowl, box(kWheelRadius, kWheelRadius), 20), 0.5);
        }
    }
}

/// In a round pipe of 1 m, of so many pieces: let go half way up, or so fast at the bottom that it goes round.
struct PipeRide {
    double speed = 0;
    double friction = 0;
    double spin = 0;  ///< of a ball that rolls: −speed / radius
    double gravity = kGravity;
    int pieces = 128;
    double restitution = 0;

    std::string name(Profile profile) const {
        return profileName(profile) + ", friction " + std::to_string(friction) + ", " + std::to_string(speed) +
               " m/s, spin " + std::to_string(spin) + ", gravity " + std::to_string(gravity) + ", " +
               std::to_string(pieces) + " pieces, restitution " + std::to_string(restitution) + ": ";
    }
};

/// In ten seconds, energy as parts of what it had in the beginning.
struct PipeResult {
    double left = 0;
    double most = 0;
    double deepest = 0;  ///< metres
};

PipeResult ridePipe(Profile profile, const PipeRide& ride) {
    World world = makeWorld(profile, ride.gravity);
    std::vector<Vec2> points;
    for (int i = 0; i < ride.pieces; ++i) {
        const double angle = -2 * kPi * i / ride.pieces;
        points.push_back(vec(std::cos(angle), std::sin(angle)));
    }
    must(world.addChain(must(world.createBody({})), points, true, material(ride.friction)));
    const DVec2 start = ride.speed > 0 ? DVec2{0, -1 + kWheelRadius} : DVec2{1 - kWheelRadius, 0};
    const BodyId ball = addBody(world, dynamicAt(start, vec(ride.speed, 0), ride.spin), circle(kWheelRadius),
                                material(ride.friction, ride.restitution));
    const auto energy = [&] {
        const double height = world.position(ball).y + 1 - kWheelRadius;
        return kineticEnergy(world, ball) + static_cast<double>(world.mass(ball)) * ride.gravity * height;
    };
    const double before = energy();
    PipeResult result;
    for (int i = 0; i < 600; ++i) {
        must(world.step(kStep));
        result.left = energy() / before;
        result.most = std::max(result.most, result.left);
        result.deepest = std::max(result.deepest, length(world.position(ball)) + kWheelRadius - 1);
    }
    return result;
}

TEST(CurvedGround, OfAPipeMakesNoEnergy) {
    for (const Profile profile : kProfiles) {
        for (const double friction : {0.0, 0.6}) {
            for (const double speed : {0.0, 7.0}) {
                const PipeRide ride{
                    .speed = speed, .friction = friction, .spin = friction > 0 ? speed / kWheelRadius : 0};
                const PipeResult result = ridePipe(profile, ride);
                expectAtMost(ride.name(profile) + "most", result.most, 1.01);
                EXPECT_GE(result.left, friction > 0 ? 0.1 : 0.6) << ride.name(profile);
            }
        }
    }
}

TEST(CurvedGround, OfAPipeMakesNoEnergyOfBounces) {
    for (const Profile profile : kProfiles) {
        for (const double restitution : {0.3, 0.9, 1.0}) {
            for (const double speed : {7.0, 25.0}) {
                const PipeRide ride{.speed = speed, .pieces = 40, .restitution = restitution};
                expectAtMost(ride.name(profile) + "most", ridePipe(profile, ride).most, 1.0005);
            }
        }
    }
}

/// A marble that slides over flat pieces, and hops, keeps its speed along them, and loses all of that of its fall.
TEST(CurvedGround, TakesTheSpeedOfAFall) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        std::vector<Vec2> points;
        for (int i = 0; i <= 400; ++i) { points.push_back(vec(20 - 0.1 * i, 0)); }
        must(world.addChain(must(world.createBody({})), points, false, material(0)));
        const BodyId ball =
            addBody(world, dynamicAt({-19, kWheelRadius}, vec(10, 0)), circle(kWheelRadius), material(0));
        for (int hop = 0; hop < 4; ++hop) {
            runFor(world, 0.3);
            must(world.setVelocity(ball, vec(10, 1), 0));
        }
        runFor(world, 0.5);
        expectAtMost(profileName(profile), std::fabs(length(velocityOf(world, ball)) - 10), 0.005);
    }
}

/// Where a ramp of 0.2 rad begins that is another body than the floor, what flies onto it keeps cos² of its energy.
/// (What a contact carries through the corner, as from −5.31, gets all of it back: its ground turned.)
TEST(CurvedGround, EndsWithItsBody) {
    const double slope = 0.2;
    for (const Profile profile : kProfiles) {
        for (const double start : {-5.0, -5.13, -5.2, -5.42}) {
            World world = makeWorld(profile);
            addBody(world, bodyAt(BodyType::fixed, {-20, -0.5}), box(20, 0.5), material(0));
            const DVec2 middle = turned({20, -0.5}, slope);
            addBody(world, bodyAt(BodyType::fixed, middle, slope), box(20, 0.5), material(0));
            const BodyId ball = addBody(world, dynamicAt({start, 0.25}, vec(30, 0)), circle(0.25), material(0));
            while (world.position(ball).x < 2) { must(world.step(kStep)); }
            const double left =
                energyOf(world, std::span(&ball, 1), kGravity) / (world.mass(ball) * (450 + 0.25 * kGravity));
            EXPECT_NEAR(left, std::pow(std::cos(slope), 2), 2e-3) << profileName(profile) << ", from " << start;
        }
    }
}

/// What rolled, and was put elsewhere, comes down on a slope as if it had never rolled.
TEST(CurvedGround, IsForgottenBySetPose) {
    for (const Profile profile : kProfiles) {
        double left[2] = {};
        for (const bool rolled : {false, true}) {
            World world = makeWorld(profile);
            addStatic(world, box(5, 0.5), material(0), {0, -0.5});
            addStatic(world, box(20, 0.5), material(0), {100, -0.5}, 0.2);
            const BodyId ball =
                addBody(world, dynamicAt({-3, rolled ? 0.25 : 5}, vec(5, 0)), circle(0.25), material(0));
            runFor(world, 0.3);
            must(world.setPose(ball, {100, 0.6}, 0));
            must(world.setVelocity(ball, vec(40, -20), 0));
            must(world.step(kStep));
            left[rolled ? 1 : 0] = length(velocityOf(world, ball));
        }
        EXPECT_EQ(left[0], left[1]) << profileName(profile);
    }
}

/// Fast enough to stay on it overhead, a marble goes round and round: the pieces that the pipe is made of take nothing
/// from it, and it stays within the circle that their corners lie on.
TEST(CurvedGround, OfAPipeTakesNoEnergyOfWhatGoesRound) {
    const double fast = 15;
    const PipeRide rides[] = {{.speed = 7},
                              {.speed = fast},
                              {.speed = fast, .friction = 0.3, .spin = -fast / kWheelRadius},
                              {.speed = fast, .pieces = 32},
                              {.speed = fast, .pieces = 512},
                              {.speed = 4, .gravity = 0},
                              {.speed = 40, .gravity = 0}};
    for (const Profile profile : kProfiles) {
        for (const PipeRide& ride : rides) {
            const PipeResult result = ridePipe(profile, ride);
            EXPECT_GE(result.left, 0.97) << ride.name(profile);
            expectAtMost(ride.name(profile) + "most", result.most, 1.0005);
            expectAtMost(ride.name(profile) + "deepest", result.deepest, 0.003 * kWheelRadius);
        }
    }
}

/// Who rides together in a bowl: a row of balls that touch, two on a rod, a car.
enum class Riders : std::uint8_t { row, rod, car };

struct Convoy {
    World world;
    std::vector<BodyId> bodies;

    Convoy(Profile profile, const Bowl& bowl, Riders riders) : world(makeWorld(profile)) {
        bowl.addTo(world);
        const double spacing = riders == Riders::row ? 2 * kWheelRadius : 6 * kWheelRadius;
        const DVec2 rear = wheelPlace(bowl, -1.6);
        double x = -1.6 + spacing / 2;
        for (int i = 0; i < 40; ++i) { x += spacing - length(wheelPlace(bowl, x) - rear); }
        const DVec2 front = wheelPlace(bowl, x);
        for (const DVec2 place : {rear, front}) {
            bodies.push_back(addBody(world, dynamicAt(place), circle(kWheelRadius), material(bowl.friction)));
        }
        if (riders == Riders::rod) {
            const JointDef ends{.bodyA = bodies[0], .bodyB = bodies[1]};
            must(world.createJoint(DistanceJointDef{.base = ends, .anchorA = rear, .anchorB = front}));
        }
        if (riders == Riders::car) { addChassis(rear, front, bowl.friction); }
    }

    static DVec2 wheelPlace(const Bowl& bowl, double x) {
        const double slope = 2 * bowl.steepness * x / kGroundHalf;
        const double scale = kWheelRadius / std::hypot(1, slope);
        return {x - slope * scale, bowl.at(x) + scale};
    }
    void addChassis(DVec2 rear, DVec2 front, double friction) {
        const DVec2 along = (1 / length(front - rear)) * (front - rear);
        const BodyDef def{.type = BodyType::dynamic,
                          .position = 0.5 * (rear + front) + 0.15 * DVec2{-along.y, along.x},
                          .angle = std::atan2(along.y, along.x)};
        const BodyId chassis = addBody(world, def, box(0.35, 0.08), material(friction));
        for (const DVec2 place : {rear, front}) {
            const BodyId wheel = place.x == rear.x ? bodies[0] : bodies[1];
            must(world.createJoint(RevoluteJointDef{.base = {.bodyA = chassis, .bodyB = wheel}, .anchor = place}));
        }
        bodies.push_back(chassis);
    }
    double energy() const {
        double sum = 0;
        for (const BodyId body : bodies) {
            sum +=
                kineticEnergy(world, body) + static_cast<double>(world.mass(body)) * kGravity * world.position(body).y;
        }
        return sum;
    }
    double mass() const {
        double sum = 0;
        for (const BodyId body : bodies) { sum += static_cast<double>(world.mass(body)); }
        return sum;
    }
};

/// Most that they have in energy in 30 s, above the lowest place, as a part of what they had.
double mostOfConvoy(Profile profile, const Bowl& bowl, Riders riders) {
    Convoy convoy(profile, bowl, riders);
    const double lowest = convoy.mass() * kGravity * kWheelRadius;
    const double before = convoy.energy() - lowest;
    double most = 0;
    for (int i = 0; i < 1800; ++i) {
        must(convoy.world.step(kStep));
        most = std::max(most, (convoy.energy() - lowest) / before);
    }
    return most;
}

TEST(CurvedGround, LiftsNobodyWhoRidesWithOthers) {
    for (const Profile profile : kProfiles) {
        for (const double steepness : {0.3, 0.6}) {
            for (const Riders riders : {Riders::row, Riders::rod, Riders::car}) {
                const Bowl bowl{.steepness = steepness, .segments = 800, .friction = riders == Riders::car ? 0.6 : 0.0};
                const std::string name = profileName(profile) + ", steepness " + std::to_string(steepness) + ", " +
                                         std::to_string(static_cast<int>(riders)) + ", most";
                expectAtMost(name, mostOfConvoy(profile, bowl, riders), 1.01);
            }
        }
    }
}

/// What rolled in a trough and is put onto a plane goes on there like what is new. (It bent its way by the turn from
/// the ground that it had left, and was off by up to 0.25 m/s.)
TEST(CurvedGround, IsForgottenByWhatIsPutOntoAPlane) {
    for (const Profile profile : kProfiles) {
        for (int rolled = 10; rolled < 60; rolled += 7) {
            for (const double turn : {-0.3, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.3}) {
                World world = makeWorld(profile);
                std::vector<Vec2> trough;
                for (int i = 0; i <= 64; ++i) { trough.push_back(toReal(turned({5, 0}, -kPi * i / 64))); }
                must(world.addChain(must(world.createBody({})), trough, false, material(0)));
                const BodyId ball = addBody(world, dynamicAt({-4.6, -1}), circle(0.2), material(0));
                run(world, rolled);
                const DVec2 velocity = velocityOf(world, ball);
                const double slope = std::atan2(velocity.y, velocity.x) - turn;
                const DVec2 place{40, -0.5};
                const DVec2 above = place + turned({0, 0.7 - 1e-4}, slope);
                World other = makeWorld(profile);
                for (World* const each : {&world, &other}) {
                    addStatic(*each, box(20, 0.5), material(0), place, slope);
                }
                must(world.setPose(ball, above, 0));
                const BodyId fresh =
                    addBody(other, dynamicAt(above, toReal(velocity), spinOf(world, ball)), circle(0.2), material(0));
                run(world, 3);
                run(other, 3);
                const DVec2 off = velocityOf(world, ball) - velocityOf(other, fresh);
                EXPECT_LT(length(off), 1e-5) << profileName(profile) << ", " << rolled << " steps, turned by " << turn;
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
