#include "free_motion.h"

#include <limits>
#include <span>

#include "wide/wide_motion.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
MoveBodies motionKernel() { return nullptr; }
FindRotations rotationKernel() { return nullptr; }
#endif

void moveBodies(std::span<BodyState> bodies, Real h) {
    for (BodyState& body : bodies) {
        body.deltaPosition += h * body.velocity;
        body.deltaAngle += h * body.angularVelocity;
        body.deltaRotation = rotationFromAngle(static_cast<double>(body.deltaAngle));
    }
}

void findRotations(std::span<const double> angles, std::span<Rotation> rotations) {
    for (std::size_t i = 0; i < angles.size(); ++i) { rotations[i] = rotationFromAngle(angles[i]); }
}

namespace {

/// @return whether the speed was cut
bool limitSpeed(BodyState& body, Real maxSpeed) {
    const Real speed = length(body.velocity);
    if (!(speed > maxSpeed)) { return false; }
    body.velocity = (maxSpeed / speed) * body.velocity;
    return true;
}

}  // namespace

int limitSpeeds(SolverBatch& batch, Real maxSpeed, std::size_t begin, std::size_t end) {
    int limited = 0;
    for (std::size_t i = begin; i < end; ++i) {
        limited += isMovable(batch.inertias[i]) && limitSpeed(batch.states[i], maxSpeed) ? 1 : 0;
    }
    return limited;
}

int integrateVelocities(SolverBatch& batch, Real maxSpeed, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        BodyState& body = batch.states[i];
        const BodyDrive& drive = batch.drives[i];
        body.velocity = drive.decay * body.velocity + drive.gain;
        body.angularVelocity = drive.angularDecay * body.angularVelocity + drive.angularGain;
    }
    if (!(maxSpeed < std::numeric_limits<Real>::infinity())) { return 0; }
    return limitSpeeds(batch, maxSpeed, begin, end);
}

namespace {

Speeds speedsOf(const BodyState& body) {
    return {body.velocity.x, body.velocity.y, body.angularVelocity, body.deltaAngle};
}
void setSpeeds(BodyState& body, const Speeds& speeds) {
    body.velocity = {speeds[0], speeds[1]};
    body.angularVelocity = speeds[2];
}

/// Drives of a whole sub-step, and on top of them what constraints did to the body in the sub-step before.
/// @param free  its speeds without these: before, and then now
/// @return whether the speed was cut
template <bool kIsFirst>
bool integrateAndRepeat(BodyState& body, const BodyDrive& drive, Real maxSpeed, Speeds& free) {
    const Speeds before = speedsOf(body);
    const Speeds decay{drive.decay, drive.decay, drive.angularDecay, 0};
    const Speeds gain{drive.gain.x, drive.gain.y, drive.angularGain, 0};
    Speeds push{};
    Speeds now{};
    for (std::size_t i = 0; i < now.size(); ++i) {
        if constexpr (!kIsFirst) { push[i] = before[i] - free[i]; }
        now[i] = decay[i] * before[i] + gain[i];
    }
    bool isLimited = false;
    if (maxSpeed < std::numeric_limits<Real>::infinity()) {
        setSpeeds(body, now);
        isLimited = limitSpeed(body, maxSpeed);
        now = speedsOf(body);
    }
    free = now;
    if constexpr (!kIsFirst) {
        for (std::size_t i = 0; i < now.size(); ++i) { now[i] += push[i]; }
    }
    setSpeeds(body, now);
    return isLimited;
}

template <bool kIsFirst>
int integrateAndRepeat(SolverBatch& batch, Real maxSpeed, RawVector<Speeds>& free, std::size_t begin, std::size_t end) {
    constexpr Real kNone = std::numeric_limits<Real>::infinity();
    int limited = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const Real own = !(maxSpeed < kNone) || isMovable(batch.inertias[i]) ? maxSpeed : kNone;
        limited += integrateAndRepeat<kIsFirst>(batch.states[i], batch.drives[i], own, free[i]) ? 1 : 0;
    }
    return limited;
}

}  // namespace

int integrateAndRepeat(SolverBatch& batch, Real maxSpeed, bool isFirst, RawVector<Speeds>& free, std::size_t begin,
                       std::size_t end) {
    return isFirst ? integrateAndRepeat<true>(batch, maxSpeed, free, begin, end)
                   : integrateAndRepeat<false>(batch, maxSpeed, free, begin, end);
}

}  // namespace swept::inline SWEPT_PRECISION
