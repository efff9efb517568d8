#include <chrono>
#include <string>

#include "../support/random.h"
#include "world_support.h"

/// Piles of a thousand boxes and more at rest: all of their contacts are solved at once, and held afterwards.

namespace swept::test {
namespace {

struct Pile {
    World world = makeWorld();
    std::vector<BodyId> bodies;
    std::vector<DVec2> places;

    Pile() { addStatic(world, box(100, 0.5), material(0.6), {0, -0.5}); }
    void add(DVec2 place, double halfWidth, double halfHeight) {
        bodies.push_back(addBody(world, dynamicAt(place), box(halfWidth, halfHeight), material(0.6)));
        places.push_back(place);
    }
    double worstMove() const {
        double worst = 0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            worst = std::max(worst, length(world.position(bodies[i]) - places[i]));
        }
        return worst;
    }
};

/// Steps, and how many of them had no search. What begins at rest and nothing pushes, however weakly, would be in
/// balance without any (load_paths_test.cpp). @return that
int runAndCountHeld(Pile& pile, int steps) {
    int held = 0;
    for (int i = 0; i < steps; ++i) {
        if (i < 10) { must(pile.world.applyForce(pile.bodies[0], vec(1e-12, 0), pile.places[0])); }
        must(pile.world.step(kStep));
        if (i == 0) { EXPECT_EQ(pile.world.counters().directBodies, pile.bodies.size()); }
        const StepCounters& counters = pile.world.counters();
        EXPECT_EQ(counters.directBodies + counters.settledBodies, pile.bodies.size()) << "step " << i;
        EXPECT_EQ(counters.directGivenUp, 0U) << "step " << i;
        held += counters.settledBodies == pile.bodies.size() ? 1 : 0;
    }
    return held;
}

/// Unit boxes, μ 0.6, columns 1.05 apart: 1275 of them, for ten seconds.
TEST(LargePiles, Pyramid50) {
    constexpr int kRows = 50;
    constexpr int kSteps = 600;
    Pile pile;
    for (int row = 0; row < kRows; ++row) {
        for (int i = 0; i < kRows - row; ++i) { pile.add({1.05 * (i - 0.5 * (kRows - row - 1)), row + 0.5}, 0.5, 0.5); }
    }
    const int held = runAndCountHeld(pile, kSteps);
    // Box2D 3 at its stiffest: 1.3e-2. Measured 1.7e-6 in float; ten times that.
    expectAtMost("pyramid-50 move, m", pile.worstMove(), 2e-5);
    expectAtMost("pyramid-50 steps that are solved anew, part", 1 - held / static_cast<double>(kSteps), 0.25);
}

/// Bricks of 1 × 0.5, half of one at the ends of every other row: 1025 of them.
TEST(LargePiles, WallOfAThousandBricks) {
    constexpr int kRows = 50;
    constexpr int kColumns = 20;
    constexpr double kGap = 0.005;  // on both sides of each
    Pile pile;
    for (int row = 0; row < kRows; ++row) {
        const double height = 0.5 * row + 0.25;
        const bool isOdd = row % 2 != 0;
        for (int i = 0; i < kColumns - (isOdd ? 1 : 0); ++i) {
            pile.add({i + (isOdd ? 0.5 : 0), height}, 0.5 - kGap, 0.25);
        }
        if (!isOdd) { continue; }
        pile.add({-0.25, height}, 0.25 - kGap, 0.25);
        pile.add({kColumns - 0.75, height}, 0.25 - kGap, 0.25);
    }
    runAndCountHeld(pile, 60);
    expectAtMost("wall-1025 move, m", pile.worstMove(), 1e-4);
}

/// Stones of 0.6 to 1.4 m by 0.5 in rows of one length, 4 mm between them: no two lie on each other alike.
void expectStonesStand(double length, int rows, std::uint64_t seed) {
    SCOPED_TRACE(testing::Message() << rows << " rows, seed " << seed);
    Random random(seed);
    Pile pile;
    for (int row = 0; row < rows; ++row) {
        for (double left = length; left > 0;) {
            const double half = left > 2 ? random.range(0.3, 0.7) : left > 1.4 ? 0.25 * left : 0.5 * left;
            pile.add({left - half, 0.5 * row + 0.25}, half - 0.002, 0.25);
            left -= 2 * half;
        }
    }
    const int held = runAndCountHeld(pile, 60);
    expectAtMost("stones move, m", pile.worstMove(), 1e-4);
    expectAtMost("stones' steps that are solved anew, part", 1 - held / 60.0, 0.5);
}
TEST(LargePiles, WallsOfRandomStones) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) { expectStonesStand(24, 24, seed); }
}

/// Fifty rows of unit boxes, each set down up to 0.1 mm too high or too low.
void addUnevenPyramid(Pile& pile, double spacing) {
    Random random(3);
    for (int row = 0; row < 50; ++row) {
        for (int i = 0; i < 50 - row; ++i) {
            pile.add({spacing * (i - 0.5 * (50 - row)), row + 0.5 + (row > 0 ? random.range(-1e-4, 1e-4) : 0)}, 0.5,
                     0.5);
        }
    }
}
/// Stones as above in rows whose right ends are ragged: some of them fall off there.
void addRaggedWall(Pile& pile, double length, int rows) {
    Random random(3);
    for (int row = 0; row < rows; ++row) {
        for (double x = 0; x < length;) {
            const double half = random.range(0.3, 0.7);
            pile.add({x + half, 0.5 * row + 0.25}, half, 0.25);
            x += 2 * half + 0.004;
        }
    }
}
/// As many bricks in each of so many rows, every other row half a brick farther right.
void addOverhangingWall(Pile& pile, int rows) {
    for (int row = 0; row < rows; ++row) {
        for (int i = 0; i < rows; ++i) { pile.add({i + (row % 2 != 0 ? 0.5 : 0), 0.5 * row + 0.25}, 0.495, 0.25); }
    }
}

/// Piles that begin out of balance, or in one that is not found without a search: what that costs is kept for
/// `--gtest_output=json:FILE` (solver/README.md), that it finds something is checked.
TEST(LargePiles, AreFoundInTheirFirstSteps) {
    const auto start = [](const std::string& name, const auto& add) {
        SCOPED_TRACE(name);
        Pile pile;
        add(pile);
        std::string took = testing::PrintToString(pile.bodies.size()) + " bodies, ms (factorisations):";
        for (int i = 0; i < 4; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            must(pile.world.step(kStep));
            const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
            const StepCounters& counters = pile.world.counters();
            if (i == 0) {
                EXPECT_EQ(counters.directBodies, pile.bodies.size());
                EXPECT_EQ(counters.directGivenUp, 0U);
            }
            took += ' ' + testing::PrintToString(time.count()) + " (" +
                    testing::PrintToString(counters.factorisations) + ')';
        }
        testing::Test::RecordProperty(name, took);
    };
    start("pyramid, apart", [](Pile& pile) { addUnevenPyramid(pile, 1.02); });
    start("pyramid, side by side", [](Pile& pile) { addUnevenPyramid(pile, 1); });
    start("24 rows of stones", [](Pile& pile) { addRaggedWall(pile, 24, 24); });
    start("44 rows of stones", [](Pile& pile) { addRaggedWall(pile, 45, 44); });
    start("60 rows of stones", [](Pile& pile) { addRaggedWall(pile, 33, 60); });
    start("30 rows that overhang", [](Pile& pile) { addOverhangingWall(pile, 30); });
    start("44 rows that overhang", [](Pile& pile) { addOverhangingWall(pile, 44); });
}

}  // namespace
}  // namespace swept::test
