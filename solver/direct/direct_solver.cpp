#include "direct_solver.h"

#include <algorithm>
#include <cmath>

#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Blocks of the factor per body beyond which a batch is left to iteration.
constexpr std::size_t kMostBlocksPerBody = 32;
/// Strength of a row, in units of its own mass times the ratio of the heaviest mass in the island to that of its
/// bodies. For joints about the square root of what a double resolves at 10⁶ : 1: as many digits are left for the light
/// bodies as for the rows.
constexpr double kJointStrength = 16384;
/// Contacts that close no loop are at least as strong; what they resolve goes by the square of how many there are, one
/// on another, and with equal masses there are digits left.
constexpr double kTowerStrength = 64 * kJointStrength;
/// Rows in loops depend on each other, and what is too strong finds a state in which they work against each other: a
/// pyramid of boxes pressed itself apart.
constexpr double kLoopStrength = kJointStrength / 16;
/// Of what joints carry, this part is to be found again in each solve: an error of 1/64 over their strength, 10⁻⁶. Two
/// joints that hold the same against a motor would else work against each other more and more, each solve by what the
/// motor gave: a weld and a slider went from 1 to 1350 N·m·s in a third of a second, and flew apart.
constexpr double kForgottenPart = 1.0 / 64;
/// Rounds of a step, or of a part of one, beyond the usual ones of its solves: so many at least, and so many bodies in
/// all of them. What takes more is iterated. (Heaps of 256 bodies took 180 at times, 12 ms.)
constexpr std::size_t kFewestSpareRounds = 32;
constexpr std::size_t kSpareBodyRounds = 8192;
/// Changes this much smaller than the largest in the island are noise.
constexpr double kNoiseRatio = 1.0 / static_cast<double>(std::uint64_t{1} << 36);

int spareRoundsFor(std::size_t bodies) {
    return static_cast<int>(std::max(kFewestSpareRounds, kSpareBodyRounds / bodies));
}

Block3 velocityOf(const BodyState& state) {
    return {static_cast<double>(state.velocity.x), static_cast<double>(state.velocity.y),
            static_cast<double>(state.angularVelocity)};
}

/// Speed of the row per velocity of A, and of B.
struct RowEnds {
    Block3 a;
    Block3 b;
};
RowEnds endsOf(const JointRow& row) {
    const auto x = static_cast<double>(row.linear.x);
    const auto y = static_cast<double>(row.linear.y);
    return {{-x, -y, -static_cast<double>(row.spinA)}, {x, y, static_cast<double>(row.spinB)}};
}

}  // namespace

bool DirectSolver::prepare(SolverBatch& batch, DirectScope scope, bool isPatient, bool isTakenBack) {
    if ((scope == DirectScope::freeJoints || scope == DirectScope::islands) && !batch.contacts.empty()) {
        return false;
    }
    scope_ = scope;
    isPatient_ = isPatient;
    isTakenBack_ = isTakenBack;
    hasGivenUp_ = false;
    isFactorised_ = false;
    motions_.clear();
    joints_.clear();
    drives_.clear();
    for (std::vector<DriveMemory>& drives : remembered_) { drives.clear(); }
    contacts_.clear();
    listNodes(batch);
    if (nodes_.empty() || !listEdges(batch)) { return false; }
    spareRounds_ = spareRoundsFor(nodes_.size());
    takesLong_.assign(nodes_.size(), 0);
    if (scope == DirectScope::all) { listContacts(batch); }
    if (scope == DirectScope::jointed) { listJointed(batch); }
    markDrives(batch);
    return true;
}

