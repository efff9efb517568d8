#include <cmath>
#include <string>

#include "joint_support.h"

/// What is pressed between two bodies is squeezed by as much as the load asks for, and no farther: however light it is,
/// it does not let the press through.

namespace swept::test {
namespace {

struct Press {
    Profile profile;
    double size;      ///< of the crate, metres
    double strength;  ///< of the motor, weights of the crate
    double atLeast;  ///< height of the plate's centre over that of the crate in the end, sizes; 0.7 where nothing gives
};

TEST(Presses, AreBorneByWhatTheyPress) {
    for (const Press& press :
         {Press{Profile::accurate, 0.05, 300, 0.35}, Press{Profile::accurate, 0.1, 100, 0.6},
          Press{Profile::accurate, 0.3, 300, 0.6}, Press{Profile::accurate, 1, 300, 0.68},
          Press{Profile::fast, 0.1, 30, 0.4}, Press{Profile::fast, 0.3, 100, 0.4}, Press{Profile::fast, 1, 300, 0.4}}) {
        WorldSettings settings = awakeSettings();
        settings.profile = press.profile;
        World world = makeWorld(settings);
        const double size = press.size;
        const BodyId floor = addStatic(world, box(20 * size, size), material(0.6), {0, -size});
        const BodyId crate = addBody(world, dynamicAt({0, 0.5 * size}), box(0.5 * size, 0.5 * size));
        const BodyId plate = addBody(world, dynamicAt({0, 1.2 * size}), box(0.8 * size, 0.2 * size));
        PrismaticJointDef def;
        def.base = between(floor, plate);
        def.anchor = {0, 1.2 * size};
        def.axis = {0, 1};
        def.motor = LinearMotor{real(-0.5 * std::sqrt(size)), real(press.strength * world.mass(crate) * kGravity)};
        must(world.createJoint(def));
        const auto height = [&] { return (world.position(plate).y - world.position(crate).y) / size; };
        runFor(world, 4);
        const double before = height();
        runFor(world, 4);
        const std::string what = std::string(press.profile == Profile::fast ? "fast" : "accurate") + ", " +
                                 std::to_string(size) + " m, " + std::to_string(press.strength) + " weights";
        EXPECT_GT(height(), press.atLeast) << what;
        EXPECT_NEAR(height(), before, 1e-3) << what << ": sinks on";
    }
}

}  // namespace
}  // namespace swept::test
