#include "direct_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "../closeness.h"
#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rounds of a step, or of a part of one, beyond the usual ones of its solves: so many at least, and so many bodies in
/// all of them; the same of each island that is searched by itself, and of all together. What takes more is iterated.
/// (Heaps of 256 bodies took 180 at times, 12 ms.)
constexpr std::size_t kFewestSpareRounds = 32;
constexpr std::size_t kSpareBodyRounds = 8192;

int spareRoundsFor(std::size_t bodies) {
    return static_cast<int>(std::max(kFewestSpareRounds, kSpareBodyRounds / bodies));
}

/// Among so many bodies, whose contacts close loops, a search that is disturbed takes tens of rounds, each with a
/// factor, and what follows counts: what was found is kept (`beginSecondHalf`, `tighten`), what carries nothing has a
/// known limit of friction (`gatherOf`), and few rows that changed ask for no new factor (`takeUpFactor`). Fewer bodies
/// find their way at once.
constexpr std::size_t kFewestOfWide = 129;

/// Gaps beyond this part of the distance to the centre of mass of the nearer body that can be moved, across which what
/// pressed before does not press before they are closed: the same, of many bodies, where so wide ones are left.
constexpr Real kGapRatio = Real(1) / (1 << 15);
constexpr Real kGapRatioOfMany = Real(1) / (1 << 13);

/// Whether a point gapes more than rounding and what is left of closed gaps explain.
bool isOpen(const SolverBatch& batch, const ContactConstraint& contact, const ContactConstraintPoint& point,
            Real separation, Real ratio) {
    const bool movesA = isMovable(batch.inertias[contact.slotA]);
    const bool movesB = isMovable(batch.inertias[contact.slotB]);
    const Real lever = leverAt(point, movesA, movesB);
    return separation > std::max(ratio * lever, separationRounding(point.anchorA, point.anchorB));
}

/// What a mover presses through a wedge carries some times the momentum that all would have at its speed; what is
/// jammed carries thousands of times that.
constexpr double kMostOfMomentum = 8;

/// m/s: how fast something kinematic moves at a point; 0 of all else.
double leadOf(const SolverBatch& batch, BodySlot slot, Vec2 anchor) {
    return isMovable(batch.inertias[slot]) ? 0 : static_cast<double>(length(velocityAt(batch.states[slot], anchor)));
}

}  // namespace

void DirectContacts::begin(std::size_t nodes, bool hasManyBodies) {
    hasManyBodies_ = hasManyBodies;
    points_.clear();
    parts_.clear();
    spareBodyRounds_ = static_cast<std::int64_t>(spareRoundsFor(nodes)) * static_cast<std::int64_t>(nodes);
    takesLong_.assign(nodes, 0);
}

/// Contacts part by part; within one their order stays.
void DirectContacts::orderByPart(const SolverBatch& batch, const DirectSystem& system) {
    const std::span<const NodeRange> parts = system.parts();
    partOf_.resize(system.nodes().size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        std::fill(partOf_.begin() + parts[i].begin, partOf_.begin() + parts[i].end, i);
    }
    const auto partOf = [&](const ContactConstraint& contact) {
        const std::uint32_t a = system.nodeOf(contact.slotA);
        const std::uint32_t node = a != kNoNode ? a : system.nodeOf(contact.slotB);
        return node != kNoNode ? partOf_[node] : kNoNode;
    };
    next_.assign(parts.size() + 1, 0);
    for (const ContactConstraint& contact : batch.contacts) {
        if (const std::uint32_t part = partOf(contact); part != kNoNode) { ++next_[part + 1]; }
    }
    std::partial_sum(next_.begin(), next_.end(), next_.begin());
    order_.resize(next_.back());
    for (std::uint32_t i = 0; i < batch.contacts.size(); ++i) {
        if (const std::uint32_t part = partOf(batch.contacts[i]); part != kNoNode) { order_[next_[part]++] = i; }
    }
}