void DirectSolver::listNodes(const SolverBatch& batch) {
    constexpr std::uint32_t kIsTied = 0;
    // Where contacts are iterated, what no joint holds has no part in it.
    const bool areAllTied = scope_ == DirectScope::all || scope_ == DirectScope::jointed;
    nodeOf_.assign(batch.inertias.size(), areAllTied ? kIsTied : kNoNode);
    forEachHeldKind(batch, [this](const auto& joints) {
        for (const auto& joint : joints) { nodeOf_[joint.slotA] = nodeOf_[joint.slotB] = kIsTied; }
    });
    if (holdsDrives(scope_)) { tieMotors(batch, kIsTied); }
    nodes_.clear();
    for (std::uint32_t slot = 0; slot < batch.inertias.size(); ++slot) {
        const BodyInertia& body = batch.inertias[slot];
        if (nodeOf_[slot] != kIsTied || !isMovable(body)) {
            nodeOf_[slot] = kNoNode;
            continue;
        }
        nodeOf_[slot] = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({slot, body.inverseMass > 0 ? 1 / static_cast<double>(body.inverseMass) : 0,
                          body.inverseInertia > 0 ? 1 / static_cast<double>(body.inverseInertia) : 0});
    }
    change_.resize(nodes_.size());
}

bool DirectSolver::listEdges(const SolverBatch& batch) {
    edges_.clear();
    islands_.reset(nodes_.size());
    const auto tie = [this](const auto& constraints) {
        for (const auto& constraint : constraints) {
            const std::uint32_t a = nodeOf_[constraint.slotA];
            const std::uint32_t b = nodeOf_[constraint.slotB];
            if (a == kNoNode || b == kNoNode || a == b) { continue; }
            edges_.push_back({a, b});
            islands_.unite(a, b);
        }
    };
    forEachHeldKind(batch, tie);
    if (holdsDrives(scope_)) { tie(batch.motors); }
    if (scope_ == DirectScope::all) { tie(batch.contacts); }
    weighIslands(batch);
    const auto count = static_cast<std::uint32_t>(nodes_.size());
    return matrix_.analyse(count, edges_, kMostBlocksPerBody * count);
}

void DirectSolver::weighIslands(const SolverBatch& batch) {
    loads_.assign(nodes_.size(), {});
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        TiedLoad& load = loads_[islands_.find(i)];
        const double mass = nodes_[i].mass;
        load.heaviest = std::max(load.heaviest, mass);
        load.lightest = load.bodies++ == 0 ? mass : std::min(load.lightest, mass);
    }
    if (scope_ == DirectScope::all) {
        for (const ContactConstraint& contact : batch.contacts) {
            const std::uint32_t a = nodeOf_[contact.slotA];
            const std::uint32_t node = a != kNoNode ? a : nodeOf_[contact.slotB];
            if (node != kNoNode) { ++loads_[islands_.find(node)].contacts; }
        }
    }
    for (TiedLoad& load : loads_) {
        if (scope_ != DirectScope::all) {
            load.strength = kJointStrength;
        } else if (load.contacts > load.bodies) {
            load.strength = kLoopStrength;
        } else {
            const double spread = load.lightest > 0 ? load.heaviest / load.lightest : kTowerStrength;
            load.strength = std::max(kTowerStrength / std::max(spread, 1.0), kJointStrength);
        }
    }
}

DirectSolver::Row DirectSolver::rowOf(const SolverBatch& batch, const DirectRow& held) {
    const RowEnds ends = endsOf(held.row);
    Row row{.nodeA = nodeOf_[held.slotA], .nodeB = nodeOf_[held.slotB]};
    double inverse = 0;
    double inverseMass = 0;
    std::uint32_t island = 0;
    const auto add = [&](std::uint32_t node, BodySlot slot, const Block3& all, Block3& moved) {
        if (node == kNoNode) { return; }
        const BodyInertia& body = batch.inertias[slot];
        const auto linear = static_cast<double>(body.inverseMass);
        const auto angular = static_cast<double>(body.inverseInertia);
        moved = {linear > 0 ? all[0] : 0, linear > 0 ? all[1] : 0, angular > 0 ? all[2] : 0};
        inverse += linear * (moved[0] * moved[0] + moved[1] * moved[1]) + angular * moved[2] * moved[2];
        inverseMass += linear;
        island = islands_.find(node);
    };
    add(row.nodeA, held.slotA, ends.a, row.ofA);
    add(row.nodeB, held.slotB, ends.b, row.ofB);
    if (inverse > 0) {
        const TiedLoad& load = loads_[island];
        row.strength = load.strength * (std::max(load.heaviest * inverseMass, 1.0) / inverse);
    }
    return row;
}

