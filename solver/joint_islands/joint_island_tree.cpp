#include <algorithm>
#include <cmath>

#include "../direct/direct_parts.h"
#include "joint_island.h"

/// Newton's method for trees: bodies and rows are eliminated together from the leaves to the ground (Baraff 1996,
/// "Linear-time dynamics using Lagrange multipliers"). No row has a strength that it could give way by, or that light
/// masses could be lost beside.

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::uint32_t kNone = IslandBranch::kNone;
/// A body's resistance to turning is never made less than this part of it by forces that push it together.
constexpr double kLeastInertia = 1.0 / 8;
/// Of a row by its parent, where its body cannot be moved.
constexpr double kLeastResponse = 1.0 / (1 << 10);
/// Radians by which a round may change the turn of a sub-step: farther away rows are not what they are here.
constexpr double kMostTurnOfRound = 1;

/// L·U of a block, in place, the diagonal of L being 1.
void factoriseBlock(Block33& m) {
    m[3] /= m[0];
    m[6] /= m[0];
    m[4] -= m[3] * m[1];
    m[5] -= m[3] * m[2];
    m[7] = (m[7] - m[6] * m[1]) / m[4];
    m[8] -= m[6] * m[2] + m[7] * m[5];
}

Block3 solveBlock(const Block33& m, Block3 v) {
    v[1] -= m[3] * v[0];
    v[2] -= m[6] * v[0] + m[7] * v[1];
    v[2] /= m[8];
    v[1] = (v[1] - m[5] * v[2]) / m[4];
    v[0] = (v[0] - m[1] * v[1] - m[2] * v[2]) / m[0];
    return v;
}

}  // namespace

/// The rows of a branch: how impulses act, and how gaps change, of its body and of its parent.
struct JointIsland::BranchRows {
    struct Each {
        Block3 pushes{};
        Block3 pushesParent{};
        Block3 moves{};
        Block3 movesParent{};
        double yields = 0;  ///< speed by impulse, besides
        double excess = 0;
    };
    Each each[3];
    std::size_t count = 0;
};

/// Branches from the ground outwards. Bodies that cannot be moved are one ground, however often they are there.
void JointIsland::growTree() {
    std::size_t joints = 0;
    for (const IslandHold& hold : holds_) { joints += hold.kind != IslandHold::Kind::angle ? 1 : 0; }
    isTree_ = joints + (isFree() ? 1 : 0) <= columns_;
    if (!isTree_) { return; }
    // Holds by body, as one list.
    neighbours_.clear();
    for (std::uint32_t i = 0; i < holds_.size(); ++i) {
        neighbours_.push_back({holds_[i].a, i});
        neighbours_.push_back({holds_[i].b, i});
    }
    std::sort(neighbours_.begin(), neighbours_.end());
    branches_.clear();
    inertias_.resize(bodies_.size());
    isReached_.assign(bodies_.size(), 0);
    const auto visit = [this](std::uint32_t body) {
        for (auto i = std::lower_bound(neighbours_.begin(), neighbours_.end(), std::pair{body, std::uint32_t{0}});
             i != neighbours_.end() && i->first == body; ++i) {
            const IslandHold& hold = holds_[i->second];
            const std::uint32_t other = hold.a == body ? hold.b : hold.a;
            if (bodies_[other].column == kNoNode) { continue; }
            if (isReached_[other] != 0) {
                // The second hold of a joint follows the first.
                if (!branches_.empty() && branches_.back().body == other && branches_.back().holds[1] == kNone &&
                    branches_.back().holds[0] != i->second) {
                    branches_.back().holds[1] = i->second;
                }
                continue;
            }
            isReached_[other] = 1;
            branches_.push_back({other, bodies_[body].column == kNoNode ? kNone : body, {i->second, kNone}, {}, {}});
        }
    };
    if (isFree()) {
        isReached_[0] = 1;
        branches_.push_back({0, kNone, {kNone, kNone}, {}, {}});
    }
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        if (bodies_[i].column == kNoNode) { visit(i); }
    }
    for (std::size_t i = 0; i < branches_.size(); ++i) { visit(branches_[i].body); }
}

void JointIsland::gatherBranch(const IslandBranch& branch, BranchRows& rows) const {
    rows.count = 0;
    const IslandBody& body = bodies_[branch.body];
    for (const std::uint32_t number : branch.holds) {
        if (number == kNone) { break; }
        const IslandHold& hold = holds_[number];
        const bool isB = hold.b == branch.body;
        const auto gather = [&](const IslandHold::Row& row, double yields) {
            BranchRows::Each& each = rows.each[rows.count++];
            each.pushes = movable(isB ? row.ofB : row.ofA, body);
            each.moves = movable(isB ? row.endB : row.endA, body);
            if (branch.parent != kNone) {
                each.pushesParent = movable(isB ? row.ofA : row.ofB, bodies_[branch.parent]);
                each.movesParent = movable(isB ? row.endA : row.endB, bodies_[branch.parent]);
            }
            each.yields = yields;
            each.excess = yields > 0 ? 0 : row.excess;
        };
        for (std::size_t i = 0; i < hold.count; ++i) { gather(hold.rows[i], 0); }
        if (hold.tightness > 0) { gather(hold.rows[1], 1 / hold.tightness); }
    }
}

