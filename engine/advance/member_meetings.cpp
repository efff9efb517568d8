#include "member_meetings.h"

#include <algorithm>
#include <vector>

#include "../contacts/may_touch.h"
#include "../containers/boxed_items.h"
#include "../flight/bullets_ahead.h"
#include "../flight/solved_pair.h"
#include "../flight/solved_path.h"
#include "../flight/sweep_circles.h"
#include "../flight/sweep_obstacles.h"
#include "../flight/sweep_tolerances.h"
#include "../state/tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// In the boxes of their paths.
void listMovers(const WorldState& world, std::span<const std::uint32_t> members, std::vector<BoxedItem>& movers) {
    movers.clear();
    for (const std::uint32_t slot : members) {
        const Body& body = world.bodies[slot];
        const Aabb box = boxOfPath(pathOf(world, slot), static_cast<double>(body.radius + kTargetRatio * body.widest));
        if (overlaps(box, box)) { movers.push_back({box, slot, meetsMembers(world, slot)}); }
    }
}

double firstMeetingOf(WorldState& world, std::uint32_t bullet, std::uint32_t other, double limit,
                      FlightScratch& scratch) {
    const Body& body = world.bodies[bullet];
    const Body& otherBody = world.bodies[other];
    const Sweep path = pathOf(world, bullet);
    const Sweep otherPath = pathOf(world, other);
    const Real circles = (body.radius + otherBody.radius) + 2 * kTargetRatio * std::min(body.widest, otherBody.widest);
    if (stayBeyond(path, otherPath, static_cast<double>(circles))) { return limit; }
    ++scratch.counters.sweeps;
    for (const std::uint32_t own : body.shapes) {
        for (const std::uint32_t met : otherBody.shapes) {
            const Shape& a = world.shapes[own];
            const Shape& b = world.shapes[met];
            if (a.def.sensor || b.def.sensor || !(limit > 0) || !mayTouch(world, a, b)) { continue; }
            FlightObstacle shapes{.own = own, .other = met};
            shapes.level = targetOf(world, shapes);
            allowTouch(world, shapes, path, otherPath);
            const FirstImpact impact = firstImpactWith(world, path, otherPath, shapes, limit, scratch, true);
            if (impact.hit) { limit = impact.fraction; }
        }
    }
    return limit;
}

}  // namespace

double firstMeetingOf(WorldState& world, std::span<const std::uint32_t> members, const StepPart& part, double limit,
                      FlightScratch& scratch) {
    listMovers(world, members, scratch.movers);
    forEachOverlap(scratch.movers, [&](std::uint32_t slot, std::uint32_t other) {
        const double share = part.length / part.dt;
        if (!movedFast(world, slot, share) && !movedFast(world, other, share)) { return; }
        limit = firstMeetingOf(world, slot, other, limit, scratch);
    });
    return limit;
}

}  // namespace swept::inline SWEPT_PRECISION
