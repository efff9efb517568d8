#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "../contacts/contact_demand.h"
#include "direct_parts.h"
#include "direct_solver.h"

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
void DirectSolver::listTies(const SolverBatch& batch) {
    const auto count = static_cast<std::uint32_t>(nodes_.size());
    ties_.assign(count, {});
    for (std::uint32_t i = 0; i < count; ++i) {
        Tie& tie = ties_[islands_.find(i)];
        ++tie.nodes;
        tie.mass += nodes_[i].mass;
    }
    std::uint32_t first = 0;
    for (Tie& tie : ties_) {
        tie.first = first;
        first += std::exchange(tie.nodes, 0);
    }
    tieNodes_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        Tie& tie = ties_[islands_.find(i)];
        tieNodes_[tie.first + tie.nodes++] = i;
    }
    piles_.reset(count);
    for (std::uint32_t i = 0; i < count; ++i) { piles_.unite(i, islands_.find(i)); }
    for (const ContactConstraint& contact : batch.contacts) {
        const std::uint32_t a = nodeOf_[contact.slotA];
        const std::uint32_t b = nodeOf_[contact.slotB];
        if (a != kNoNode && b != kNoNode) { piles_.unite(a, b); }
    }
}

void DirectSolver::listJointed(SolverBatch& batch) {
    listTies(batch);
    jointed_.clear();
    jointedRounds_ = 0;
    std::size_t answers = 0;
    for (ContactConstraint& contact : batch.contacts) {
        const std::uint32_t a = nodeOf_[contact.slotA];
        const std::uint32_t b = nodeOf_[contact.slotB];
        if (a == kNoNode && b == kNoNode) { continue; }
        for (int i = 0; i < contact.count; ++i) {
            JointedPoint point;
            point.contact = &contact;
            point.point = &contact.points[static_cast<std::size_t>(i)];
            point.pile = piles_.find(a != kNoNode ? a : b);
            point.tieA = a != kNoNode ? islands_.find(a) : kNoNode;
            point.tieB = b != kNoNode && islands_.find(b) != point.tieA ? islands_.find(b) : kNoNode;
            point.answers = answers;
            for (const std::uint32_t tie : {point.tieA, point.tieB}) {
                if (tie == kNoNode) { continue; }
                point.nodes += ties_[tie].nodes;
                point.round = std::max(point.round, ties_[tie].rounds);
            }
            // What stands in the same round shares no tie.
            for (const std::uint32_t tie : {point.tieA, point.tieB}) {
                if (tie != kNoNode) { ties_[tie].rounds = point.round + 1; }
            }
            jointedRounds_ = std::max(jointedRounds_, point.round + 1);
            point.heldNormal = normalRowOf(contact, *point.point, 0);
            point.heldTangent = tangentRowOf(contact, *point.point);
            point.normal = rowOf(batch, point.heldNormal);
            point.tangent = rowOf(batch, point.heldTangent);
            jointed_.push_back(point);
            answers += 2 * point.nodes;
        }
    }
    answers_.resize(answers);
    std::sort(jointed_.begin(), jointed_.end(), [](const JointedPoint& p, const JointedPoint& q) {
        return p.pile != q.pile ? p.pile < q.pile : p.answers < q.answers;  // of a pile in the order of its contacts
    });
}

/// Of each row while the joints hold. Ties do not answer to each other: a row of each is found at once.
void DirectSolver::findAnswers() {
    for (std::uint32_t round = 0; round < jointedRounds_; ++round) {
        for (const bool isTangent : {false, true}) {
            std::fill(change_.begin(), change_.end(), Block3{});
            for (const JointedPoint& point : jointed_) {
                if (point.round == round) { push(isTangent ? point.tangent : point.normal, 1); }
            }
            matrix_.solve(change_);
            for (JointedPoint& point : jointed_) {
                if (point.round == round) { readAnswers(point, isTangent); }
            }
        }
    }
    areAnswersCurrent_ = true;
}

void DirectSolver::readAnswers(JointedPoint& point, bool isTangent) {
    std::size_t place = point.answers + (isTangent ? point.nodes : 0);
    forEachNode(point, [&](std::uint32_t node) { answers_[place++] = change_[node]; });
    const Row& row = isTangent ? point.tangent : point.normal;
    double answer = 0;
    if (row.nodeA != kNoNode) { answer += dot3(row.ofA, change_[row.nodeA]); }
    if (row.nodeB != kNoNode) { answer += dot3(row.ofB, change_[row.nodeB]); }
    double& mass = isTangent ? point.tangentMass : point.normalMass;
    mass = inverseOf(answer);
    if (!isWithinTie(point)) { return; }
    const double ofTie = ties_[point.tieA].mass;
    if (mass > kMostTieMasses * ofTie) { mass = 0; }
    if (!isTangent) { point.pushShare = static_cast<Real>(std::min(1.0, kMostPushedMasses * ofTie / mass)); }
}

bool DirectSolver::isWithinTie(const JointedPoint& point) {
    return point.normal.nodeA != kNoNode && point.normal.nodeB != kNoNode && point.tieB == kNoNode;
}

