#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "../../shapes/trig.h"
#include "../direct/direct_parts.h"
#include "joint_island.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Momenta of this part of those that come and go are none.
constexpr double kMomentumRatio = 1.0 / static_cast<double>(std::uint64_t{1} << 44);
/// What may be left where rounds take no more away: rounding, momenta where energy is lost anyway, and more where the
/// next thing to do would be worse.
struct Left {
    double gaps;
    double momenta;
};
constexpr double kRounded = 1.0 / static_cast<double>(std::uint64_t{1} << 32);
constexpr Left kLeftByMiddle{kRounded, kRounded};
constexpr Left kLeftByEnd{kRounded, 1.0 / (1 << 20)};
constexpr Left kLeftAtLast{1.0 / (1 << 17), std::numeric_limits<double>::max()};
/// Of a momentum, to which others are held no better than by rounding.
constexpr double kRoundedPart = 1.0 / 1024;
/// Rounds of Newton's method: four to six do where nothing turns by more than half a radian.
constexpr int kMostRounds = 24;
constexpr int kFewestRounds = 10;
constexpr int kHoldRounds = 2;
/// Gaps that were opened are closed by this part of them in a step, or its square, or its cube.
constexpr double kFewestStepsOfClosing = 4;
constexpr double kMostStepsOfClosing = 64;

/// An arm such that it, turned by a right angle, times the turn, is by how much its end moves.
DVec2 middleArm(const IslandBody& body, DVec2 arm) {
    return body.middle.chord * turned(body.middle.c, body.middle.s, arm);
}

struct Ends {
    DVec2 before;
    DVec2 after;
};
/// From A's anchor to B's.
Ends offsetsOf(const IslandHold& hold, const IslandBody& a, const IslandBody& b) {
    const auto at = [&hold](const IslandBody::Place& ofA, const IslandBody::Place& ofB) {
        return hold.offset + (ofB.position - ofA.position) + turned(ofB.c, ofB.s, hold.anchorB) -
               turned(ofA.c, ofA.s, hold.anchorA);
    };
    return {at(a.place, b.place), at(a.next, b.next)};
}

void setRow(IslandHold::Row& row, DVec2 direction, double spinA, double spinB) {
    row.ofA = {-direction.x, -direction.y, -spinA};
    row.ofB = {direction.x, direction.y, spinB};
}
void setEnd(IslandHold::Row& row, DVec2 direction, double spinA, double spinB) {
    row.endA = {-direction.x, -direction.y, -spinA};
    row.endB = {direction.x, direction.y, spinB};
}
DVec2 endArm(const IslandBody& body, DVec2 arm) { return turned(body.next.c, body.next.s, arm); }

double gapOf(const IslandHold& hold, const IslandBody& a, const IslandBody& b, DVec2 after, std::size_t row) {
    switch (hold.kind) {
        case IslandHold::Kind::point:
            return row == 0 ? after.x : after.y;
        case IslandHold::Kind::rod:
            return length(after) - hold.rest;
        case IslandHold::Kind::side:
            return dot(leftOf(turned(a.next.c, a.next.s, hold.axis)), after);
        case IslandHold::Kind::angle:
            return hold.rest + (b.next.angle - a.next.angle);
    }
    return 0;
}

/// The rows of a joint between the present places of its bodies and the next ones.
class TreeRows {
public:
    /// @param time  s, from here to there
    /// @param isMiddle  whether its forces have the direction of the middle of the way, else that of its end
    TreeRows(IslandHold& hold, IslandBody& a, IslandBody& b, double time, bool isMiddle)
        : hold_(hold),
          a_(a),
          b_(b),
          time_(time),
          turning_(isMiddle ? 0.5 * time : time),
          isMiddle_(isMiddle),
          endA_(endArm(a, hold.anchorA)),
          endB_(endArm(b, hold.anchorB)),
          armA_(isMiddle ? middleArm(a, hold.anchorA) : endA_),
          armB_(isMiddle ? middleArm(b, hold.anchorB) : endB_) {}

