#include "scripted_world.h"

#include <string>
#include <utility>

#include "swept_world.h"

namespace swept::worlds {
namespace {

std::unique_ptr<PeerWorld> makeWorld(const SceneDescription& scene, const EngineChoice& engine, TaskSystem* tasks) {
    if (engine.isOurs == 0) { return makePeerWorld(scene, engine.peer); }
    std::string error;
    return makeSweptWorld(scene, engine.precision, tasks, error);
}

}  // namespace

ScriptedWorld::ScriptedWorld(BenchScene bench, const EngineChoice& engine, TaskSystem* tasks)
    : bench_(std::move(bench)) {
    bench_.scene.settings.profile = engine.profile;
    world_ = makeWorld(bench_.scene, engine, tasks);
    isPresent_.assign(bench_.scene.bodies.size(), true);
    if (world_ != nullptr && !bench_.absent.empty()) {
        // Backwards: what is made next takes the places in order again.
        take({bench_.absent.rbegin(), bench_.absent.rend()});
    }
}

void ScriptedWorld::step() {
    change();
    world_->step();
    ++steps_;
}

void ScriptedWorld::take(const std::vector<std::uint32_t>& bodies) {
    world_->remove(bodies);
    for (const std::uint32_t body : bodies) { isPresent_[body] = false; }
}

void ScriptedWorld::change() {
    if (!bench_.script) { return; }
    const SceneChange change = bench_.script(steps_);
    if (!change.removed.empty()) { take(change.removed); }
    if (!change.added.empty()) {
        world_->add(change.added);
        for (const std::uint32_t body : change.added) { isPresent_[body] = true; }
    }
    for (const SceneChange::Push& push : change.pushed) { world_->setVelocity(push.body, push.velocity); }
}

}  // namespace swept::worlds
