#pragma once

#include <swept/solver/impacts/impact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "../support/random.h"
#include "numbers.h"

namespace swept::test {

using Wide = long double;

struct WideVec {
    Wide x = 0;
    Wide y = 0;
};
inline WideVec wide(Vec2 v) { return {v.x, v.y}; }
inline WideVec operator+(WideVec a, WideVec b) { return {a.x + b.x, a.y + b.y}; }
inline WideVec operator-(WideVec a, WideVec b) { return {a.x - b.x, a.y - b.y}; }
inline WideVec operator*(Wide s, WideVec a) { return {s * a.x, s * a.y}; }
inline Wide dot(WideVec a, WideVec b) { return a.x * b.x + a.y * b.y; }
inline Wide cross(WideVec a, WideVec b) { return a.x * b.y - a.y * b.x; }
inline Wide apart(Wide a, Wide b) { return std::fabs(a - b); }
inline Wide norm(WideVec a) { return std::sqrt(dot(a, a)); }

enum class Form : std::uint8_t { bar, box, disk };
enum class Partner : std::uint8_t { dynamic, still, kinematic };

/// What kind of impacts to make; the rest is random.
struct ImpactFamily {
    Form form = Form::bar;
    Partner partner = Partner::dynamic;
    int points = 1;
    bool spinningPartner = true;  ///< whether a kinematic partner turns
    double fixedRotationShare = 0.1;
};

/// Two bodies in contact: slot 0 is the world, 1 is A (static and kinematic partners), 2 is B. Point 0 is the origin.
struct ImpactCase {
    std::array<BodyState, 3> states{};
    std::array<BodyInertia, 3> inertias{};
    ContactConstraint contact;

