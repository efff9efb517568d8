#pragma once

#include "impact_case.h"

/// Newton's rule with Coulomb friction at one point, in long double: the three modes are tried one after the other
/// (sticking, sliding either way), and one that satisfies its own conditions is taken. Nothing guards the energy.

namespace swept::test {

struct NewtonResult {
    bool found = false;
    Wide normalImpulse = 0;
    Wide tangentImpulse = 0;
    Wide energyChange = 0;
};

struct PointResponse {
    Wide nn = 0;
    Wide nt = 0;
    Wide tt = 0;
};

inline PointResponse responseOf(const ImpactCase& c) {
    const WideVec n = wide(c.contact.normal);
    const WideVec t = wide(rightPerp(c.contact.normal));
    const Wide mass = Wide(c.inertias[1].inverseMass) + Wide(c.inertias[2].inverseMass);
    PointResponse k{mass, 0, mass};
    for (std::size_t slot = 1; slot < 3; ++slot) {
        const ContactConstraintPoint& point = c.contact.points[0];
        const WideVec arm = wide(slot == 1 ? point.anchorA : point.anchorB);
        const Wide inverse = c.inertias[slot].inverseInertia;
        k.nn += inverse * cross(arm, n) * cross(arm, n);
        k.nt += inverse * cross(arm, n) * cross(arm, t);
        k.tt += inverse * cross(arm, t) * cross(arm, t);
    }
    return k;
}

inline NewtonResult newtonWithFriction(const ImpactCase& c, Wide restitution) {
    const PointResponse k = responseOf(c);
    const Wide approach = approachOf(c, 0);
    const Wide slip = dot(relativeVelocity(c, 0), wide(rightPerp(c.contact.normal)));
    const Wide mu = c.contact.friction;
    const Wide change = (1 + restitution) * approach;
    const auto resultOf = [&](Wide normal, Wide tangent) {
        const Wide endNormal = -approach + k.nn * normal + k.nt * tangent;
        const Wide endSlip = slip + k.nt * normal + k.tt * tangent;
        return NewtonResult{true, normal, tangent, (normal * (endNormal - approach) + tangent * (endSlip + slip)) / 2};
    };
    const Wide determinant = k.nn * k.tt - k.nt * k.nt;
    const Wide stickNormal = (change * k.tt + slip * k.nt) / determinant;
    const Wide stickTangent = (-slip * k.nn - change * k.nt) / determinant;
    if (stickNormal >= 0 && std::fabs(stickTangent) <= mu * stickNormal) { return resultOf(stickNormal, stickTangent); }
    for (const Wide side : {Wide(1), Wide(-1)}) {
        const Wide kSlide = k.nn + side * mu * k.nt;
        if (kSlide <= 0) { continue; }
        const Wide normal = change / kSlide;
        const Wide endSlip = slip + (k.nt + side * mu * k.tt) * normal;
        if (side * endSlip <= 0) { return resultOf(normal, side * mu * normal); }
    }
    return {};
}

}  // namespace swept::test
