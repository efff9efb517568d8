#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <swept/solver/direct/direct_parts.h>
#include <swept/solver/joint_islands/island_drive.h>
#include <swept/solver/joint_islands/joint_flow.h>
#include <swept/solver/joint_islands/joint_island_parts.h>
#include "../support/some_of.h"
#include "flow_oracle.h"
#include "flow_tree.h"

namespace swept::test {
namespace {

void expectSame(const FlowTree& tree, const FlowOracle& oracle, const std::string& seed) {
    constexpr double kNear = 2e-7;
    for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
        const IslandBody& body = tree.bodies[i];
        const std::string what = seed + ", body " + std::to_string(i);
        ASSERT_NEAR(body.place.position.x, oracle.place()[3 * i], kNear) << what;
        ASSERT_NEAR(body.place.position.y, oracle.place()[3 * i + 1], kNear) << what;
        ASSERT_NEAR(body.place.angle, oracle.place()[3 * i + 2], kNear) << what;
        ASSERT_NEAR(body.velocity.x, oracle.velocity()[3 * i], 30 * kNear) << what;
        ASSERT_NEAR(body.velocity.y, oracle.velocity()[3 * i + 1], 30 * kNear) << what;
        ASSERT_NEAR(body.spin, oracle.velocity()[3 * i + 2], 30 * kNear) << what;
    }
    std::size_t row = 0;
    for (const IslandHold& hold : tree.holds) {
        for (std::size_t i = 0; i < hold.count; ++i, ++row) {
            ASSERT_NEAR(hold.rows[i].total, oracle.impulses()[row], 30 * kNear) << seed << ", row " << row;
        }
    }
    for (std::size_t i = 0; i < tree.drives.size(); ++i) {
        const IslandDrive& drive = tree.drives[i];
        const bool holds = drive.motor == IslandDrive::Motor::holds;
        const double expected = holds ? oracle.impulses()[row++] : oracle.pushed()[i];
        const double given = drive.motorTotal + drive.springTotal;
        ASSERT_NEAR(given, expected, 30 * kNear) << seed << ", drive " << i;
    }
}

/// Takes random trees through a step. @param visit  called with each
template <class Visit>
void expectLed(bool isDriven, const Visit& visit) {
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        FlowTree tree(seed, isDriven);
        visit(tree);
        const FlowOracle oracle(tree);
        JointFlow flow;
        flow.start(tree.island(), kFlowStep / kFlowSubSteps);
        ASSERT_TRUE(flow.advance(kFlowStep, 64, JointFlow::Tremor::followed)) << "seed " << seed;
        flow.finish(tree.bodies, tree.holds, tree.drives);
        ASSERT_NO_FATAL_FAILURE(expectSame(tree, oracle, "seed " + std::to_string(seed)));
    }
}

/// Hinges, rods, welds, sliders and wheels, on what is fixed, moves or flies free, damped or not; speeds that joints do
/// not allow are taken away first.
TEST(JointFlow, LeadsWhereJointsDemand) {
    int kinds[5] = {0, 0, 0, 0, 0};
    expectLed(false, [&kinds](const FlowTree& tree) {
        for (std::size_t i = 0; i < 5; ++i) { kinds[i] += tree.jointKinds[i]; }
    });
    for (const int count : kinds) { EXPECT_GT(count, someOf(50)); }
}

/// The same with springs and motors.
TEST(JointFlow, LeadsWhereDrivesDemand) {
    int kinds[4] = {0, 0, 0, 0};
    expectLed(true, [&kinds](const FlowTree& tree) {
        for (std::size_t i = 0; i < 4; ++i) { kinds[i] += tree.driveKinds[i]; }
    });
    for (const int count : kinds) { EXPECT_GT(count, someOf(30)); }
}

/// A wheel that hangs at its middle.
struct OneHinge {
    std::vector<IslandBody> bodies{2};
    std::vector<IslandHold> holds{1};
    std::vector<IslandBranch> branches{1};
    std::vector<IslandDrive> drives{1};

    OneHinge() {
        bodies[0].column = kNoNode;
        bodies[1].inverseMass = bodies[1].inverseInertia = 1;
        holds[0].count = 2;
        holds[0].b = 1;
        holds[0].size = 1;
        holds[0].drives = 1;
        branches[0].body = 1;
        branches[0].holds[0] = 0;
    }
    bool advance() {
        JointFlow flow;
        flow.start({bodies, holds, branches, drives}, kFlowStep / kFlowSubSteps);
        return flow.advance(kFlowStep, 64, JointFlow::Tremor::followed);
    }
};

/// Who takes the step another way knows what happens then.
TEST(JointFlow, IsNotForAMotorThatGetsItsSpeed) {
    for (const double spin : {0.9, 0.97}) {
        OneHinge wheel;
        wheel.drives[0].motor = IslandDrive::Motor::pushes;
        wheel.drives[0].push = 0.05 / kFlowStep;  // of what it gains in the step
        wheel.drives[0].speed = 1;
        wheel.bodies[1].spin = spin;
        EXPECT_EQ(wheel.advance(), spin + 0.05 < 1);
    }
}

TEST(JointFlow, IsNotForAMotorThatIsTooWeak) {
    for (const double strength : {0.9, 1.1}) {
        OneHinge wheel;
        wheel.drives[0].motor = IslandDrive::Motor::holds;
        wheel.drives[0].most = strength;
        wheel.bodies[1].angularGain = 0.5 * kFlowStep / kFlowSubSteps;  // of a torque of 1 N·m
        EXPECT_EQ(wheel.advance(), strength > 1);
    }
}

TEST(JointFlow, IsNotForWhatReachesALimit) {
    for (const double limit : {0.9, 1.1}) {
        OneHinge wheel;
        wheel.drives[0].hasLimits = true;
        wheel.drives[0].lower = -1;
        wheel.drives[0].upper = limit * kFlowStep;
        wheel.bodies[1].spin = 1;
        EXPECT_EQ(wheel.advance(), limit > 1);
    }
}

}  // namespace
}  // namespace swept::test