    SolverBodies bodies() { return {states, inertias}; }
    void prepare() { prepareContact(contact, inertias); }
};

/// A body of the given form, with the arm from its centre to a surface point that may touch something in direction
/// `side`.
struct RandomBody {
    double halfLength = 1;
    double halfWidth = 1;
    double mass = 1;
    double inertia = 1;
};
inline RandomBody randomBody(Form form, Random& random) {
    RandomBody body;
    body.halfLength = std::exp2(random.range(-2, 2));
    const double slenderness = form == Form::bar ? random.range(0.005, 0.1) : random.range(0.5, 1);
    body.halfWidth = form == Form::disk ? body.halfLength : slenderness * body.halfLength;
    body.mass = std::pow(10, random.range(-2, 2));
    const double square = body.halfLength * body.halfLength + body.halfWidth * body.halfWidth;
    body.inertia = form == Form::disk ? body.mass * square / 4 : body.mass * square / 3;
    return body;
}

/// Arm to a corner of a bar or box that lies towards `direction` (an angle), or to the rim of a disk.
inline Vec2 armTowards(Form form, const RandomBody& body, double direction, Random& random) {
    if (form == Form::disk) { return turned(direction, body.halfLength, 0); }
    const double lean = random.range(-1.5, 1.5);  // of the body's own axis, from the normal
    const double across = lean > 0 ? -body.halfWidth : body.halfWidth;
    return turned(direction + lean, body.halfLength, across);
}

/// Two bodies that approach at one point, or face to face at two, at any angle, speed and spin.
inline ImpactCase randomImpact(const ImpactFamily& family, std::uint64_t seed) {
    Random random(seed);
    ImpactCase c;
    const double direction = random.range(-3.14, 3.14);
    const Vec2 normal = turned(direction, 1, 0);
    const Vec2 tangent = rightPerp(normal);
    c.contact.slotA = 1;
    c.contact.slotB = 2;
    c.contact.normal = normal;
    c.contact.count = family.points;
    const RandomBody a = randomBody(family.form, random);
    const RandomBody b = randomBody(family.form, random);
    if (family.points == 1) {
        c.contact.points[0].anchorA = armTowards(family.form, a, direction, random);
        c.contact.points[0].anchorB = armTowards(family.form, b, direction + 3.14159265, random);
    } else {
        const double start = random.range(-1, 1);
        const double end = random.chance(0.05) ? start : random.range(-1, 1);
        const double shift = random.range(-0.5, 0.5) * b.halfLength;
        int i = 0;
        for (const double x : {start * b.halfLength, end * b.halfLength}) {
            c.contact.points[static_cast<std::size_t>(i)].anchorA =
                real(a.halfWidth) * normal + real(x + shift) * tangent;
            c.contact.points[static_cast<std::size_t>(i)].anchorB = real(-b.halfWidth) * normal + real(x) * tangent;
            ++i;
        }
    }
    const auto setUp = [&](std::size_t slot, const RandomBody& body, Partner kind) {
        const bool turns = !random.chance(family.fixedRotationShare);
        if (kind == Partner::dynamic) {
            c.inertias[slot] = {real(1 / body.mass), turns ? real(1 / body.inertia) : Real(0)};
        }
        if (kind == Partner::still) { return; }
        c.states[slot].velocity = {real(random.range(-1, 1)), real(random.range(-1, 1))};
        const bool spins = kind == Partner::dynamic ? turns : family.spinningPartner;
        if (spins) { c.states[slot].angularVelocity = real(random.range(-1, 1) / body.halfLength); }
    };
    setUp(1, a, family.partner);
    setUp(2, b, Partner::dynamic);
    // B's share of approach: enough that most points meet, not so much that both always do.
    c.states[2].velocity -= real(random.range(0, 2)) * normal;
    c.contact.restitution = real(random.chance(0.1) ? 1 : random.uniform());
    c.contact.friction = real(random.chance(0.1) ? 0 : random.range(0, 2));
    c.prepare();
    return c;
}

inline WideVec pointVelocity(const BodyState& body, Vec2 arm) {
    return {Wide(body.velocity.x) - Wide(body.angularVelocity) * arm.y,
            Wide(body.velocity.y) + Wide(body.angularVelocity) * arm.x};
}
/// Velocity of B's point against A's.
inline WideVec relativeVelocity(const ImpactCase& c, int i) {
    const ContactConstraintPoint& point = c.contact.points[static_cast<std::size_t>(i)];
    return pointVelocity(c.states[2], point.anchorB) - pointVelocity(c.states[1], point.anchorA);
}
inline Wide approachOf(const ImpactCase& c, int i) { return -dot(relativeVelocity(c, i), wide(c.contact.normal)); }

/// Speeds of which the relative velocity of point i is made: its rounding is some epsilons of this.
inline Wide speedScale(const ImpactCase& c, int i) {
    const ContactConstraintPoint& point = c.contact.points[static_cast<std::size_t>(i)];
    return norm(wide(c.states[1].velocity)) + norm(wide(c.states[2].velocity)) +
           std::fabs(Wide(c.states[1].angularVelocity)) * norm(wide(point.anchorA)) +
           std::fabs(Wide(c.states[2].angularVelocity)) * norm(wide(point.anchorB));
}

/// Kinetic energy of the movable bodies in the frame of A's contact point when A is kinematic or static.
inline Wide kineticEnergy(const ImpactCase& c) {
    const bool bothMove = c.inertias[1].inverseMass > 0;
    const WideVec frame = bothMove ? WideVec{} : pointVelocity(c.states[1], c.contact.points[0].anchorA);
    Wide energy = 0;
    for (std::size_t slot = 1; slot < 3; ++slot) {
        if (!(c.inertias[slot].inverseMass > 0)) { continue; }
        const WideVec v = wide(c.states[slot].velocity) - frame;
        energy += dot(v, v) / (2 * Wide(c.inertias[slot].inverseMass));
        if (!(c.inertias[slot].inverseInertia > 0)) { continue; }
        const Wide spin = c.states[slot].angularVelocity;
        energy += spin * spin / (2 * Wide(c.inertias[slot].inverseInertia));
    }
    return energy;
}

/// Energy that rounding of the stored velocities may add or take: their own rounding times the momentum they carry.
inline Wide energyRounding(const ImpactCase& before, const ImpactCase& after) {
    Wide scale = 0;
    for (const ImpactCase* c : {&before, &after}) {
        const Wide frame = norm(pointVelocity(c->states[1], c->contact.points[0].anchorA));
        for (std::size_t slot = 1; slot < 3; ++slot) {
            if (!(c->inertias[slot].inverseMass > 0)) { continue; }
            const Wide speed = norm(wide(c->states[slot].velocity)) + (c->inertias[1].inverseMass > 0 ? 0 : frame);
            scale += speed * speed / Wide(c->inertias[slot].inverseMass);
            if (!(c->inertias[slot].inverseInertia > 0)) { continue; }
            const Wide spin = c->states[slot].angularVelocity;
            scale += spin * spin / Wide(c->inertias[slot].inverseInertia);
        }
    }
    return 16 * Wide(kEpsilon) * scale;
}

}  // namespace swept::test