void DirectContacts::addPoints(SolverBatch& batch, ContactConstraint& contact, DirectSystem& system) {
    const std::uint32_t a = system.nodeOf(contact.slotA);
    const std::uint32_t island = system.islandOf(a != kNoNode ? a : system.nodeOf(contact.slotB));
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        points_.push_back({.contact = &contact,
                           .point = &point,
                           .island = island,
                           .normal = system.rowOf(batch.inertias, normalRowOf(contact, point, 0)),
                           .tangent = system.rowOf(batch.inertias, tangentRowOf(contact, point))});
    }
}

void DirectContacts::list(SolverBatch& batch, DirectSystem& system) {
    // They are large: room is made at once, not in steps of which each is copied and given back.
    std::size_t points = 0;
    for (const ContactConstraint& contact : batch.contacts) { points += static_cast<std::size_t>(contact.count); }
    if (points_.capacity() < points) { points_.reserve(std::max(points, 2 * points_.capacity())); }
    orderByPart(batch, system);
    std::size_t taken = 0;
    for (std::size_t i = 0; i < system.parts().size(); ++i) {
        const NodeRange nodes = system.parts()[i];
        const std::size_t bodies = nodes.end - nodes.begin;
        const DirectSystem::Load& load = system.loadOf(system.islandOf(nodes.begin));
        Part part{.nodes = nodes,
                  .begin = points_.size(),
                  .isWide = load.bodies >= kFewestOfWide && load.contacts > load.bodies,
                  .spareRounds = spareRoundsFor(bodies)};
        for (; taken < next_[i]; ++taken) { addPoints(batch, batch.contacts[order_[taken]], system); }
        part.end = points_.size();
        parts_.push_back(part);
    }
}

SearchEffort DirectContacts::effortOf(std::uint32_t island) const {
    const auto after = std::upper_bound(parts_.begin(), parts_.end(), island,
                                        [](std::uint32_t one, const Part& part) { return one < part.nodes.begin; });
    const Part& part = *(after - 1);
    return {.rounds = part.rounds,
            .bodies = part.nodes.end - part.nodes.begin,
            .isLong = takesLong_[island] != 0,
            .isInVain = part.isInVain};
}

void DirectContacts::beginFirstHalf() {
    for (Part& part : parts_) { part.isLong = false; }
    for (Point& contact : points_) {
        contact.half = contact.point->normalImpulse *= Real(0.5);
        contact.tangentHalf = contact.point->tangentImpulse *= Real(0.5);
    }
}

void DirectContacts::beginSecondHalf() {
    for (Point& contact : points_) {
        contact.first = contact.point->normalImpulse;
        contact.tangentFirst = contact.point->tangentImpulse;
    }
    for (const Part& part : parts_) {
        // What took long to find is not sought twice: the first half ends with what the second one needs.
        if (part.isWide && part.isLong) { continue; }
        for (Point& contact : pointsOf(part)) {
            contact.point->normalImpulse = contact.half;
            contact.point->tangentImpulse = contact.tangentHalf;
        }
    }
}

void DirectContacts::addHalves() {
    for (const Point& contact : points_) {
        contact.point->normalImpulse += contact.first;
        contact.point->tangentImpulse += contact.tangentFirst;
    }
}

void DirectContacts::gather(const SolverBatch& batch, Real h, bool useBias) {
    for (const Part& part : parts_) { gatherOf(part, batch, h, useBias); }
    guessHolds(points_);
}

