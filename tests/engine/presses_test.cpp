#include <algorithm>
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
        const std::string what = profileName(press.profile) + ", " + std::to_string(size) + " m, " +
                                 std::to_string(press.strength) + " weights";
        EXPECT_GT(height(), press.atLeast) << what;
        EXPECT_NEAR(height(), before, 1e-3) << what << ": sinks on";
    }
}

/// A kinematic plate comes down on a crate and draws it along; a ball that lies beside it has a tenth of its mass or
/// less, so that both are solved all at once, in `accurate`. Their impulses grew by as much in each sub-step, up to 5e6
/// N·s, and then friction flung the crate away at up to 12 km/s.
TEST(Presses, DoNotFlingAwayWhatIsSqueezed) {
    constexpr double kHalf = 0.3;
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const double down : {1.0, 2.0, 4.0}) {
            for (const double along : {0.0, 3.0, 6.0, 10.0}) {
                for (const double ratio : {0.1, 0.02}) {
                    WorldSettings settings = awakeSettings(profile);
                    World world = makeWorld(settings);
                    addStatic(world, segment(-10, 0, 10, 0));
                    const BodyId crate = addBody(world, dynamicAt({0, kHalf}), box(kHalf, kHalf));
                    const double radius = 2 * kHalf * std::sqrt(ratio / kPi);
                    const BodyId ball = addBody(world, dynamicAt({kHalf + radius, radius}), circle(radius));
                    BodyDef plate = bodyAt(BodyType::kinematic, {-0.2, 2 * kHalf + 0.55});
                    plate.velocity = vec(along, -down);
                    addBody(world, plate, box(0.8, 0.5));
                    double fastest = 0;
                    double strongest = 0;
                    for (int i = 0; i < 40; ++i) {
                        run(world, 1);
                        fastest =
                            std::max({fastest, length(velocityOf(world, crate)), length(velocityOf(world, ball))});
                        world.visitContacts([&strongest](const ContactView& contact) {
                            strongest = std::max(strongest, static_cast<double>(contact.impulse));
                        });
                    }
                    const std::string what = std::string(profile == Profile::fast ? "fast, " : "accurate, ") +
                                             std::to_string(down) + " m/s down, " + std::to_string(along) +
                                             " along, ball of " + std::to_string(ratio);
                    expectAtMost(what, fastest, 6 * std::hypot(along, down));
                    expectAtMost(what + ", N·s", strongest, 1e4);
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