    void placePoint() const {
        place(hold_.rows[0], {1, 0}, {1, 0});
        place(hold_.rows[1], {0, 1}, {0, 1});
        const DVec2 impulse{hold_.rows[0].impulse, hold_.rows[1].impulse};
        a_.middle.stiffness -= turning_ * dot(armA_, impulse);
        b_.middle.stiffness += turning_ * dot(armB_, impulse);
    }

    void placeRod() const {
        const Ends ends = offsetsOf(hold_, a_, b_);
        const double far = length(ends.after);
        const double apart = isMiddle_ ? length(ends.before) + far : far;
        if (apart > 0) { hold_.axis = (1 / apart) * (isMiddle_ ? ends.before + ends.after : ends.after); }
        const double impulse = hold_.rows[0].impulse;
        place(hold_.rows[0], hold_.axis, far > 0 ? (1 / far) * ends.after : hold_.axis);
        const DVec2 aside = leftOf(hold_.axis);
        setRow(hold_.rows[1], aside, cross(armA_, aside), cross(armB_, aside));
        hold_.rows[1].endA = hold_.rows[1].ofA;
        hold_.rows[1].endB = hold_.rows[1].ofB;
        if (apart > 0) { hold_.tightness = std::max(-impulse * time_ / apart, 0.0); }
        a_.middle.stiffness -= turning_ * impulse * dot(armA_, hold_.axis);
        b_.middle.stiffness += turning_ * impulse * dot(armB_, hold_.axis);
    }

    void placeSide() const {
        const Ends ends = offsetsOf(hold_, a_, b_);
        const DVec2 across =
            0.5 * leftOf(turned(a_.place.c, a_.place.s, hold_.axis) + turned(a_.next.c, a_.next.s, hold_.axis));
        const DVec2 swinging = leftOf(middleArm(a_, hold_.axis));
        const double spinA = cross(armA_, across) + cross(0.5 * (ends.before + ends.after), swinging);
        setRow(hold_.rows[0], across, spinA, cross(armB_, across));
        const DVec2 end = leftOf(endArm(a_, hold_.axis));
        setEnd(hold_.rows[0], end, cross(endA_ + ends.after, end), cross(endB_, end));
        if (isMiddle_) { return; }
        hold_.rows[0].ofA = hold_.rows[0].endA;
        hold_.rows[0].ofB = hold_.rows[0].endB;
    }

    void placeAngle() const {
        setRow(hold_.rows[0], {}, 1, 1);
        setEnd(hold_.rows[0], {}, 1, 1);
    }

private:
    void place(IslandHold::Row& row, DVec2 direction, DVec2 end) const {
        setRow(row, direction, cross(armA_, direction), cross(armB_, direction));
        setEnd(row, end, cross(endA_, end), cross(endB_, end));
    }

    IslandHold& hold_;
    IslandBody& a_;
    IslandBody& b_;
    double time_;
    double turning_;  ///< s, in which its forces turn with the bodies
    bool isMiddle_;
    DVec2 endA_;
    DVec2 endB_;
    DVec2 armA_;
    DVec2 armB_;
};

double speedOf(const Block3& row, const IslandBody& body) {
    return row[0] * body.velocity.x + row[1] * body.velocity.y + row[2] * body.spin;
}

}  // namespace

void JointIsland::findTreePlaces(double time) {
    for (IslandBody& body : bodies_) {
        const double half = 0.5 * time * body.spin;
        const SinCos turn = sinCos(half);
        const auto further = [&turn](double c, double s) {
            return DVec2{c * turn.cos - s * turn.sin, s * turn.cos + c * turn.sin};
        };
        const DVec2 middle = further(body.place.c, body.place.s);
        const DVec2 next = further(middle.x, middle.y);
        body.middle.c = middle.x;
        body.middle.s = middle.y;
        body.middle.chord = half != 0 ? turn.sin / half : 1;
        body.next = {body.place.position + time * body.velocity, body.place.angle + 2 * half, next.x, next.y};
    }
}

