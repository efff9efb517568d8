#include "direct_solver.h"

#include <algorithm>
#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::uint32_t kNoNode = ~std::uint32_t{0};
/// Strength of a row, in units of its own mass times the ratio of the heaviest mass in the island to that of its
/// bodies. About the square root of what a double resolves at 10⁶ : 1: as many digits are left for the light bodies as
/// for the rows.
constexpr double kStrength = 16384;
/// The same where positions are moved: rows that contradict each other (a card wedged between planks) must give.
constexpr double kProjectionStrength = kStrength / 64;
/// Blocks of the factor per body beyond which a batch is left to iteration.
constexpr std::size_t kMostBlocksPerBody = 16;
/// Rounds of one solve: contacts are taken in during the first ones only, so that none goes in and out for ever.
constexpr int kMaxRounds = 16;
constexpr int kTakeInRounds = 3;
/// Changes this much smaller than the largest in the island are noise.
constexpr double kNoiseRatio = 1.0 / static_cast<double>(std::uint64_t{1} << 36);
/// Part of an overlap or gap that a projection closes.
constexpr Real kProjectionRate = Real(1) / 4;
/// Separations beyond this part of the distance to the centre of mass are closed within the step, smaller ones at its
/// end.
constexpr Real kLargeRatio = Real(1) / 8192;


double dot3(const Block3& a, const Block3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Block3 velocityOf(const BodyState& state) {
    return {static_cast<double>(state.velocity.x), static_cast<double>(state.velocity.y),
            static_cast<double>(state.angularVelocity)};
}

void addOuter(Block33& block, double factor, const Block3& a, const Block3& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double scaled = factor * a[i];
        for (std::size_t k = 0; k < 3; ++k) {
            block[3 * i + k] += scaled * b[k];
        }
    }
}

void addScaled(Block3& to, double factor, const Block3& a) {
    for (std::size_t i = 0; i < 3; ++i) {
        to[i] += factor * a[i];
    }
}

bool sticks(const ContactConstraint& contact, const ContactConstraintPoint& point) {
    return std::fabs(point.tangentImpulse) < contact.friction * point.normalImpulse;
}

}  // namespace

bool DirectSolver::prepare(const SolverBatch& batch, DirectScope scope) {
    if (scope == DirectScope::freeJoints && !batch.contacts.empty()) {
        return false;
    }
    scope_ = scope;
    isFactorised_ = false;
    contacts_.clear();
    listNodes(batch);
    return !nodes_.empty() && listEdges(batch);
}

void DirectSolver::listNodes(const SolverBatch& batch) {
    nodeOf_.assign(batch.inertias.size(), kNoNode);
    nodes_.clear();
    for (std::uint32_t slot = 0; slot < batch.inertias.size(); ++slot) {
        const BodyInertia& body = batch.inertias[slot];
        if (!isMovable(body)) {
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
            if (a == kNoNode || b == kNoNode || a == b) {
                continue;
            }
            edges_.push_back({a, b});
            islands_.unite(a, b);
        }
    };
    forEachHeldKind(batch, tie);
    if (scope_ == DirectScope::all) {
        tie(batch.contacts);
    }
    const auto count = static_cast<std::uint32_t>(nodes_.size());
    heaviest_.assign(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        double& heaviest = heaviest_[islands_.find(i)];
        heaviest = std::max(heaviest, nodes_[i].mass);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        heaviest_[i] = heaviest_[islands_.find(i)];
    }
    return matrix_.analyse(count, edges_, kMostBlocksPerBody * count);
}

