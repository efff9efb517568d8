#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <variant>

#include "../engine/world_scene.h"
#include "counter_names.h"
#include "engine_refusal.h"
#include "present_contacts.h"
#include "runner.h"
#include "scene_names.h"
#include "scene_reader.h"
#include "world_builder.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

const char* nameOf(LostTimeReason reason) {
    switch (reason) {
        case LostTimeReason::stop:
            return "stop";
        case LostTimeReason::budget:
            return "budget";
        case LostTimeReason::stuck:
            return "stuck";
        case LostTimeReason::clamp:
            return "clamp";
        case LostTimeReason::speedLimit:
            return "speedLimit";
    }
    return "";  // unreachable, but GCC cannot know
}

SceneEventType typeOf(ContactEventType type) {
    switch (type) {
        case ContactEventType::begin:
            return SceneEventType::begin;
        case ContactEventType::end:
            return SceneEventType::end;
        case ContactEventType::hit:
            return SceneEventType::hit;
        case ContactEventType::sensorBegin:
            return SceneEventType::sensorBegin;
        case ContactEventType::sensorEnd:
            return SceneEventType::sensorEnd;
    }
    return SceneEventType::begin;  // unreachable, but GCC cannot know
}

/// Energy and momenta of a moment.
struct Totals {
    double energy = 0;
    DVec2 momentum;
    double angularMomentum = 0;
};

/// Our world behind the common interface.
class WorldRunner final : public Runner {
public:
    WorldRunner(const SceneDescription& scene, const RunnerOptions& options, SceneWorld built)
        : scene_(scene), options_(options), built_(std::move(built)) {
        built_.world.setTaskSystem(options_.tasks);
        if (options_.measure) { touching_.emplace(scene_, built_); }
        beginReport();
    }

    bool step() override {
        if (options_.ways) { keepStarts(); }
        const Status status = timedStep();
        if (!status.ok()) {
            report_.refusal = refusalText("/settings", hasKey<SettingsDescription>(status.field), status);
            return false;
        }
        ++steps_;
        addStep(sums_, built_.world.counters());
        for (const LostTimeEntry& entry : built_.world.lostTime()) { noteLostTime(entry); }
        if (options_.collectEvents) { collectEvents(); }
        if (options_.measure) {
            measureOverlaps(touching_->ofMoved());
            measureJoints();
        }
        if (steps_ == options_.reportFrom) { beginReport(); }
        return true;
    }

    void read(Frame& frame, bool withContacts) const override {
        frame.step = steps_;
        frame.time = now();
        frame.bodies.clear();
        frame.contacts.clear();
        frame.impacts.clear();
        const World& world = built_.world;
        for (const BodyId id : built_.bodies) {
            frame.bodies.push_back({world.position(id), world.angle(id), toDouble(world.velocity(id)),
                                    static_cast<double>(world.angularVelocity(id)), world.isAwake(id)});
        }
        for (const ImpactPose& pose : world.impactPoses()) {
            frame.impacts.push_back({static_cast<int>(world.userData(pose.body)), pose.position, pose.angle});
        }
        if (options_.ways) { readWays(frame); }
        if (!withContacts) { return; }
        PresentContacts present(scene_, built_);
        for (const PresentContact& contact : present.all(steps_ > 0)) {
            frame.contacts.push_back(
                {contact.point, toDouble(contact.normal), static_cast<double>(contact.separation), 0});
        }
    }

    const std::vector<SceneEvent>& events() const override { return events_; }
    std::vector<std::string> approximations() const override { return {}; }

    std::string sceneNow() const override {
        const World& world = built_.world;
        return sceneOf(world, {.scene = scene_.name,
                               .ofBody = [&](BodyId id) { return bodyName(scene_, world.userData(id)); },
                               .ofJoint = [&](JointId id) { return jointName(scene_, world.userData(id)); }});
    }

