#include "blow_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "../state/tolerances.h"
#include "joint_place.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of the joints of a body, the first ones: what more hold, it is held by already.
constexpr std::size_t kMostRows = 12;
/// Of its own answer: a row that is left with less is held by those before it.
constexpr double kHeldAlready = 1e-6;
/// How near to its limit a joint is at it: of a radian, or of the extent of a body.
constexpr Real kAtLimit = Real(1) / 256;

/// One direction in which a joint holds the body to the ground.
struct HeldRow {
    DVec2 along;      ///< (0, 0): angles alone
    double turn = 0;  ///< metres along it by a radian
};

/// How a body moves by an impulse of 1.
struct Moved {
    DVec2 velocity{};
    double spin = 0;
};

/// What holds a body to the ground where something strikes it.
class HeldBody {
public:
    HeldBody(const WorldState& world, std::uint32_t body)
        : world_(world),
          body_(body),
          inverseMass_(static_cast<double>(world.bodies[body].inverseMass)),
          inverseInertia_(static_cast<double>(world.bodies[body].inverseInertia)) {
        forEachJoint([this](const Joint& joint) { addRowsOf(joint); });
    }

    bool isHeld() const { return count_ > 0; }
    /// Of the body without its joints: how fast it gets along one row by an impulse along another.
    double answer(const HeldRow& a, const HeldRow& b) const {
        return inverseMass_ * dot(a.along, b.along) + inverseInertia_ * a.turn * b.turn;
    }
    /// @param blow  along it, and its lever
    Moved movedBy(const HeldRow& blow) const;
    /// What a blow drives into its limit is held by that, too.
    void addLimits(const HeldRow& blow) {
        const Moved moved = movedBy(blow);
        forEachJoint([&](const Joint& joint) { addLimitOf(joint, moved); });
    }

private:
    template <class Visit>
    void forEachJoint(const Visit& visit) const {
        for (const std::uint32_t index : world_.bodies[body_].joints) {
            if (world_.joints[index].holds()) { visit(world_.joints[index]); }
        }
    }
    void add(const HeldRow& row) {
        if (count_ < kMostRows) { rows_[count_++] = row; }
    }
    bool isA(const Joint& joint) const { return joint.bodyA == body_; }
    void addAlong(const Joint& joint, DVec2 along) {
        // What slides is held where B's anchor is.
        const bool slides = joint.type() == JointType::prismatic || joint.type() == JointType::wheel;
        const Vec2 armB = armOf(world_, joint.bodyB, joint.localAnchorB);
        const Vec2 armA = slides ? armB + centerOffset(world_, joint) : armOf(world_, joint.bodyA, joint.localAnchorA);
        const double ofA = cross(toDouble(armA), along);
        const double ofB = cross(toDouble(armB), along);
        add({along, isA(joint) ? ofA : ofB});
    }
    void addPoint(const Joint& joint) {
        addAlong(joint, {1, 0});
        addAlong(joint, {0, 1});
    }
    void addAngle() { add({{}, 1}); }

    void addRowsOf(const Joint& joint) {
        switch (joint.type()) {
            case JointType::revolute:
                addPoint(joint);
                break;
            case JointType::weld: {
                const WeldJointDef& def = std::get<JointPart<WeldJointDef, WeldConstraint>>(joint.parts).def;
                if (!def.linearSpring) { addPoint(joint); }
                if (!def.angularSpring) { addAngle(); }
                break;
            }
            case JointType::prismatic:
                addAngle();
                addAlong(joint, toDouble(leftPerp(axisOf(world_, joint))));
                break;
            case JointType::wheel:
                addAlong(joint, toDouble(leftPerp(axisOf(world_, joint))));
                break;
            case JointType::distance: {
                const DistanceJointDef& def =
                    std::get<JointPart<DistanceJointDef, DistanceConstraint>>(joint.parts).def;
                if (!def.spring && !def.limits) { addAlong(joint, toDouble(directionOf(world_, joint))); }
                break;
            }
            default:
                break;
        }
    }

    /// Of a hinge or slider that is at a limit into which the blow drives it.
    void addLimitOf(const Joint& joint, const Moved& moved) {
        const double sign = isA(joint) ? -1 : 1;  // of B against A, as far as the body does it
        if (joint.type() == JointType::revolute) {
            const std::optional<AngleLimits>& limits = std::get<HingePart>(joint.parts).def.limits;
            if (limits && isInto(*limits, angleOf(world_, joint), kAtLimit, sign * moved.spin)) { addAngle(); }
        }
        if (joint.type() == JointType::prismatic) {
            using Part = JointPart<PrismaticJointDef, PrismaticConstraint>;
            const std::optional<TranslationLimits>& limits = std::get<Part>(joint.parts).def.limits;
            const DVec2 axis = toDouble(axisOf(world_, joint));
            const Real room = kAtLimit * world_.bodies[body_].extent;
            const auto place = static_cast<double>(translationOf(world_, joint));
            if (limits && isInto(*limits, place, room, sign * dot(moved.velocity, axis))) { addAlong(joint, axis); }
        }
    }
    template <class Limits>
    static bool isInto(const Limits& limits, double place, Real room, double speed) {
        return (speed < 0 && place <= static_cast<double>(limits.lower + room)) ||
               (speed > 0 && place >= static_cast<double>(limits.upper - room));
    }

    const WorldState& world_;
    std::uint32_t body_;
    double inverseMass_;
    double inverseInertia_;
    std::array<HeldRow, kMostRows> rows_{};
    std::size_t count_ = 0;
};