/// Rows whose speeds, times the time, are exactly by how much the gaps change from here to the next places; and how
/// their forces turn with the bodies.
void JointIsland::placeTreeRows(double time, ForceAt at) {
    for (IslandBody& body : bodies_) { body.middle.stiffness = 0; }
    for (IslandHold& hold : holds_) {
        hold.tightness = 0;
        const TreeRows rows(hold, bodies_[hold.a], bodies_[hold.b], time, at == ForceAt::middle);
        switch (hold.kind) {
            case IslandHold::Kind::point:
                rows.placePoint();
                break;
            case IslandHold::Kind::rod:
                rows.placeRod();
                break;
            case IslandHold::Kind::side:
                rows.placeSide();
                break;
            case IslandHold::Kind::angle:
                rows.placeAngle();
                break;
        }
    }
}

/// Gaps that the next places have, less those that are closed later, as speeds.
double JointIsland::findTreeGaps(double time) {
    double worst = 0;
    const double left = openPart();
    for (IslandHold& hold : holds_) {
        const IslandBody& a = bodies_[hold.a];
        const IslandBody& b = bodies_[hold.b];
        const DVec2 after = offsetsOf(hold, a, b).after;
        const bool isAngle = hold.kind == IslandHold::Kind::angle;
        const double scale =
            isAngle ? std::fabs(a.next.angle) + std::fabs(b.next.angle) : norm(a.next.position) + norm(b.next.position);
        for (std::size_t i = 0; i < hold.count; ++i) {
            const double gap = gapOf(hold, a, b, after, i) - left * hold.rows[i].open;
            hold.rows[i].excess = gap / time;
            if (gap != 0) { worst = worse(worst, std::fabs(gap) / (hold.size + scale)); }
        }
    }
    return worst;
}

/// What the impulses lack of the change of the momenta, into `change_`.
double JointIsland::findMomenta() {
    for (IslandBody& body : bodies_) {
        body.given = body.turned = 0;
        if (body.column == kNoNode) { continue; }
        const double mass = body.inverseMass > 0 ? 1 / body.inverseMass : 0;
        const double inertia = body.inverseInertia > 0 ? 1 / body.inverseInertia : 0;
        const DVec2 lack = mass * (body.middle.velocity - body.velocity);
        change_[body.column] = {lack.x, lack.y, inertia * (body.middle.spin - body.spin)};
    }
    const auto add = [this](IslandBody& body, const Block3& row, double impulse, bool isAngle) {
        if (body.column == kNoNode) { return; }
        Block3& change = change_[body.column];
        if (body.inverseMass > 0) {
            change[0] += row[0] * impulse;
            change[1] += row[1] * impulse;
            body.given += isAngle ? 0 : body.inverseMass * std::fabs(impulse);
        }
        if (body.inverseInertia > 0) {
            change[2] += row[2] * impulse;
            body.turned += body.inverseInertia * std::fabs(row[2] * impulse);
        }
    };
    for (const IslandHold& hold : holds_) {
        const bool isAngle = hold.kind == IslandHold::Kind::angle;
        for (std::size_t i = 0; i < hold.count; ++i) {
            add(bodies_[hold.a], hold.rows[i].ofA, hold.rows[i].impulse, isAngle);
            add(bodies_[hold.b], hold.rows[i].ofB, hold.rows[i].impulse, isAngle);
        }
    }
    return worstLack();
}

/// Of the momenta that are missing (`change_`), as a part of those that come and go.
double JointIsland::worstLack() const {
    // What the rounding of a heavy body's speed pushes light ones with.
    double most = 0;
    for (const IslandBody& body : bodies_) {
        if (body.inverseMass > 0) { most = std::max(most, norm(body.velocity) / body.inverseMass); }
    }
    most *= kRoundedPart;
    double worst = 0;
    for (const IslandBody& body : bodies_) {
        if (body.column == kNoNode) { continue; }
        const Block3& change = change_[body.column];
        const double linear = body.inverseMass * norm({change[0], change[1]});
        const double angular = body.inverseInertia * std::fabs(change[2]);
        const double rounded = body.inverseMass * most;
        if (linear > 0) { worst = worse(worst, linear / (norm(body.velocity) + body.given + rounded)); }
        if (angular > 0) {
            const double size = std::sqrt(body.inverseMass * body.inverseInertia);
            worst = worse(worst, angular / (std::fabs(body.spin) + body.turned + size * most));
        }
    }
    return worst;
}

