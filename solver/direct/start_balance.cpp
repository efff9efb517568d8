#include "start_balance.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "../solve_preparation.h"
#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of a damper, in units of its own mass, or of the heaviest one against its bodies. Towers of forty have theirs right
/// to a hundredth in a round, and digits of a double are left at masses of 10⁵ : 1.
constexpr double kStartStrength = 131072;
/// Rounds, and the change of impulses, as a part of the largest, after which none follows.
constexpr int kMostStartRounds = 32;
constexpr double kSmallStartChange = 1.0 / 65536;
/// Speeds that are left, as a part of what drives give: what is faster is in no balance.
constexpr double kLeftOfStart = 1.0 / 64;
/// What impulses let fall by no more than this part of what drives give is carried already.
constexpr double kLeftOfCarried = 1.0 / 8;
/// A contact that turns more often than that presses no longer.
constexpr int kMostStartTurns = 4;
/// Blocks of the factor per body: what is so tangled begins with what it has.
constexpr std::size_t kMostStartBlocks = 32;

}  // namespace

bool StartBalance::listBodies(const SolverBatch& batch) {
    nodes_.assign(batch.inertias.size(), kNoNode);
    inertias_.clear();
    heaviest_ = 0;
    for (std::size_t slot = 0; slot < batch.inertias.size(); ++slot) {
        const BodyInertia& body = batch.inertias[slot];
        if (!isMovable(body)) { continue; }
        nodes_[slot] = static_cast<std::uint32_t>(inertias_.size());
        inertias_.push_back(body);
        if (body.inverseMass > 0) { heaviest_ = std::max(heaviest_, 1 / static_cast<double>(body.inverseMass)); }
    }
    return !inertias_.empty();
}

void StartBalance::addRow(const SolverBatch& batch, const DirectRow& held) {
    Row row{.nodeA = nodes_[held.slotA], .nodeB = nodes_[held.slotB], .to = held.impulse};
    row.impulse = static_cast<double>(*held.impulse);
    const auto x = static_cast<double>(held.row.linear.x);
    const auto y = static_cast<double>(held.row.linear.y);
    double inverse = 0;
    double inverseMass = 0;
    const auto take = [&](BodySlot slot, double sign, double spin, Block3& of) {
        const BodyInertia& body = batch.inertias[slot];
        if (nodes_[slot] == kNoNode) { return; }
        const auto linear = static_cast<double>(body.inverseMass);
        const auto angular = static_cast<double>(body.inverseInertia);
        of = {linear > 0 ? sign * x : 0, linear > 0 ? sign * y : 0, angular > 0 ? sign * spin : 0};
        inverse += linear * (of[0] * of[0] + of[1] * of[1]) + angular * of[2] * of[2];
        inverseMass += linear;
    };
    take(held.slotA, -1, static_cast<double>(held.row.spinA), row.ofA);
    take(held.slotB, 1, static_cast<double>(held.row.spinB), row.ofB);
    const bool isAngle = x == 0 && y == 0;
    if (isAngle && inverseMass > 0) { row.perLever = std::sqrt(inverse / inverseMass); }
    if (inverse > 0) { row.strength = kStartStrength * std::max(heaviest_ * inverseMass, 1.0) / inverse; }
    rows_.push_back(row);
}

void StartBalance::listRows(SolverBatch& batch) {
    rows_.clear();
    jointRows_.clear();
    points_.clear();
    edges_.clear();
    addJointRows(batch, {}, 1, 1, false, jointRows_);
    for (const DirectRow& row : jointRows_) { addRow(batch, row); }
    for (ContactConstraint& contact : batch.contacts) {
        if (nodes_[contact.slotA] == kNoNode && nodes_[contact.slotB] == kNoNode) { continue; }
        for (int i = 0; i < contact.count; ++i) {
            ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
            if (point.baseSeparation > 0) { continue; }
            points_.push_back({.row = rows_.size(),
                               .friction = contact.surfaceSpeed == 0 ? static_cast<double>(contact.friction) : 0});
            DirectRow normal = normalRowOf(contact, point, 0);
            DirectRow tangent = tangentRowOf(contact, point);
            normal.impulse = &point.normalImpulse;
            tangent.impulse = &point.tangentImpulse;
            addRow(batch, normal);
            addRow(batch, tangent);
            if (!(contact.friction > 0) || contact.surfaceSpeed != 0) { rows_.back().hold = Hold::free; }
        }
    }
    for (const Row& row : rows_) {
        const bool areBoth = row.nodeA != kNoNode && row.nodeB != kNoNode && row.nodeA != row.nodeB;
        const bool isKnown = !edges_.empty() && edges_.back().a == row.nodeA && edges_.back().b == row.nodeB;
        if (areBoth && !isKnown) { edges_.push_back({row.nodeA, row.nodeB}); }
    }
}

