#include "gear_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::size_t kBodies = 4;

/// What one body contributes to the speed of the gear.
struct GearTerm {
    BodySlot slot = kFixedSlot;
    Vec2 linear;
    Real spin = 0;
};

/// The gear as it stands in this sub-step. Bodies that take part twice have one term; unused terms stay empty.
struct Mesh {
    std::array<GearTerm, kBodies> terms;
    std::size_t count = 0;
    Real error = 0;

    void add(BodySlot slot, Vec2 linear, Real spin) {
        if (slot == kFixedSlot) { return; }
        for (std::size_t i = 0; i < count; ++i) {
            if (terms[i].slot != slot) { continue; }
            terms[i].linear += linear;
            terms[i].spin += spin;
            return;
        }
        terms[count++] = {slot, linear, spin};
    }
};

/// Adds one side to the mesh, with its weight.
void addSide(Mesh& mesh, const GearSide& side, Real weight, const SolverBodies& bodies) {
    const BodyState& a = bodies.states[side.slotA];
    const BodyState& b = bodies.states[side.slotB];
    if (!side.slides) {
        mesh.add(side.slotA, {}, -weight);
        mesh.add(side.slotB, {}, weight);
        mesh.error += weight * (b.deltaAngle - a.deltaAngle);
        return;
    }
    const Vec2 axis = rotate(a.deltaRotation, side.axis);
    const Vec2 armB = rotate(b.deltaRotation, side.anchorB);
    const Vec2 before = side.centerOffset + side.anchorB - side.anchorA;
    const Vec2 offset =
        side.centerOffset + (b.deltaPosition - a.deltaPosition) + armB - rotate(a.deltaRotation, side.anchorA);
    const JointRow row = rowAlong(axis, rotate(a.deltaRotation, side.anchorA) + offset, armB);
    mesh.add(side.slotA, -weight * axis, -weight * row.spinA);
    mesh.add(side.slotB, weight * axis, weight * row.spinB);
    mesh.error += weight * (dot(axis, offset) - dot(side.axis, before));
}

Mesh meshOf(GearConstraint& gear, const SolverBodies& bodies) {
    Mesh mesh;
    mesh.error = gear.baseError;
    addSide(mesh, gear.first, 1, bodies);
    addSide(mesh, gear.second, gear.ratio, bodies);
    gear.axisNow = rotate(bodies.states[gear.second.slotA].deltaRotation, gear.second.axis);
    return mesh;
}

/// The fixed slot has no term, and kinematic bodies take no impulse: neither is written.
void apply(const Mesh& mesh, const SolverBodies& bodies, Real impulse) {
    for (std::size_t i = 0; i < mesh.count; ++i) {
        const GearTerm& term = mesh.terms[i];
        const BodyInertia& inertia = bodies.inertias[term.slot];
        if (!(inertia.inverseMass > 0) && !(inertia.inverseInertia > 0)) { continue; }
        BodyState& body = bodies.states[term.slot];
        body.velocity += (inertia.inverseMass * impulse) * term.linear;
        body.angularVelocity += inertia.inverseInertia * term.spin * impulse;
    }
}

void solveOne(GearConstraint& gear, const SolverBodies& bodies, bool useBias) {
    const Mesh mesh = meshOf(gear, bodies);
    Real inverse = 0;
    Real speed = 0;
    for (std::size_t i = 0; i < mesh.count; ++i) {
        const GearTerm& term = mesh.terms[i];
        const BodyInertia& inertia = bodies.inertias[term.slot];
        const BodyState& body = bodies.states[term.slot];
        inverse += inertia.inverseMass * lengthSquared(term.linear) + inertia.inverseInertia * square(term.spin);
        speed += dot(term.linear, body.velocity) + term.spin * body.angularVelocity;
    }
    if (!(inverse > 0)) { return; }
    const Real change = scalarChange(1 / inverse, speed, useBias ? mesh.error : Real(0), gear.impulse,
                                     useBias ? gear.softness : kRigid);
    gear.impulse += change;
    apply(mesh, bodies, change);
}

}  // namespace

std::array<BodySlot, 4> bodySlots(const GearConstraint& gear) {
    return {gear.first.slotA, gear.first.slotB, gear.second.slotA, gear.second.slotB};
}

void prepare(GearConstraint&, std::span<const BodyInertia>) {}

void warmStart(std::span<GearConstraint> gears, const SolverBodies& bodies) {
    for (GearConstraint& gear : gears) { apply(meshOf(gear, bodies), bodies, gear.impulse); }
}

void solve(std::span<GearConstraint> gears, const SolverBodies& bodies, Real, bool useBias) {
    for (GearConstraint& gear : gears) { solveOne(gear, bodies, useBias); }
}

JointReaction reactionOf(const GearConstraint& gear) {
    const Real onSecond = gear.ratio * gear.impulse;
    if (gear.second.slides) { return {onSecond * gear.axisNow, 0}; }
    return {{}, onSecond};
}

}  // namespace swept::inline SWEPT_PRECISION