void DirectSolver::noteMotions(const SolverBatch& batch) {
    motions_.clear();
    for (const BodyState& state : batch.states) { motions_.push_back({state.velocity, state.angularVelocity}); }
}

double DirectSolver::excessOf(const SolverBatch& batch, const DirectRow& held) const {
    const RowEnds ends = endsOf(held.row);
    double excess = static_cast<double>(held.bias);
    excess += dot3(ends.a, velocityOf(batch.states[held.slotA]));
    excess += dot3(ends.b, velocityOf(batch.states[held.slotB]));
    return excess;
}

void DirectSolver::gatherJoints(SolverBatch& batch, Real h, bool useBias, bool atRest) {
    jointRows_.clear();
    addJointRows(batch, motions_, h, std::max(h, leastClosing_), useBias, jointRows_);
    joints_.clear();
    for (const DirectRow& held : jointRows_) {
        Row row = rowOf(batch, held);
        row.excess = atRest ? 0 : excessOf(batch, held);
        joints_.push_back({row, held.impulse, atRest ? 0 : kForgottenPart * static_cast<double>(*held.impulse)});
    }
}

bool DirectSolver::holdsAsBefore() const {
    if (!isFactorised_ || factorised_ != strength_ || !joints_.empty()) { return false; }
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        if (holdsOf(contacts_[i].normalHold == Hold::held, contacts_[i].tangentHold == Hold::held) != holds_[i]) {
            return false;
        }
    }
    return true;
}

void DirectSolver::addToMatrix(const Row& row, double share) {
    if (!(row.strength > 0)) { return; }
    const double k = share * strength_ * row.strength;
    if (row.nodeA != kNoNode) { addOuter(matrix_.diagonal(row.nodeA), k, row.ofA, row.ofA); }
    if (row.nodeB != kNoNode) { addOuter(matrix_.diagonal(row.nodeB), k, row.ofB, row.ofB); }
    if (row.nodeA != kNoNode && row.nodeB != kNoNode && row.nodeA != row.nodeB) {
        const BlockLdlt::OffDiagonal off = matrix_.offDiagonal(row.nodeA, row.nodeB);
        addOuter(off.block, k, off.rowIsB ? row.ofB : row.ofA, off.rowIsB ? row.ofA : row.ofB);
    }
}

template <bool kJoints>
void DirectSolver::assemble(DirectReport& report, double tangentShare) {
    factorised_ = strength_;
    matrix_.clear();
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const Node& node = nodes_[i];
        Block33& block = matrix_.diagonal(i);
        block[0] = block[4] = node.mass > 0 ? node.mass : 1;
        block[8] = node.inertia > 0 ? node.inertia : 1;
    }
    if constexpr (kJoints) {
        for (const HeldJoint& joint : joints_) { addToMatrix(joint.row); }
        assembleDrives();
    }
    holds_.clear();
    for (const ContactPoint& contact : contacts_) {
        const bool presses = contact.normalHold == Hold::held;
        const bool sticks = contact.tangentHold == Hold::held;
        holds_.push_back(holdsOf(presses, sticks));
        if (presses) { addToMatrix(contact.normal); }
        if (sticks) { addToMatrix(contact.tangent, tangentShare); }
    }
    matrix_.factorise();
    isFactorised_ = true;
    areAnswersCurrent_ = false;
    ++report.factorisations;
}

void DirectSolver::push(const Row& row, double impulse) {
    if (row.nodeA != kNoNode) { addScaled(change_[row.nodeA], impulse, row.ofA); }
    if (row.nodeB != kNoNode) { addScaled(change_[row.nodeB], impulse, row.ofB); }
}

