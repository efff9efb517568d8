#include "jointed_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "../contacts/contact_demand.h"
#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Most passes over the contacts of a pile in place of one, and the part of its largest impulse that is no change.
constexpr int kMostPasses = 8;
constexpr Real kSmallChange = 16 * kEpsilon;

/// Of two bodies that joints hold to each other. An overlap is a spring as stiff as what it moves is heavy, and where
/// the joints hardly let it move anything that is without bound: a box welded to another one that it overlaps was flung
/// about with hundreds of times the energy of its fall, as any turn makes motion of what such a spring holds. Beyond so
/// many times the mass of all that hangs on the joints an overlap is pushed out more slowly, by as much as it is
/// heavier; and what a lever of 32 : 1 does not move carries nothing, since the contact contradicts the joints.
constexpr double kMostPushedMasses = 1;
constexpr double kMostTieMasses = 1024;

/// Whether the other point of the contact carries something.
bool otherCarries(const ContactConstraint& contact, const ContactConstraintPoint& point) {
    return contact.count > 1 && contact.points[&point == contact.points.data() ? 1 : 0].normalImpulse > 0;
}

/// 0 of what hardly moves: its inverse would be no number.
double inverseOf(double answer) {
    const bool moves = answer > 0 && 1 / answer <= static_cast<double>(std::numeric_limits<Real>::max());
    return moves ? 1 / answer : 0;
}

}  // namespace

/// Nodes that the matrix couples, side by side; and piles, that contacts tie together as well.
void JointedContacts::listTies(const SolverBatch& batch, DirectSystem& system) {
    const auto count = static_cast<std::uint32_t>(system.nodes().size());
    ties_.assign(count, {});
    for (std::uint32_t i = 0; i < count; ++i) {
        Tie& tie = ties_[system.islandOf(i)];
        ++tie.nodes;
        tie.mass += system.nodes()[i].mass;
    }
    std::uint32_t first = 0;
    for (Tie& tie : ties_) {
        tie.first = first;
        first += std::exchange(tie.nodes, 0);
    }
    tieNodes_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        Tie& tie = ties_[system.islandOf(i)];
        tieNodes_[tie.first + tie.nodes++] = i;
    }
    piles_.reset(count);
    for (std::uint32_t i = 0; i < count; ++i) { piles_.unite(i, system.islandOf(i)); }
    for (const ContactConstraint& contact : batch.contacts) {
        const std::uint32_t a = system.nodeOf(contact.slotA);
        const std::uint32_t b = system.nodeOf(contact.slotB);
        if (a != kNoNode && b != kNoNode) { piles_.unite(a, b); }
    }
}

void JointedContacts::list(SolverBatch& batch, DirectSystem& system) {
    listTies(batch, system);
    points_.clear();
    rounds_ = 0;
    std::size_t answers = 0;
    for (ContactConstraint& contact : batch.contacts) {
        const std::uint32_t a = system.nodeOf(contact.slotA);
        const std::uint32_t b = system.nodeOf(contact.slotB);
        if (a == kNoNode && b == kNoNode) { continue; }
        for (int i = 0; i < contact.count; ++i) {
            Point point;
            point.contact = &contact;
            point.point = &contact.points[static_cast<std::size_t>(i)];
            point.pile = piles_.find(a != kNoNode ? a : b);
            point.tieA = a != kNoNode ? system.islandOf(a) : kNoNode;
            point.tieB = b != kNoNode && system.islandOf(b) != point.tieA ? system.islandOf(b) : kNoNode;
            for (const std::uint32_t tie : {point.tieA, point.tieB}) {
                if (tie == kNoNode) { continue; }
                point.nodes += ties_[tie].nodes;
                point.round = std::max(point.round, ties_[tie].rounds);
            }
            // What stands in the same round shares no tie.
            for (const std::uint32_t tie : {point.tieA, point.tieB}) {
                if (tie != kNoNode) { ties_[tie].rounds = point.round + 1; }
            }
            rounds_ = std::max(rounds_, point.round + 1);
            point.rows[kNormal].held = normalRowOf(contact, *point.point, 0);
            point.rows[kNormal].held.impulse = &point.point->normalImpulse;
            point.rows[kTangent].held = tangentRowOf(contact, *point.point);
            point.rows[kTangent].held.impulse = &point.point->tangentImpulse;
            point.rows[kRolling].held = {kSpinRow, contact.slotA, contact.slotB, 0, &contact.rollingImpulse};
            point.rowCount = contact.rolling > 0 ? kRowKinds : kRolling;
            for (Row& row : point.used()) {
                row.row = system.rowOf(batch.inertias, row.held);
                row.answers = std::exchange(answers, answers + point.nodes);
            }
            points_.push_back(point);
        }
    }
    answers_.resize(answers);
    std::sort(points_.begin(), points_.end(), [](const Point& p, const Point& q) {
        // Of a pile in the order of its contacts.
        return p.pile != q.pile ? p.pile < q.pile : p.rows[kNormal].answers < q.rows[kNormal].answers;
    });
}

