#include "bullet_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "../broadphase/tree_walks.h"
#include "bullet_paths.h"
#include "flight_state.h"
#include "modes.h"
#include "sweep_circles.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

bool isBullet(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    return body.isDynamic() && body.awake && body.def.bullet && modeOf(world, body) == ContinuousMode::subStep;
}

Real speedBound(const WorldState& world, std::uint32_t slot, Real dt) {
    const Body& body = world.bodies[slot];
    return length(world.motions[slot].velocity) +
           (body.isDynamic() ? dt * length(accelerationOf(world, body)) : Real(0));
}

/// Where a body may get within the step, whatever direction it is sent into.
Aabb realmOf(const WorldState& world, std::uint32_t slot, Real reach) {
    const Body& body = world.bodies[slot];
    return grown(roundedOutward(body.startCenter, body.startCenter), reach + body.radius);
}

/// How far the solver moved any point of a body in this step, metres.
Real wayOf(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const double turned = std::fabs(motion.angle - body.startAngle) * static_cast<double>(body.radius);
    return roundedUp(length(motion.center - body.startCenter) + turned);
}

Aabb boxOf(const BulletPartner& partner) {
    const Body& body = partner.flight.body();
    return boxOfPath(partner.path, static_cast<double>(body.radius + kTargetRatio * body.widest));
}

BulletPartner partnerOf(WorldState& world, std::uint32_t slot, double dt, FlightScratch& scratch) {
    const Body& body = world.bodies[slot];
    BulletPartner partner{.flight = flightOf(world, slot, dt, scratch), .path = {}};
    partner.isBullet = isBullet(world, slot);
    partner.tied = body.holdingJoints > 0 || body.touchesDynamic;
    if (body.awake && body.role == BodyRole::flyer) {
        partner.flies = partner.moved = true;
        limitSpeed(partner.flight);
        resolveStanding(partner.flight);
        return partner;
    }
    const BodyMotion& motion = world.motions[slot];
    partner.path = {.localCenter = toDouble(body.localCenter),
                    .c0 = body.awake ? body.startCenter : motion.center,
                    .c1 = motion.center,
                    .a0 = body.awake ? body.startAngle : motion.angle,
                    .a1 = motion.angle};
    return partner;
}

void add(BulletWork& work, const BulletMeeting& meeting) {
    work.meetings.push_back(meeting);
    std::push_heap(work.meetings.begin(), work.meetings.end(),
                   [](const BulletMeeting& a, const BulletMeeting& b) { return a.isAfter(b); });
}

/// What it does in the rest of the step while nothing happens to it, and when that meets something static or kinematic.
void renewPath(BulletWork& work, std::uint32_t index) {
    BulletPartner& partner = work.partners[index];
    ++partner.changes;
    if (partner.flies) {
        const Flight& flight = partner.flight;
        partner.pathFrom = flight.elapsed;
        partner.path = sweepOf(flight);
        const FirstImpact first = nextImpact(flight, partner.path);
        if (first.hit) {
            add(work, {.time = flight.elapsed + first.fraction * flight.remaining(),
                       .first = flight.slot,
                       .second = kNoIndex,
                       .firstChanges = partner.changes,
                       .shapes = {}});
        }
    }
}

/// Where others look for it.
void place(BulletWork& work, std::uint32_t index) {
    BulletPartner& partner = work.partners[index];
    if (partner.leaf == kNoNode) {
        partner.leaf = work.tree.insert(boxOf(partner), index, false);
    } else {
        work.tree.move(partner.leaf, boxOf(partner));
    }
}

/// The same of all, at once.
void placeAll(BulletWork& work) {
    work.boxes.clear();
    for (BulletPartner& partner : work.partners) {
        partner.leaf = static_cast<NodeIndex>(work.boxes.size());
        work.boxes.push_back(boxOf(partner));
    }
    work.tree.build(work.boxes);
}

/// @pre placed after that
void addPartner(WorldState& world, std::uint32_t slot, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    const auto index = static_cast<std::uint32_t>(work.partners.size());
    work.places[slot] = index;
    work.partners.push_back(partnerOf(world, slot, work.dt, scratch));
    renewPath(work, index);
}

Vec2 carrierOf(const BulletWork& work, const BulletPartner& first, std::uint32_t second) {
    for (std::uint32_t i = first.firstCarrier; i != kNoIndex; i = work.carriers[i].next) {
        if (work.carriers[i].other == second) { return work.carriers[i].normal; }
    }
    return {};
}

/// First impact of any two of their shapes from now on.
void predict(WorldState& world, std::uint32_t one, std::uint32_t other, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    const bool inOrder = work.partners[one].flight.slot < work.partners[other].flight.slot;
    const BulletPartner& first = work.partners[inOrder ? one : other];
    const BulletPartner& second = work.partners[inOrder ? other : one];
    const double from = std::max(first.pathFrom, second.pathFrom);
    if ((!first.isBullet && !second.isBullet) || (first.tied && second.tied) || !(from < work.dt)) { return; }
    const Body& firstBody = world.bodies[first.flight.slot];
    const Body& secondBody = world.bodies[second.flight.slot];
    const Sweep path = pathAfter(second, from);
    const Sweep otherPath = pathAfter(first, from);
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
            shapes.lift = rideSag(world, shapes, std::max(first.impacts, second.impacts)) * toDouble(carrier);
            const FirstImpact impact = firstImpactWith(world, path, otherPath, shapes, limit, scratch);
            if (!impact.hit) { continue; }
            limit = impact.fraction;
            meeting.shapes = shapes;
            meeting.time = from + impact.fraction * (work.dt - from);
        }
    }
    if (meeting.time < kNever) { add(work, meeting); }
}

