#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Many bodies, one moment: cradles, break shots, gas.

namespace swept::test {
namespace {

/// Newton's cradle without the strings: five touching balls are hit by a sixth.
TEST(SimultaneousImpacts, OnlyTheLastBallLeavesACradle) {
    for (const double speed : {1.0, 5.0, 10.0}) {
        World world = makeWorld(0);
        std::vector<BodyId> balls;
        for (int i = 0; i < 5; ++i) {
            balls.push_back(addBody(world, dynamicAt({i * 0.4, 0}), circle(0.2), material(0, 1)));
        }
        const BodyId hitter = addBody(world, dynamicAt({-1, 0}, vec(speed, 0)), circle(0.2), material(0, 1));
        runFor(world, 1 + 1 / speed);
        const std::string name = std::to_string(speed) + " m/s: ";
        EXPECT_GE(velocityOf(world, balls[4]).x, 0.99 * speed) << name;
        expectAtMost(name + "hitter", std::abs(velocityOf(world, hitter).x) / speed, 0.01);
        for (std::size_t i = 0; i < 4; ++i) {
            expectAtMost(name + "speed of ball " + std::to_string(i), std::abs(velocityOf(world, balls[i]).x) / speed,
                         0.01);
            expectAtMost(name + "way of ball " + std::to_string(i),
                         std::abs(world.position(balls[i]).x - 0.4 * static_cast<double>(i)), 0.4 / 1024);
        }
    }
}

/// Touching balls in a triangle are hit at the tip: what is a mirror image stays one, and no energy is lost.
/// @param rows  of balls
void expectSymmetricBreak(Profile profile, double speed, int rowsOfRack) {
    constexpr double kRadius = 0.1;
    World world = makeWorld(profile, 0);
    std::vector<std::vector<BodyId>> rows;
    std::vector<BodyId> all;
    for (int row = 0; row < rowsOfRack; ++row) {
        rows.emplace_back();
        for (int k = 0; k <= row; ++k) {
            const DVec2 place{row * std::sqrt(3.0) * kRadius, (2 * k - row) * kRadius};
            rows.back().push_back(addBody(world, dynamicAt(place), circle(kRadius), material(0, 1)));
            all.push_back(rows.back().back());
        }
    }
    all.push_back(addBody(world, dynamicAt({-1, 0}, vec(speed, 0)), circle(kRadius), material(0, 1)));
    const double before = energyOf(world, all, 0);
    runFor(world, 1 / speed + 0.25);
    const std::string name =
        profileName(profile) + ", " + std::to_string(speed) + " m/s, rows " + std::to_string(rowsOfRack) + ": ";
    double off = std::abs(velocityOf(world, all.back()).y);
    for (const std::vector<BodyId>& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            const DVec2 a = velocityOf(world, row[k]);
            const DVec2 b = velocityOf(world, row[row.size() - 1 - k]);
            off = std::max(off, length(a - DVec2{b.x, -b.y}));
        }
    }
    expectAtMost(name + "asymmetry", off / speed, 0.01);
    expectAtMost(name + "energy", std::abs(energyOf(world, all, 0) / before - 1), 1e-3);
}

/// (In `fast` those of more than 24 contacts bounced in turn, and the break was lopsided by a third of its speed.)
TEST(SimultaneousImpacts, ABreakShotIsSymmetric) {
    for (const Profile profile : kProfiles) {
        for (const double speed : {1.0, 3.0, 10.0}) {
            for (const int rows : {5, 6}) { expectSymmetricBreak(profile, speed, rows); }
        }
    }
}

/// A break straight on the tip of a rack of 15 billiard balls. What is hit at the same moment is hit together: one
/// after the other it was lopsided by half the speed.
TEST(SimultaneousImpacts, ABreakShotOfBulletsIsSymmetric) {
    constexpr double kRadius = 0.028575;
    constexpr double kSpeed = 6;
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const bool isBullet : {false, true}) {
            for (const double gap : {0.0, 0.001}) {
                for (const double restitution : {1.0, 0.95}) {
                    WorldSettings settings = awakeSettings(profile, 0);
                    World world = makeWorld(settings);
                    const auto ball = [&](DVec2 place, Vec2 velocity) {
                        BodyDef def = dynamicAt(place, velocity);
                        def.bullet = isBullet;
                        return addBody(world, def, circle(kRadius), material(0, restitution));
                    };
                    std::vector<std::vector<BodyId>> rows(5);
                    for (std::size_t row = 0; row < rows.size(); ++row) {
                        const auto depth = static_cast<double>(row);
                        for (std::size_t k = 0; k <= row; ++k) {
                            const double side = static_cast<double>(k) - depth / 2;
                            rows[row].push_back(
                                ball({depth * std::sqrt(3.0) * (kRadius + gap / 2), side * (2 * kRadius + gap)}, {}));
                        }
                    }
                    const BodyId cue = ball({-0.5, 0}, vec(kSpeed, 0));
                    run(world, 12);
                    double off = std::abs(velocityOf(world, cue).y);
                    for (const std::vector<BodyId>& row : rows) {
                        for (std::size_t k = 0; k < row.size(); ++k) {
                            const DVec2 a = velocityOf(world, row[k]);
                            const DVec2 b = velocityOf(world, row[row.size() - 1 - k]);
                            off = std::max(off, length(a - DVec2{b.x, -b.y}));
                        }
                    }
                    const std::string name = profileName(profile) + (isBullet ? ", bullets" : "") + ", gap " +
                                             std::to_string(gap) + ", restitution " + std::to_string(restitution);
                    expectAtMost(name, off / kSpeed, 0.01);
                }
            }
        }
    }
}

