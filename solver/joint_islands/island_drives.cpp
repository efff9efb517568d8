#include "island_drives.h"

#include <algorithm>
#include <cmath>

#include "joint_island_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Radians of the oscillation of a spring in a step, and how often it halves a speed there, beyond which sub-steps take
/// less time.
constexpr double kMostSpringPhase = 1.5;
/// What is nearer to a limit than so many ways of a step may reach it.
constexpr double kRoomAhead = 1.25;
/// A motor has the speed that it wants where it could have it in this part of the step, and gets it where it could in
/// as many steps.
constexpr double kPartToHold = 1.0 / 64;
constexpr double kStepsToGet = 2;
/// Of the speeds of two bodies.
constexpr double kSpeedRounding = 4 * static_cast<double>(kEpsilon);

/// How two points answer to each other.
struct Response {
    double along = 0;
    double across = 0;
    double both = 0;

    void add(double turns, double ofAlong, double ofAcross) {
        along += turns * ofAlong * ofAlong;
        across += turns * ofAcross * ofAcross;
        both += turns * ofAlong * ofAcross;
    }
    double determinant() const { return along * across - both * both; }
};

void setBodies(IslandDrive& drive, const BodyInertia& a, const BodyInertia& b) {
    drive.inverseMass = static_cast<double>(a.inverseMass) + static_cast<double>(b.inverseMass);
    drive.inverseInertiaOfA = static_cast<double>(a.inverseInertia);
    drive.inverseInertiaOfB = static_cast<double>(b.inverseInertia);
}

/// Takes a spring that is not held back. @return whether it is, and slow enough
bool takeSpring(IslandDrive& drive, const SpringGains& gains, const DrivenStep& step) {
    if (gains.lag != 0 || gains.drag == 1) { return false; }
    const double loss = 1 / (1 - static_cast<double>(gains.drag));
    drive.hasSpring = true;
    drive.stiffness = static_cast<double>(gains.push) / step.h;
    drive.damping = 2 * (std::sqrt(loss) - 1) / step.h;
    drive.springRate = std::max(std::sqrt(drive.stiffness), drive.damping);
    return drive.springRate * step.duration <= kMostSpringPhase;
}

/// @param speed  along the way now
bool takeLimits(IslandDrive& drive, const FreedomParts& parts, double speed, const DrivenStep& step) {
    drive.hasLimits = true;
    drive.lower = static_cast<double>(parts.lower);
    drive.upper = static_cast<double>(parts.upper);
    const double ahead = kRoomAhead * step.duration * speed;
    return !parts.isGliding && drive.place + std::min(ahead, 0.0) > drive.lower &&
           drive.place + std::max(ahead, 0.0) < drive.upper;
}

struct Wanted {
    Real speed;
    Real mostImpulse;  ///< in a sub-step
};

/// Along the way of a motor.
struct WayNow {
    double mass = 0;      ///< that it moves, at least
    double speed = 0;     ///< along the way
    double rounding = 0;  ///< of that
};

/// What has no strength is none.
bool takeMotor(IslandDrive& drive, const Wanted& wanted, const WayNow& now, const DrivenStep& step) {
    drive.speed = static_cast<double>(wanted.speed);
    drive.most = static_cast<double>(wanted.mostImpulse) / step.h;
    if (!(drive.most > 0)) { return true; }
    const double lacks = now.mass * (drive.speed - now.speed);
    const double most = drive.most * step.duration;
    if (std::fabs(lacks) <= kPartToHold * most + now.mass * now.rounding) {
        drive.motor = IslandDrive::Motor::holds;
        return true;
    }
    drive.motor = IslandDrive::Motor::pushes;
    drive.push = std::copysign(drive.most, lacks);
    return std::fabs(lacks) > kStepsToGet * most;
}

/// Without the mass.
WayNow turningOf(const SolverBatch& batch, const JointConstraint& joint) {
    const auto a = static_cast<double>(batch.states[joint.slotA].angularVelocity);
    const auto b = static_cast<double>(batch.states[joint.slotB].angularVelocity);
    return {.speed = b - a, .rounding = kSpeedRounding * (std::fabs(a) + std::fabs(b))};
}

}  // namespace

double IslandDrive::massAt(DVec2 axis, DVec2 armOfA, DVec2 armOfB) const {
    if (!(inverseMass > 0)) { return mass; }
    const double turns = inverseInertiaOfA + inverseInertiaOfB;
    const double together = turns > 0 ? inverseInertiaOfA * inverseInertiaOfB / turns : 0;
    const DVec2 apart = armOfA - armOfB;
    if (way == Way::turn) {
        // Determinants of the points alone, and with the angle.
        Response points{inverseMass, inverseMass, 0};
        points.add(inverseInertiaOfA, armOfA.x, armOfA.y);
        points.add(inverseInertiaOfB, armOfB.x, armOfB.y);
        return points.determinant() / (inverseMass * (inverseMass * turns + turns * together * dot(apart, apart)));
    }
    Response points{inverseMass, inverseMass, 0};
    if (holdsAngle) {
        points.add(together, cross(apart, axis), dot(apart, axis));
    } else {
        points.add(inverseInertiaOfA, cross(armOfA, axis), dot(armOfA, axis));
        points.add(inverseInertiaOfB, cross(armOfB, axis), dot(armOfB, axis));
    }
    return points.across / points.determinant();
}

