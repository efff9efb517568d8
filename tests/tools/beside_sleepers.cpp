#include <cstdlib>
#include <string>
#include <vector>

#include <swept/engine/world.h>

/// `beside_sleepers CRATES STEPS fast|accurate`: twenty disks that glide, the last ten of them in a chain, and beside
/// them crates that fall asleep before step 120; from then on every tenth step kicks one. For counting instructions.

namespace swept {
namespace {

template <class T>
T must(const Result<T>& result) {
    if (!result) { std::exit(1); }
    return result.value();
}
void must(const Status& status) {
    if (!status) { std::exit(1); }
}

BodyId add(World& world, BodyType type, DVec2 position, const Polygon& shape, Real friction) {
    BodyDef def;
    def.type = type;
    def.position = position;
    const BodyId body = must(world.createBody(def));
    ShapeDef surface;
    surface.friction = friction;
    must(world.addShape(body, shape, surface));
    return body;
}

void addDisks(World& world) {
    add(world, BodyType::fixed, {-100, -1}, must(makeBox({50, 1})), 0);
    BodyId before;
    for (int i = 0; i < 20; ++i) {
        const double x = 1.5 * i - 140;
        const BodyId disk = add(world, BodyType::dynamic, {x, 0.5}, must(makeCircle({}, Real(0.5))), 0);
        must(world.setVelocity(disk, {2, 0}, 0));
        RevoluteJointDef hinge;
        hinge.base = {.bodyA = before, .bodyB = disk};
        hinge.anchor = {x - 0.75, 0.5};
        if (i > 10) { must(world.createJoint(hinge)); }
        before = disk;
    }
}

void run(World& world, int crates, int steps) {
    addDisks(world);
    std::vector<BodyId> sleepers;
    for (int i = 0; i < crates; ++i) {
        if (i % 50 == 0) { add(world, BodyType::fixed, {2.0 * i + 49, -1}, must(makeBox({50, 1})), Real(0.6)); }
        const Polygon box = must(makeBox({Real(0.5), Real(0.5)}));
        sleepers.push_back(add(world, BodyType::dynamic, {2.0 * i, 0.5}, box, Real(0.6)));
    }
    for (int i = 0; i < steps; ++i) {
        if (i >= 120 && i % 10 == 0) {
            must(world.setVelocity(sleepers[static_cast<std::size_t>(i) % sleepers.size()], {0, 1}, 0));
        }
        must(world.step(1.0 / 60));
        if (i == 119 && world.counters().awakeBodies != 20) { std::exit(2); }
    }
}

}  // namespace
}  // namespace swept

int main(int count, char** arguments) {
    if (count != 4) { return EXIT_FAILURE; }
    swept::World world;
    swept::WorldSettings settings;
    settings.gravity = {0, -10};
    settings.profile = std::string(arguments[3]) == "fast" ? swept::Profile::fast : swept::Profile::accurate;
    swept::must(world.configure(settings));
    swept::run(world, std::atoi(arguments[1]), std::atoi(arguments[2]));
    return EXIT_SUCCESS;
}