    RunReport report() const override {
        RunReport report = report_;
        report.counters = namedCounters(sums_);
        for (std::size_t i = 0; i < lost_.size(); ++i) {
            for (const auto& [reason, seconds] : lost_[i]) {
                report.lostTime.push_back({static_cast<int>(i), seconds, nameOf(reason)});
            }
        }
        const Totals totals = this->totals();
        report.endEnergy = totals.energy;
        report.endMomentum = totals.momentum;
        report.endAngularMomentum = totals.angularMomentum;
        report.stateHash = built_.world.stateHash();
        for (const BodyId id : built_.bodies) {
            const World& world = built_.world;
            report.finite = report.finite && isFinite(world.position(id)) && std::isfinite(world.angle(id)) &&
                            isFinite(world.velocity(id)) && isFinite(world.angularVelocity(id));
        }
        return report;
    }

private:
    /// From here on, as if nothing had happened before; but the clock goes on.
    void beginReport() {
        const double stepSeconds = report_.stepSeconds;
        report_ = {};
        report_.stepSeconds = stepSeconds;
        sums_ = {};
        lost_.assign(scene_.bodies.size(), {});
        const Totals totals = this->totals();
        report_.startEnergy = totals.energy;
        report_.startMomentum = totals.momentum;
        report_.startAngularMomentum = totals.angularMomentum;
        if (!options_.measure) { return; }
        measureOverlaps(touching_->all(steps_ > 0));
        measureJoints();
    }

    Status timedStep() {
        if (!options_.measure) { return built_.world.step(scene_.settings.dt); }
        const auto start = std::chrono::steady_clock::now();
        const Status status = built_.world.step(scene_.settings.dt);
        report_.stepSeconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return status;
    }

    Totals totals() const {
        Totals totals;
        const World& world = built_.world;
        for (std::size_t i = 0; i < built_.bodies.size(); ++i) {
            const BodyId id = built_.bodies[i];
            if (world.type(id) != BodyType::dynamic || !world.isEnabled(id)) { continue; }
            const double mass = world.mass(id);
            const double inertia = scene_.bodies[i].fixedRotation ? 0 : world.inertia(id);
            const DVec2 velocity = toDouble(world.velocity(id));
            const auto spin = static_cast<double>(world.angularVelocity(id));
            const DVec2 center = world.centerOfMass(id);
            totals.energy += 0.5 * mass * dot(velocity, velocity) + 0.5 * inertia * spin * spin -
                             mass * scene_.bodies[i].gravityScale * dot(scene_.gravity, center);
            totals.momentum += mass * velocity;
            totals.angularMomentum += mass * cross(center, velocity) + inertia * spin;
        }
        return totals;
    }

    void keepStarts() {
        starts_.clear();
        for (const BodyId id : built_.bodies) {
            starts_.push_back({built_.world.position(id), built_.world.angle(id), 0});
        }
    }