template <class Visit>
void DirectSolver::forEachNode(const JointedPoint& point, const Visit& visit) const {
    for (const std::uint32_t tie : {point.tieA, point.tieB}) {
        if (tie == kNoNode) { continue; }
        for (std::uint32_t i = 0; i < ties_[tie].nodes; ++i) { visit(tieNodes_[ties_[tie].first + i]); }
    }
}

/// @param answers  of the row
void DirectSolver::pushTies(const JointedPoint& point, std::size_t answers, double impulse) {
    if (impulse == 0) { return; }
    forEachNode(point, [&](std::uint32_t node) { addScaled(change_[node], impulse, answers_[answers++]); });
}

/// As `solveContacts` does, one point after the other. @return how far its impulses changed
Real DirectSolver::solvePoint(JointedPoint& jointed, const ContactPass& pass) {
    const ContactConstraint& contact = *jointed.contact;
    ContactConstraintPoint& point = *jointed.point;
    const bool isCarrying = point.normalImpulse > 0 || (contact.begins && otherCarries(contact, point));
    const auto closing = static_cast<Real>(-changedExcess(jointed.normal));
    const auto mass = static_cast<Real>(jointed.normalMass);
    const NormalDemand demand =
        demandOf(contact, point, mass, closing, 1 / pass.h, pass.useBias, isCarrying, jointed.pushShare);
    const Real normalBefore = point.normalImpulse;
    if (demand.any) {
        const Real change = demand.changeAt(point, mass);
        const Real wanted = jointed.normalMass > 0 ? normalBefore + change : Real(0);
        point.normalImpulse = std::max(wanted, Real(0));
        pushTies(jointed, jointed.answers, static_cast<double>(point.normalImpulse - normalBefore));
    }
    const Real limit = contact.friction * point.normalImpulse;
    const Real tangentBefore = point.tangentImpulse;
    const auto change = static_cast<Real>(-jointed.tangentMass * changedExcess(jointed.tangent));
    point.tangentImpulse = std::clamp(tangentBefore + change, -limit, limit);
    pushTies(jointed, jointed.answers + jointed.nodes, static_cast<double>(point.tangentImpulse - tangentBefore));
    return std::max(std::fabs(point.normalImpulse - normalBefore), std::fabs(point.tangentImpulse - tangentBefore));
}

/// Until hardly anything changes.
void DirectSolver::solvePile(std::span<JointedPoint> points, const ContactPass& pass) {
    for (int i = 0; i < kMostPasses; ++i) {
        Real change = 0;
        Real largest = 0;
        for (JointedPoint& point : points) {
            change = std::max(change, solvePoint(point, pass));
            largest = std::max(largest, point.point->normalImpulse);
        }
        if (!(change > kSmallChange * largest)) { return; }
    }
}

void DirectSolver::solvePiles(const ContactPass& pass) {
    if (!areAnswersCurrent_) { findAnswers(); }
    std::fill(change_.begin(), change_.end(), Block3{});
    pushForced();
    for (std::size_t begin = 0; begin < jointed_.size();) {
        std::size_t end = begin;
        while (end < jointed_.size() && jointed_[end].pile == jointed_[begin].pile) { ++end; }
        solvePile(std::span(jointed_).subspan(begin, end - begin), pass);
        begin = end;
    }
}

void DirectSolver::solveJointed(SolverBatch& batch, const ContactPass& pass) {
    takeUpDrives(batch);
    for (JointedPoint& jointed : jointed_) {
        const ContactConstraint& contact = *jointed.contact;
        jointed.normal.excess = excessOf(batch, jointed.heldNormal);
        jointed.tangent.excess = excessOf(batch, jointed.heldTangent);
        jointed.point->separation =
            currentSeparation(contact, *jointed.point, batch.states[contact.slotA], batch.states[contact.slotB]);
        jointed.normalBefore = jointed.point->normalImpulse;
        jointed.tangentBefore = jointed.point->tangentImpulse;
    }
    solvePiles(pass);
    // Contacts were answered as if motors held whatever it takes.
    while (letGoDrives()) {
        DirectReport ofPass;
        assemble<true>(ofPass);
        for (JointedPoint& jointed : jointed_) {
            jointed.point->normalImpulse = jointed.normalBefore;
            jointed.point->tangentImpulse = jointed.tangentBefore;
        }
        solvePiles(pass);
    }
    if (pass.isLast) {
        for (JointedPoint& jointed : jointed_) { jointed.point->totalNormalImpulse += jointed.point->normalImpulse; }
    }
    for (const HeldJoint& joint : joints_) {
        const double moved = changedExcess(joint.row) - joint.row.excess;
        const double change = -strength_ * joint.row.strength * moved;
        *joint.impulse = static_cast<Real>(static_cast<double>(*joint.impulse) + change);
    }
    for (const Drive& drive : drives_) {
        const DrivePush impulse = laterImpulseOf(drive);
        for (std::size_t i = 0; i < drive.count; ++i) { *drive.rows[i].held.impulse = static_cast<Real>(impulse[i]); }
    }
    dropNoise();
    applyToBodies(batch);
}

void DirectSolver::forgetBlows() {
    for (const HeldJoint& joint : joints_) { *joint.impulse = 0; }
    for (const JointedPoint& jointed : jointed_) { jointed.point->normalImpulse = jointed.point->tangentImpulse = 0; }
}

}  // namespace swept::inline SWEPT_PRECISION