TEST(SimultaneousImpacts, AGasKeepsItsEnergy) {
    for (const double spread : {5.0, 20.0}) {
        World world = makeWorld(0);
        for (int side = 0; side < 4; ++side) {
            const double turn = side * kPi / 2;
            addStatic(world, segment(0, -5, 0, 5), material(0, 1), turned({5, 0}, turn), turn);
        }
        Random random(2);
        const auto normal = [&random] {  // Box and Muller
            const double u = 1 - random.uniform();
            return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * random.uniform());
        };
        std::vector<BodyId> disks;
        for (int i = 0; i < 100; ++i) {
            const DVec2 place{-4.5 + i % 10, -4.5 + static_cast<double>(i / 10)};
            const double x = spread * normal();
            disks.push_back(addBody(world, dynamicAt(place, vec(x, spread * normal())), circle(0.2), material(0, 1)));
        }
        const double before = energyOf(world, disks, 0);
        double lost = 0;
        for (int i = 0; i < 1200; ++i) {
            must(world.step(kStep));
            for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
        }
        const std::string name = std::to_string(spread) + " m/s: ";
        expectAtMost(name + "energy", std::abs(energyOf(world, disks, 0) / before - 1), 0.01);
        expectAtMost(name + "lost time", lost / (100 * 1200 * kStep), 1e-3);
        for (const BodyId disk : disks) {
            const DVec2 p = world.position(disk);
            EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), 5) << name;
        }
    }
}

/// Of sixty racks at once, far from each other, each breaks as if it were alone: so many contacts bounce in turn where
/// they are solved together, and profile `accurate` leaves these to their own islands. (Lopsided by a third.)
TEST(SimultaneousImpacts, BreakShotsBesideOthersAreSymmetric) {
    constexpr double kRadius = 0.1;
    constexpr double kSpeed = 40;
    constexpr int kRows = 4;
    World world = makeWorld(Profile::accurate, 0);
    std::vector<BodyId> balls;  // rack by rack, row by row
    for (int rack = 0; rack < 60; ++rack) {
        const DVec2 tip{0, 20.0 * rack};
        for (int row = 0; row < kRows; ++row) {
            for (int k = 0; k <= row; ++k) {
                const DVec2 place{row * std::sqrt(3.0) * kRadius, (2 * k - row) * kRadius};
                balls.push_back(addBody(world, dynamicAt(tip + place), circle(kRadius), material(0, 1)));
            }
        }
        addBody(world, dynamicAt(tip - DVec2{0.22, 0}, vec(kSpeed, 0)), circle(kRadius), material(0, 1));
    }
    run(world, 8);
    double off = 0;
    double fastest = 0;
    for (std::size_t first = 0; first < balls.size();) {
        const std::size_t row = first % (kRows * (kRows + 1) / 2);  // 0, 1, 3, 6: its first place
        const std::size_t count = row == 0 ? 1 : (row == 1 ? 2 : (row == 3 ? 3 : 4));
        for (std::size_t k = 0; k < count; ++k) {
            const DVec2 a = velocityOf(world, balls[first + k]);
            const DVec2 b = velocityOf(world, balls[first + count - 1 - k]);
            off = std::max(off, length(a - DVec2{b.x, -b.y}));
            fastest = std::max(fastest, length(a));
        }
        first += count;
    }
    expectAtMost("asymmetry", off / kSpeed, 1e-3);
    EXPECT_GT(fastest, 0.2 * kSpeed);
}

}  // namespace
}  // namespace swept::test
