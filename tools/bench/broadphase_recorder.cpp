#include <algorithm>

#include <swept/samples/world_builder.h>

#include "../reference/joint_ends.h"
#include "../worlds/bench_scene.h"
#include "broadphase_peer_scenes.h"

namespace swept::bench {
namespace {

constexpr double kDt = 1.0 / 60;

ProxyKind kindOf(SceneBodyType type) {
    switch (type) {
        case SceneBodyType::fixed:
            return ProxyKind::fixed;
        case SceneBodyType::kinematic:
            return ProxyKind::kinematic;
        case SceneBodyType::dynamic:
            return ProxyKind::dynamic;
    }
    return ProxyKind::fixed;  // unreachable, but GCC cannot know
}

/// Our world, which tells the bounds of what moves.
class Recorder {
public:
    explicit Recorder(const worlds::BenchScene& bench) : scene_(bench.scene), ends_(jointEndsOf(bench.scene)) {
        scene_.settings.profile = SceneProfile::fast;
        std::string error;  // what other benchmarks play can be built
        (void)buildWorld(scene_, built_, error);
        bodies_.resize(scene_.bodies.size());
        motion_.name = scene_.name;
        for (std::uint32_t body = 0; body < bodies_.size(); ++body) { track(body); }
        remove({bench.absent.rbegin(), bench.absent.rend()});
    }

    void change(const worlds::SceneChange& change) {
        remove(change.removed);
        std::string error;
        (void)rebuildBodies(scene_, change.added, jointsOn(ends_, change.added), built_, error);
        for (const std::uint32_t body : change.added) { track(body); }
        for (const worlds::SceneChange::Push& push : change.pushed) {
            const BodyId id = built_.bodies[push.body];
            (void)built_.world.setVelocity(id, toReal(push.velocity), built_.world.angularVelocity(id));
        }
    }

    void step(double dt) { (void)built_.world.step(dt); }

    void startRecording() {
        pending_ = {};
        note();
    }
    /// Adds a step to the motion: where everything is now.
    void note() {
        for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
            Tracked& tracked = bodies_[number];
            if (tracked.isGone) { continue; }
            const WorldTransform pose = poseOf(number);
            const bool isNew = !tracked.shapes.empty() && tracked.shapes.front().proxy == kNoProxy;
            if (isNew || !(pose == tracked.lastPose)) { noteBody(number, pose, isNew); }
        }
        std::sort(pending_.removed.begin(), pending_.removed.end());
        motion_.steps.push_back(std::move(pending_));
        pending_ = {};
    }

    Motion take() { return std::move(motion_); }

private:
    static constexpr std::uint32_t kNoProxy = ~0U;

    struct TrackedShape {
        Polygon polygon;
        Filter filter;
        std::uint32_t proxy = kNoProxy;  // numbered when it is first told of
    };
    struct Tracked {
        bool isGone = false;
        WorldTransform lastPose{};
        std::vector<TrackedShape> shapes;
    };

    void track(std::uint32_t body) {
        bodies_[body] = {};
        for (const ShapeDescription& shape : scene_.bodies[body].shapes) {
            const Filter filter{shape.filter.category, shape.filter.mask, shape.filter.group};
            for (const Polygon& polygon : polygonsOf(shape)) { bodies_[body].shapes.push_back({polygon, filter}); }
        }
    }

    void remove(const std::vector<std::uint32_t>& bodies) {
        for (const std::uint32_t body : bodies) {
            (void)built_.world.destroyBody(built_.bodies[body]);
            bodies_[body].isGone = true;
            for (const TrackedShape& shape : bodies_[body].shapes) {
                if (shape.proxy != kNoProxy) { pending_.removed.push_back(shape.proxy); }
            }
        }
    }

    WorldTransform poseOf(std::uint32_t body) const {
        const BodyId id = built_.bodies[body];
        return {built_.world.position(id), rotationFromAngle(built_.world.angle(id))};
    }

    void noteBody(std::uint32_t number, const WorldTransform& pose, bool isNew) {
        Tracked& tracked = bodies_[number];
        tracked.lastPose = pose;
        const Vec2 motion = static_cast<Real>(kDt) * built_.world.velocity(built_.bodies[number]);
        for (TrackedShape& shape : tracked.shapes) {
            const Aabb bounds = boundsOf(shape.polygon, pose);
            if (isNew) {
                shape.proxy = static_cast<std::uint32_t>(motion_.proxies.size());
                motion_.proxies.push_back(traitsOf(shape, number, bounds));
            }
            (isNew ? pending_.placed : pending_.moved).push_back({shape.proxy, bounds, motion});
        }
    }

    ProxyTraits traitsOf(const TrackedShape& shape, std::uint32_t body, const Aabb& bounds) const {
        ProxyTraits traits;
        traits.kind = kindOf(scene_.bodies[body].type);
        traits.body = body;
        traits.filter = shape.filter;
        traits.extent = static_cast<float>(extentOf(shape.polygon));
        traits.reach =
            static_cast<float>(std::max(bounds.upper.x - bounds.lower.x, bounds.upper.y - bounds.lower.y) / 2);
        return traits;
    }

    SceneDescription scene_;
    std::vector<JointEnds> ends_;
    SceneWorld built_;
    std::vector<Tracked> bodies_;
    Motion motion_;
    MotionStep pending_;
};

}  // namespace

const char* nameOf(PeerScene scene) {
    switch (scene) {
        case PeerScene::compounds:
            return "compounds";
        case PeerScene::smash:
            return "smash";
        case PeerScene::spinner:
            return "spinner";
        case PeerScene::tumbler:
            return "tumbler";
        case PeerScene::washer:
            return "washer";
        case PeerScene::jointGrid:
            return "joint-grid";
        case PeerScene::rain:
            return "rain";
        case PeerScene::junkyard:
            return "junkyard";
    }
    return "";  // unreachable, but GCC cannot know
}

RecordedScene recordPeerScene(PeerScene scene, double stepScale) {
    constexpr int kWarmSteps = 15;  // until boxes are renewed at different times again
    constexpr int kTimedSteps = 30;
    const auto scaled = [stepScale](int steps) { return 1 + static_cast<int>(stepScale * steps); };
    const worlds::BenchScene bench = worlds::sceneNamed(nameOf(scene))->make(1);
    Recorder recorder(bench);
    const int skipped = scaled(bench.warmSteps);
    const int last = skipped + scaled(kWarmSteps) + scaled(kTimedSteps);
    for (int step = 0; step < last; ++step) {
        if (step == skipped) { recorder.startRecording(); }
        if (bench.script) { recorder.change(bench.script(step)); }
        recorder.step(kDt);
        if (step >= skipped) { recorder.note(); }
    }
    return {recorder.take(), 1 + static_cast<std::size_t>(scaled(kWarmSteps))};
}

}  // namespace swept::bench
