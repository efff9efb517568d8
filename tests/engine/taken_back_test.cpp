#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <swept/engine/islands/effort_trial.h>

#include "joint_support.h"
#include "state_of.h"

/// What was solved and is solved again, with more sub-steps or from impact to impact, begins as if it were the first
/// time.

namespace swept::test {
namespace {

/// The method stays what it was, with all that the solver is told of it: a large web is searched as patiently, and what
/// takes turns is in no class with what does not.
TEST(TakenBack, MoreSubStepsChangeNothingElse) {
    WorldSettings settings = awakeSettings(0);
    settings.maxJointError = real(1e-4);
    World world = makeWorld(settings);
    const BodyId ground = anchorOf(world);
    const BodyId body = addBody(world, dynamicAt({1, 0}), circle(0.5));
    const JointId joint = must(world.createJoint(RevoluteJointDef{.base = between(ground, body)}));
    run(world, 1);
    WorldState& state = stateOf(world);
    const Effort before{.direct = DirectScope::joints, .isInTurns = true, .isLarge = true, .retry = 3};
    state.bodies[body.index].effort = before;
    state.motions[body.index].center.x += 0.01;
    state.motions[body.index].pose.position.x += 0.01;
    const std::vector<std::uint32_t> members{body.index};
    const std::vector<std::uint32_t> joints{joint.index};
    ASSERT_TRUE(raiseMissedJoints(state, members, joints, kStep));
    Effort after = state.bodies[body.index].effort;
    EXPECT_GT(after.doublings, before.doublings);
    after.doublings = before.doublings;
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace swept::test
