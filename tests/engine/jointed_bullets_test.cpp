#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "../support/random.h"
#include "any_order_tasks.h"
#include "joint_support.h"

/// A bullet keeps its promise whatever hangs on it: it passes through nothing dynamic, and its joints hold.

namespace swept::test {
namespace {

constexpr double kHeadRadius = 0.15;  ///< of the bullets
constexpr double kPlankHalfWidth = 0.05;
constexpr double kPlankHalfHeight = 0.2;

enum class Thrown { flail, arrow, chain };
enum class Struck { loose, wall, hinged };
constexpr Thrown kThrown[] = {Thrown::flail, Thrown::arrow, Thrown::chain};
constexpr Struck kStruck[] = {Struck::loose, Struck::wall, Struck::hinged};

std::string nameOf(Thrown thrown) {
    return thrown == Thrown::flail ? "flail" : thrown == Thrown::arrow ? "arrow" : "chain";
}
std::string nameOf(Struck struck) {
    return struck == Struck::loose ? "loose" : struck == Struck::wall ? "wall" : "hinged";
}

BodyId addThrown(World& world, DVec2 place, Vec2 velocity, const Polygon& polygon, double density) {
    BodyDef def = dynamicAt(place, velocity);
    def.bullet = true;
    return addBody(world, def, polygon, material(0.3, 0, density));
}

/// Where the head is, seen from a plank, and the angle of that.
struct Sight {
    DVec2 head;
    double angle;
};

/// Something thrown at upright planks 10 cm thick about a place, without gravity. The first of `bodies` is the head of
/// what is thrown.
struct Throw {
    World& world;
    std::vector<BodyId> bodies;
    std::vector<BodyId> planks;
    std::vector<JointId> joints;

    /// @param head  where it begins, seen from the middle of the planks
    /// @param turn  whether planks may
    Throw(World& in, Thrown thrown, Struck struck, double speed, DVec2 head, DVec2 middle = {}, bool turn = true)
        : world(in) {
        const int count = struck == Struck::loose ? 1 : struck == Struck::wall ? 5 : 2;
        for (int i = 0; i < count; ++i) {
            const DVec2 place = middle + DVec2{0, (2 * i - (count - 1)) * kPlankHalfHeight};
            BodyDef def = dynamicAt(place);
            def.fixedRotation = !turn;
            planks.push_back(addBody(world, def, box(kPlankHalfWidth, kPlankHalfHeight)));
        }
        if (struck == Struck::hinged) { hinge(planks[0], planks[1], middle); }
        addThrown(thrown, vec(speed, 0), middle + head);
        bodies.insert(bodies.end(), planks.begin(), planks.end());
    }

    void hinge(BodyId a, BodyId b, DVec2 anchor) {
        RevoluteJointDef def;
        def.base = between(a, b);
        def.anchor = anchor;
        joints.push_back(must(world.createJoint(def)));
    }

    void addThrown(Thrown thrown, Vec2 velocity, DVec2 head) {
        bodies.push_back(test::addThrown(world, head, velocity, circle(kHeadRadius), 4));
        if (thrown == Thrown::flail) {
            bodies.push_back(test::addThrown(world, head - DVec2{1, 0}, velocity, circle(kHeadRadius), 4));
            DistanceJointDef def;
            def.base = between(bodies[0], bodies[1]);
            def.anchorA = head;
            def.anchorB = head - DVec2{1, 0};
            joints.push_back(must(world.createJoint(def)));
        } else if (thrown == Thrown::arrow) {
            bodies.push_back(test::addThrown(world, head - DVec2{0.5, 0}, velocity, box(0.35, 0.02), 1));
            WeldJointDef def;
            def.base = between(bodies[0], bodies[1]);
            def.anchor = head - DVec2{kHeadRadius, 0};
            joints.push_back(must(world.createJoint(def)));
        } else {
            for (int i = 0; i < 4; ++i) {
                const DVec2 place = head - DVec2{kHeadRadius + 0.1 + 0.2 * i, 0};
                bodies.push_back(addBody(world, dynamicAt(place, velocity), box(0.1, 0.03), material(0.3, 0, 4)));
                hinge(bodies[bodies.size() - 2], bodies.back(), place + DVec2{0.1, 0});
            }
        }
    }

