#include "box2d3_threads.h"

#include <memory>
#include <variant>

#include <box2d/box2d.h>

#ifdef SWEPT_BENCH_TBB
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#endif

#include "box2d3_vector.h"

namespace swept::bench {
namespace {

constexpr int kSubSteps = 4;
constexpr float kStep = 1.0F / 60;

void addShape(b2BodyId body, const ShapeDescription& shape) {
    b2ShapeDef def = b2DefaultShapeDef();
    def.density = static_cast<float>(shape.density);
    def.material.friction = static_cast<float>(shape.friction);
    def.material.restitution = static_cast<float>(shape.restitution);
    if (const auto* box = std::get_if<BoxGeometry>(&shape.geometry)) {
        const b2Polygon polygon = b2MakeOffsetBox(static_cast<float>(box->half.x), static_cast<float>(box->half.y),
                                                  vectorOf(box->center), b2MakeRot(static_cast<float>(box->angle)));
        b2CreatePolygonShape(body, &def, &polygon);
    } else if (const auto* circle = std::get_if<CircleGeometry>(&shape.geometry)) {
        const b2Circle disk{vectorOf(circle->center), static_cast<float>(circle->radius)};
        b2CreateCircleShape(body, &def, &disk);
    } else if (const auto* capsule = std::get_if<CapsuleGeometry>(&shape.geometry)) {
        const b2Capsule pill{vectorOf(capsule->points[0]), vectorOf(capsule->points[1]),
                             static_cast<float>(capsule->radius)};
        b2CreateCapsuleShape(body, &def, &pill);
    }
}

#ifdef SWEPT_BENCH_TBB
/// Its tasks in an arena of oneTBB, as `TbbTaskSystem` runs our loops.
struct Tasks {
    tbb::task_arena arena;

    explicit Tasks(int threads) : arena(threads) {}

    static void* enqueue(b2TaskCallback* task, void* taskContext, void* userContext) {
        auto* const tasks = static_cast<Tasks*>(userContext);
        auto* const group = new tbb::task_group;  // NOLINT: handed to finish
        tasks->arena.execute([&] { group->run([task, taskContext] { task(taskContext); }); });
        return group;
    }
    static void finish(void* userTask, void* userContext) {
        const std::unique_ptr<tbb::task_group> group(static_cast<tbb::task_group*>(userTask));
        static_cast<Tasks*>(userContext)->arena.execute([&] { group->wait(); });
    }
};
#endif

class Box2d3World final : public TimedWorld {
public:
    Box2d3World(const SceneDescription& scene, [[maybe_unused]] int threads) {
        b2WorldDef def = b2DefaultWorldDef();
        def.gravity = vectorOf(scene.gravity);
        def.enableSleep = scene.settings.sleep;
#ifdef SWEPT_BENCH_TBB
        if (threads > 1) {
            tasks_ = std::make_unique<Tasks>(threads);
            def.workerCount = threads;
            def.enqueueTask = Tasks::enqueue;
            def.finishTask = Tasks::finish;
            def.userTaskContext = tasks_.get();
        }
#endif
        world_ = b2CreateWorld(&def);
        for (const BodyDescription& body : scene.bodies) {
            b2BodyDef bodyDef = b2DefaultBodyDef();
            bodyDef.type = body.type == SceneBodyType::dynamic ? b2_dynamicBody : b2_staticBody;
            bodyDef.position = vectorOf(body.position);
            bodyDef.linearVelocity = vectorOf(body.velocity);
            const b2BodyId id = b2CreateBody(world_, &bodyDef);
            for (const ShapeDescription& shape : body.shapes) { addShape(id, shape); }
        }
    }
    Box2d3World(const Box2d3World&) = delete;
    Box2d3World& operator=(const Box2d3World&) = delete;
    ~Box2d3World() override { b2DestroyWorld(world_); }

    void step() override { b2World_Step(world_, kStep, kSubSteps); }

private:
#ifdef SWEPT_BENCH_TBB
    std::unique_ptr<Tasks> tasks_;
#endif
    b2WorldId world_{};
};

}  // namespace

std::unique_ptr<TimedWorld> makeBox2d3Threads(const SceneDescription& scene, int threads) {
#ifndef SWEPT_BENCH_TBB
    if (threads > 1) { return nullptr; }
#endif
    return std::make_unique<Box2d3World>(scene, threads);
}

}  // namespace swept::bench
