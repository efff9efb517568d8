#include "bullet_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <span>

#include "../../broadphase/wide_kernels.h"
#include "../bodies/place_order.h"
#include "../contacts/may_touch.h"
#include "../containers/move_all.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "bullet_meetings.h"
#include "bullet_paths.h"
#include "bullet_start.h"
#include "flight_state.h"
#include "free_path.h"
#include "solved_pair.h"
#include "sweep_circles.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Of its path. One that overflowed is nowhere: a box that is no box would hide others in a tree.
Aabb boxOf(const BulletPartner& partner) {
    const Body& body = partner.flight.body();
    const Aabb box = boxOfPath(partner.path, static_cast<double>(body.radius + kTargetRatio * body.widest));
    return overlaps(box, box) ? box : kNoBox;
}

/// Made in place: it is large, and a copy would have to wait for what was just written.
void makePartner(BulletPartner& place, WorldState& world, std::uint32_t slot, double dt, FlightScratch& scratch) {
    const Body& body = world.bodies[slot];
    BulletPartner& partner = *new (&place) BulletPartner{.flight = flightOf(world, slot, dt, scratch), .path = {}};
    partner.isBullet = isBullet(world, slot);
    partner.clash = dissolvedClashOf(world, slot);
    if (body.awake && body.role == BodyRole::flyer) {
        partner.flies = partner.moved = true;
        limitSpeed(partner.flight);
        resolveStart(partner.flight);
        return;
    }
    partner.tied = isTied(body);
    const BodyMotion& motion = world.motions[slot];
    partner.path = {.localCenter = toDouble(body.localCenter),
                    .c0 = body.awake ? body.startCenter : motion.center,
                    .c1 = motion.center,
                    .a0 = body.awake ? body.startAngle : motion.angle,
                    .a1 = motion.angle};
    if (partner.tied && body.awake) {
        partner.lead = toReal((1 / dt) * (partner.path.c1 - partner.path.c0)) - motion.velocity;
        partner.angularLead = static_cast<Real>((partner.path.a1 - partner.path.a0) / dt) - motion.angularVelocity;
    }
    if (body.awake && body.role == BodyRole::free) {
        const Drift drift = driftOf(world, body, dt);
        const DVec2 way = partner.path.c1 - partner.path.c0;
        partner.path.k = way - dt * toDouble(velocityBefore(way, 0, drift).linear);
    }
}

/// What it does in the rest of the step while nothing happens to it, and when that meets something static or kinematic.
void renewPath(BulletPartner& partner, std::vector<BulletMeeting>& meetings) {
    ++partner.changes;
    if (!partner.flies) { return; }
    const Flight& flight = partner.flight;
    partner.pathFrom = flight.elapsed;
    partner.path = sweepOf(flight);
    const FirstImpact first = nextImpact(flight, partner.path);
    if (!first.hit) { return; }
    meetings.push_back({.time = flight.elapsed + first.fraction * flight.remaining(),
                        .first = flight.slot,
                        .second = kNoIndex,
                        .firstChanges = partner.changes,
                        .shapes = {}});
}

Vec2 carrierOf(const BulletWork& work, const BulletPartner& first, std::uint32_t second) {
    for (std::uint32_t i = first.firstCarrier; i != kNoIndex; i = work.carriers[i].next) {
        if (work.carriers[i].other == second) { return work.carriers[i].normal; }
    }
    return {};
}

double turnOf(const Sweep& path) { return std::fabs(path.a1 - path.a0); }

/// How far any point of one may get relative to the other, metres; turns count as if they were not the same.
double wayBetween(const Body& body, const Sweep& path, const Body& otherBody, const Sweep& otherPath) {
    const DVec2 way = (path.c1 - path.c0) - (otherPath.c1 - otherPath.c0);
    return length(way) + turnOf(path) * static_cast<double>(body.radius) +
           turnOf(otherPath) * static_cast<double>(otherBody.radius);
}

/// Radians in a step beyond which ways along something that turns are no straight ones.
constexpr double kMostTurn = 1;

