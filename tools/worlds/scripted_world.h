#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <swept/engine/task_system.h>
#include <swept/samples/runner.h>

#include "../reference/peer_world.h"
#include "bench_scene.h"

namespace swept::worlds {

/// Which engine, with which settings. Sent to a child as it is: both ends are the same program.
struct EngineChoice {
    std::int32_t isOurs = 0;
    Precision precision = Precision::f32;           ///< of ours
    SceneProfile profile = SceneProfile::accurate;  ///< of ours
    PeerSettings peer;                              ///< of another engine
};

/// A scene that runs in some engine with its script.
class ScriptedWorld {
public:
    /// @param tasks  of ours; null: the calling thread. Outlives this
    ScriptedWorld(BenchScene bench, const EngineChoice& engine, TaskSystem* tasks);
    ScriptedWorld(const ScriptedWorld&) = delete;
    ScriptedWorld& operator=(const ScriptedWorld&) = delete;
    ~ScriptedWorld() = default;

    /// False when the engine is not part of this build, or refused the scene; then the rest may not be called.
    bool isThere() const { return world_ != nullptr; }
    /// What the script does before it, and a step.
    void step();

    const BenchScene& bench() const { return bench_; }
    const PeerWorld& world() const { return *world_; }
    /// By body: false while it is taken away.
    const std::vector<bool>& isPresent() const { return isPresent_; }

private:
    void take(const std::vector<std::uint32_t>& bodies);
    void change();

    BenchScene bench_;
    std::unique_ptr<PeerWorld> world_;
    std::vector<bool> isPresent_;
    std::int64_t steps_ = 0;
};

}  // namespace swept::worlds
