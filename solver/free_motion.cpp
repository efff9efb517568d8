#include "free_motion.h"

#include <cstddef>
#include <cstring>
#include <limits>
#include <span>

#include "../shapes/compiler.h"
#include "../shapes/lanes.h"
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

namespace {

/// The first half of a state, as registers of the baseline instruction set. Read and written as a whole: of what is
/// written in pieces the next kernel, which reads it as a whole, would have to wait for all of them.
class SpeedLanes {
    static constexpr std::size_t kLanes = 16 / sizeof(Real);
    static constexpr std::size_t kParts = 4 / kLanes;
    using Lanes = LanesOf<Real, kLanes>;

public:
    SWEPT_FORCE_INLINE static SpeedLanes of(const BodyState& body) { return at(&body.velocity.x); }
    SWEPT_FORCE_INLINE static SpeedLanes of(const Speeds& speeds) { return at(speeds.data()); }

    SWEPT_FORCE_INLINE void writeTo(Speeds& speeds) const { std::memcpy(speeds.data(), parts_, sizeof parts_); }
    /// All but what is no speed. @param before  that of the body
    SWEPT_FORCE_INLINE void writeTo(BodyState& body, const SpeedLanes& before) const {
        SpeedLanes state = *this;
        Lanes& last = state.parts_[kParts - 1];
        if constexpr (kParts == 1) {
            const Lanes turning = shuffled<2, 2, 7, 7>(last, before.parts_[0]);
            last = shuffled<0, 1, 4, 6>(last, turning);  // in two steps, each of which is one instruction
        } else {
            last = shuffled<0, 3>(last, before.parts_[1]);
        }
        std::memcpy(&body.velocity.x, state.parts_, sizeof state.parts_);
    }

    /// In the last lane there is anything.
    SWEPT_FORCE_INLINE SpeedLanes drivenBy(const BodyDrive& drive) const {
        static_assert(offsetof(BodyDrive, angularGain) == 2 * sizeof(Real) &&
                      offsetof(BodyDrive, decay) == 3 * sizeof(Real));
        const SpeedLanes gain = at(&drive.gain.x);
        SpeedLanes driven;
        if constexpr (kParts == 1) {
            Lanes turning{};
            std::memcpy(&turning, &drive.angularDecay, sizeof(Real));
            driven.parts_[0] = shuffled<3, 3, 4, 4>(gain.parts_[0], turning) * parts_[0] + gain.parts_[0];
        } else {
            driven.parts_[0] = drive.decay * parts_[0] + gain.parts_[0];
            driven.parts_[1] = drive.angularDecay * parts_[1] + gain.parts_[1];
        }
        return driven;
    }

    SWEPT_FORCE_INLINE friend SpeedLanes operator+(const SpeedLanes& a, const SpeedLanes& b) {
        SpeedLanes sum;
        for (std::size_t i = 0; i < kParts; ++i) { sum.parts_[i] = a.parts_[i] + b.parts_[i]; }
        return sum;
    }
    SWEPT_FORCE_INLINE friend SpeedLanes operator-(const SpeedLanes& a, const SpeedLanes& b) {
        SpeedLanes difference;
        for (std::size_t i = 0; i < kParts; ++i) { difference.parts_[i] = a.parts_[i] - b.parts_[i]; }
        return difference;
    }

private:
    SWEPT_FORCE_INLINE static SpeedLanes at(const Real* numbers) {
        SpeedLanes lanes;
        std::memcpy(lanes.parts_, numbers, sizeof lanes.parts_);
        return lanes;
    }

    Lanes parts_[kParts];
};

}  // namespace

int integrateVelocities(SolverBatch& batch, Real maxSpeed, std::size_t begin, std::size_t end) {
    BodyState* const states = batch.states.data();  // known not to change, whatever is written
    const BodyDrive* const drives = batch.drives.data();
    for (std::size_t i = begin; i < end; ++i) {
        const SpeedLanes before = SpeedLanes::of(states[i]);
        before.drivenBy(drives[i]).writeTo(states[i], before);
    }
    if (!(maxSpeed < std::numeric_limits<Real>::infinity())) { return 0; }
    return limitSpeeds(batch, maxSpeed, begin, end);
}

namespace {

/// Drives of a whole sub-step, and on top of them what constraints did to the body in the sub-step before.
/// @param free  its speeds without these: before, and then now
/// @return whether the speed was cut
template <bool kIsFirst, bool kIsLimited>
SWEPT_FORCE_INLINE bool integrateAndRepeat(BodyState& body, const BodyDrive& drive, Real maxSpeed, Speeds& free) {
    const SpeedLanes before = SpeedLanes::of(body);
    SpeedLanes now = before.drivenBy(drive);
    bool isLimited = false;
    if constexpr (kIsLimited) {
        now.writeTo(body, before);
        isLimited = limitSpeed(body, maxSpeed);
        now = SpeedLanes::of(body);
    }
    SpeedLanes repeated = now;
    if constexpr (!kIsFirst) { repeated = now + (before - SpeedLanes::of(free)); }
    now.writeTo(free);
    repeated.writeTo(body, before);
    return isLimited;
}

template <bool kIsFirst>
int integrateAndRepeat(SolverBatch& batch, Real maxSpeed, Speeds* free, std::size_t begin, std::size_t end) {
    BodyState* const states = batch.states.data();
    const BodyDrive* const drives = batch.drives.data();
    constexpr Real kNone = std::numeric_limits<Real>::infinity();
    if (!(maxSpeed < kNone)) {
        for (std::size_t i = begin; i < end; ++i) {
            integrateAndRepeat<kIsFirst, false>(states[i], drives[i], maxSpeed, free[i]);
        }
        return 0;
    }
    int limited = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const Real own = isMovable(batch.inertias[i]) ? maxSpeed : kNone;
        limited += integrateAndRepeat<kIsFirst, true>(states[i], drives[i], own, free[i]) ? 1 : 0;
    }
    return limited;
}

}  // namespace

int integrateAndRepeat(SolverBatch& batch, Real maxSpeed, bool isFirst, RawVector<Speeds>& free, std::size_t begin,
                       std::size_t end) {
    return isFirst ? integrateAndRepeat<true>(batch, maxSpeed, free.data(), begin, end)
                   : integrateAndRepeat<false>(batch, maxSpeed, free.data(), begin, end);
}

}  // namespace swept::inline SWEPT_PRECISION