JointDrives drivesOf(const SolverBatch& batch, const RevoluteConstraint& joint, const DrivenStep& step) {
    if (!joint.hasSpring && !joint.hasLimits && !joint.hasMotor) { return {}; }
    JointDrives drives;
    IslandDrive& turn = drives.turn.emplace();
    turn.place = static_cast<double>(joint.baseAngle);
    const DVec2 armA = toDouble(joint.anchorA);
    const DVec2 armB = toDouble(joint.anchorB);
    setBodies(turn, batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
    WayNow now = turningOf(batch, joint);
    bool& areSmooth = drives.areSmooth;
    if (joint.hasSpring) { areSmooth = takeSpring(turn, joint.spring, step); }
    if (joint.hasLimits) { areSmooth = areSmooth && takeLimits(turn, joint, now.speed, step); }
    if (joint.hasMotor) {
        now.mass = turn.massAt({}, armA, armB);
        areSmooth = areSmooth && takeMotor(turn, {joint.motorSpeed, joint.maxMotorImpulse}, now, step);
    }
    return drives;
}

JointDrives drivesOf(const SolverBatch& batch, const WeldConstraint& joint, const DrivenStep& step) {
    JointDrives drives;
    IslandDrive& turn = drives.turn.emplace();
    turn.place = static_cast<double>(joint.baseAngle);
    setBodies(turn, batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
    drives.areSmooth = takeSpring(turn, joint.angularSpring, step);
    return drives;
}

namespace {

/// Along an axis, now.
struct SlideNow : WayNow {
    IslandDrive drive;
};

template <class Joint>
SlideNow slideOf(const SolverBatch& batch, const Joint& joint, bool holdsAngle) {
    const DVec2 axis = toDouble(joint.axis);
    const DVec2 armB = toDouble(joint.anchorB);
    const DVec2 armA = toDouble(joint.centerOffset) + armB;  // forces act where B's anchor is
    const BodyState& a = batch.states[joint.slotA];
    const BodyState& b = batch.states[joint.slotB];
    const DVec2 ofA = toDouble(a.velocity) + static_cast<double>(a.angularVelocity) * leftOf(armA);
    const DVec2 ofB = toDouble(b.velocity) + static_cast<double>(b.angularVelocity) * leftOf(armB);
    SlideNow slide;
    slide.drive.way = IslandDrive::Way::slide;
    slide.drive.place = dot(axis, armA - toDouble(joint.anchorA));
    slide.drive.holdsAngle = holdsAngle;
    setBodies(slide.drive, batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
    slide.mass = slide.drive.massAt(axis, armA, armB);
    slide.speed = dot(axis, ofB - ofA);
    slide.rounding = kSpeedRounding * (norm(ofA) + norm(ofB));
    return slide;
}

}  // namespace

JointDrives drivesOf(const SolverBatch& batch, const PrismaticConstraint& joint, const DrivenStep& step) {
    if (!joint.hasSpring && !joint.hasLimits && !joint.hasMotor) { return {}; }
    SlideNow slide = slideOf(batch, joint, true);
    JointDrives drives;
    bool& areSmooth = drives.areSmooth;
    if (joint.hasSpring) { areSmooth = takeSpring(slide.drive, joint.spring, step); }
    if (joint.hasLimits) { areSmooth = areSmooth && takeLimits(slide.drive, joint, slide.speed, step); }
    if (joint.hasMotor) {
        const Wanted wanted{joint.motorSpeed, joint.maxMotorImpulse};
        areSmooth = areSmooth && takeMotor(slide.drive, wanted, slide, step);
    }
    drives.slide = slide.drive;
    return drives;
}

JointDrives drivesOf(const SolverBatch& batch, const WheelConstraint& joint, const DrivenStep& step) {
    JointDrives drives;
    bool& areSmooth = drives.areSmooth;
    const FreedomParts& suspension = joint.suspension;
    if (suspension.hasSpring || suspension.hasLimits) {
        SlideNow slide = slideOf(batch, joint, false);
        if (suspension.hasSpring) {
            const auto response = static_cast<Real>(1 / slide.mass);
            areSmooth = takeSpring(slide.drive, gainsAt(joint.spring, phaseSquaredAt(joint.spring, response)), step);
            slide.drive.fixedStiffness = slide.drive.stiffness * slide.mass;
            slide.drive.stiffness = 0;
        }
        if (suspension.hasLimits) { areSmooth = areSmooth && takeLimits(slide.drive, suspension, slide.speed, step); }
        drives.slide = slide.drive;
    }
    if (!joint.hasMotor) { return drives; }
    IslandDrive turn;
    setBodies(turn, batch.inertias[joint.slotA], batch.inertias[joint.slotB]);
    WayNow now = turningOf(batch, joint);
    // A wheel turns about its anchor; what carries it resists as a whole.
    now.mass = turn.massAt({}, toDouble(joint.centerOffset + joint.anchorB), toDouble(joint.anchorB));
    areSmooth = areSmooth && takeMotor(turn, {joint.motorSpeed, joint.maxMotorImpulse}, now, step);
    drives.turn = turn;
    return drives;
}

}  // namespace swept::inline SWEPT_PRECISION
