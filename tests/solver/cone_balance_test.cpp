#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <swept/solver/direct/cone_balance.h>

/// Pushes within cones of friction that undo a load: against the law of the lever, and random loads that can be undone,
/// or provably cannot.

namespace swept::test {
namespace {

Wrench push(DVec2 force, DVec2 arm) { return {force, cross(arm, force)}; }

void addCone(ConeBalance& balance, DVec2 normal, DVec2 arm, double friction, double before = 0) {
    const DVec2 tangent{normal.y, -normal.x};
    balance.addEdge(push(normal + friction * tangent, arm), before);
    balance.addEdge(push(normal + (-friction) * tangent, arm), before);
}
double normalOf(const ConeBalance& balance, std::size_t cone) {
    return balance.part(2 * cone) + balance.part(2 * cone + 1);
}

TEST(ConeBalance, TwoFeetShareByTheLever) {
    for (const double place : {-0.75, -0.2, 0.0, 0.6}) {
        ConeBalance balance;
        addCone(balance, {0, 1}, {-1, -1}, 0.5);
        addCone(balance, {0, 1}, {1, -1}, 0.5);
        const double left = balance.solve({{0, -8}, -8 * place}, true, 1e-9);
        EXPECT_LE(left, 1e-9);
        EXPECT_NEAR(normalOf(balance, 0), 4 * (1 - place), 1e-8);
        EXPECT_NEAR(normalOf(balance, 1), 4 * (1 + place), 1e-8);
    }
}

TEST(ConeBalance, NoFootPulls) {
    ConeBalance balance;
    addCone(balance, {0, 1}, {-1, -1}, 0.5);
    addCone(balance, {0, 1}, {1, -1}, 0.5);
    EXPECT_GT(balance.solve({{0, -8}, -8 * 1.01}, true, 1e-9), 0.01);
    EXPECT_GE(balance.part(0), 0);
    EXPECT_GE(balance.part(1), 0);
    EXPECT_LE(balance.solve({{0, -8}, -8 * 1.01}, false, 1e-9), 1e-9) << "what cannot turn does not topple";
}

TEST(ConeBalance, FrictionEndsAtTheCone) {
    for (const double share : {0.99, 1.01}) {
        ConeBalance balance;
        addCone(balance, {0, 1}, {-1, 0}, 0.5);
        addCone(balance, {0, 1}, {1, 0}, 0.5);
        const double left = balance.solve({{4 * share, -8}, 0}, true, 1e-9);
        EXPECT_EQ(left <= 1e-9, share < 1) << left;
    }
}

/// A ball has one foot: nothing there can turn it, and nothing has to.
TEST(ConeBalance, OneFootUnderTheMiddle) {
    ConeBalance balance;
    addCone(balance, {0, 1}, {0, -1}, 0.5);
    EXPECT_LE(balance.solve({{0, -8}, 0}, true, 1e-9), 1e-9);
    EXPECT_NEAR(balance.part(0), 4, 1e-8);
    EXPECT_NEAR(balance.part(1), 4, 1e-8);
    EXPECT_GT(balance.solve({{0, -8}, 0.1}, true, 1e-9), 1e-3);
}

TEST(ConeBalance, StaysNearWhatWas) {
    ConeBalance balance;
    for (const double x : {-1.0, 0.0, 1.0}) { addCone(balance, {0, 1}, {x, -1}, 0.5, x == 0 ? 1.0 : 1.5); }
    EXPECT_LE(balance.solve({{0, -8}, 0}, true, 1e-9), 1e-9);  // they push with 8 in all
    EXPECT_EQ(balance.part(0), 1.5);
    EXPECT_EQ(balance.part(2), 1.0);
}

/// Loads that random pushes in the cones make are undone; loads on the other side of a plane that has all cones on the
/// one side are not, by no less than their distance from it.
TEST(ConeBalance, UndoesAllThatCanBeUndone) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    int lost = 0;
    for (int i = 0; i < 500; ++i) {
        ConeBalance balance;
        std::vector<Wrench> edges;
        const int cones = 1 + i % 6;
        for (int k = 0; k < 2 * cones; ++k) {
            const Wrench edge{{number(random), number(random)}, number(random)};
            edges.push_back(edge);
            balance.addEdge(edge, std::max(number(random), 0.0));
        }
        Wrench load;
        for (const Wrench& edge : edges) {
            const double part = std::max(number(random), 0.0);
            load += {-part * edge.force, -part * edge.twist};
        }
        lost += balance.solve(load, true, 1e-6) <= 1e-6 ? 0 : 1;
        Wrench sum = load;
        for (std::size_t k = 0; k < edges.size(); ++k) {
            EXPECT_GE(balance.part(k), 0);
            sum += {balance.part(k) * edges[k].force, balance.part(k) * edges[k].twist};
        }
        EXPECT_LE(length(sum.force), 1e-5) << i;
        EXPECT_LE(std::fabs(sum.twist), 1e-5) << i;
        // All edges on one side of a plane through 0.
        balance.clear();
        for (Wrench& edge : edges) {
            edge.force.y = std::fabs(edge.force.y);
            balance.addEdge(edge, std::max(number(random), 0.0));
        }
        EXPECT_GE(balance.solve({{number(random), 0.1}, number(random)}, true, 1e-6), 0.1 - 1e-12) << i;
    }
    EXPECT_LE(lost, 5);
}

}  // namespace
}  // namespace swept::test
