#pragma once

#include <cstdint>
#include <span>

#include "../shapes/rotation.h"

namespace swept::inline SWEPT_PRECISION {

/// Place of a body in the arrays of one solve, for this step only. Slot 0 is the fixed world: all static bodies.
using BodySlot = std::uint32_t;
inline constexpr BodySlot kFixedSlot = 0;

/// What the solver reads and writes for every constraint: one element per slot. Motion is relative to the start of the
/// step, so it stays small and precise wherever the body is.
struct BodyState {
    Vec2 velocity{};           ///< of the centre of mass, m/s
    Real angularVelocity = 0;  ///< rad/s
    Real deltaAngle = 0;       ///< turned since the start of the step, rad
    Vec2 deltaPosition{};      ///< moved since the start of the step, m
    Rotation deltaRotation{};  ///< of `deltaAngle`
};
static_assert(sizeof(BodyState) == 8 * sizeof(Real), "a state fills one 8-lane register");

/// Where a state begins in the array of states, bytes: so that a kernel, which asks for sixteen bodies at a time, has
/// an address at once.
using StateOffset = std::uint32_t;
constexpr StateOffset offsetOf(BodySlot slot) { return slot * static_cast<StateOffset>(sizeof(BodyState)); }
constexpr BodySlot slotAt(StateOffset offset) { return offset / static_cast<StateOffset>(sizeof(BodyState)); }

/// Read by every constraint. Zero for static and kinematic bodies.
struct BodyInertia {
    Real inverseMass = 0;     ///< 1/kg
    Real inverseInertia = 0;  ///< 1/(kg·m²)
};

/// What acceleration and damping do within one sub-step h: v ← decay·v + gain, exactly (see `DampedMotion`).
struct BodyDrive {
    Vec2 gain{};           ///< m/s
    Real angularGain = 0;  ///< rad/s
    Real decay = 1;
    Real angularDecay = 1;
};

/// Bodies of a solve, as the kernels see them.
struct SolverBodies {
    std::span<BodyState> states;
    std::span<const BodyInertia> inertias;
};

/// Kinematic bodies are read but never changed by a constraint.
constexpr bool isMovable(const BodyInertia& inertia) { return inertia.inverseMass > 0 || inertia.inverseInertia > 0; }

/// Writes two bodies back. What cannot be moved is shared by many constraints of one colour and must never be written.
inline void storePair(const SolverBodies& bodies, BodySlot slotA, const BodyState& a, BodySlot slotB,
                      const BodyState& b) {
    if (isMovable(bodies.inertias[slotA])) { bodies.states[slotA] = a; }
    if (isMovable(bodies.inertias[slotB])) { bodies.states[slotB] = b; }
}

/// Velocity of a point at `arm` from the centre of mass.
constexpr Vec2 velocityAt(const BodyState& body, Vec2 arm) { return body.velocity + cross(body.angularVelocity, arm); }

/// Applies an impulse (N·s) at `arm` from the centre of mass.
constexpr void applyImpulse(BodyState& body, const BodyInertia& inertia, Vec2 impulse, Vec2 arm) {
    body.velocity += inertia.inverseMass * impulse;
    body.angularVelocity += inertia.inverseInertia * cross(arm, impulse);
}

}  // namespace swept::inline SWEPT_PRECISION