/// What springs, limits and motors give is told by what they do to bodies at rest whose other impulses are zero. What
/// resists rolling stays as it is.
void StartBalance::findDrives(SolverBatch& batch) {
    for (const Row& row : rows_) { *row.to = 0; }
    for (std::size_t i = 0; i < batch.states.size(); ++i) {
        batch.states[i].velocity = isMovable(batch.inertias[i]) ? batch.drives[i].gain : Vec2{};
        batch.states[i].angularVelocity = isMovable(batch.inertias[i]) ? batch.drives[i].angularGain : Real(0);
    }
    prepareJoints(batch);
    const SolverBodies bodies{batch.states, batch.inertias};
    batch.forEachJointKind([&bodies](auto& joints) { swept::warmStart(std::span(joints), bodies); });
    drives_.resize(inertias_.size());
    for (std::size_t i = 0; i < batch.states.size(); ++i) {
        BodyState& state = batch.states[i];
        if (nodes_[i] != kNoNode) {
            const BodyInertia& body = batch.inertias[i];
            const double mass = body.inverseMass > 0 ? 1 / static_cast<double>(body.inverseMass) : 0;
            const double inertia = body.inverseInertia > 0 ? 1 / static_cast<double>(body.inverseInertia) : 0;
            drives_[nodes_[i]] = {mass * static_cast<double>(state.velocity.x),
                                  mass * static_cast<double>(state.velocity.y),
                                  inertia * static_cast<double>(state.angularVelocity)};
        }
        state.velocity = {};
        state.angularVelocity = 0;
    }
    for (const ContactConstraint& contact : batch.contacts) {
        if (!(contact.rolling > 0)) { continue; }
        const auto turn = static_cast<double>(contact.rollingImpulse);
        if (nodes_[contact.slotA] != kNoNode) { drives_[nodes_[contact.slotA]][2] -= turn; }
        if (nodes_[contact.slotB] != kNoNode) { drives_[nodes_[contact.slotB]][2] += turn; }
    }
}

void StartBalance::push(const Row& row, double impulse) {
    if (row.nodeA != kNoNode) { addScaled(speeds_[row.nodeA], impulse, row.ofA); }
    if (row.nodeB != kNoNode) { addScaled(speeds_[row.nodeB], impulse, row.ofB); }
}

double StartBalance::speedOf(const Row& row) const {
    double speed = 0;
    if (row.nodeA != kNoNode) { speed += dot3(row.ofA, speeds_[row.nodeA]); }
    if (row.nodeB != kNoNode) { speed += dot3(row.ofB, speeds_[row.nodeB]); }
    return speed;
}

void StartBalance::assemble() {
    matrix_.clear();
    for (std::uint32_t i = 0; i < inertias_.size(); ++i) {
        const BodyInertia& body = inertias_[i];
        Block33& block = matrix_.diagonal(i);
        block[0] = block[4] = body.inverseMass > 0 ? 1 / static_cast<double>(body.inverseMass) : 1;
        block[8] = body.inverseInertia > 0 ? 1 / static_cast<double>(body.inverseInertia) : 1;
    }
    for (const Row& row : rows_) {
        if (row.hold != Hold::held || !(row.strength > 0)) { continue; }
        if (row.nodeA != kNoNode) { addOuter(matrix_.diagonal(row.nodeA), row.strength, row.ofA, row.ofA); }
        if (row.nodeB != kNoNode) { addOuter(matrix_.diagonal(row.nodeB), row.strength, row.ofB, row.ofB); }
        if (row.nodeA == kNoNode || row.nodeB == kNoNode || row.nodeA == row.nodeB) { continue; }
        const BlockLdlt::OffDiagonal off = matrix_.offDiagonal(row.nodeA, row.nodeB);
        addOuter(off.block, row.strength, off.rowIsB ? row.ofB : row.ofA, off.rowIsB ? row.ofA : row.ofB);
    }
    matrix_.factorise();
}

