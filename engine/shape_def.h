#pragma once

#include <cstdint>

#include "../shapes/real.h"
#include "mixing_rule.h"

namespace swept {

/// Two shapes collide when their groups are equal and positive; not when equal and negative; else when each one's
/// category is in the other's mask.
struct Filter {
    std::uint32_t category = 1;
    std::uint32_t mask = 0xFFFFFFFFu;
    std::int32_t group = 0;
    constexpr bool operator==(const Filter&) const = default;
};

constexpr bool shouldCollide(const Filter& a, const Filter& b) {
    if (a.group == b.group && a.group != 0) { return a.group > 0; }
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

}  // namespace swept

namespace swept::inline SWEPT_PRECISION {

/// What a shape is to what touches it; each segment of a chain may have one of its own. A pair mixes √(μ₁μ₂),
/// max(e₁, e₂), unless one of the two has another rule, max(c₁, c₂) of rolling resistances and the sum of both surface
/// speeds.
struct Surface {
    Real friction = Real(0.6);  ///< at least 0
    Real restitution = 0;       ///< 0 … 1
    /// A coefficient c, at least 0, mostly much less than 1. Where a pair touches at a single point, a torque of at
    /// most c · r · N opposes that one turns relative to the other: N is the normal force, r the radius of the circle
    /// (of two circles the smaller one; without circles the larger rounding radius; 0 of sharp shapes). A ball rests on
    /// slopes up to tan⁻¹ c. It has no effect on impacts in flight.
    Real rollingResistance = 0;
    /// Along the outline, as of an endless belt, m/s. Where y is up, it runs to the right on top if above 0, and on
    /// round clockwise; on a chain against its direction. Friction carries along what touches it, and keeps that awake
    /// (what sleeps it does not wake); the body stays where it is.
    Real surfaceSpeed = 0;
    MixingRule frictionMixing = MixingRule::usual;
    MixingRule restitutionMixing = MixingRule::usual;
    std::uint64_t material = 0;  ///< what it is made of, for the game (sounds): the world does not look at it
    constexpr bool operator==(const Surface&) const = default;
};

/// Surface and bulk of a shape.
struct ShapeDef {
    Real density = 1;  ///< kg/m², at least 0
    // As of `Surface`.
    Real friction = Real(0.6);
    Real restitution = 0;
    Real rollingResistance = 0;
    Real surfaceSpeed = 0;
    MixingRule frictionMixing = MixingRule::usual;
    MixingRule restitutionMixing = MixingRule::usual;
    bool sensor = false;  ///< reports overlaps with what is no sensor (of fixed bodies: if it can move), never collides
    Filter filter{};
    std::uint64_t userData = 0;
    std::uint64_t material = 0;  ///< as of `Surface`
    constexpr bool operator==(const ShapeDef&) const = default;
};

constexpr Surface surfaceOf(const ShapeDef& def) {
    return {.friction = def.friction,
            .restitution = def.restitution,
            .rollingResistance = def.rollingResistance,
            .surfaceSpeed = def.surfaceSpeed,
            .frictionMixing = def.frictionMixing,
            .restitutionMixing = def.restitutionMixing,
            .material = def.material};
}
/// The same definition with another surface.
constexpr ShapeDef withSurface(ShapeDef def, const Surface& surface) {
    def.friction = surface.friction;
    def.restitution = surface.restitution;
    def.rollingResistance = surface.rollingResistance;
    def.surfaceSpeed = surface.surfaceSpeed;
    def.frictionMixing = surface.frictionMixing;
    def.restitutionMixing = surface.restitutionMixing;
    def.material = surface.material;
    return def;
}

}  // namespace swept::inline SWEPT_PRECISION