/// Takes over the next places, and the speeds of the end: by the middle, twice those of it, less those of the start.
void JointIsland::leaveSubStep(double time, ForceAt at) {
    const bool isMiddle = at == ForceAt::middle;
    for (IslandBody& body : bodies_) {
        body.place = body.next;
        if (body.column == kNoNode || !isMiddle) { continue; }
        body.velocity += body.velocity - body.middle.velocity;
        body.spin += body.spin - body.middle.spin;
    }
    for (IslandHold& hold : holds_) {
        for (std::size_t i = 0; i < hold.count; ++i) {
            IslandHold::Row& row = hold.rows[i];
            if (isMiddle) { row.impulse *= 2; }  // those up to the middle are half of them
            row.force = row.impulse / time;
        }
    }
    endStage();
}

/// @param part  of the sub-step h that drives were made for; may be negative where forces act in the middle
/// @param isLast  whether nothing is left to be tried
bool JointIsland::subStepOfTree(double part, double h, ForceAt at, bool isLast) {
    ++subSteps_;
    const double time = part * h;
    goOn(time);
    drive(part);
    for (IslandBody& body : bodies_) {
        body.middle.velocity = body.velocity;
        body.middle.spin = body.spin;
    }
    const double share = at == ForceAt::middle ? 0.5 : 1;
    for (IslandHold& hold : holds_) {
        for (std::size_t i = 0; i < hold.count; ++i) { hold.rows[i].impulse = share * time * hold.rows[i].force; }
    }
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0;; ++round) {
        findTreePlaces(time);
        placeTreeRows(time, at);
        // Momenta may be as much as their rounding more.
        const double gaps = findTreeGaps(time);
        const double momenta = findMomenta();
        const double worst = std::max(gaps, kNoGapRatio / kMomentumRatio * momenta);
        if (worst <= kNoGapRatio) { break; }
        if (round >= kMostRounds || (round >= kFewestRounds && !(worst <= 0.5 * before))) {
            const Left& left = isLast ? kLeftAtLast : at == ForceAt::middle ? kLeftByMiddle : kLeftByEnd;
            if (!(gaps <= left.gaps && momenta <= left.momenta)) { return false; }
            break;
        }
        before = worst;
        factoriseTree();
        solveTree(time);
    }
    leaveSubStep(time, at);
    drive(part);
    return true;
}

/// Takes away the speeds that sub-steps leave against the joints: rounding between steps, mostly.
void JointIsland::holdTree() {
    for (IslandHold& hold : holds_) {
        for (IslandHold::Row& row : hold.rows) { row.impulse = 0; }
    }
    findTreePlaces(0);
    placeTreeRows(0, ForceAt::end);
    factoriseTree();
    for (int round = 0; round < kHoldRounds; ++round) {
        for (IslandHold& hold : holds_) {
            for (std::size_t i = 0; i < hold.count; ++i) {
                IslandHold::Row& row = hold.rows[i];
                row.excess = speedOf(row.endA, bodies_[hold.a]) + speedOf(row.endB, bodies_[hold.b]) - row.pace;
            }
        }
        std::fill(change_.begin(), change_.end(), Block3{});
        solveTree(0);
    }
    endStage();
}

/// Bodies that were put apart come together in some tens of steps: they are moved by a part of the gaps, as little as
/// can be for their masses, and keep their speeds but for what the joints do not allow. Speeds that close gaps do not
/// end with them, as bodies turn meanwhile.
void JointIsland::closeGaps() {
    keepsOpen_ = isPaced_ = false;  // rods are as long as they are to be
    saved_ = holds_;
    start_ = bodies_;
    const double time = 1;
    for (double steps = kFewestStepsOfClosing; steps <= kMostStepsOfClosing; steps *= kFewestStepsOfClosing) {
        for (IslandBody& body : bodies_) {
            body.velocity = body.gain = {};
            body.spin = body.angularGain = 0;
        }
        dropForces();
        elapsed_ = 0;
        duration_ = steps * time;
        const bool isDone = subStepOfTree(1, time, ForceAt::end, false);
        holds_ = saved_;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (isDone) { start_[i].place = bodies_[i].place; }
            bodies_[i] = start_[i];
        }
        if (isDone) {
            holdTree();
            return;
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
