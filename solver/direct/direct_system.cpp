#include "direct_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
/// Changes this much smaller than the largest in the island are noise.
constexpr double kNoiseRatio = 1.0 / static_cast<double>(std::uint64_t{1} << 36);

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

void DirectSystem::listNodes(std::span<const BodyInertia> inertias, std::span<const BodyTie> ties) {
    nodes_.clear();
    nodeOf_.assign(inertias.size(), kNoNode);
    for (std::uint32_t slot = 0; slot < inertias.size(); ++slot) {
        const BodyInertia& body = inertias[slot];
        if (ties[slot] != BodyTie::tied || !isMovable(body)) { continue; }
        nodeOf_[slot] = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({slot, body.inverseMass > 0 ? 1 / static_cast<double>(body.inverseMass) : 0,
                          body.inverseInertia > 0 ? 1 / static_cast<double>(body.inverseInertia) : 0});
    }
    change_.resize(nodes_.size());
    edges_.clear();
    islands_.reset(nodes_.size());
    forgetFactor();
}

bool DirectSystem::analyse(std::span<const ContactConstraint> contacts, bool holdsContacts, bool hasParts) {
    parts_.assign(1, whole());
    if (hasParts) { numberByIslands(); }
    weighIslands(contacts, holdsContacts);
    return matrix_.analyse(parts_, edges_, kMostBlocksPerBody * nodes_.size());
}

/// Within an island the order stays.
void DirectSystem::numberByIslands() {
    const auto count = static_cast<std::uint32_t>(nodes_.size());
    nextNumbers_.assign(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) { ++nextNumbers_[islands_.find(i)]; }
    parts_.clear();
    std::uint32_t begin = 0;
    for (std::uint32_t& next : nextNumbers_) {  // that of the first node of an island says how many it has
        if (next == 0) { continue; }
        parts_.push_back({begin, begin + next});
        begin += std::exchange(next, begin);
    }
    if (parts_.size() == 1) { return; }
    numbers_.clear();
    for (std::uint32_t i = 0; i < count; ++i) { numbers_.push_back(nextNumbers_[islands_.find(i)]++); }
    oldNodes_.assign(nodes_.begin(), nodes_.end());
    for (std::uint32_t i = 0; i < count; ++i) {
        nodes_[numbers_[i]] = oldNodes_[i];
        nodeOf_[oldNodes_[i].slot] = numbers_[i];
    }
    for (BlockEdge& edge : edges_) { edge = {numbers_[edge.a], numbers_[edge.b]}; }
    islands_.reset(count);
    for (const NodeRange& part : parts_) {
        for (std::uint32_t i = part.begin + 1; i < part.end; ++i) { islands_.unite(part.begin, i); }
    }
}

void DirectSystem::weighIslands(std::span<const ContactConstraint> contacts, bool holdsContacts) {
    loads_.assign(nodes_.size(), {});
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        Load& load = loads_[islands_.find(i)];
        const double mass = nodes_[i].mass;
        load.heaviest = std::max(load.heaviest, mass);
        load.lightest = load.bodies++ == 0 ? mass : std::min(load.lightest, mass);
        load.mass += mass;
    }
    for (const ContactConstraint& contact : contacts) {
        const std::uint32_t a = nodeOf_[contact.slotA];
        const std::uint32_t node = a != kNoNode ? a : nodeOf_[contact.slotB];
        if (node != kNoNode) { ++loads_[islands_.find(node)].contacts; }
    }
    for (Load& load : loads_) {
        if (!holdsContacts) {
            load.strength = kJointStrength;
        } else if (load.contacts > load.bodies) {
            load.strength = kLoopStrength;
        } else {
            const double spread = load.lightest > 0 ? load.heaviest / load.lightest : kTowerStrength;
            load.strength = std::max(kTowerStrength / std::max(spread, 1.0), kJointStrength);
        }
    }
}

SystemRow DirectSystem::rowOf(std::span<const BodyInertia> inertias, const DirectRow& held) {
    const RowEnds ends = endsOf(held.row);
    SystemRow row{.nodeA = nodeOf_[held.slotA], .nodeB = nodeOf_[held.slotB]};
    double inverse = 0;
    double inverseMass = 0;
    std::uint32_t island = 0;
    const auto add = [&](std::uint32_t node, BodySlot slot, const Block3& all, Block3& moved) {
        if (node == kNoNode) { return; }
        const BodyInertia& body = inertias[slot];
        const bool moves = body.inverseMass > 0;
        moved = {moves ? all[0] : 0, moves ? all[1] : 0, body.inverseInertia > 0 ? all[2] : 0};
        inverse += answerOf(body, moved);
        inverseMass += static_cast<double>(body.inverseMass);
        island = islands_.find(node);
    };
    add(row.nodeA, held.slotA, ends.a, row.ofA);
    add(row.nodeB, held.slotB, ends.b, row.ofB);
    if (inverse > 0) {
        const Load& load = loads_[island];
        row.strength = load.strength * (std::max(load.heaviest * inverseMass, 1.0) / inverse);
    }
    return row;
}