void DirectContacts::gatherOf(const Part& part, const SolverBatch& batch, Real h, bool useBias) {
    const auto pressed = [](const Point& contact) { return contact.point->normalImpulse > 0; };
    const std::span<Point> points = pointsOf(part);
    // Among many bodies, most of which are known to press, what carries nothing slides until it is known how much it
    // presses. With limits that are not known the search has no minimum to go to, and took twice the rounds to find
    // what else carries the load of a brick that is taken out of a wall. Nor is it expected to press: at the brink all
    // stays as it is guessed, so it was held in the first half of each sub-step and free in the second, and each of
    // them had a factor of its own.
    const bool isKnown = part.isWide && std::any_of(points.begin(), points.end(), pressed);
    const Real gapRatio = hasManyBodies_ ? kGapRatioOfMany : kGapRatio;
    for (Point& contact : points) {
        const ContactConstraint& constraint = *contact.contact;
        const ContactConstraintPoint& point = *contact.point;
        const BodyState& a = batch.states[constraint.slotA];
        const BodyState& b = batch.states[constraint.slotB];
        Real expected = useBias ? point.normalImpulse : contact.first;
        const Real separation = useBias ? currentSeparation(constraint, point, a, b) : Real(0);
        // More points may press than bodies have ways to move, where others hold them apart. To go on pressing across
        // such a gap, and to close it against those, moved heaps of planks by 0.2 mm a second, for minutes.
        if (expected > 0 && separation > 0 && isOpen(batch, constraint, point, separation, gapRatio)) { expected = 0; }
        const Real bias = !(expected > 0) && separation > 0 ? separation / h : Real(0);
        const Real closing = -dot(velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA), constraint.normal);
        // What bounces must arrive in the next sub-step with its speed.
        const bool isOut = !useBias && (!(expected > 0) || closing > constraint.bounceSpeed);
        const bool mayBegin = !isKnown && closing >= bias && !(separation > 0);
        const bool presses = !isOut && (expected > 0 || mayBegin);
        contact.normal.guess = isOut ? 0 : static_cast<double>(point.normalImpulse);
        contact.tangent.guess = isOut ? 0 : static_cast<double>(point.tangentImpulse);
        contact.normal.impulse = contact.tangent.impulse = 0;
        contact.normal.excess = DirectSystem::excessOf(batch.states, normalRowOf(constraint, point, bias));
        contact.tangent.excess = DirectSystem::excessOf(batch.states, tangentRowOf(constraint, point));
        // What touches and does not part is guessed to press, and to stick: a stack that comes down comes down on all
        // its contacts.
        contact.limit = static_cast<double>(constraint.friction) * contact.normal.guess;
        const bool isNew = !(point.normalImpulse > 0);
        if (isNew && !isKnown && constraint.friction > 0) { contact.limit = std::numeric_limits<double>::infinity(); }
        contact.isExpected = presses;
        contact.partings = 0;
        contact.normalHold = isOut ? Hold::free : Hold::held;
    }
}

/// Whether something is jammed between a kinematic body that comes and what does not yield: impulses that have nothing
/// to do with any momentum make it turn or slip after all, and those of the next sub-step are as large, for other
/// places. (A car of a ton that another one, kinematic, rammed into a corner at 9 m/s, beside a cone of a kilogram: 2e7
/// N·s in a sub-step; as that was given up, iteration began with them, and the car had 84 m/s, the cone 1 km/s.)
bool DirectContacts::isSqueezed(const SolverBatch& batch, const DirectSystem& system) {
    bool any = false;
    for (Part& part : parts_) {
        if (!part.mayBeSqueezed) { continue; }
        double speed = 0;
        double most = 0;
        bool isDriven = false;
        for (const Point& contact : pointsOf(part)) {
            const SystemRow& normal = contact.normal;
            if (contact.normalHold != Hold::held) { continue; }
            most = std::max(most, normal.impulse);
            speed = std::max(speed, std::fabs(normal.excess));
            const double led = std::max(leadOf(batch, contact.contact->slotA, contact.point->anchorA),
                                        leadOf(batch, contact.contact->slotB, contact.point->anchorB));
            isDriven = isDriven || led > 0;
            speed = std::max(speed, led);
        }
        if (!isDriven) { continue; }
        double mass = 0;
        for (std::size_t i = part.nodes.begin; i < part.nodes.end; ++i) { mass += system.nodes()[i].mass; }
        if (!(most > kMostOfMomentum * mass * speed)) { continue; }
        for (const Point& contact : pointsOf(part)) { takesLong_[contact.island] = 1; }
        part.isInVain = any = true;
    }
    return any;
}

void DirectContacts::write() {
    for (Point& contact : points_) {
        const auto keep = [this, &contact](const SystemRow& row, double least) {
            return std::fabs(row.impulse) < noise_[contact.island] ? Real(0)
                                                                   : static_cast<Real>(std::max(row.impulse, least));
        };
        contact.point->normalImpulse = keep(contact.normal, 0);
        contact.point->tangentImpulse = keep(contact.tangent, contact.tangent.impulse);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