/// Of a row that cannot move its body, such as the angle of one that is held to its rotation: a damper beside which the
/// parent is light. No number that does not go with the masses may stand here, but where there is nothing at all.
double JointIsland::leastResponse(const Block3& pushes, const Block3& moves, const IslandBranch& branch) const {
    if (branch.parent == kNone) { return 1; }
    const IslandBody& parent = bodies_[branch.parent];
    const double response = parent.inverseMass * std::fabs(pushes[0] * moves[0] + pushes[1] * moves[1]) +
                            parent.inverseInertia * std::fabs(pushes[2] * moves[2]);
    return response > 0 ? kLeastResponse * response : 1;
}

void JointIsland::factoriseTree() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const IslandBody& body = bodies_[i];
        const double mass = body.inverseMass > 0 ? 1 / body.inverseMass : 1;
        const double inertia = body.inverseInertia > 0 ? 1 / body.inverseInertia : 1;
        inertias_[i] = {
            mass, 0, 0, 0, mass, 0, 0, 0, std::max(inertia + body.middle.stiffness, kLeastInertia * inertia)};
    }
    BranchRows rows;
    for (std::size_t n = branches_.size(); n-- > 0;) {
        IslandBranch& branch = branches_[n];
        Block33& own = inertias_[branch.body];
        factoriseBlock(own);
        gatherBranch(branch, rows);
        branch.response = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        for (std::size_t k = 0; k < rows.count; ++k) {
            const Block3 given = solveBlock(own, rows.each[k].pushes);
            for (std::size_t i = 0; i < rows.count; ++i) {
                branch.response[3 * i + k] = dot3(rows.each[i].moves, given);
            }
            double& itself = branch.response[3 * k + k];
            itself += rows.each[k].yields;
            // It may be negative: where a sub-step ends rows may lie the other way than their forces push.
            if (itself == 0) { itself = leastResponse(rows.each[k].pushesParent, rows.each[k].movesParent, branch); }
        }
        factoriseBlock(branch.response);
        if (branch.parent == kNone) { continue; }
        Block33& next = inertias_[branch.parent];
        for (std::size_t c = 0; c < 3; ++c) {
            Block3 moves{};
            for (std::size_t k = 0; k < rows.count; ++k) { moves[k] = rows.each[k].movesParent[c]; }
            const Block3 impulses = solveBlock(branch.response, moves);
            for (std::size_t k = 0; k < rows.count; ++k) {
                for (std::size_t r = 0; r < 3; ++r) { next[3 * r + c] += rows.each[k].pushesParent[r] * impulses[k]; }
            }
        }
    }
    ++factorisations_;
}

/// One step of Newton's method, for speeds and impulses at once. @pre what momenta lack is in `change_`
void JointIsland::solveTree(double time) {
    BranchRows rows;
    for (std::size_t n = branches_.size(); n-- > 0;) {
        IslandBranch& branch = branches_[n];
        Block3& own = change_[bodies_[branch.body].column];
        gatherBranch(branch, rows);
        const Block3 change = solveBlock(inertias_[branch.body], own);
        branch.lack = {};
        for (std::size_t k = 0; k < rows.count; ++k) {
            branch.lack[k] = -rows.each[k].excess - dot3(rows.each[k].moves, change);
        }
        if (branch.parent == kNone) { continue; }
        const Block3 impulses = solveBlock(branch.response, branch.lack);
        Block3& next = change_[bodies_[branch.parent].column];
        for (std::size_t k = 0; k < rows.count; ++k) { addScaled(next, impulses[k], rows.each[k].pushesParent); }
    }
    double fastest = 0;
    for (IslandBranch& branch : branches_) {
        const IslandBody& body = bodies_[branch.body];
        Block3& change = change_[body.column];
        gatherBranch(branch, rows);
        if (branch.parent != kNone) {
            const Block3& ofParent = change_[bodies_[branch.parent].column];
            for (std::size_t k = 0; k < rows.count; ++k) { branch.lack[k] -= dot3(rows.each[k].movesParent, ofParent); }
        }
        branch.lack = solveBlock(branch.response, branch.lack);
        for (std::size_t k = 0; k < rows.count; ++k) { addScaled(change, branch.lack[k], rows.each[k].pushes); }
        change = solveBlock(inertias_[branch.body], change);
        if (body.inverseInertia > 0) { fastest = std::max(fastest, std::fabs(change[2])); }
    }
    applyChanges(fastest * std::fabs(time) > kMostTurnOfRound ? kMostTurnOfRound / (fastest * std::fabs(time)) : 1);
}

/// @param part  of a step of Newton's method that is taken
void JointIsland::applyChanges(double part) {
    for (const IslandBranch& branch : branches_) {
        IslandBody& body = bodies_[branch.body];
        const Block3& change = change_[body.column];
        if (body.inverseMass > 0) { body.velocity += part * DVec2{change[0], change[1]}; }
        if (body.inverseInertia > 0) { body.spin += part * change[2]; }
        std::size_t k = 0;
        for (const std::uint32_t number : branch.holds) {
            if (number == kNone) { break; }
            IslandHold& hold = holds_[number];
            for (std::size_t i = 0; i < hold.count; ++i, ++k) { hold.rows[i].impulse += part * branch.lack[k]; }
            k += hold.tightness > 0 ? 1 : 0;
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