double DirectSystem::excessOf(std::span<const BodyState> states, const DirectRow& held) {
    const RowEnds ends = endsOf(held.row);
    double excess = static_cast<double>(held.bias);
    excess += dot3(ends.a, velocityOf(states[held.slotA]));
    excess += dot3(ends.b, velocityOf(states[held.slotB]));
    return excess;
}

void DirectSystem::beginMatrix(NodeRange part) {
    matrix_.clear(part);
    for (std::uint32_t i = part.begin; i < part.end; ++i) {
        const Node& node = nodes_[i];
        Block33& block = matrix_.diagonal(i);
        block[0] = block[4] = node.mass > 0 ? node.mass : 1;
        block[8] = node.inertia > 0 ? node.inertia : 1;
    }
}

void DirectSystem::add(const SystemRow& row, double share) {
    if (!(row.strength > 0)) { return; }
    const double k = share * strength_ * row.strength;
    if (row.nodeA != kNoNode) { addOuter(matrix_.diagonal(row.nodeA), k, row.ofA, row.ofA); }
    if (row.nodeB != kNoNode) { addOuter(matrix_.diagonal(row.nodeB), k, row.ofB, row.ofB); }
    if (row.nodeA != kNoNode && row.nodeB != kNoNode && row.nodeA != row.nodeB) {
        const BlockLdlt::OffDiagonal off = matrix_.offDiagonal(row.nodeA, row.nodeB);
        addOuter(off.block, k, off.rowIsB ? row.ofB : row.ofA, off.rowIsB ? row.ofA : row.ofB);
    }
}

void DirectSystem::factorise(NodeRange part) {
    matrix_.factorise(part);
    factorised_[part.begin] = strength_;
    ++factorNumber_;
    changes_.clear();
}

void DirectSystem::change(const SystemRow& row, bool isAdded, NodeRange part) {
    const double k = strength_ * row.strength;
    if (!(k > 0)) { return; }
    RowChanges::End ends[2];
    std::size_t count = 0;
    if (row.nodeA != kNoNode) { ends[count++] = {row.nodeA, row.ofA}; }
    if (row.nodeB != kNoNode) { ends[count++] = {row.nodeB, row.ofB}; }
    changes_.add(matrix_, part, {ends, count}, isAdded ? k : -k);
}

void DirectSystem::beginChange(NodeRange part) {
    std::fill(change_.data() + part.begin, change_.data() + part.end, Block3{});
}

void DirectSystem::push(const SystemRow& row, double impulse) {
    if (row.nodeA != kNoNode) { addScaled(change_[row.nodeA], impulse, row.ofA); }
    if (row.nodeB != kNoNode) { addScaled(change_[row.nodeB], impulse, row.ofB); }
}

double DirectSystem::excessAfter(const SystemRow& row, std::span<const Block3> change) {
    double excess = row.excess;
    if (row.nodeA != kNoNode) { excess += dot3(row.ofA, change[row.nodeA]); }
    if (row.nodeB != kNoNode) { excess += dot3(row.ofB, change[row.nodeB]); }
    return excess;
}

void DirectSystem::dropNoise() {
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

void DirectSystem::changeVelocities(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        BodyState& state = states[nodes_[i].slot];
        const Block3 v = velocityOf(state);
        state.velocity = {static_cast<Real>(v[0] + change_[i][0]), static_cast<Real>(v[1] + change_[i][1])};
        state.angularVelocity = static_cast<Real>(v[2] + change_[i][2]);
    }
}

void DirectSystem::changePlaces(std::span<BodyState> states) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (change_[i] == Block3{}) { continue; }
        BodyState& state = states[nodes_[i].slot];
        state.deltaPosition += {static_cast<Real>(change_[i][0]), static_cast<Real>(change_[i][1])};
        state.deltaAngle += static_cast<Real>(change_[i][2]);
        state.deltaRotation = rotationFromAngle(static_cast<double>(state.deltaAngle));
    }
}

}  // namespace swept::inline SWEPT_PRECISION
