#include <algorithm>
#include <cmath>
#include <string>

#include "../support/random.h"
#include "joint_support.h"

/// An island that advances from impact to impact is solved in parts, some of which are cut short. What forces, torques
/// and damping do to its members in a step stays the same.

namespace swept::test {
namespace {

enum class CutChange { gravity, torque, damping };

/// Two bodies on a slack rope, of which nothing else tells the second that the first one strikes a wall.
struct SlackPair {
    World world;
    BodyId other;

    SlackPair(Random& random, CutChange change, Profile profile) {
        WorldSettings settings = awakeSettings(change == CutChange::gravity ? 10 : 0);
        settings.profile = profile;
        world = makeWorld(settings);
        addStatic(world, box(0.1, 50), material(0), {0, 0});
        const double away = random.range(0.3, 1.8);
        BodyDef def = dynamicAt({-away, 0}, vec(random.range(100, 400), 0), random.range(-10, 10));
        def.angle = random.range(0, 3);
        def.linearDamping = real(random.range(60, 260));
        const BodyId striker = addBody(world, def, box(0.3, 0.05));
        def = dynamicAt({-away - 10, 0}, vec(0, change == CutChange::torque ? 0 : 30));
        def.linearDamping = change == CutChange::damping ? real(20) : real(0);
        other = addBody(world, def, circle(0.5));
        DistanceJointDef rope;
        rope.base = between(other, striker);
        rope.anchorA = world.position(other);
        rope.anchorB = world.position(striker);
        rope.limits = LengthLimits{0, 100};
        must(world.createJoint(rope));
    }
};

TEST(CutMotion, OfWhatNothingHoldsIsThatOfAWholeStep) {
    Random random(5);
    int strikes = 0;
    for (int trial = 0; trial < 150; ++trial) {
        const Profile profile = trial % 2 == 0 ? Profile::accurate : Profile::fast;
        const std::string what = "trial " + std::to_string(trial);
        SlackPair rising(random, CutChange::gravity, profile);
        run(rising.world, 1);
        strikes += static_cast<int>(rising.world.contactEvents().size());
        EXPECT_NEAR(rising.world.velocity(rising.other).y, 30 - 10 * kStep, 1e-3) << what;
        SlackPair turned(random, CutChange::torque, profile);
        must(turned.world.applyTorque(turned.other, real(5)));
        run(turned.world, 1);
        const double turn = 5 * kStep / turned.world.inertia(turned.other);
        EXPECT_NEAR(turned.world.angularVelocity(turned.other), turn, 0.005 * turn) << what;
        SlackPair damped(random, CutChange::damping, profile);
        run(damped.world, 1);
        EXPECT_NEAR(damped.world.velocity(damped.other).y, 30 * std::exp(-20 * kStep), 0.15) << what;
    }
    EXPECT_GT(strikes, 50) << "too few to prove anything";
}

}  // namespace
}  // namespace swept::test
