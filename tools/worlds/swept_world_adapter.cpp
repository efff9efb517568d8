#include <swept/samples/world_builder.h>

#include "../reference/joint_ends.h"
#include "../reference/peer_world.h"

// Compiled once for each precision; named by swept_world.cpp.

namespace swept::inline SWEPT_PRECISION {
namespace {

class SweptWorld final : public PeerWorld {
public:
    SweptWorld(const SceneDescription& scene, SceneWorld built)
        : PeerWorld(scene), built_(std::move(built)), ends_(jointEndsOf(scene)) {}

    void remove(std::span<const std::uint32_t> bodies) override {
        for (const std::uint32_t body : bodies) { (void)built_.world.destroyBody(built_.bodies[body]); }
    }
    void add(std::span<const std::uint32_t> bodies) override {
        std::string error;  // what could be made once can be made again
        (void)rebuildBodies(scene(), bodies, jointsOn(ends_, bodies), built_, error);
    }
    void setVelocity(std::uint32_t body, DVec2 velocity) override {
        const BodyId id = built_.bodies[body];
        (void)built_.world.setVelocity(id, toReal(velocity), built_.world.angularVelocity(id));
    }

    PeerStages stages() const override {
        if (!built_.world.settings().measureStageTimes) { return {}; }
        const StageTimes& times = built_.world.stageTimes();
        return {times.pairs, times.collide, times.islands, times.solve, times.continuous, times.finish};
    }

private:
    /// Seconds. Of a shorter step the clocks at the ends of its stages would be the greater part.
    static constexpr double kShortestWatched = 5e-6;

    void watchStages(bool on) {
        WorldSettings settings = built_.world.settings();
        if (settings.measureStageTimes == on) { return; }
        settings.measureStageTimes = on;
        (void)built_.world.configure(settings);  // as valid as it was
    }

    void advance() override { (void)built_.world.step(scene().settings.dt); }
    void afterStep() override { watchStages(lastStepSeconds() >= kShortestWatched); }
    bool isThere(std::size_t body) const override { return built_.world.isValid(built_.bodies[body]); }

    void readBody(std::size_t i, PeerSample& sample) const override {
        const World& world = built_.world;
        const BodyId id = built_.bodies[i];
        const DVec2 velocity = toDouble(world.velocity(id));
        const auto spin = static_cast<double>(world.angularVelocity(id));
        sample.frame.bodies.push_back({world.position(id), world.angle(id), velocity, spin, world.isAwake(id)});
        if (world.type(id) == BodyType::dynamic && world.isEnabled(id)) {
            const BodyDescription& description = scene().bodies[i];
            addMotion({world.mass(id), description.fixedRotation ? 0 : world.inertia(id), world.centerOfMass(id),
                       velocity, spin, description.gravityScale * scene().gravity},
                      sample);
        }
    }

    SceneWorld built_;
    std::vector<JointEnds> ends_;
};

}  // namespace

std::unique_ptr<PeerWorld> makeSweptPeer(const SceneDescription& scene, TaskSystem* tasks, std::string& error) {
    SceneWorld built;
    if (!buildWorld(scene, built, error)) { return nullptr; }
    built.world.setTaskSystem(tasks);
    WorldSettings settings = built.world.settings();
    settings.measureStageTimes = true;
    (void)built.world.configure(settings);
    return std::make_unique<SweptWorld>(scene, std::move(built));
}

}  // namespace swept::inline SWEPT_PRECISION
