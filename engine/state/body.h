#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "../../shapes/cache_line.h"
#include "../../shapes/transform.h"
#include "../body_def.h"
#include "effort.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {

/// Where an array begins whose elements fill one cache line each in `Real` float, and more than one in double.
inline constexpr std::size_t kLineOfFloats = sizeof(Real) == sizeof(float) ? kCacheLine : alignof(double);

/// Hot state of a body, one element per body slot, in an array of its own: what every stage of the step reads.
struct alignas(kLineOfFloats) BodyMotion {
    DVec2 center{};         ///< of mass, world
    double angle = 0;       ///< unwrapped
    WorldTransform pose{};  ///< of the body frame; follows from centre, angle and local centre
    Vec2 velocity{};        ///< of the centre of mass
    Real angularVelocity = 0;
};

/// Part a body plays in the present step.
enum class BodyRole : std::uint8_t {
    idle,      ///< static or asleep
    free,      ///< nothing holds it: one step of its parabola
    solved,    ///< tied to others by contacts or joints: the sub-stepped solver
    together,  ///< in an island with something fast: the same solver, from impact to impact of the whole island
    flyer,     ///< fast, with nothing but static and kinematic things in its way: the impact loop
};

/// The rest of a body. What every stage asks comes first and close together: of a world of many bodies each line of
/// memory that a stage reads has its price.
struct Body {
    Real inverseMass = 0;
    Real inverseInertia = 0;
    Real extent = 0;  ///< smallest extent of its solid shapes; 0: none
    Real widest = 0;  ///< largest extent of its solid shapes
    Real radius = 0;  ///< farthest solid point from the centre of mass
    Real reach = 0;   ///< farthest point of all, sensors too
    Vec2 localCenter{};
    Vec2 force{};  ///< for the next step
    Real torque = 0;
    /// Of ground that bore it in the last step, or along which it flew, towards it, of any length; 0: none did
    /// (curved_ground.h).
    Vec2 groundNormal{};
    std::uint32_t ground = 0xFFFFFFFFu;  ///< slot of that ground, if it flew there; else it is not known
    std::uint32_t holdingJoints = 0;     ///< of `joints`, those that hold (`Joint::holds`)

    bool awake = false;
    bool fresh = true;            ///< was in no step yet: asleep or awake as it was made
    bool isPut = false;           ///< elsewhere since the last step, or back into the world: it did not move there
    bool touchesDynamic = false;  ///< this step: contact points with a dynamic body
    bool hasContact = false;      ///< this step: contact points with anything solid
    bool deepContact = false;     ///< this step: overlaps something static too far to be swept out of it
    bool sunk = false;            ///< this step: likewise, so far that it is swept however slowly it goes on
    bool bounces = false;         ///< this step: comes back from something static or kinematic, or is about to
    bool rests = false;           ///< this step: something static or kinematic carries it
    bool strikes = false;    ///< gets to something static or kinematic within this step, not slowly, or round a curve
    bool startled = false;   ///< this step: a kinematic body may move over it
    bool fast = false;       ///< this step: startled, or some point may move far (`kFastRatio` and its like)
    bool flung = false;      ///< this step: the solver moved it about as far as only a fast body may
    bool hasSensor = false;  ///< some of its shapes are sensors
    bool hasLine = false;    ///< some of its solid shapes have no thickness at all
    BodyRole role = BodyRole::idle;
    std::uint16_t searchDebt = 0;   ///< what solving its island all at once cost lately (search_debt.h)
    std::uint16_t soughtSteps = 0;  ///< in which it was still, and its island not in balance (balance.h)
    Effort effort;                  ///< of its island, this step
    DVec2 startCenter{};            ///< at the start of this step
    double startAngle = 0;
    /// Smallest `leastPassed` of its shapes, sensors too, metres (body_measures.h).
    Real leastPassed = std::numeric_limits<Real>::infinity();

    BodyDef def;                        ///< as given; pose and velocity there are not kept up to date
    std::vector<std::uint32_t> shapes;  ///< shape slots, in order of creation
    std::vector<std::uint32_t> joints;  ///< joint slots
    double mass = 0;
    double inertia = 0;
    double lostTime = 0;  ///< seconds, of all steps

    DVec2 restCenter{};  ///< pose since which it has hardly moved
    double restAngle = 0;
    double restTime = 0;  ///< seconds it has hardly moved
    int restSteps = 0;
    std::uint32_t nextAsleep = 0;        ///< ring of the bodies that fell asleep, or are held, together
    std::uint32_t heldIn = 0xFFFFFFFFu;  ///< place in `HeldIslands`; then it counts as asleep here, not to the user

    bool isDynamic() const { return def.type == BodyType::dynamic; }
    /// What part of an extent it moves in a step at most where it is not fast.
    Real slowRatio() const { return hasLine ? kLineRatio : kFastRatio; }
};

/// Body pose from centre of mass and rotation, or angle.
constexpr WorldTransform poseOf(DVec2 center, Rotation rotation, Vec2 localCenter) {
    return {center - toDouble(rotate(rotation, localCenter)), rotation};
}
inline WorldTransform poseOf(DVec2 center, double angle, Vec2 localCenter) {
    return poseOf(center, rotationFromAngle(angle), localCenter);
}

}  // namespace swept::inline SWEPT_PRECISION
