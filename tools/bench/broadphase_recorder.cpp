#include <algorithm>

#include <swept/engine/world.h>

#include "broadphase_peer_scenes.h"
#include "peer_scenes.h"

namespace swept::bench {
namespace {

constexpr double kDt = 1.0 / 60;

ProxyKind kindOf(BodyType type) {
    switch (type) {
        case BodyType::fixed: return ProxyKind::fixed;
        case BodyType::kinematic: return ProxyKind::kinematic;
        case BodyType::dynamic: return ProxyKind::dynamic;
    }
    return ProxyKind::fixed;  // unreachable, but GCC cannot know
}

/// Our world, which tells the bounds of what moves.
class Recorder final : public PeerWorld {
public:
    explicit Recorder(const char* name) {
        motion_.name = name;
        settings_.profile = Profile::fast;
        settings_.gravity = {0, -10};
        (void)world_.configure(settings_);
    }

    void setGravity(Vec2 gravity) override {
        settings_.gravity = gravity;
        (void)world_.configure(settings_);
    }
    void setSleep(bool allowed) override {
        settings_.sleep = allowed;
        (void)world_.configure(settings_);
    }

    std::uint32_t addBody(const PeerBody& body) override {
        const auto number = static_cast<std::uint32_t>(bodies_.size());
        Tracked& tracked = bodies_.emplace_back();
        tracked.id = world_.createBody(body.def).value();
        tracked.type = body.def.type;
        for (const PeerShape& shape : body.shapes) {
            (void)world_.addShape(tracked.id, shape.polygon, shape.def);
            track(number, shape.polygon, shape.def.filter);
        }
        if (!body.loop.empty()) {
            ShapeDef def;
            def.friction = body.loopFriction;
            (void)world_.addChain(tracked.id, body.loop, true, def);
            for (std::size_t i = 0; i < body.loop.size(); ++i) {
                const Vec2 next = body.loop[(i + 1) % body.loop.size()];
                track(number, makeSegment(body.loop[i], next).value(), def.filter);
            }
        }
        return number;
    }

    void removeBody(std::uint32_t body) override {
        Tracked& tracked = bodies_[body];
        (void)world_.destroyBody(tracked.id);
        tracked.isGone = true;
        if (isRecording_) {
            for (const TrackedShape& shape : tracked.shapes) {
                if (shape.proxy != kNoProxy) { pending_.removed.push_back(shape.proxy); }
            }
        }
    }

    void addHinge(const PeerHinge& hinge) override {
        RevoluteJointDef def;
        def.base.bodyA = bodies_[hinge.a].id;
        def.base.bodyB = bodies_[hinge.b].id;
        def.anchor = hinge.anchor;
        def.limits = hinge.limits;
        def.motor = hinge.motor;
        def.spring = hinge.spring;
        (void)world_.createJoint(def);
    }

    void setVelocity(std::uint32_t body, Vec2 velocity) override {
        (void)world_.setVelocity(bodies_[body].id, velocity, 0);
    }

    void step(double dt) override { (void)world_.step(dt); }

    void startRecording() {
        isRecording_ = true;
        pending_ = {};
        note();
    }
    /// Adds a step to the motion: where everything is now.
    void note() {
        for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
            Tracked& tracked = bodies_[number];
            if (tracked.isGone) { continue; }
            const WorldTransform pose = poseOf(tracked);
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
        BodyId id{};
        BodyType type = BodyType::fixed;
        bool isGone = false;
        WorldTransform lastPose{};
        std::vector<TrackedShape> shapes;
    };

    void track(std::uint32_t body, const Polygon& polygon, const Filter& filter) {
        bodies_[body].shapes.push_back({polygon, filter});
    }

    WorldTransform poseOf(const Tracked& tracked) const {
        return {world_.position(tracked.id), rotationFromAngle(world_.angle(tracked.id))};
    }

    void noteBody(std::uint32_t number, const WorldTransform& pose, bool isNew) {
        Tracked& tracked = bodies_[number];
        tracked.lastPose = pose;
        const Vec2 motion = static_cast<Real>(kDt) * world_.velocity(tracked.id);
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
        traits.kind = kindOf(bodies_[body].type);
        traits.body = body;
        traits.filter = shape.filter;
        traits.extent = static_cast<float>(extentOf(shape.polygon));
        traits.reach = static_cast<float>(std::max(bounds.upper.x - bounds.lower.x, bounds.upper.y - bounds.lower.y) / 2);
        return traits;
    }

    World world_;
    WorldSettings settings_;
    std::vector<Tracked> bodies_;
    Motion motion_;
    MotionStep pending_;
    bool isRecording_ = false;
};

}  // namespace

RecordedScene recordPeerScene(PeerScene scene, double stepScale) {
    constexpr int kWarmSteps = 15;  // until boxes are renewed at different times again
    constexpr int kTimedSteps = 30;
    const auto scaled = [stepScale](int steps) { return 1 + static_cast<int>(stepScale * steps); };
    const std::unique_ptr<PeerScript> script = makePeerScript(scene);
    Recorder recorder(nameOf(scene));
    script->create(recorder);
    const int skipped = scaled(script->stepsToSkip());
    const int last = skipped + scaled(kWarmSteps) + scaled(kTimedSteps);
    for (int step = 0; step < last; ++step) {
        if (step == skipped) { recorder.startRecording(); }
        script->beforeStep(recorder, step);
        recorder.step(kDt);
        if (step >= skipped) { recorder.note(); }
    }
    return {recorder.take(), 1 + static_cast<std::size_t>(scaled(kWarmSteps))};
}

}  // namespace swept::bench
