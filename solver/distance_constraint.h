#pragma once

#include <cstdint>
#include <span>

#include "contact_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// The distance of two anchors is held (rod), kept within limits (rope), or pulled to a length (spring).
/// Anchors relative to the centres of mass, world orientation, at the start of the step.
struct DistanceConstraint {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    Vec2 anchorA;
    Vec2 anchorB;
    Vec2 centerOffset;  ///< centre of B minus centre of A at the start of the step, metres
    Real length = 0;    ///< of rod or spring, metres
    Real minLength = 0;
    Real maxLength = 0;
    Softness softness;  ///< of rod and limits
    Softness spring;
    bool isRigid = true;
    bool hasSpring = false;
    bool hasLimits = false;
    std::uint32_t source = 0;  ///< the engine's name for the joint
    Vec2 axis;                 ///< unit, from A's anchor to B's, renewed each sub-step; kept when the anchors coincide
    /// Accumulated; warm start in, result out. N·s per sub-step.
    Real rigidImpulse = 0;
    Real springImpulse = 0;
    Real lowerImpulse = 0;
    Real upperImpulse = 0;
};

/// Drops warm-start impulses of parts the joint no longer has. The effective mass turns with the axis: it is taken anew in
/// each sub-step.
void prepareDistance(DistanceConstraint& joint);
void warmStartDistances(std::span<DistanceConstraint> joints, const SolverBodies& bodies);
void solveDistances(std::span<DistanceConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);

/// By how much rod or limits are violated now, metres, at least 0. A spring has no error.
Real lengthError(const DistanceConstraint& joint, const BodyState& a, const BodyState& b);

}  // namespace swept::inline SWEPT_PRECISION
