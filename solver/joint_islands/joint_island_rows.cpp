#include <algorithm>
#include <cmath>

#include "../../shapes/trig.h"
#include "../direct/direct_parts.h"
#include "joint_island.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Strength of a row, in units of its own mass times the root of the ratio of the heaviest mass of the island to those
/// it moves. What a solve leaves is this part of the change of the impulse, more where masses are far apart, and goes
/// in again; with the ratio itself, rounding took more than that gave (masses of 10⁵ : 1 in eight links).
constexpr double kStrength = 1 << 20;
/// Of the ratio: beyond it the masses themselves would be lost in the matrix, to rounding.
constexpr double kMostSpread = 1 << 20;
/// Radians that the closing of a gap may turn a body by, or a part of a rod's length.
constexpr double kMostGapTurn = 1.0 / 16;

DVec2 turned(const IslandBody::Place& place, DVec2 v) {
    return {place.c * v.x - place.s * v.y, place.s * v.x + place.c * v.y};
}

double speedOf(const IslandHold::Row& row, const IslandBody& a, const IslandBody& b) {
    return (row.ofA[0] * a.velocity.x + row.ofA[1] * a.velocity.y + row.ofA[2] * a.spin) +
           (row.ofB[0] * b.velocity.x + row.ofB[1] * b.velocity.y + row.ofB[2] * b.spin);
}

void setRow(IslandHold::Row& row, DVec2 direction, DVec2 armA, DVec2 armB) {
    row.ofA = {-direction.x, -direction.y, -cross(armA, direction)};
    row.ofB = {direction.x, direction.y, cross(armB, direction)};
}

/// What is wrong with a hold where the bodies are, or will be.
struct Gaps {
    double row[2] = {0, 0};
};

Gaps gapsOf(const IslandHold& hold, const IslandBody::Place& a, const IslandBody::Place& b) {
    const DVec2 offset = hold.offset + (b.position - a.position) + turned(b, hold.anchorB) - turned(a, hold.anchorA);
    switch (hold.kind) {
        case IslandHold::Kind::point:
            return {{offset.x, offset.y}};
        case IslandHold::Kind::rod:
            return {{length(offset) - hold.rest, 0}};
        case IslandHold::Kind::side:
            return {{dot(leftOf(turned(a, hold.axis)), offset), 0}};
        case IslandHold::Kind::angle:
            return {{hold.rest + (b.angle - a.angle), 0}};
    }
    return {};
}

}  // namespace

double easeOf(const IslandBody& body, DVec2 anchor) {
    const double arm = norm(anchor);
    if (!(arm > 0) || !(body.inverseMass > 0) || !(body.inverseInertia > 0)) { return 0; }
    // arm/(m·arm² + I), times the mass
    return arm * body.inverseInertia / (arm * arm * body.inverseInertia + body.inverseMass);
}

/// Whether gaps are wider than any that steps leave: bodies were put apart. Closed at once they would give speeds that
/// do not end with them, as the bodies have turned by then.
bool JointIsland::isOpen() const {
    return std::any_of(holds_.begin(), holds_.end(), [this](const IslandHold& hold) {
        const IslandBody& a = bodies_[hold.a];
        const IslandBody& b = bodies_[hold.b];
        const Gaps gaps = gapsOf(hold, a.place, b.place);
        const double gap = std::fabs(gaps.row[0]) + std::fabs(gaps.row[1]);
        if (hold.kind == IslandHold::Kind::angle) { return gap > kMostGapTurn; }
        if (hold.kind == IslandHold::Kind::rod && gap > kMostGapTurn * hold.rest) { return true; }
        return gap * std::max(easeOf(a, hold.anchorA), easeOf(b, hold.anchorB)) > kMostGapTurn;
    });
}

void JointIsland::moveRods() {
    for (IslandHold& hold : holds_) {
        if (hold.kind == IslandHold::Kind::rod) { hold.rest = hold.begun + hold.rows[0].pace * elapsed_; }
    }
}

