#include <cmath>

#include "modes.h"
#include "step.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per task: one sweep is work enough.
constexpr std::size_t kFlyerGrain = 4;

/// Whether the solver moved a body as far as only a fast one may: something hit it within the step.
bool wasFlung(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const auto extent = static_cast<double>(body.extent);
    const double turned = std::fabs(motion.angle - body.startAngle) * static_cast<double>(body.radius);
    return body.role == BodyRole::solved && extent > 0 &&
           length(motion.center - body.startCenter) + turned > static_cast<double>(kFastRatio) * extent;
}

bool isHeldAtImpacts(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    if (!body.isDynamic() || body.role == BodyRole::flyer || !isSwept(modeOf(world, body))) { return false; }
    return body.fast || wasFlung(world, slot);
}

LostTimeReason reasonOf(const WorldState& world, const Body& body) {
    return modeOf(world, body) == ContinuousMode::stop ? LostTimeReason::stop : LostTimeReason::clamp;
}

template <class T>
void append(std::vector<T>& all, std::vector<T>& some) {
    all.insert(all.end(), some.begin(), some.end());
    some.clear();
}

void merge(WorldState& world, FlightScratch& scratch) {
    append(world.contactEvents, scratch.events);
    append(world.lostTime, scratch.lostTime);
    append(world.impactPoses, scratch.impactPoses);
    world.counters.toiCalls += scratch.toiCalls;
    world.counters.toiIterations += scratch.toiIterations;
    world.counters.impacts += scratch.impacts;
    world.counters.speedsLimited += scratch.speedsLimited;
    scratch.toiCalls = scratch.toiIterations = scratch.impacts = scratch.speedsLimited = 0;
}

}  // namespace

void sweepFastBodies(WorldState& world, double dt) {
    for (const std::uint32_t slot : world.awake) {
        if (isHeldAtImpacts(world, slot)) { world.flyers.push_back(slot); }
    }
    if (world.flyers.empty()) { return; }
    world.counters.sweeps = world.flyers.size();
    world.flightScratch.resize(static_cast<std::size_t>(world.tasks->workerCount()));
    world.tasks->run(world.flyers.size(), kFlyerGrain, [&](std::size_t begin, std::size_t end, int worker) {
        FlightScratch& scratch = world.flightScratch[static_cast<std::size_t>(worker)];
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t slot = world.flyers[i];
            const Body& body = world.bodies[slot];
            if (body.role == BodyRole::flyer) {
                fly(world, slot, dt, scratch);
            } else {
                clampAtImpact(world, slot, dt, reasonOf(world, body), scratch);
            }
        }
    });
    for (FlightScratch& scratch : world.flightScratch) { merge(world, scratch); }
}

}  // namespace swept::inline SWEPT_PRECISION
