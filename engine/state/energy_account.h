#pragma once

#include <cstdint>

#include "../../shapes/vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// What a solve did to an island, J. The excess is what it gained beyond what it was given: gained − springs − motors −
/// returned − work (`excessOf`, energy_gain.h, which says what of that is no error). Unless the island `isFed`, it pays
/// for it, out of the motion of all its bodies (energy_guard.h).
struct EnergyAccount {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    std::uint64_t solve = 0;       ///< that it is about
    std::uint32_t motion = kNone;  ///< of the island, an index

    double kinetic = 0;  ///< at the end
    double gained = 0;   ///< of kinetic energy, since the start
    double work = 0;     ///< of gravity and forces
    double fall = 0;     ///< kinetic energy that they give to what rests, in the same time
    double drift = 0;    ///< kinetic, of how an island goes as a whole that joints alone hold together

    // What gives, beside gravity and forces.
    bool isFed = false;     ///< from outside: by belts, kinematic bodies, calls; what it gains is no error
    bool isSprung = false;  ///< what springs or a target gave is known: to an eighth or so
    double springs = 0;     ///< their work: what they held before the solve, less what they hold after it
    double stored = 0;      ///< what they hold at the end
    /// The most that they may have given, or what targets did give or take (motor_work.h), of what gained.
    double motors = 0;
    double returned = 0;  ///< the most that joints may have given back of what opening them took (lent_energy.h)
    /// Of small gains of many steps, what is beyond all that may add up of them, and what it costs (chain_balance.h).
    double owed = 0;

    // What holds it.
    bool isJointed = false;
    bool isDoubled = false;     ///< two joints tie two of its bodies to each other: they may not agree
    bool gaveWay = false;       ///< where others were solved exactly (`Solver::gaveWay`, `isLeft`)
    bool isYanked = false;      ///< a call moved what a joint holds far: its gap is closed at no cost
    bool isAnchored = false;    ///< joints, or a gear, tie it to what is not dynamic
    std::uint32_t anchors = 0;  ///< such joints

    // What it touches, noted only of what may have gained.
    bool isTouching = false;
    bool meetsGround = false;  ///< what is not dynamic
    bool isGrounded = false;   ///< presses on something static
    bool isOnChain = false;    ///< and that is a chain
    DVec2 push{};              ///< of what is static, all of it, N·s

    // What leads it: joints to kinematic bodies, and those that calls move; and kinematic bodies that it touches, if it
    // is doubled. Noted only of what may have gained.
    bool isLed = false;
    std::uint32_t carrier = kNone;  ///< slot of the kinematic body that turns most
    double leadSpeed = 0;           ///< of the fastest one, m/s
    double leadSpin = 0;            ///< rad/s
    double led = 0;                 ///< kinetic energy, if all of it went along with them

    // What may have gone off (energy_calm.cpp).
    bool isTorn = false;    ///< its joints cannot all hold, and it goes faster than it is led: so it pays
    bool isCalmed = false;  ///< was put back
    Real gapBefore = 0;     ///< of its joints and limits
    Real gapAfter = 0;
    double way = 0;  ///< kinetic, if its bodies had gone evenly to where they are
};

/// What a solve did to one body, J: what its island's account grows by. Of the motion of its centre of mass, and of its
/// turning.
struct EnergyEntry {
    double kinetic = 0;
    double gained = 0;
    double work = 0;
    double fall = 0;
    double turningKinetic = 0;
    double turningGained = 0;
    double turningWork = 0;
    // How the body moved before the solve, m/s and rad/s, and how far in it, metres and radians.
    Vec2 velocityBefore{};
    Vec2 moved{};
    Real spinBefore = 0;
    Real turned = 0;
};

/// What of the motion of a chain damping took, and its own weight: sums over its bodies, of a solve.
struct ChainSums {
    double mass = 0;
    DVec2 before{};  ///< momentum, N·s
    DVec2 after{};
    DVec2 moved{};  ///< mass times way, kg·m
    DVec2 pull{};   ///< of gravity and forces, N
    // As from rest.
    double damped = 0;  ///< J
    DVec2 dampedBefore{};
    DVec2 dampedAfter{};
    // Of the part of its speed that damping takes.
    double leastDamping = 1;
    double mostDamping = 0;
    bool isHeld = false;  ///< some body turns without moving
};

/// An island that gained, as one rigid body.
struct IslandMotion {
    std::uint32_t root = 0;
    double mass = 0;
    DVec2 center{};  ///< of mass, relative to that of the root
    DVec2 velocity{};
    double inertia = 0;
    double spin = 0;
    // What it keeps of that: nothing inside of an island moves or turns it as a whole.
    DVec2 keptVelocity{};
    double keptSpin = 0;
    double share = 1;  ///< what is left of the motion relative to it
    double lift = 0;   ///< of ground that turned under it (`payForLift`), J
};

}  // namespace swept::inline SWEPT_PRECISION