DirectSolver::Row DirectSolver::rowOf(const SolverBatch& batch, const DirectRow& held, bool atRest) const {
    const auto x = static_cast<double>(held.row.linear.x);
    const auto y = static_cast<double>(held.row.linear.y);
    Row row{.nodeA = nodeOf_[held.slotA], .nodeB = nodeOf_[held.slotB], .impulse = held.impulse};
    double inverse = 0;
    double inverseMass = 0;
    double heaviest = 0;
    row.excess = static_cast<double>(held.bias);
    const auto add = [&](std::uint32_t node, BodySlot slot, const Block3& all, Block3& moved) {
        if (!atRest) {
            row.excess += dot3(all, velocityOf(batch.states[slot]));
        }
        if (node == kNoNode) {
            return;
        }
        const BodyInertia& body = batch.inertias[slot];
        const auto linear = static_cast<double>(body.inverseMass);
        const auto angular = static_cast<double>(body.inverseInertia);
        moved = {linear > 0 ? all[0] : 0, linear > 0 ? all[1] : 0, angular > 0 ? all[2] : 0};
        inverse += linear * (moved[0] * moved[0] + moved[1] * moved[1]) + angular * moved[2] * moved[2];
        inverseMass += linear;
        heaviest = heaviest_[node];
    };
    add(row.nodeA, held.slotA, {-x, -y, -static_cast<double>(held.row.spinA)}, row.ofA);
    add(row.nodeB, held.slotB, {x, y, static_cast<double>(held.row.spinB)}, row.ofB);
    if (inverse > 0) {
        row.strength = std::max(heaviest * inverseMass, 1.0) / inverse;
    }
    return row;
}

void DirectSolver::gatherJoints(SolverBatch& batch, Real h, bool useBias, bool atRest) {
    jointRows_.clear();
    addJointRows(batch, h, useBias, jointRows_);
    joints_.clear();
    for (const DirectRow& row : jointRows_) {
        joints_.push_back(rowOf(batch, row, atRest));
    }
}

void DirectSolver::addPoint(const SolverBatch& batch, ContactConstraint& contact, ContactConstraintPoint& point,
                            Real bias, bool presses, bool isStuck, bool atRest) {
    const DirectRow normal{rowAlong(contact.normal, point.anchorA, point.anchorB), contact.slotA, contact.slotB, bias,
                           &point.normalImpulse};
    const DirectRow tangent{rowAlong(rightPerp(contact.normal), point.anchorA, point.anchorB), contact.slotA,
                            contact.slotB, 0, &point.tangentImpulse};
    const auto friction = static_cast<double>(contact.friction);
    contacts_.push_back({rowOf(batch, normal, atRest), presses ? Hold::held : Hold::free, friction});
    contacts_.push_back({rowOf(batch, tangent, atRest), presses && isStuck ? Hold::held : Hold::free, friction});
}

void DirectSolver::gatherContacts(SolverBatch& batch, Real h, bool useBias) {
    contacts_.clear();
    for (ContactConstraint& contact : batch.contacts) {
        const BodyState& a = batch.states[contact.slotA];
        const BodyState& b = batch.states[contact.slotB];
        for (int i = 0; i < contact.count; ++i) {
            ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
            const bool pressed = point.normalImpulse > 0;
            const Real closing = -dot(velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA), contact.normal);
            const Real separation = useBias ? currentSeparation(contact, point, a, b) : Real(0);
            const Real bias = !pressed && separation > 0 ? separation / h : Real(0);
            // What touches and does not part is guessed to press: a stack that comes down comes down on all its
            // contacts.
            const bool presses = useBias ? pressed || closing >= bias : pressed && closing <= contact.bounceSpeed;
            addPoint(batch, contact, point, bias, presses, contact.friction > 0 && (!pressed || sticks(contact, point)),
                     false);
        }
    }
}

bool DirectSolver::gatherOverlaps(SolverBatch& batch, Real h) {
    contacts_.clear();
    bool anyLarge = false;
    for (ContactConstraint& contact : batch.contacts) {
        const BodyState& a = batch.states[contact.slotA];
        const BodyState& b = batch.states[contact.slotB];
        for (int i = 0; i < contact.count; ++i) {
            ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
            const Real separation = currentSeparation(contact, point, a, b);
            const bool presses = point.normalImpulse > 0 || separation < 0;
            const Real size = std::max(lengthSquared(point.anchorA), lengthSquared(point.anchorB));
            anyLarge = anyLarge || (presses && square(separation) > square(kLargeRatio) * size);
            const Real move = std::max(kProjectionRate * separation, -contact.maxPushSpeed * h);
            addPoint(batch, contact, point, move, presses, sticks(contact, point), true);
        }
    }
    return anyLarge;
}