/// @return the largest change, as a part of the largest impulse
double StartBalance::changeImpulses() {
    speeds_ = drives_;
    for (const Row& row : rows_) { push(row, row.impulse); }
    matrix_.solve(speeds_);
    double change = 0;
    double largest = 0;
    for (Row& row : rows_) {
        if (row.hold != Hold::held) { continue; }
        const double more = -row.strength * speedOf(row);
        row.impulse += more;
        change = std::max(change, row.perLever * std::fabs(more));
        largest = std::max(largest, row.perLever * std::fabs(row.impulse));
    }
    return largest > 0 ? change / largest : 0;
}

/// What pulls is let go, what closes presses, what slips has the friction that there is.
/// @return whether any row is held otherwise
bool StartBalance::holdPoints() {
    bool changed = false;
    for (Point& point : points_) {
        Row& normal = rows_[point.row];
        Row& tangent = rows_[point.row + 1];
        const Hold normalBefore = normal.hold;
        const Hold tangentBefore = tangent.hold;
        const bool isFree = normal.hold == Hold::free;
        const bool closes = isFree && speedOf(normal) < 0 && point.turns < kMostStartTurns;
        normal.hold = (isFree ? closes : normal.impulse > 0) ? Hold::held : Hold::free;
        if (normal.hold == Hold::free) { normal.impulse = 0; }
        const double limit = point.friction * normal.impulse;
        const bool sticks = point.friction > 0 && normal.hold == Hold::held && std::fabs(tangent.impulse) < limit;
        if (closes) {
            tangent.hold = point.friction > 0 ? Hold::held : Hold::free;
        } else if (!sticks) {
            tangent.hold = limit > 0 ? Hold::given : Hold::free;
            tangent.impulse = std::clamp(tangent.impulse, -limit, limit);
        }
        point.turns += normal.hold != normalBefore ? 1 : 0;
        changed = changed || normal.hold != normalBefore || tangent.hold != tangentBefore;
    }
    return changed;
}

/// Squared, what moves a body by so much. Turns count by the radius of gyration.
double StartBalance::squaredSpeed(std::uint32_t node, const Block3& speed) const {
    const auto linear = static_cast<double>(inertias_[node].inverseMass);
    const auto angular = static_cast<double>(inertias_[node].inverseInertia);
    const double turning = angular > 0 ? speed[2] * speed[2] * linear / angular : 0;
    return speed[0] * speed[0] + speed[1] * speed[1] + turning;
}

double StartBalance::squaredSpeedOfDrives() const {
    double most = 0;
    for (std::size_t i = 0; i < inertias_.size(); ++i) {
        const auto linear = static_cast<double>(inertias_[i].inverseMass);
        const Block3& drive = drives_[i];
        most = std::max(most, linear * linear * (drive[0] * drive[0] + drive[1] * drive[1]));
    }
    return most;
}

/// Whether nothing is left to move.
bool StartBalance::isStill() const {
    double fastest = 0;
    for (std::uint32_t i = 0; i < inertias_.size(); ++i) { fastest = std::max(fastest, squaredSpeed(i, speeds_[i])); }
    return fastest <= kLeftOfStart * kLeftOfStart * squaredSpeedOfDrives();
}

/// Whether impulses leave a body as it is, but for a part of what drives it, or of what drives the others.
bool StartBalance::isBalanced(std::uint32_t node, double mostOfAll) const {
    const auto linear = static_cast<double>(inertias_[node].inverseMass);
    const auto angular = static_cast<double>(inertias_[node].inverseInertia);
    const Block3& drive = drives_[node];
    const Block3& left = speeds_[node];
    const double own = linear * linear * (drive[0] * drive[0] + drive[1] * drive[1]);
    const double most = std::max(own, kLeftOfStart * kLeftOfStart * mostOfAll);
    return squaredSpeed(node, {linear * left[0], linear * left[1], angular * left[2]}) <=
           kLeftOfCarried * kLeftOfCarried * most;
}