/// Two that the solver moved, one of them a bullet that may leave its way. What contacts do to them is done, and of
/// those only what is fast gets far into what it touches, or past it.
bool mayPass(const BulletPartner& first, const BulletPartner& second, const Sweep& otherPath, const Sweep& path) {
    if (!mayLeave(first) && !mayLeave(second)) { return false; }
    const Body& body = first.flight.body();
    const Body& other = second.flight.body();
    const Sweep& longer = body.radius > other.radius ? otherPath : path;
    if (turnOf(longer) > kMostTurn) { return false; }
    const auto extent = static_cast<double>(std::min(body.extent, other.extent));
    return wayBetween(body, otherPath, other, path) > static_cast<double>(kFastRatio) * extent;
}

/// First impact of any two of their shapes from now on.
void predict(const WorldState& world, std::uint32_t one, std::uint32_t other, FlightScratch& scratch,
             std::vector<BulletMeeting>& meetings) {
    const BulletWork& work = world.bulletWork;
    const bool inOrder = work.partners[one].flight.slot < work.partners[other].flight.slot;
    const BulletPartner& first = work.partners[inOrder ? one : other];
    const BulletPartner& second = work.partners[inOrder ? other : one];
    const double from = std::max(first.pathFrom, second.pathFrom);
    const bool wereTogether = first.clash != kNoIndex && first.clash == second.clash;
    if (!first.isBullet && !second.isBullet && !wereTogether) { return; }
    if (!(from < work.dt)) { return; }
    const Body& firstBody = world.bodies[first.flight.slot];
    const Body& secondBody = world.bodies[second.flight.slot];
    const Sweep path = pathAfter(second, from);
    const Sweep otherPath = pathAfter(first, from);
    const bool areTied = first.tied && second.tied;
    if (areTied && !mayPass(first, second, otherPath, path)) { return; }
    const Real circles =
        (firstBody.radius + secondBody.radius) + kTargetRatio * std::min(firstBody.widest, secondBody.widest);
    if (stayBeyond(otherPath, path, static_cast<double>(circles))) { return; }
    const Vec2 carrier = carrierOf(work, first, second.flight.slot);
    BulletMeeting meeting{.time = kNever,
                          .first = first.flight.slot,
                          .second = second.flight.slot,
                          .firstChanges = first.changes,
                          .secondChanges = second.changes,
                          .shapes = {}};
    double limit = 1;
    for (const std::uint32_t own : secondBody.shapes) {
        for (const std::uint32_t met : firstBody.shapes) {
            const Shape& a = world.shapes[met];
            const Shape& b = world.shapes[own];
            if (a.def.sensor || b.def.sensor || !mayTouch(world, a, b) || !(limit > 0)) { continue; }
            FlightObstacle shapes{.own = own, .other = met};
            shapes.level = targetOf(world, shapes);
            if (areTied) {
                allowTouch(world, shapes, path, otherPath);
            } else {
                shapes.lift = rideSag(world, shapes, std::max(first.impacts, second.impacts)) * toDouble(carrier);
            }
            const FirstImpact impact = firstImpactWith(world, path, otherPath, shapes, limit, scratch);
            if (!impact.hit || (areTied && !endsBeyond(world, shapes, path, otherPath, impact.fraction))) { continue; }
            limit = impact.fraction;
            meeting.shapes = shapes;
            meeting.time = from + impact.fraction * (work.dt - from);
        }
    }
    if (meeting.time < kNever) { meetings.push_back(meeting); }
}

/// Whether it looks for others. Where there are bullets that do not, what may meet them does.
bool searches(const BulletWork& work, const BulletPartner& partner) {
    return partner.isBullet || partner.clash != kNoIndex || work.areSomeAtRest;
}