bool DirectSolver::holdsAsBefore() const {
    return isFactorised_ && joints_.empty() &&
           std::equal(contacts_.begin(), contacts_.end(), holds_.begin(), holds_.end(),
                      [](const ContactRow& row, std::uint8_t held) { return (row.hold == Hold::held) == (held != 0); });
}

void DirectSolver::addToMatrix(const Row& row, double strength) {
    if (!(row.strength > 0)) {
        return;
    }
    const double k = strength * row.strength;
    if (row.nodeA != kNoNode) {
        addOuter(matrix_.diagonal(row.nodeA), k, row.ofA, row.ofA);
    }
    if (row.nodeB != kNoNode) {
        addOuter(matrix_.diagonal(row.nodeB), k, row.ofB, row.ofB);
    }
    if (row.nodeA == kNoNode || row.nodeB == kNoNode || row.nodeA == row.nodeB) {
        return;
    }
    const BlockLdlt::OffDiagonal off = matrix_.offDiagonal(row.nodeA, row.nodeB);
    addOuter(off.block, k, off.rowIsB ? row.ofB : row.ofA, off.rowIsB ? row.ofA : row.ofB);
}

void DirectSolver::assemble(double strength, DirectReport& report) {
    matrix_.clear();
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const Node& node = nodes_[i];
        Block33& block = matrix_.diagonal(i);
        block[0] = block[4] = node.mass > 0 ? node.mass : 1;
        block[8] = node.inertia > 0 ? node.inertia : 1;
    }
    for (const Row& row : joints_) {
        addToMatrix(row, strength);
    }
    holds_.clear();
    for (const ContactRow& contact : contacts_) {
        const bool held = contact.hold == Hold::held;
        holds_.push_back(held);
        if (held) {
            addToMatrix(contact.row, strength);
        }
    }
    matrix_.factorise();
    isFactorised_ = true;
    ++report.factorisations;
}

void DirectSolver::computeChange(double strength) {
    std::fill(change_.begin(), change_.end(), Block3{});
    const auto push = [this](const Row& row, double impulse) {
        if (row.nodeA != kNoNode) {
            addScaled(change_[row.nodeA], impulse, row.ofA);
        }
        if (row.nodeB != kNoNode) {
            addScaled(change_[row.nodeB], impulse, row.ofB);
        }
    };
    for (const Row& row : joints_) {
        push(row, -strength * row.strength * row.excess);
    }
    for (const ContactRow& contact : contacts_) {
        if (contact.hold == Hold::held) {
            push(contact.row, -strength * contact.row.strength * contact.row.excess);
        }
        if (contact.hold == Hold::forced) {
            push(contact.row, contact.row.change);
        }
    }
    matrix_.solve(change_);
    for (Row& row : joints_) {
        row.change = -strength * row.strength * changedExcess(row);
    }
    for (ContactRow& contact : contacts_) {
        Row& row = contact.row;
        if (contact.hold == Hold::held) {
            row.change = -strength * row.strength * changedExcess(row);
        }
    }
}

double DirectSolver::changedExcess(const Row& row) const {
    double excess = row.excess;
    if (row.nodeA != kNoNode) {
        excess += dot3(row.ofA, change_[row.nodeA]);
    }
    if (row.nodeB != kNoNode) {
        excess += dot3(row.ofB, change_[row.nodeB]);
    }
    return excess;
}

/// Lets go what pulls, lets slide what would stick beyond its friction, takes in what would sink in. @return whether
/// any did
bool DirectSolver::correct(bool mayTakeIn) {
    bool changed = false;
    for (std::size_t i = 0; i < contacts_.size(); i += 2) {
        ContactRow& normal = contacts_[i];
        ContactRow& tangent = contacts_[i + 1];
        const auto pressed = static_cast<double>(*normal.row.impulse);
        const auto rubbed = static_cast<double>(*tangent.row.impulse);
        if (normal.hold != Hold::held) {
            if (!mayTakeIn || !(changedExcess(normal.row) < 0)) {
                continue;
            }
            normal.hold = Hold::held;
            tangent.hold = normal.friction > 0 ? Hold::held : Hold::free;
            changed = true;
        } else if (pressed + normal.row.change < 0) {
            normal.hold = tangent.hold = Hold::forced;
            normal.row.change = -pressed;
            tangent.row.change = -rubbed;
            changed = true;
        } else if (tangent.hold == Hold::held) {
            const double limit = tangent.friction * (pressed + normal.row.change);
            if (std::fabs(rubbed + tangent.row.change) <= limit) {
                continue;
            }
            tangent.hold = Hold::forced;
            tangent.row.change = std::clamp(rubbed + tangent.row.change, -limit, limit) - rubbed;
            changed = true;
        }
    }
    return changed;
}