/// With a body on joints that is sought: what these tie to it, and what rests on it (its load). With any: what it rests
/// on if joints hold that (they carry it).
void StartBalance::spread(std::vector<Search>& searches) const {
    std::vector<std::uint8_t> isJointed(inertias_.size(), 0);
    for (std::size_t i = 0; i < jointRows_.size(); ++i) {
        for (const std::uint32_t node : {rows_[i].nodeA, rows_[i].nodeB}) {
            if (node == kNoNode) { continue; }
            isJointed[node] = 1;
            if (searches[node] == Search::alone) { searches[node] = Search::withLoad; }
        }
    }
    bool any = true;
    const auto seek = [&](std::uint32_t node) {
        any = any || searches[node] != Search::withLoad;
        searches[node] = Search::withLoad;
    };
    const auto support = [&](std::uint32_t below, std::uint32_t above, const Block3& way, bool presses) {
        if (!(dot3(way, drives_[above]) < 0)) { return; }
        if (searches[below] == Search::withLoad && presses) { seek(above); }
        if (searches[above] != Search::none && isJointed[below] != 0) { seek(below); }
    };
    while (any) {
        any = false;
        for (std::size_t i = 0; i < jointRows_.size(); ++i) {
            const Row& row = rows_[i];
            if (row.nodeA == kNoNode || row.nodeB == kNoNode) { continue; }
            if (searches[row.nodeA] != Search::none) { seek(row.nodeB); }
            if (searches[row.nodeB] != Search::none) { seek(row.nodeA); }
        }
        for (const Point& point : points_) {
            const Row& row = rows_[point.row];
            if (row.nodeA == kNoNode || row.nodeB == kNoNode) { continue; }
            support(row.nodeA, row.nodeB, row.ofB, row.impulse > 0);
            support(row.nodeB, row.nodeA, row.ofA, row.impulse > 0);
        }
    }
}

/// What is in balance by the impulses that there are, and has nothing to do with what is not, stands fast: a joint that
/// is made between bodies of a heap at rest asks for no balance of the heap. @return whether there is any such
bool StartBalance::leaveCarried() {
    speeds_ = drives_;
    for (const Row& row : rows_) {
        push(row, row.impulse);
        *row.to = static_cast<Real>(row.impulse);
    }
    const double mostOfAll = squaredSpeedOfDrives();
    std::vector<Search> searches(inertias_.size(), Search::none);
    for (std::uint32_t i = 0; i < inertias_.size(); ++i) {
        if (!isBalanced(i, mostOfAll)) { searches[i] = Search::alone; }
    }
    spread(searches);
    std::uint32_t count = 0;
    std::vector<std::uint32_t> renamed(inertias_.size(), kNoNode);
    for (std::uint32_t i = 0; i < inertias_.size(); ++i) {
        if (searches[i] != Search::none) { renamed[i] = count++; }
    }
    if (count == inertias_.size()) { return false; }
    heaviest_ = 0;
    for (std::uint32_t i = 0; i < inertias_.size(); ++i) {
        if (renamed[i] == kNoNode) { continue; }
        inertias_[renamed[i]] = inertias_[i];
        if (inertias_[i].inverseMass > 0) {
            heaviest_ = std::max(heaviest_, 1 / static_cast<double>(inertias_[i].inverseMass));
        }
    }
    inertias_.resize(count);
    for (std::uint32_t& node : nodes_) {
        if (node != kNoNode) { node = renamed[node]; }
    }
    return true;
}

bool StartBalance::find(SolverBatch& batch) {
    if (!listBodies(batch)) { return false; }
    listRows(batch);
    findDrives(batch);
    if (leaveCarried()) {
        listRows(batch);
        findDrives(batch);
    }
    const auto count = static_cast<std::uint32_t>(inertias_.size());
    if (rows_.empty() || !matrix_.analyse(count, edges_, kMostStartBlocks * count)) { return false; }
    bool isOld = true;
    bool isFound = false;
    for (int round = 0; round < kMostStartRounds && !isFound; ++round) {
        if (isOld) { assemble(); }
        const double change = changeImpulses();
        isOld = holdPoints();
        isFound = !isOld && change <= kSmallStartChange;
    }
    for (const Row& row : rows_) { *row.to = static_cast<Real>(row.impulse); }
    return isFound && isStill();
}

}  // namespace swept::inline SWEPT_PRECISION