    Sight sightFrom(BodyId plank) const {
        const double angle = world.angle(plank);
        return {turned(world.position(bodies[0]) - world.position(plank), -angle), angle};
    }
    double worstJoint() const {
        double worst = 0;
        for (const JointId joint : joints) { worst = std::max(worst, static_cast<double>(world.jointError(joint))); }
        return worst;
    }
};

/// How deep the head is in a plank, metres.
double depthOf(DVec2 head) {
    const double x = std::fabs(head.x) - kPlankHalfWidth;
    const double y = std::fabs(head.y) - kPlankHalfHeight;
    const double apart = x > 0 || y > 0 ? std::hypot(std::max(x, 0.0), std::max(y, 0.0)) : std::max(x, y);
    return kHeadRadius - apart;
}

/// Radians: what turns farther in a step may have got out of the way, and be on the other side.
constexpr double kMostTurn = 0.5;

/// Whether a straight way leads through a plank from side to side.
bool leadsThrough(const Sight& from, const Sight& to) {
    if ((from.head.x > 0) == (to.head.x > 0) || std::fabs(to.angle - from.angle) > kMostTurn) { return false; }
    const double share = from.head.x / (from.head.x - to.head.x);
    return std::fabs(from.head.y + share * (to.head.y - from.head.y)) < kPlankHalfHeight;
}

struct Outcome {
    int passed = 0;
    double deepest = 0;
    double worstJoint = 0;
};

Outcome watch(Throw& shot, int steps) {
    Outcome outcome;
    std::vector<Sight> before;
    for (const BodyId plank : shot.planks) { before.push_back(shot.sightFrom(plank)); }
    for (int i = 0; i < steps; ++i) {
        must(shot.world.step(kStep));
        for (std::size_t k = 0; k < shot.planks.size(); ++k) {
            const Sight now = shot.sightFrom(shot.planks[k]);
            outcome.passed += leadsThrough(before[k], now) ? 1 : 0;
            outcome.deepest = std::max(outcome.deepest, depthOf(now.head));
            before[k] = now;
        }
        outcome.worstJoint = std::max(outcome.worstJoint, shot.worstJoint());
    }
    return outcome;
}

template <class Visit>
void forEachThrow(const Visit& visit) {
    Random random(58);
    for (const Profile profile : kProfiles) {
        for (const Thrown thrown : kThrown) {
            for (const Struck struck : kStruck) {
                for (const double speed : {20.0, 60.0, 200.0}) {
                    for (int i = 0; i < 4; ++i) {
                        const double distance = 0.5 + random.uniform() * speed * kStep;
                        const double height = random.range(-0.15, 0.15);
                        World world = makeWorld(profile, 0);
                        Throw shot(world, thrown, struck, speed, {-distance, height}, {}, i % 2 == 0);
                        visit(shot, profileName(profile) + ", " + nameOf(thrown) + " at " + nameOf(struck) + ", " +
                                        std::to_string(speed) + " m/s, throw " + std::to_string(i));
                    }
                }
            }
        }
    }
}

/// What contacts may give way by is half of that.
constexpr double kMostOverlap = kPlankHalfWidth / 2;

TEST(JointedBullets, PassThroughNothingDynamic) {
    forEachThrow([](Throw& shot, const std::string& what) {
        const Outcome outcome = watch(shot, 30);
        EXPECT_EQ(outcome.passed, 0) << what;
        expectAtMost(what + ": overlap", outcome.deepest, kMostOverlap);
    });
}

TEST(JointedBullets, HoldTogether) {
    forEachThrow([](Throw& shot, const std::string& what) {
        const double most = shot.world.settings().profile == Profile::fast ? 0.06 : 0.01;
        expectAtMost(what + ": joints", watch(shot, 30).worstJoint, most);
    });
}

TEST(JointedBullets, KeepTheirMomentum) {
    forEachThrow([](Throw& shot, const std::string& what) {
        const DVec2 before = momentumOf(shot.world, shot.bodies);
        run(shot.world, 30);
        expectAtMost(what, length(momentumOf(shot.world, shot.bodies) - before),
                     length(before) * (kIsDouble ? 1e-10 : 1e-4));
    });
}

TEST(JointedBullets, WakeWhatTheyReach) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile, 0);
        Throw shot(world, Thrown::flail, Struck::wall, 100, {-4, 0.05});
        must(world.step(kStep));  // planks know of each other
        for (const BodyId plank : shot.planks) { must(world.setAwake(plank, false)); }
        EXPECT_EQ(watch(shot, 10).passed, 0) << profileName(profile);
        EXPECT_TRUE(world.isAwake(shot.planks[2])) << profileName(profile);
    }
}