    void readWays(Frame& frame) const {
        const World& world = built_.world;
        frame.ways.clear();
        frame.hits.clear();
        const StepCounters& counters = world.counters();
        frame.work = {counters.sweeps, counters.toiCalls, counters.toiIterations, counters.impacts, 0};
        for (std::size_t i = 0; i < starts_.size(); ++i) {
            const BodyId id = built_.bodies[i];
            const PoseFrame end{world.position(id), world.angle(id), 1};
            if (end.position == starts_[i].position && end.angle == starts_[i].angle) { continue; }
            WayFrame way{static_cast<int>(i), {starts_[i]}, 0};
            for (const ImpactPose& pose : world.impactPoses()) {
                if (pose.body == id) { way.poses.push_back({pose.position, pose.angle, pose.fraction}); }
            }
            way.poses.push_back(end);
            for (const LostTimeEntry& entry : world.lostTime()) {
                if (entry.body == id) { way.lostSeconds += entry.seconds; }
            }
            frame.work.lostSeconds += way.lostSeconds;
            frame.ways.push_back(std::move(way));
        }
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.type == ContactEventType::hit) { frame.hits.push_back({event.point, toDouble(event.normal)}); }
        }
    }

    void noteLostTime(const LostTimeEntry& entry) {
        auto& list = lost_[static_cast<std::size_t>(built_.world.userData(entry.body))];
        for (auto& [reason, seconds] : list) {
            if (reason != entry.reason) { continue; }
            seconds += entry.seconds;
            return;
        }
        list.emplace_back(entry.reason, entry.seconds);
    }

    double timeAt(double fraction) const { return (static_cast<double>(steps_ - 1) + fraction) * scene_.settings.dt; }

    void collectEvents() {
        events_.clear();
        const World& world = built_.world;
        for (const ContactEvent& event : world.contactEvents()) {
            const ShapeOrigin a = shapeOrigin(world.userData(event.shapeA));
            const ShapeOrigin b = shapeOrigin(world.userData(event.shapeB));
            events_.push_back({steps_, timeAt(event.fraction), event.fraction, typeOf(event.type), a.body, b.body,
                               a.shape, b.shape, event.point, toDouble(event.normal),
                               static_cast<double>(event.approachSpeed), static_cast<double>(event.impulse)});
            events_.back().segmentA = event.segmentA;
            events_.back().segmentB = event.segmentB;
        }
        for (const JointBreakEvent& event : world.jointBreaks()) {
            SceneEvent broken;
            broken.step = steps_;
            broken.fraction = 1;
            broken.time = timeAt(1);
            broken.type = SceneEventType::jointBreak;
            broken.a = static_cast<int>(world.userData(event.bodyA));
            broken.b = static_cast<int>(world.userData(event.bodyB));
            broken.point = event.point;
            broken.joint = static_cast<int>(event.userData);
            events_.push_back(broken);
        }
    }

    double now() const { return static_cast<double>(steps_) * scene_.settings.dt; }

    void measureOverlaps(const std::vector<PresentContact>& contacts) {
        for (const PresentContact& contact : contacts) {
            const double depth = -static_cast<double>(contact.separation);
            if (!(depth > report_.deepestPenetration)) { continue; }
            report_.deepestPenetration = depth;
            report_.deepestPair = DeepestPair{now(), contact.bodyA, contact.bodyB};
        }
    }

    /// What holds nothing has no error.
    bool isOff(JointId joint) const {
        const AnyJointDef any = built_.world.definition(joint);
        const JointDef& base = std::visit([](const auto& def) -> const JointDef& { return def.base; }, any);
        return !built_.world.isEnabled(base.bodyA) || !built_.world.isEnabled(base.bodyB);
    }
    void measureJoints() {
        for (std::size_t i = 0; i < built_.joints.size(); ++i) {
            const auto gap = static_cast<double>(built_.world.jointError(built_.joints[i]));
            if (!(gap > report_.largestJointError) || isOff(built_.joints[i])) { continue; }
            report_.largestJointError = gap;
            report_.worstJoint = WorstJoint{now(), static_cast<int>(i)};
        }
    }

    SceneDescription scene_;
    RunnerOptions options_;
    SceneWorld built_;
    std::int64_t steps_ = 0;
    StepCounters sums_;
    std::vector<std::vector<std::pair<LostTimeReason, double>>> lost_;
    std::vector<PoseFrame> starts_;  ///< before the last step
    std::vector<SceneEvent> events_;
    std::optional<PresentContacts> touching_;  ///< only to measure
    RunReport report_;
};

}  // namespace

std::unique_ptr<Runner> makeWorldRunner(const SceneDescription& scene, const RunnerOptions& options,
                                        std::string& error) {
    // A length of step that `World::step` refuses is bad input, as a body is that it does not create.
    const double dt = scene.settings.dt;
    if (!isInRange(dt) || !isInRange(1 / dt)) {
        error = refusalText("/settings", true, {StatusCode::outOfRange, "dt"}) + ", for dt = " + shortestNumber(dt) +
                " and for 1/dt" + (sizeof(Real) == sizeof(float) ? "; --precision f64 takes more" : "");
        return nullptr;
    }
    SceneWorld built;
    if (!buildWorld(scene, built, error)) { return nullptr; }
    return std::make_unique<WorldRunner>(scene, options, std::move(built));
}

}  // namespace swept::inline SWEPT_PRECISION