/// What is slow, and lies where the path of a bullet leads, becomes a partner.
void discover(WorldState& world, std::uint32_t bullet, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    std::vector<std::uint32_t>& found = work.found;
    found.clear();
    world.broadphase->query(grown(boxOf(work.partners[bullet]), work.drift), [&](ProxyId id) {
        const Shape& shape = world.shapes[world.proxyShapes[static_cast<std::uint32_t>(id)]];
        const bool isNew = work.places[shape.body] == kNoIndex;
        if (isNew && world.bodies[shape.body].isDynamic() && !shape.def.sensor) { found.push_back(shape.body); }
        return true;
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const std::uint32_t slot : found) { addPartner(world, slot, scratch); }
}

/// @param isDue  by index of the other one
template <class IsDue>
void predictAll(WorldState& world, std::uint32_t index, FlightScratch& scratch, const IsDue& isDue) {
    BulletWork& work = world.bulletWork;
    bool goOn = true;
    walkOverlaps(work.tree, work.tree.node(work.partners[index].leaf).box, goOn, [&](std::uint32_t other) {
        if (other != index && isDue(other)) { predict(world, index, other, scratch); }
        return true;
    });
}

/// What is fast and may get to where a bullet may get. @param fast  slots of what is no bullet; the others are dropped
void dropOutOfReach(WorldState& world, std::vector<std::uint32_t>& fast, std::span<const std::uint32_t> bullets,
                    Real dt) {
    Real fastest = 0;
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].isDynamic()) { fastest = std::max(fastest, speedBound(world, slot, dt)); }
    }
    BulletWork& work = world.bulletWork;
    AabbTree& realms = work.tree;
    work.boxes.clear();
    for (const std::uint32_t slot : bullets) {
        work.boxes.push_back(realmOf(world, slot, dt * (speedBound(world, slot, dt) + fastest)));
    }
    realms.build(work.boxes);
    std::erase_if(fast, [&](std::uint32_t slot) {
        bool isFree = true;
        walkOverlaps(realms, realmOf(world, slot, dt * speedBound(world, slot, dt)), isFree,
                     [](std::uint32_t /*bullet*/) { return false; });
        return isFree;
    });
}

/// Bullets, and what is fast and near enough; and how far the others move.
void findEarly(WorldState& world, Real dt) {
    BulletWork& work = world.bulletWork;
    work.early.clear();
    work.found.clear();
    work.drift = 0;
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        if (isBullet(world, slot)) {
            work.early.push_back(slot);
        } else if (body.isDynamic() && body.fast) {
            work.found.push_back(slot);
        } else if (body.isDynamic()) {
            work.drift = std::max(work.drift, wayOf(world, slot));
        }
    }
    if (!work.found.empty()) { dropOutOfReach(world, work.found, work.early, dt); }
    work.early.insert(work.early.end(), work.found.begin(), work.found.end());
    std::sort(work.early.begin(), work.early.end());
}

}  // namespace

bool BulletMeeting::isAfter(const BulletMeeting& other) const {
    return std::tuple(time, isPair(), first, second) >
           std::tuple(other.time, other.isPair(), other.first, other.second);
}

void findPartners(WorldState& world, double dt, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    for (const BulletPartner& partner : work.partners) { work.places[partner.flight.slot] = kNoIndex; }
    work.places.resize(world.motions.size(), kNoIndex);
    work.partners.clear();
    work.meetings.clear();
    work.carriers.clear();
    work.dt = dt;
    findEarly(world, static_cast<Real>(dt));
    for (const std::uint32_t slot : work.early) { addPartner(world, slot, scratch); }
    for (std::uint32_t i = 0; i < work.early.size(); ++i) {
        if (work.partners[i].isBullet) { discover(world, i, scratch); }
    }
    placeAll(work);
    for (std::uint32_t i = 0; i < work.early.size(); ++i) {
        if (!work.partners[i].isBullet) { continue; }
        // A pair of bullets once.
        predictAll(world, i, scratch, [&](std::uint32_t other) { return other > i || !work.partners[other].isBullet; });
    }
}

bool takeMeeting(BulletWork& work, BulletMeeting& meeting) {
    while (!work.meetings.empty()) {
        std::pop_heap(work.meetings.begin(), work.meetings.end(),
                      [](const BulletMeeting& a, const BulletMeeting& b) { return a.isAfter(b); });
        meeting = work.meetings.back();
        work.meetings.pop_back();
        const bool isFirstSame = work.partners[work.places[meeting.first]].changes == meeting.firstChanges;
        const bool isSecondSame =
            !meeting.isPair() || work.partners[work.places[meeting.second]].changes == meeting.secondChanges;
        if (isFirstSame && isSecondSame) { return true; }
    }
    return false;
}

void lookAhead(WorldState& world, std::initializer_list<std::uint32_t> partners, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    for (const std::uint32_t index : partners) {
        renewPath(work, index);
        place(work, index);
    }
    const auto known = static_cast<std::uint32_t>(work.partners.size());
    for (const std::uint32_t index : partners) {
        if (work.partners[index].isBullet) { discover(world, index, scratch); }
    }
    for (std::uint32_t i = known; i < work.partners.size(); ++i) { place(work, i); }
    for (const std::uint32_t index : partners) {
        // Two that changed once.
        predictAll(world, index, scratch, [&](std::uint32_t other) {
            return other > index || std::find(partners.begin(), partners.end(), other) == partners.end();
        });
    }
}

void setCarrier(BulletWork& work, const BulletMeeting& pair, Vec2 normal) {
    std::uint32_t& head = work.partners[work.places[pair.first]].firstCarrier;
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