void JointIsland::weigh() {
    double heaviest = 0;
    for (const IslandBody& body : bodies_) {
        if (body.inverseMass > 0) { heaviest = std::max(heaviest, 1 / body.inverseMass); }
    }
    for (IslandHold& hold : holds_) {
        const IslandBody& a = bodies_[hold.a];
        const IslandBody& b = bodies_[hold.b];
        const bool isAngle = hold.kind == IslandHold::Kind::angle;
        // The force of a side acts on A where B's anchor is.
        const DVec2 armA = hold.kind == IslandHold::Kind::side ? hold.offset + hold.anchorB : hold.anchorA;
        const double linear = a.inverseMass + b.inverseMass;
        const double angular = a.inverseInertia * (isAngle ? 1 : dot(armA, armA)) +
                               b.inverseInertia * (isAngle ? 1 : dot(hold.anchorB, hold.anchorB));
        const double inverse = (isAngle ? 0 : linear) + angular;
        const double spread = std::clamp(heaviest * linear, 1.0, kMostSpread);
        for (IslandHold::Row& row : hold.rows) {
            row.strength = inverse > 0 ? kStrength * (std::sqrt(spread) / inverse) : 0;
        }
        hold.size = isAngle ? 1 : norm(hold.anchorA) + norm(hold.anchorB) + norm(hold.offset);
    }
}

void JointIsland::push(const IslandHold& hold, const IslandHold::Row& row, double impulse) {
    IslandBody& a = bodies_[hold.a];
    IslandBody& b = bodies_[hold.b];
    a.velocity += (a.inverseMass * impulse) * DVec2{row.ofA[0], row.ofA[1]};
    a.spin += a.inverseInertia * impulse * row.ofA[2];
    b.velocity += (b.inverseMass * impulse) * DVec2{row.ofB[0], row.ofB[1]};
    b.spin += b.inverseInertia * impulse * row.ofB[2];
    if (hold.kind != IslandHold::Kind::angle) {  // whose impulse is none of forces
        a.given += a.inverseMass * std::fabs(impulse);
        b.given += b.inverseMass * std::fabs(impulse);
    }
    a.turned += a.inverseInertia * std::fabs(impulse * row.ofA[2]);
    b.turned += b.inverseInertia * std::fabs(impulse * row.ofB[2]);
}

void JointIsland::findPlaces(double time) {
    for (IslandBody& body : bodies_) {
        body.next.position = body.place.position + time * body.velocity;
        body.next.angle = body.place.angle + time * body.spin;
        const SinCos turn = sinCos(body.next.angle);
        body.next.c = turn.cos;
        body.next.s = turn.sin;
    }
}

void JointIsland::findOpenGaps() {
    for (IslandHold& hold : holds_) {
        const Gaps gaps = gapsOf(hold, bodies_[hold.a].place, bodies_[hold.b].place);
        for (std::size_t i = 0; i < hold.count; ++i) { hold.rows[i].open = gaps.row[i]; }
    }
}

/// What a step begins with, rounding between steps at least, is closed over all of it: in the first of hundreds of
/// sub-steps that would pull harder than a heavy load.
/// @return the largest one, as a part of what it is measured against
double JointIsland::findGaps(double time) {
    double worst = 0;
    const double left = openPart();
    for (IslandHold& hold : holds_) {
        const IslandBody::Place& a = bodies_[hold.a].next;
        const IslandBody::Place& b = bodies_[hold.b].next;
        const Gaps gaps = gapsOf(hold, a, b);
        const bool isAngle = hold.kind == IslandHold::Kind::angle;
        const double scale = isAngle ? std::fabs(a.angle) + std::fabs(b.angle) : norm(a.position) + norm(b.position);
        for (std::size_t i = 0; i < hold.count; ++i) {
            const double gap = gaps.row[i] - left * hold.rows[i].open;
            hold.rows[i].excess = gap / time;
            if (gap != 0) { worst = worse(worst, std::fabs(gap) / (hold.size + scale)); }
        }
    }
    return worst;
}

/// Likewise of the speeds that joints do not allow.
double JointIsland::findSpeeds() {
    double worst = 0;
    for (IslandHold& hold : holds_) {
        const IslandBody& a = bodies_[hold.a];
        const IslandBody& b = bodies_[hold.b];
        const bool isAngle = hold.kind == IslandHold::Kind::angle;
        const double linear = isAngle ? 0 : norm(a.velocity) + a.given + norm(b.velocity) + b.given;
        const double turn = (std::fabs(a.spin) + a.turned) + (std::fabs(b.spin) + b.turned);
        const double scale = linear + turn * hold.size;
        for (std::size_t i = 0; i < hold.count; ++i) {
            IslandHold::Row& row = hold.rows[i];
            row.excess = speedOf(row, a, b) - row.pace;
            if (row.excess != 0) { worst = worse(worst, std::fabs(row.excess) / scale); }
        }
    }
    return worst;
}