/// What is so small against the largest change in its island is the rounding of the solution; left in, it would
/// multiply with its like until it underflows.
void DirectSolver::dropNoise() {
    largest_.assign(nodes_.size(), Block3{});
    const auto size = [](double x, double y) { return std::max(std::fabs(x), std::fabs(y)); };
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        Block3& largest = largest_[islands_.find(i)];
        largest[0] = std::max(largest[0], size(change_[i][0], change_[i][1]));
        largest[1] = std::max(largest[1], std::fabs(change_[i][2]));
    }
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const Block3& largest = largest_[islands_.find(i)];
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::fabs(change_[i][k]) < kNoiseRatio * largest[k < 2 ? 0 : 1]) {
                change_[i][k] = 0;
            }
        }
    }
    const auto rootOf = [this](const Row& row) { return islands_.find(row.nodeA != kNoNode ? row.nodeA : row.nodeB); };
    for (const ContactRow& contact : contacts_) {
        if (contact.row.nodeA == kNoNode && contact.row.nodeB == kNoNode) {
            continue;
        }
        double& largest = largest_[rootOf(contact.row)][2];
        largest = size(largest, static_cast<double>(*contact.row.impulse));
    }
    for (ContactRow& contact : contacts_) {
        if (contact.row.nodeA == kNoNode && contact.row.nodeB == kNoNode) {
            continue;
        }
        if (std::fabs(contact.row.change) < kNoiseRatio * largest_[rootOf(contact.row)][2]) {
            contact.row.change = 0;
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

void DirectSolver::applyToImpulses() const {
    const auto apply = [](const Row& row) {
        *row.impulse = static_cast<Real>(static_cast<double>(*row.impulse) + row.change);
    };
    for (const Row& row : joints_) {
        apply(row);
    }
    for (const ContactRow& contact : contacts_) {
        if (contact.hold != Hold::free) {
            apply(contact.row);
        }
    }
}

void DirectSolver::solve(SolverBatch& batch, Real h, bool useBias, DirectReport& report) {
    gatherJoints(batch, h, useBias, false);
    if (scope_ == DirectScope::all) {
        gatherContacts(batch, h, useBias);
    }
    for (int round = 0; round < kMaxRounds; ++round) {
        if (!holdsAsBefore()) {
            assemble(kStrength, report);
        }
        computeChange(kStrength);
        if (correct(useBias && round < kTakeInRounds)) {
            continue;
        }
        dropNoise();
        applyToBodies(batch);
        applyToImpulses();
        return;
    }
    ++report.givenUp;
}

void DirectSolver::moveBodies(SolverBatch& batch) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        BodyState& state = batch.states[nodes_[i].slot];
        state.deltaPosition += {static_cast<Real>(change_[i][0]), static_cast<Real>(change_[i][1])};
        state.deltaAngle += static_cast<Real>(change_[i][2]);
        state.deltaRotation = rotationFromAngle(static_cast<double>(state.deltaAngle));
    }
}

void DirectSolver::project(SolverBatch& batch, Real h, bool always, DirectReport& report) {
    if (scope_ != DirectScope::all || batch.contacts.empty()) {
        return;
    }
    if (!gatherOverlaps(batch, h) && !always) {
        return;
    }
    gatherJoints(batch, h, false, true);
    assemble(kProjectionStrength, report);
    computeChange(kProjectionStrength);
    isFactorised_ = false;
    dropNoise();
    moveBodies(batch);
}

}  // namespace swept::inline SWEPT_PRECISION
