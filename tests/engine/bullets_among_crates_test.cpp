#include <cmath>

#include "../support/random.h"
#include "world_support.h"

/// Many bullets among bodies that move, too: what several of them do in one step.

namespace swept::test {
namespace {

/// Whoever else they, or what they strike, meet in the same step: crates adrift and bullets among them, in a closed
/// room. Nothing passes a face, so no centre of a bullet is ever beneath one.
TEST(BulletsAmongCrates, GetIntoNone) {
    for (const double restitution : {1.0, 0.5}) {
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", restitution " + std::to_string(restitution));
            Random random(seed);
            World world = makeWorld(0.0);
            const ShapeDef surface = material(0, restitution);
            constexpr double kHalf = 20;
            for (const double edge : {-kHalf, kHalf}) {
                addStatic(world, box(0.5, kHalf), surface, {edge, 0});
                addStatic(world, box(kHalf, 0.5), surface, {0, edge});
            }
            for (int i = 0; i < 81; ++i) {
                const Vec2 drift = vec(random.range(-1, 1), random.range(-1, 1));
                addBody(world, dynamicAt({4.0 * (i % 9) - 16, 4.0 * (i / 9) - 16}, drift), box(0.5, 0.5), surface);
            }
            ShapeDef shot = surface;
            shot.filter = {.category = 2, .mask = ~2U};
            std::vector<BodyId> bullets;
            for (int i = 0; i < 200; ++i) {
                const double way = random.range(0, 2 * kPi);
                const double speed = random.range(30, 60);
                BodyDef def = dynamicAt({4.0 * (i % 8) - 14 + random.range(-1, 1), 4.0 * (i / 8 % 8) - 14},
                                        vec(speed * std::cos(way), speed * std::sin(way)));
                def.bullet = true;
                bullets.push_back(addBody(world, def, circle(0.1), shot));
            }
            for (int i = 0; i < 120; ++i) {
                must(world.step(kStep));
                for (const BodyId bullet : bullets) {
                    const QueryFilter others{.mask = 1};
                    world.overlapShape(circle(0.07), {world.position(bullet), {}}, others, [&](ShapeId shape) {
                        ADD_FAILURE() << "step " << i << ": bullet " << bullet.index << " is in body "
                                      << world.bodyOf(shape).index;
                        return false;
                    });
                }
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