/// What is slow, and lies where the paths of some partners lead that are near each other; some of it more than once.
void discover(const WorldState& world, std::span<const std::uint32_t> searchers, std::vector<std::uint32_t>& found) {
    const BulletWork& work = world.bulletWork;
    std::array<Aabb, kWide> boxes;
    std::transform(searchers.begin(), searchers.end(), boxes.begin(),
                   [&](std::uint32_t index) { return grown(work.boxes[index], work.drift); });
    world.broadphase->queryDynamic(std::span(boxes).first(searchers.size()), [&](std::size_t lane, ProxyId id) {
        const Shape& shape = world.shapes[world.proxyShapes[static_cast<std::uint32_t>(id)]];
        const bool isNew = work.indices[shape.body] == kNoIndex;
        if (!isNew || !world.bodies[shape.body].isDynamic() || shape.def.sensor) { return; }
        if (work.partners[searchers[lane]].isBullet || isBullet(world, shape.body)) { found.push_back(shape.body); }
    });
}

/// @param isDue  by index, of one of them and the other one
template <class IsDue>
void predictAll(const WorldState& world, std::span<const std::uint32_t> partners, FlightScratch& scratch,
                std::vector<BulletMeeting>& meetings, const IsDue& isDue) {
    const BulletWork& work = world.bulletWork;
    std::array<Aabb, kWide> boxes;
    std::transform(partners.begin(), partners.end(), boxes.begin(),
                   [&](std::uint32_t index) { return work.boxes[index]; });
    widestKernels().queries(work.tree, WideBoxes::of(std::span(boxes).first(partners.size())),
                            [&](std::uint32_t lane, ProxyId id) {
                                const std::uint32_t index = partners[lane];
                                const auto other = static_cast<std::uint32_t>(id);
                                if (other == index || !isDue(index, other)) { return; }
                                predict(world, index, other, scratch, meetings);
                            });
}

/// Room for partners that `beginPartner` fills. @param slots  some of them maybe more than once
void addPartners(BulletWork& work, std::span<const std::uint32_t> slots) {
    for (const std::uint32_t slot : slots) {
        if (work.indices[slot] != kNoIndex) { continue; }
        work.indices[slot] = static_cast<std::uint32_t>(work.slots.size());
        work.slots.push_back(slot);
    }
    work.partners.resize(work.slots.size());
    work.boxes.resize(work.slots.size());
    work.places.resize(work.slots.size());
}

/// What a partner does from the start of the step on. Touches nothing of the others.
void beginPartner(WorldState& world, std::uint32_t index, FlightScratch& scratch,
                  std::vector<BulletMeeting>& meetings) {
    BulletWork& work = world.bulletWork;
    BulletPartner& partner = work.partners[index];
    makePartner(partner, world, work.slots[index], work.dt, scratch);
    renewPath(partner, meetings);
    work.boxes[index] = boxOf(partner);
}

/// All from `first` on, by several threads.
void beginPartners(WorldState& world, std::size_t first) {
    constexpr std::size_t kGrain = 8;
    BulletWork& work = world.bulletWork;
    world.loops->run(work.partners.size() - first, kGrain, [&](std::size_t from, std::size_t to, int worker) {
        const auto place = static_cast<std::size_t>(worker);
        for (std::size_t i = first + from; i < first + to; ++i) {
            beginPartner(world, static_cast<std::uint32_t>(i), world.flightScratch[place], work.finds[place].meetings);
        }
    });
}

/// Calls `some(searchers, scratch, finds)` for all early partners that are such, some at a time, on several threads.
template <class Some>
void shareSearch(WorldState& world, const Some& some) {
    BulletWork& work = world.bulletWork;
    const std::span<const std::uint32_t> all = work.searchers;
    const std::size_t groups = (all.size() + kWide - 1) / kWide;
    world.loops->run(groups, 1, [&](std::size_t from, std::size_t to, int worker) {
        const auto place = static_cast<std::size_t>(worker);
        for (std::size_t i = from * kWide; i < std::min(to * kWide, all.size()); i += kWide) {
            some(all.subspan(i, std::min<std::size_t>(kWide, all.size() - i)), world.flightScratch[place],
                 work.finds[place]);
        }
    });
}

/// Some partners at a time.
template <class Some>
void forSome(std::span<const std::uint32_t> partners, const Some& some) {
    for (std::size_t i = 0; i < partners.size(); i += kWide) {
        some(partners.subspan(i, std::min<std::size_t>(kWide, partners.size() - i)));
    }
}

