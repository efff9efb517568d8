#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "../support/random.h"
#include "any_order_tasks.h"
#include "world_support.h"

/// Bullets that touch something as a step begins, or that meet what does: the solver moves both, and knows nothing of
/// what is on the way.

namespace swept::test {
namespace {

BodyDef tiedBulletAt(DVec2 position, Vec2 velocity, double spin = 0) {
    BodyDef def = dynamicAt(position, velocity, spin);
    def.bullet = true;
    return def;
}

WorldSettings settingsOf(std::uint64_t seed, double gravity = 0) {
    return awakeSettings(seed % 2 == 0 ? Profile::accurate : Profile::fast, gravity);
}

/// In the frame of a plank.
DVec2 seenFrom(const World& world, BodyId plank, BodyId body) {
    return turned(world.position(body) - world.position(plank), -static_cast<double>(world.angle(plank)));
}

constexpr double kTiedPlankHalf = 4;

/// Whether a body is behind a plank that it began in front of, and the plank has not turned far yet.
enum class Side { front, behind, unknown };
Side sideOf(const World& world, BodyId plank, BodyId body) {
    const DVec2 place = seenFrom(world, plank, body);
    const bool isBeside = std::abs(place.y) > 0.8 * kTiedPlankHalf;
    if (isBeside || std::abs(static_cast<double>(world.angle(plank))) > 0.5) { return Side::unknown; }
    return place.x > 0 ? Side::behind : Side::front;
}

/// A bullet sends a plank through another one, which is no bullet, and follows it. What gets the two planks apart again
/// must not put one of them through the bullet.
TEST(TiedBullets, StayInFrontOfPlanksThatAreSetApart) {
    constexpr int kRuns = 2000;
    int behind = 0;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
        Random random(seed);
        const double gravity = random.chance(0.5) ? kGravity : 0;
        World world = makeWorld(settingsOf(seed, gravity));
        std::vector<BodyId> planks;
        for (const double x : {3.0, 5.0}) {
            const double density = std::pow(10, random.range(0, 3));
            const double restitution = random.chance(0.5) ? random.range(0, 1) : 0;
            planks.push_back(
                addBody(world, dynamicAt({x, 0}), box(0.02, kTiedPlankHalf), material(0.6, restitution, density)));
        }
        const double y = random.range(-2, 2);
        const double speed = std::pow(10, random.range(1, 3));
        const double aside = random.range(-20, 20);
        const double spin = random.range(-200, 200);
        const double size = random.range(0.02, 0.2);
        const double density = std::pow(10, random.range(-1, 2));
        const BodyId bullet = addBody(world, tiedBulletAt({0, y}, vec(speed, aside), spin),
                                      seed % 4 < 2 ? circle(size) : box(size, 0.6 * size), material(0.6, 0, density));
        for (int i = 0; i < 40; ++i) {
            run(world, 1);
            const Side side = sideOf(world, planks[0], bullet);
            if (side == Side::unknown) { break; }
            if (side == Side::front) { continue; }
            ++behind;
            ADD_FAILURE() << "seed " << seed << ", step " << i;
            break;
        }
    }
    expectAtMost("behind the plank, of " + std::to_string(kRuns), behind, 0);
}

/// Rows of bullets that touch each other, thrown at a plank that touches what is behind it.
struct Volley {
    World world;
    BodyId plank;
    std::vector<BodyId> bullets;
    std::vector<BodyId> all;

