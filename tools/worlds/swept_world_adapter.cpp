#include <swept/samples/world_builder.h>

#include "../bench/stopwatch.h"
#include "../reference/joint_ends.h"
#include "../reference/peer_world.h"

// Compiled once for each precision; named by swept_world.cpp.

namespace swept::inline SWEPT_PRECISION {
namespace {

class SweptWorld final : public PeerWorld {
public:
    SweptWorld(const SceneDescription& scene, SceneWorld built)
        : scene_(scene), built_(std::move(built)), ends_(jointEndsOf(scene)) {}

    void step() override {
        const bench::Stopwatch watch;
        (void)built_.world.step(scene_.settings.dt);
        lastSeconds_ = watch.seconds();
        seconds_ += lastSeconds_;
        watchStages(lastSeconds_ >= kShortestWatched);
        ++steps_;
    }

    PeerSample sample() const override {
        PeerSample sample;
        sample.frame.step = steps_;
        sample.frame.time = static_cast<double>(steps_) * scene_.settings.dt;
        sample.stepSeconds = seconds_;
        const World& world = built_.world;
        for (std::size_t i = 0; i < built_.bodies.size(); ++i) {
            const BodyId id = built_.bodies[i];
            if (!world.isValid(id)) {
                sample.frame.bodies.emplace_back();
                continue;
            }
            const DVec2 velocity = toDouble(world.velocity(id));
            const auto spin = static_cast<double>(world.angularVelocity(id));
            sample.frame.bodies.push_back({world.position(id), world.angle(id), velocity, spin, world.isAwake(id)});
            if (world.type(id) == BodyType::dynamic) {
                addMotion({world.mass(id), scene_.bodies[i].fixedRotation ? 0 : world.inertia(id),
                           world.centerOfMass(id), velocity, spin, scene_.bodies[i].gravityScale * scene_.gravity},
                          sample);
            }
        }
        return sample;
    }

    void remove(std::span<const std::uint32_t> bodies) override {
        for (const std::uint32_t body : bodies) {
            (void)built_.world.destroyBody(built_.bodies[body]);
        }
    }
    void add(std::span<const std::uint32_t> bodies) override {
        std::string error;  // what could be made once can be made again
        (void)rebuildBodies(scene_, bodies, jointsOn(ends_, bodies), built_, error);
    }
    void setVelocity(std::uint32_t body, DVec2 velocity) override {
        const BodyId id = built_.bodies[body];
        (void)built_.world.setVelocity(id, toReal(velocity), built_.world.angularVelocity(id));
    }

    double lastStepSeconds() const override { return lastSeconds_; }
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

    const SceneDescription& scene_;
    SceneWorld built_;
    std::vector<JointEnds> ends_;
    std::int64_t steps_ = 0;
    double seconds_ = 0;
    double lastSeconds_ = 0;
};

}  // namespace

std::unique_ptr<PeerWorld> makeSweptPeer(const SceneDescription& scene, std::string& error) {
    SceneWorld built;
    if (!buildWorld(scene, built, error)) {
        return nullptr;
    }
    WorldSettings settings = built.world.settings();
    settings.measureStageTimes = true;
    (void)built.world.configure(settings);
    return std::make_unique<SweptWorld>(scene, std::move(built));
}

}  // namespace swept::inline SWEPT_PRECISION