void addEarly(WorldState& world) {
    BulletWork& work = world.bulletWork;
    findEarly(world, static_cast<Real>(work.dt));
    addPartners(work, work.early);
    beginPartners(world, 0);
    work.searchers.clear();
    for (std::uint32_t i = 0; i < work.partners.size(); ++i) {
        if (searches(work, work.partners[i])) { work.searchers.push_back(i); }
    }
}

void addDiscovered(WorldState& world) {
    BulletWork& work = world.bulletWork;
    shareSearch(world, [&](std::span<const std::uint32_t> some, FlightScratch&, BulletFinds& finds) {
        discover(world, some, finds.bodies);
    });
    work.found.clear();
    for (BulletFinds& finds : work.finds) { moveAll(work.found, finds.bodies); }
    orderByPlace(world, work.found);
    const std::size_t known = work.partners.size();
    addPartners(work, work.found);
    beginPartners(world, known);
}

}  // namespace

void findPartners(WorldState& world, double dt) {
    BulletWork& work = world.bulletWork;
    for (const std::uint32_t slot : work.slots) { work.indices[slot] = kNoIndex; }
    work.indices.resize(world.motions.size(), kNoIndex);
    work.pressed.resize(world.motions.size());
    work.isPressedListed = false;
    work.finds.resize(world.flightScratch.size());
    work.slots.clear();
    work.partners.clear();
    work.meetings.clear();
    work.carriers.clear();
    work.dt = dt;
    addEarly(world);
    const std::size_t early = work.partners.size();
    addDiscovered(world);
    work.tree.pack(work.boxes);
    std::iota(work.places.begin(), work.places.end(), 0U);
    shareSearch(world, [&](std::span<const std::uint32_t> some, FlightScratch& scratch, BulletFinds& finds) {
        // A pair of those that search once.
        predictAll(world, some, scratch, finds.meetings, [&](std::uint32_t index, std::uint32_t other) {
            return other > index || other >= early || !searches(work, work.partners[other]);
        });
    });
    for (BulletFinds& finds : work.finds) { moveAll(work.meetings, finds.meetings); }
    orderMeetings(work);
}

void lookAhead(WorldState& world, std::span<const std::uint32_t> partners, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    std::vector<BulletMeeting>& meetings = work.finds[0].meetings;
    work.searchers.clear();
    for (const std::uint32_t index : partners) {
        BulletPartner& partner = work.partners[index];
        renewPath(partner, meetings);
        work.boxes[index] = boxOf(partner);
        work.tree.move(work.places[index], work.boxes[index]);
        if (searches(work, partner)) { work.searchers.push_back(index); }
    }
    work.found.clear();
    forSome(work.searchers, [&](std::span<const std::uint32_t> some) { discover(world, some, work.found); });
    const auto known = static_cast<std::uint32_t>(work.partners.size());
    addPartners(work, work.found);
    for (std::uint32_t i = known; i < work.partners.size(); ++i) {
        beginPartner(world, i, scratch, meetings);
        work.tree.insert(i, work.boxes[i], work.places);
    }
    // Two that changed once.
    forSome(partners, [&](std::span<const std::uint32_t> some) {
        predictAll(world, some, scratch, meetings, [&](std::uint32_t index, std::uint32_t other) {
            return other > index || std::find(partners.begin(), partners.end(), other) == partners.end();
        });
    });
    for (const BulletMeeting& meeting : meetings) { pushMeeting(work, meeting); }
    meetings.clear();
}

void setCarrier(BulletWork& work, const BulletMeeting& pair, Vec2 normal) {
    std::uint32_t& head = work.partners[work.indices[pair.first]].firstCarrier;
    for (std::uint32_t i = head; i != kNoIndex; i = work.carriers[i].next) {
        if (work.carriers[i].other == pair.second) {
            work.carriers[i].normal = normal;
            return;
        }
    }
    if (normal == Vec2{}) { return; }
    work.carriers.push_back({.other = pair.second, .normal = normal, .next = head});
    head = static_cast<std::uint32_t>(work.carriers.size() - 1);
}

}  // namespace swept::inline SWEPT_PRECISION