/// By elimination (LDLᵀ: roots would round otherwise in other units), row by row: first what each row has to take of
/// the blow, less what those before it do; then its impulse, from the last row back.
Moved HeldBody::movedBy(const HeldRow& blow) const {
    std::array<std::array<double, kMostRows>, kMostRows> factor{};
    std::array<double, kMostRows> pivot{};  // 0: the rows before it hold it already
    std::array<double, kMostRows> part{};
    for (std::size_t i = 0; i < count_; ++i) {
        const double whole = answer(rows_[i], rows_[i]);
        double rest = whole;
        double push = answer(rows_[i], blow);
        for (std::size_t j = 0; j < i; ++j) {
            if (!(pivot[j] > 0)) { continue; }
            double shared = answer(rows_[i], rows_[j]);
            for (std::size_t k = 0; k < j; ++k) { shared -= factor[i][k] * pivot[k] * factor[j][k]; }
            factor[i][j] = shared / pivot[j];
            rest -= factor[i][j] * shared;
            push -= factor[i][j] * part[j];
        }
        if (rest > kHeldAlready * whole) {
            pivot[i] = rest;
            part[i] = push;
        }
    }
    Moved moved{.velocity = inverseMass_ * blow.along, .spin = inverseInertia_ * blow.turn};
    std::array<double, kMostRows> impulse{};
    for (std::size_t i = count_; i-- > 0;) {
        if (!(pivot[i] > 0)) { continue; }
        double sum = part[i] / pivot[i];
        for (std::size_t j = i + 1; j < count_; ++j) { sum -= factor[j][i] * impulse[j]; }
        impulse[i] = sum;
        moved.velocity -= inverseMass_ * sum * rows_[i].along;
        moved.spin -= inverseInertia_ * sum * rows_[i].turn;
    }
    return moved;
}

/// Of the approach: what the joints do not allow of it. What is jammed, or torn, goes as they let nothing go: thrown
/// back by its whole approach with the little that they leave, it would gain energy without end.
constexpr Real kMostAstray = Real(1) / 4;

}  // namespace

bool isHeldByGround(const WorldState& world, std::uint32_t slot) {
    const std::vector<std::uint32_t>& joints = world.bodies[slot].joints;
    return std::all_of(joints.begin(), joints.end(), [&](std::uint32_t index) {
        const Joint& joint = world.joints[index];
        const std::span<const std::uint32_t> bodies = joint.allBodies();
        return !joint.holds() || std::all_of(bodies.begin(), bodies.end(), [&](std::uint32_t other) {
            return other == slot || !world.bodies[other].isDynamic();
        });
    });
}

BlowAnswer answerOf(const WorldState& world, std::uint32_t body, Vec2 arm, Vec2 direction) {
    if (!isHeldByGround(world, body)) { return {}; }
    HeldBody held(world, body);
    const HeldRow normal{toDouble(direction), cross(toDouble(arm), toDouble(direction))};
    held.addLimits(normal);
    if (!held.isHeld()) { return {}; }
    const Moved byX = held.movedBy({{1, 0}, 0});
    const Moved byY = held.movedBy({{0, 1}, 0});
    const Moved byTwist = held.movedBy({{}, 1});
    return {.isHeld = true,
            .xx = static_cast<Real>(byX.velocity.x),
            .xy = static_cast<Real>(byY.velocity.x),
            .yy = static_cast<Real>(byY.velocity.y),
            .xt = static_cast<Real>(byTwist.velocity.x),
            .yt = static_cast<Real>(byTwist.velocity.y),
            .tt = static_cast<Real>(byTwist.spin)};
}

namespace {

/// Of what goes as its joints let it; else it answers freely.
BlowAnswer answerTo(Real approach, const WorldState& world, std::uint32_t slot, Vec2 arm, Vec2 direction) {
    const BlowAnswer answer = answerOf(world, slot, arm, direction);
    if (!answer.isHeld) { return answer; }
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const Real lever = cross(arm, direction);
    const Vec2 momentum = (1 / body.inverseMass) * motion.velocity;
    const Real spin = body.inverseInertia > 0 ? motion.angularVelocity / body.inverseInertia : Real(0);
    const Real speed = dot(direction, motion.velocity) + lever * motion.angularVelocity;
    const Real allowed = answer.along(direction, lever, momentum, spin);
    return std::fabs(speed - allowed) <= kMostAstray * approach ? answer : BlowAnswer{};
}

}  // namespace

void setAnswers(const WorldState& world, const Contact& contact, ContactConstraint& constraint) {
    // What something kinematic or the ground presses against its own joints is no blow: it has nowhere to go.
    if (!contact.dynamicA || !contact.dynamicB) { return; }
    const bool isHeldA = world.bodies[contact.bodyA].holdingJoints > 0;
    const bool isHeldB = world.bodies[contact.bodyB].holdingJoints > 0;
    if (!isHeldA && !isHeldB) { return; }
    const BodyMotion& a = world.motions[contact.bodyA];
    const BodyMotion& b = world.motions[contact.bodyB];
    const BlowArms arms = armsOf(constraint);
    const Vec2 velocity = b.velocity + cross(b.angularVelocity, arms.b) - a.velocity - cross(a.angularVelocity, arms.a);
    const Real approach = -dot(velocity, constraint.normal);
    if (!(approach > 0)) { return; }
    if (isHeldA) { constraint.answerA = answerTo(approach, world, contact.bodyA, arms.a, -constraint.normal); }
    if (isHeldB) { constraint.answerB = answerTo(approach, world, contact.bodyB, arms.b, constraint.normal); }
}

}  // namespace swept::inline SWEPT_PRECISION
