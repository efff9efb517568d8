#pragma once

#include <cstdint>

#include "../../shapes/dvec2.h"
#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What a joint does along a direction that it leaves free: a spring, a motor, limits that it may not reach. Places and
/// speeds are of B seen from A.
struct IslandDrive {
    enum class Way : std::uint8_t {
        turn,   ///< of B against A
        slide,  ///< of B's anchor along the axis
    };
    enum class Motor : std::uint8_t {
        none,
        pushes,  ///< as hard as it may, until what it drives is as fast as it wants
        holds,   ///< that speed
    };
    Way way = Way::turn;
    Motor motor = Motor::none;
    bool hasSpring = false;
    bool hasLimits = false;
    double place = 0;  ///< at the start of the step, from where the spring rests: rad or metres
    double lower = 0;  ///< of places
    double upper = 0;
    double speed = 0;           ///< that the motor wants, rad/s or m/s
    double most = 0;            ///< that it gives, N·m or N, at least 0
    double push = 0;            ///< likewise, with its sign, where it pushes
    double stiffness = 0;       ///< of the spring, 1/s², times what it moves
    double fixedStiffness = 0;  ///< besides, N/m
    double damping = 0;         ///< likewise, 1/s, times what it moves
    double springRate = 0;      ///< at which it swings, or comes to rest, 1/s
    /// What it moves, kg·m² or kg, where that is the same wherever it stands: `inverseMass` is 0 then.
    double mass = 0;
    // Of the two bodies, else.
    double inverseMass = 0;  ///< of both, 1/kg
    double inverseInertiaOfA = 0;
    double inverseInertiaOfB = 0;
    bool holdsAngle = false;  ///< what slides does not turn
    double motorTotal = 0;    ///< impulse of the step, N·m·s or N·s
    double springTotal = 0;   ///< likewise

    /// What the two bodies resist with, while what the joint holds is held. @param axis  of what slides
    /// @param armOfA,armOfB  from the centres to where the joint's forces act
    double massAt(DVec2 axis, DVec2 armOfA, DVec2 armOfB) const;
};

}  // namespace swept::inline SWEPT_PRECISION