    explicit Volley(std::uint64_t seed) : world(makeWorld(settingsOf(seed))) {
        Random random(seed);
        const double half = random.range(0.02, 0.06);
        const double plankDensity = std::pow(10, random.range(0.5, 2.5));
        plank = addBody(world, dynamicAt({0, 0}), box(half, kTiedPlankHalf), material(0.3, 0, plankDensity));
        all.push_back(plank);
        for (const double y : {-2.0, 0.5}) {
            const double density = std::pow(10, random.range(0, 2));
            all.push_back(addBody(world, dynamicAt({half + 0.2, y}), box(0.2, 0.2), material(0.3, 0, density)));
        }
        const int rows = random.integer(2, 4);
        const int columns = random.integer(2, 5);
        const double speed = std::pow(10, random.range(0.7, 2.3));
        const double from = 0.5 + random.uniform() * speed * kStep;
        constexpr double kSize = 0.1;
        const Polygon polygon = random.chance(0.5) ? circle(kSize) : box(kSize, kSize);
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const DVec2 place{-from - 2 * kSize * row, 2 * kSize * (column - 0.5 * columns)};
                bullets.push_back(addBody(world, tiedBulletAt(place, vec(speed, 0)), polygon, material(0.3, 0, 10)));
            }
        }
        all.insert(all.end(), bullets.begin(), bullets.end());
    }
};

TEST(TiedBullets, OfAVolleyPassNoPlank) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        Volley volley(seed);
        const DVec2 momentum = momentumOf(volley.world, volley.all);
        double energy = energyOf(volley.world, volley.all, 0);
        const double most = energy;
        std::vector<bool> isOut(volley.bullets.size());
        for (int i = 0; i < 30; ++i) {
            run(volley.world, 1);
            for (std::size_t k = 0; k < isOut.size(); ++k) {
                if (isOut[k]) { continue; }
                const Side side = sideOf(volley.world, volley.plank, volley.bullets[k]);
                EXPECT_NE(side, Side::behind) << "seed " << seed << ", step " << i << ", bullet " << k;
                isOut[k] = side != Side::front;
            }
            const double now = energyOf(volley.world, volley.all, 0);
            EXPECT_LE(now, energy + 1e-3 * most) << "seed " << seed << ", step " << i;
            energy = now;
        }
        EXPECT_LE(length(momentumOf(volley.world, volley.all) - momentum), 1e-3 * length(momentum)) << "seed " << seed;
    }
}

/// Who leaves the way of the solver, and when, is told in no order but that of time.
TEST(TiedBullets, DoTheSameInAnyOrder) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        ShuffledTasks tasks;
        Volley one(seed);
        Volley other(seed);
        other.world.setTaskSystem(&tasks);
        for (int i = 0; i < 20; ++i) {
            run(one.world, 1);
            run(other.world, 1);
            ASSERT_EQ(one.world.stateHash(), other.world.stateHash()) << "seed " << seed << ", step " << i;
        }
    }
}

/// A bullet that lies beside something looks for nobody, and still is in the way of a plank that something pushes.
TEST(TiedBullets, AtRestArePassedByNoPlank) {
    for (const bool sleep : {false, true}) {
        for (const Profile profile : kProfiles) {
            for (int late = 0; late < 8; ++late) {
                WorldSettings settings = awakeSettings(profile, 0);
                settings.sleep = sleep;
                World world = makeWorld(settings);
                const BodyId bullet = addBody(world, tiedBulletAt({0, 0}, {}), circle(0.1), material(0.3, 0, 10));
                addBody(world, dynamicAt({0.3, 0}), box(0.2, 0.2), material(0.3, 0, 10));
                run(world, sleep ? 300 : 3);
                const double speed = 60;
                const double from = -0.5 - speed * kStep * late / 8;
                const BodyId plank = addBody(world, dynamicAt({from, 0}, vec(speed, 0)), box(0.02, kTiedPlankHalf),
                                             material(0.3, 0, 10));
                addBody(world, dynamicAt({from - 0.07, 2}, vec(speed, 0)), box(0.05, 0.05), material(0.3, 0, 10));
                for (int i = 0; i < 10; ++i) {
                    run(world, 1);
                    EXPECT_GT(seenFrom(world, plank, bullet).x, 0)
                        << profileName(profile) << (sleep ? ", asleep" : "") << ", late " << late << ", step " << i;
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
