#include <cmath>
#include <tuple>

#include "../bodies/awake.h"
#include "../solve/step_change.h"
#include "../stages/shared_step.h"
#include "../stages/step.h"
#include "../state/number_range.h"
#include "../state/profile.h"
#include "../world.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr int kMaxSubSteps = 1024;
constexpr int kMaxRelaxPasses = 64;

/// Enumerators that were made from numbers may be none.
Status checkKinds(const WorldSettings& settings) {
    if (settings.profile > Profile::fast) { return {StatusCode::outOfRange, "profile"}; }
    if (settings.continuous > ContinuousMode::subStep) { return {StatusCode::outOfRange, "continuous"}; }
    if (static_cast<int>(settings.broadphase) >= kBroadphaseKindCount) {
        return {StatusCode::outOfRange, "broadphase"};
    }
    return Status::success();
}

/// Infinite ones are none.
Status checkBudgets(const WorldSettings& settings) {
    if (std::isnan(settings.maxPenetration)) { return {StatusCode::notFinite, "maxPenetration"}; }
    if (settings.maxPenetration < 0) { return {StatusCode::negative, "maxPenetration"}; }
    if (std::isnan(settings.maxJointError)) { return {StatusCode::notFinite, "maxJointError"}; }
    if (settings.maxJointError < 0) { return {StatusCode::negative, "maxJointError"}; }
    if (std::isnan(settings.maxLostTime)) { return {StatusCode::notFinite, "maxLostTime"}; }
    if (settings.maxLostTime < 0) { return {StatusCode::negative, "maxLostTime"}; }
    return Status::success();
}

Status check(const WorldSettings& settings) {
    const Status kinds = checkKinds(settings);
    if (!kinds.ok()) { return kinds; }
    const Status gravity = checkNumber(settings.gravity, "gravity");
    if (!gravity.ok()) { return gravity; }
    if (settings.subSteps && (*settings.subSteps < 1 || *settings.subSteps > kMaxSubSteps)) {
        return {StatusCode::outOfRange, "subSteps"};
    }
    if (settings.relaxPasses && (*settings.relaxPasses < 0 || *settings.relaxPasses > kMaxRelaxPasses)) {
        return {StatusCode::outOfRange, "relaxPasses"};
    }
    if (settings.maxImpacts < 1) { return {StatusCode::outOfRange, "maxImpacts"}; }
    if (std::isnan(settings.maxSpeed)) { return {StatusCode::notFinite, "maxSpeed"}; }
    if (settings.maxSpeed <= 0) { return {StatusCode::notPositive, "maxSpeed"}; }
    if (!isFinite(settings.sleepSpeed)) { return {StatusCode::notFinite, "sleepSpeed"}; }
    if (settings.sleepSpeed < 0) { return {StatusCode::negative, "sleepSpeed"}; }
    if (settings.toiTolerance && !isFinite(*settings.toiTolerance)) { return {StatusCode::notFinite, "toiTolerance"}; }
    if (settings.toiTolerance && !(*settings.toiTolerance > 0)) { return {StatusCode::notPositive, "toiTolerance"}; }
    return checkBudgets(settings);
}

/// Whether what is in balance with the one settings is with the other ones.
bool restsAlike(const WorldSettings& a, const WorldSettings& b) {
    const auto key = [](const WorldSettings& s) {
        return std::tuple(s.gravity.x, s.gravity.y, s.profile, s.subSteps, s.relaxPasses, s.continuous,
                          s.maxPenetration, s.maxJointError, s.sleep);
    };
    return key(a) == key(b);
}

}  // namespace

World::World() : state_(std::make_unique<WorldState>()) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::World(const World& other) : state_(std::make_unique<WorldState>(*other.state_)) {}
World& World::operator=(const World& other) {
    if (this == &other) { return *this; }
    if (state_) {
        *state_ = *other.state_;
    } else {  // moved from
        state_ = std::make_unique<WorldState>(*other.state_);
    }
    return *this;
}

Status World::configure(const WorldSettings& settings) {
    const Status status = check(settings);
    if (!status.ok()) { return status; }
    WorldState& world = *state_;
    if (settings.broadphase != world.settings.broadphase) {
        if (world.shapes.size() > 0) { return {StatusCode::notNow, "broadphase"}; }
        world.broadphase = makeBroadphase(settings.broadphase);
    }
    if (!restsAlike(settings, world.settings)) { releaseAllHeld(world); }
    const bool isOtherPull = settings.gravity != world.settings.gravity;
    const bool isForbidden = world.settings.sleep && !settings.sleep;
    if (isOtherPull || isForbidden) { wakeAll(world); }
    if (isOtherPull || (settings.sleep && !world.settings.sleep)) { restAnew(world); }
    const int before = subStepsOf(world.settings);
    world.settings = settings;
    changeSubSteps(world, before);
    return Status::success();
}

const WorldSettings& World::settings() const { return state_->settings; }

Status World::setGravity(Vec2 gravity) {
    WorldSettings settings = state_->settings;
    settings.gravity = gravity;
    return configure(settings);
}

void World::setTaskSystem(TaskSystem* tasks) { state_->userTasks = tasks != nullptr ? tasks : &state_->serialTasks; }

Status World::step(double dt) {
    WorldState& world = *state_;
    const Status number = checkNumber(dt, "dt");
    if (!number.ok()) { return number; }
    if (!(dt > 0)) { return {StatusCode::notPositive, "dt"}; }
    if (!isInRange(1 / dt)) { return {StatusCode::outOfRange, "dt"}; }
    if (world.masslessBodies > 0) { return {StatusCode::missingMass, "body"}; }
    const std::uint64_t wokenBetween = world.counters.wokeUp - world.wokenBySteps;
    const double work = world.userTasks == &world.serialTasks ? 0 : workOf(world.counters);
    world.counters = {};
    world.stageTimes = {};
    world.counters.wokeUp = wokenBetween;
    world.contactEvents.clear();
    world.contactEvents.swap(world.eventsToCome);
    world.eventsBetween = world.contactEvents.size();
    world.jointBreaks.clear();
    world.bodiesPutBack.clear();
    world.bodiesFellAsleep.clear();
    world.lostTime.clear();
    world.impactPoses.clear();
    shareStep(world, work, [&world, dt] { runStages(world, dt); });
    world.wokenBySteps = world.counters.wokeUp;
    return Status::success();
}

std::span<const ContactEvent> World::contactEvents() const { return state_->contactEvents; }
std::span<const JointBreakEvent> World::jointBreaks() const { return state_->jointBreaks; }
std::span<const BodyId> World::bodiesPutBack() const { return state_->bodiesPutBack; }
std::span<const BodyId> World::bodiesFellAsleep() const { return state_->bodiesFellAsleep; }
std::span<const LostTimeEntry> World::lostTime() const { return state_->lostTime; }
std::span<const ImpactPose> World::impactPoses() const { return state_->impactPoses; }
const StepCounters& World::counters() const { return state_->counters; }
const StageTimes& World::stageTimes() const { return state_->stageTimes; }

}  // namespace swept::inline SWEPT_PRECISION