/// Of each row while the joints hold. Ties do not answer to each other: a row of each is found at once.
void JointedContacts::findAnswers(DirectSystem& system) {
    for (std::uint32_t round = 0; round < rounds_; ++round) {
        for (const RowKind kind : {kNormal, kTangent, kRolling}) {
            const auto isAsked = [&](const Point& point) { return point.round == round && kind < point.rowCount; };
            if (std::none_of(points_.begin(), points_.end(), isAsked)) { continue; }
            system.beginChange();
            for (const Point& point : points_) {
                if (isAsked(point)) { system.push(point.rows[kind].row, 1); }
            }
            system.solve();
            for (Point& point : points_) {
                if (isAsked(point)) { readAnswers(system, point, kind); }
            }
        }
    }
    answersOf_ = system.factorNumber();
}

void JointedContacts::readAnswers(const DirectSystem& system, Point& point, RowKind kind) {
    const std::span<const Block3> change = system.change();
    const SystemRow& row = point.rows[kind].row;
    std::size_t place = point.rows[kind].answers;
    forEachNode(point, [&](std::uint32_t node) { answers_[place++] = change[node]; });
    double answer = 0;
    if (row.nodeA != kNoNode) { answer += dot3(row.ofA, change[row.nodeA]); }
    if (row.nodeB != kNoNode) { answer += dot3(row.ofB, change[row.nodeB]); }
    double& mass = point.rows[kind].mass;
    mass = inverseOf(answer);
    if (!isWithinTie(point)) { return; }
    const double ofTie = ties_[point.tieA].mass;
    const double most = kind == kRolling ? static_cast<double>(point.contact->rollingMass) : ofTie;
    if (mass > kMostTieMasses * most) { mass = 0; }
    if (kind == kNormal) { point.pushShare = static_cast<Real>(std::min(1.0, kMostPushedMasses * ofTie / mass)); }
}

bool JointedContacts::isWithinTie(const Point& point) {
    const SystemRow& row = point.rows[kNormal].row;
    return row.nodeA != kNoNode && row.nodeB != kNoNode && point.tieB == kNoNode;
}

template <class Visit>
void JointedContacts::forEachNode(const Point& point, const Visit& visit) const {
    for (const std::uint32_t tie : {point.tieA, point.tieB}) {
        if (tie == kNoNode) { continue; }
        for (std::uint32_t i = 0; i < ties_[tie].nodes; ++i) { visit(tieNodes_[ties_[tie].first + i]); }
    }
}

/// @param total  that its impulse becomes. @return how far it changed
Real JointedContacts::change(DirectSystem& system, const Point& point, RowKind kind, Real total) const {
    const Row& row = point.rows[kind];
    const Real change = total - *row.held.impulse;
    *row.held.impulse = total;
    if (change == 0) { return 0; }
    const std::span<Block3> changes = system.change();
    std::size_t answers = row.answers;
    forEachNode(
        point, [&](std::uint32_t node) { addScaled(changes[node], static_cast<double>(change), answers_[answers++]); });
    return std::fabs(change);
}