template <bool kJoints>
void DirectSolver::computeChange() {
    std::fill(change_.begin(), change_.end(), Block3{});
    const auto pushContact = [&](const Row& row, Hold hold) {
        if (hold == Hold::held) {
            push(row, row.guess - strength_ * row.strength * row.excess);
        } else if (hold == Hold::forced) {
            push(row, row.impulse);
        }
    };
    if constexpr (kJoints) {
        for (const HeldJoint& joint : joints_) {
            push(joint.row, -strength_ * joint.row.strength * joint.row.excess - joint.forgotten);
        }
        pushDrives();
    }
    for (const ContactPoint& contact : contacts_) {
        pushContact(contact.normal, contact.normalHold);
        pushContact(contact.tangent, contact.tangentHold);
    }
    matrix_.solve(change_);
}

double DirectSolver::changedExcess(const Row& row) const {
    double excess = row.excess;
    if (row.nodeA != kNoNode) { excess += dot3(row.ofA, change_[row.nodeA]); }
    if (row.nodeB != kNoNode) { excess += dot3(row.ofB, change_[row.nodeB]); }
    return excess;
}

/// What is so small against the largest change in its island is the rounding of the solution; left in, it would
/// multiply with its like until it underflows.
void DirectSolver::dropNoise() {
    largest_.assign(nodes_.size(), Block3{});
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        Block3& largest = largest_[islands_.find(i)];
        largest[0] = std::max({largest[0], std::fabs(change_[i][0]), std::fabs(change_[i][1])});
        largest[1] = std::max(largest[1], std::fabs(change_[i][2]));
    }
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const Block3& largest = largest_[islands_.find(i)];
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::fabs(change_[i][k]) < kNoiseRatio * largest[k < 2 ? 0 : 1]) { change_[i][k] = 0; }
        }
    }
}

void DirectSolver::applyToBodies(SolverBatch& batch) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        BodyState& state = batch.states[nodes_[i].slot];
        const Block3 v = velocityOf(state);
        state.velocity = {static_cast<Real>(v[0] + change_[i][0]), static_cast<Real>(v[1] + change_[i][1])};
        state.angularVelocity = static_cast<Real>(v[2] + change_[i][2]);
    }
}

template <bool kJoints>
void DirectSolver::applyToImpulses() {
    if constexpr (kJoints) {
        for (const HeldJoint& joint : joints_) {
            const double change = -strength_ * joint.row.strength * changedExcess(joint.row) - joint.forgotten;
            *joint.impulse = static_cast<Real>(static_cast<double>(*joint.impulse) + change);
        }
        writeDrives();
    }
    for (ContactPoint& contact : contacts_) {
        const auto keep = [this, &contact](const Row& row, double least) {
            return std::fabs(row.impulse) < noise_[contact.island] ? Real(0)
                                                                   : static_cast<Real>(std::max(row.impulse, least));
        };
        contact.point->normalImpulse = keep(contact.normal, 0);
        contact.point->tangentImpulse = keep(contact.tangent, contact.tangent.impulse);
    }
}

bool DirectSolver::tookLong(BodySlot slot) const {
    const std::uint32_t node = nodeOf_[slot];
    return node != kNoNode && takesLong_[islands_.rootOf(node)] != 0;
}

template <bool kJoints>
bool DirectSolver::solve(SolverBatch& batch, Real h, bool useBias, DirectReport& report) {
    if (hasGivenUp_ && (isPatient_ || isTakenBack_)) { return false; }
    strength_ = 1;
    if constexpr (kJoints) {
        gatherJoints(batch, h, useBias, false);
        gatherDrives(batch, h, useBias);
    }
    gatherContacts(batch, h, useBias);
    if (!findImpulses<kJoints>(report) || (hasTightened_ && isSqueezed(batch))) {
        ++report.givenUp;
        hasGivenUp_ = true;
        return false;
    }
    applyToImpulses<kJoints>();
    dropNoise();
    applyToBodies(batch);
    return true;
}

template void DirectSolver::assemble<false>(DirectReport&, double);
template void DirectSolver::assemble<true>(DirectReport&, double);
template void DirectSolver::computeChange<false>();
template void DirectSolver::computeChange<true>();
template void DirectSolver::applyToImpulses<true>();
template bool DirectSolver::solve<false>(SolverBatch&, Real, bool, DirectReport&);
template bool DirectSolver::solve<true>(SolverBatch&, Real, bool, DirectReport&);

}  // namespace swept::inline SWEPT_PRECISION