/// One solve for speeds that take the excess away. @param keep  whether impulses add up: what gives way for good would
/// let them grow without end
void JointIsland::correct(bool keep) {
    std::fill(change_.begin(), change_.end(), Block3{});
    const auto pull = [this](const IslandBody& body, const Block3& row, double impulse) {
        if (body.column == kNoNode) { return; }
        const Block3 moved = movable(row, body);
        for (std::size_t i = 0; i < 3; ++i) { change_[body.column][i] += impulse * moved[i]; }
    };
    for (const IslandHold& hold : holds_) {
        for (std::size_t i = 0; i < hold.count; ++i) {
            const IslandHold::Row& row = hold.rows[i];
            const double impulse = -row.strength * row.excess;
            pull(bodies_[hold.a], row.ofA, impulse);
            pull(bodies_[hold.b], row.ofB, impulse);
        }
    }
    matrix_.solve(change_);
    const auto changeOf = [this](const IslandBody& body, const Block3& row) {
        if (body.column == kNoNode) { return 0.0; }
        const Block3& change = change_[body.column];
        return row[0] * change[0] + row[1] * change[1] + row[2] * change[2];
    };
    for (IslandHold& hold : holds_) {
        for (std::size_t i = 0; i < hold.count; ++i) {
            IslandHold::Row& row = hold.rows[i];
            const double excess =
                row.excess + (changeOf(bodies_[hold.a], row.ofA) + changeOf(bodies_[hold.b], row.ofB));
            const double impulse = -row.strength * excess;
            row.impulse = keep ? row.impulse + impulse : impulse;
            push(hold, row, impulse);
        }
    }
}

/// Adds the speeds that would close gaps, each at its own rate.
void JointIsland::addGapSpeeds() {
    for (IslandHold& hold : holds_) {
        const Gaps gaps = gapsOf(hold, bodies_[hold.a].place, bodies_[hold.b].place);
        for (std::size_t i = 0; i < hold.count; ++i) { hold.rows[i].excess += hold.rate * gaps.row[i]; }
    }
}

void JointIsland::placeRows() {
    for (IslandHold& hold : holds_) {
        const IslandBody::Place& a = bodies_[hold.a].place;
        const IslandBody::Place& b = bodies_[hold.b].place;
        const DVec2 armA = turned(a, hold.anchorA);
        const DVec2 armB = turned(b, hold.anchorB);
        const DVec2 offset = hold.offset + (b.position - a.position) + armB - armA;
        switch (hold.kind) {
            case IslandHold::Kind::point:
                setRow(hold.rows[0], {1, 0}, armA, armB);
                setRow(hold.rows[1], {0, 1}, armA, armB);
                break;
            case IslandHold::Kind::rod: {
                const double apart = length(offset);
                if (apart > 0) { hold.axis = (1 / apart) * offset; }
                setRow(hold.rows[0], hold.axis, armA, armB);
                break;
            }
            case IslandHold::Kind::side:
                setRow(hold.rows[0], leftOf(turned(a, hold.axis)), armA + offset, armB);
                break;
            case IslandHold::Kind::angle:
                hold.rows[0].ofA = {0, 0, -1};
                hold.rows[0].ofB = {0, 0, 1};
                break;
        }
    }
}

void JointIsland::factorise() {
    matrix_.clear();
    for (const IslandBody& body : bodies_) {
        if (body.column == kNoNode) { continue; }
        Block33& block = matrix_.diagonal(body.column);
        block[0] = block[4] = body.inverseMass > 0 ? 1 / body.inverseMass : 1;
        block[8] = body.inverseInertia > 0 ? 1 / body.inverseInertia : 1;
    }
    for (const IslandHold& hold : holds_) {
        const IslandBody& a = bodies_[hold.a];
        const IslandBody& b = bodies_[hold.b];
        for (std::size_t i = 0; i < hold.count; ++i) {
            const IslandHold::Row& row = hold.rows[i];
            const Block3 ofA = movable(row.ofA, a);
            const Block3 ofB = movable(row.ofB, b);
            if (a.column != kNoNode) { addOuter(matrix_.diagonal(a.column), row.strength, ofA, ofA); }
            if (b.column != kNoNode) { addOuter(matrix_.diagonal(b.column), row.strength, ofB, ofB); }
            if (a.column == kNoNode || b.column == kNoNode || a.column == b.column) { continue; }
            const BlockLdlt::OffDiagonal off = matrix_.offDiagonal(a.column, b.column);
            addOuter(off.block, row.strength, off.rowIsB ? ofB : ofA, off.rowIsB ? ofA : ofB);
        }
    }
    matrix_.factorise();
    ++factorisations_;
}

}  // namespace swept::inline SWEPT_PRECISION