/// Friction of either kind. @return how far its impulse changed
Real JointedContacts::hold(DirectSystem& system, const Point& point, RowKind kind, Real limit) const {
    const Row& row = point.rows[kind];
    const auto wanted = static_cast<Real>(-row.mass * system.changedExcess(row.row));
    return change(system, point, kind, std::clamp(*row.held.impulse + wanted, -limit, limit));
}

/// As `solveContacts` does, one point after the other. @return how far its impulses changed
Real JointedContacts::solvePoint(DirectSystem& system, Point& jointed, const ContactPass& pass) const {
    const ContactConstraint& contact = *jointed.contact;
    ContactConstraintPoint& point = *jointed.point;
    const Row& normal = jointed.rows[kNormal];
    const bool isCarrying = point.normalImpulse > 0 || (contact.begins && otherCarries(contact, point));
    const auto closing = static_cast<Real>(-system.changedExcess(normal.row));
    const auto mass = static_cast<Real>(normal.mass);
    const NormalDemand demand =
        demandOf(contact, point, mass, closing, 1 / pass.h, pass.useBias, isCarrying, jointed.pushShare);
    Real changed = 0;
    if (demand.any) {
        const Real wanted = normal.mass > 0 ? point.normalImpulse + demand.changeAt(point, mass) : Real(0);
        changed = change(system, jointed, kNormal, std::max(wanted, Real(0)));
    }
    changed = std::max(changed, hold(system, jointed, kTangent, contact.friction * point.normalImpulse));
    // An angular impulse, over the arm by which it is the share of what presses.
    if (jointed.rowCount > kRolling) {
        const Real turned = hold(system, jointed, kRolling, contact.rolling * point.normalImpulse);
        changed = std::max(changed, turned / contact.rolling);
    }
    return changed;
}

/// Until hardly anything changes.
void JointedContacts::solvePile(DirectSystem& system, std::span<Point> points, const ContactPass& pass) const {
    for (int i = 0; i < kMostPasses; ++i) {
        Real change = 0;
        Real largest = 0;
        for (Point& point : points) {
            change = std::max(change, solvePoint(system, point, pass));
            largest = std::max(largest, point.point->normalImpulse);
        }
        if (!(change > kSmallChange * largest)) { return; }
    }
}

void JointedContacts::solvePiles(DirectSystem& system, const DirectDrives& drives, const ContactPass& pass) {
    if (answersOf_ != system.factorNumber()) { findAnswers(system); }
    system.beginChange();
    drives.pushForced(system);
    for (std::size_t begin = 0; begin < points_.size();) {
        std::size_t end = begin;
        while (end < points_.size() && points_[end].pile == points_[begin].pile) { ++end; }
        solvePile(system, std::span(points_).subspan(begin, end - begin), pass);
        begin = end;
    }
}

void JointedContacts::solve(SolverBatch& batch, DirectSystem& system, DirectJoints& joints, DirectDrives& drives,
                            const ContactPass& pass) {
    drives.takeUp(batch.states);
    for (Point& jointed : points_) {
        const ContactConstraint& contact = *jointed.contact;
        for (Row& row : jointed.used()) {
            row.row.excess = DirectSystem::excessOf(batch.states, row.held);
            row.before = *row.held.impulse;
        }
        jointed.point->separation =
            currentSeparation(contact, *jointed.point, batch.states[contact.slotA], batch.states[contact.slotB]);
    }
    solvePiles(system, drives, pass);
    // Contacts were answered as if motors held whatever it takes.
    while (drives.letGo(system)) {
        DirectReport ofPass;
        drives.assemble(system, joints, ofPass);
        for (Point& jointed : points_) {
            for (const Row& row : jointed.used()) { *row.held.impulse = row.before; }
        }
        solvePiles(system, drives, pass);
    }
    if (pass.isLast) {
        for (Point& jointed : points_) { jointed.point->totalNormalImpulse += jointed.point->normalImpulse; }
    }
    joints.writeLater(system);
    drives.writeLater(system);
    system.dropNoise();
    system.changeVelocities(batch.states);
}

void JointedContacts::forget() {
    for (Point& jointed : points_) {
        for (const Row& row : jointed.used()) { *row.held.impulse = 0; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