TEST(JointedBullets, MayBeMarkedLater) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile, 0);
        Throw shot(world, Thrown::flail, Struck::wall, 100, {-8, 0.05});
        const auto mark = [&](bool isBullet) {
            for (const BodyId body : {shot.bodies[0], shot.bodies[1]}) {
                BodyDef def = world.definition(body);
                def.bullet = isBullet;
                must(world.redefine(body, def));
            }
        };
        mark(false);
        run(world, 2);  // its joint is known as one of what is no bullet
        mark(true);
        EXPECT_EQ(watch(shot, 10).passed, 0) << profileName(profile);
    }
}

/// A joint that only brakes: friction on a table that is seen from above.
void brake(World& world, BodyId table, BodyId ball) {
    MotorJointDef def;
    def.base = between(table, ball);
    def.base.collideConnected = true;
    def.drive = {.linearVelocity = Vec2{0, 0}, .maxForce = real(0.001)};
    must(world.createJoint(def));
}

TEST(JointedBullets, BounceAsLooseOnesDo) {
    constexpr double kBounce = 0.95;
    Random random(59);
    for (const Profile profile : kProfiles) {
        for (const double speed : {8.0, 20.0, 60.0}) {
            for (int i = 0; i < 8; ++i) {
                World world = makeWorld(profile, 0);
                const BodyId table = must(world.createBody(bodyAt(BodyType::fixed, {})));
                std::vector<BodyId> balls;
                for (const double x : {-0.5 - random.uniform() * speed * kStep, 0.0}) {
                    BodyDef def = dynamicAt({x, 0}, vec(x < 0 ? speed : 0, 0));
                    def.bullet = true;
                    balls.push_back(addBody(world, def, circle(0.03), material(0, kBounce, 70)));
                    brake(world, table, balls.back());
                }
                run(world, 2 + static_cast<int>(0.6 / (speed * kStep)));
                const std::string what =
                    profileName(profile) + ", " + std::to_string(speed) + " m/s, ball " + std::to_string(i);
                expectAtMost(what,
                             std::fabs(static_cast<double>(world.velocity(balls[1]).x) / speed - (1 + kBounce) / 2),
                             0.001);
            }
        }
    }
}

std::vector<std::uint64_t> hashesOf(Profile profile, TaskSystem* tasks) {
    World world = makeWorld(profile, 0);
    world.setTaskSystem(tasks);
    for (int i = 0; i < 9; ++i) {
        const DVec2 head{-0.5 - 0.2 * i, 0.02 * i};
        Throw(world, kThrown[i % 3], kStruck[i / 3], 100, head, {0, 4.0 * i});
    }
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 12; ++i) {
        must(world.step(kStep));
        hashes.push_back(world.stateHash());
    }
    return hashes;
}

TEST(JointedBullets, AreTheSameOnAnyThreads) {
    for (const Profile profile : kProfiles) {
        const std::vector<std::uint64_t> alone = hashesOf(profile, nullptr);
        Crowds crowds;
        for (TaskSystem* const tasks : crowds.all) {
            EXPECT_EQ(hashesOf(profile, tasks), alone) << profileName(profile);
        }
    }
}

}  // namespace
}  // namespace swept::test
