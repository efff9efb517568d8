#include <swept/engine/tbb_task_system.h>
#include <swept/engine/world.h>

#include <cstdio>

/// A world on two threads of oneTBB.
int main() {
    swept::TbbTaskSystem tasks(2);
    swept::World world;
    world.setTaskSystem(&tasks);
    const auto ball = world.createBody({.type = swept::BodyType::dynamic}).value();
    bool ok = world.addShape(ball, swept::makeCircle({0, 0}, swept::Real(0.5)).value()).ok();
    for (int i = 0; ok && i < 10; ++i) { ok = world.step(1.0 / 60).ok(); }
    std::printf("y = %.3f m with %d workers\n", world.position(ball).y, tasks.workerCount());
    return ok && world.position(ball).y < 0 && tasks.workerCount() == 2 ? 0 : 1;
}
