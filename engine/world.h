#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "../shapes/polygon.h"
#include "../shapes/status.h"
#include "body_def.h"
#include "counters.h"
#include "events.h"
#include "ids.h"
#include "joint_def.h"
#include "queries.h"
#include "shape_def.h"
#include "task_system.h"
#include "world_settings.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// A world of rigid bodies, advanced in fixed steps.
///
/// Every call that takes input checks it first and changes nothing when it refuses (see `Status`). Getters of a stale id
/// return a default value (zeros, false). One thread at a time; queries may run at the same time as each other. What a query
/// or `visitContacts` calls back must not change the world. A world that was moved from may only be assigned to or destroyed.
/// The same calls give the same bits on every machine, compiler and number of threads.
class World {
public:
    World();
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    /// Replaces all settings. Errors: `notFinite`, `outOfRange`, `notPositive` with the name of the member.
    Status configure(const WorldSettings& settings);
    const WorldSettings& settings() const;
    /// Where parallel loops run; null: on the calling thread. Must outlive the world or its replacement.
    void setTaskSystem(TaskSystem* tasks);

    /// Advances by dt > 0 seconds. Errors: `notFinite`, `notPositive`; `missingMass` when a dynamic body has neither shapes
    /// with density nor a mass of its own.
    Status step(double dt);

    // --- bodies
    Result<BodyId> createBody(const BodyDef& def);
    /// Destroys its shapes and joints too, and wakes what touched it.
    Status destroyBody(BodyId id);
    bool isValid(BodyId id) const;
    BodyType type(BodyId id) const;
    DVec2 position(BodyId id) const;       ///< of the body origin, world
    double angle(BodyId id) const;         ///< unwrapped
    DVec2 centerOfMass(BodyId id) const;   ///< world
    Vec2 velocity(BodyId id) const;        ///< of the centre of mass
    Real angularVelocity(BodyId id) const;
    bool isAwake(BodyId id) const;         ///< static bodies never are
    double mass(BodyId id) const;          ///< kg; 0 unless dynamic
    double inertia(BodyId id) const;       ///< kg·m² about the centre of mass; 0 unless dynamic
    std::uint64_t userData(BodyId id) const;
    /// Teleports. Wakes the body and what it touched.
    Status setPose(BodyId id, DVec2 position, double angle);
    Status setVelocity(BodyId id, Vec2 velocity, Real angularVelocity);
    /// For the next step only; wakes the body. Dynamic bodies only.
    Status applyForce(BodyId id, Vec2 force, DVec2 point);
    Status applyTorque(BodyId id, Real torque);
    /// At once; wakes the body. Dynamic bodies only.
    Status applyImpulse(BodyId id, Vec2 impulse, DVec2 point);
    Status setAwake(BodyId id, bool awake);
    std::uint32_t bodyCount() const;

    // --- shapes
    Result<ShapeId> addShape(BodyId body, const Polygon& polygon, const ShapeDef& def = {});
    /// A chain of one-sided segments, on static and kinematic bodies; one id for all of it. Solid on the left of its
    /// direction: ground is listed from right to left, a counter-clockwise loop is solid inside.
    Result<ShapeId> addChain(BodyId body, std::span<const Vec2> points, bool loop, const ShapeDef& def = {},
                             Real radius = 0);
    Status destroyShape(ShapeId id);
    bool isValid(ShapeId id) const;
    BodyId bodyOf(ShapeId id) const;
    std::uint64_t userData(ShapeId id) const;

    // --- joints
    Result<JointId> createJoint(const RevoluteJointDef& def);
    Result<JointId> createJoint(const DistanceJointDef& def);
    Status destroyJoint(JointId id);
    bool isValid(JointId id) const;
    /// How far the joint is from holding at the present poses: gap of the anchors, or violation of rod or limits. Metres.
    Real jointError(JointId id) const;
    Vec2 jointForce(JointId id) const;   ///< on B, in the last sub-step, N
    Real jointTorque(JointId id) const;  ///< on B, in the last sub-step, N·m
    std::uint32_t jointCount() const;

    // --- queries, at the present poses
    CastHit castRay(DVec2 origin, Vec2 translation, const QueryFilter& filter = {}) const;
    /// Calls `visit` for every shape on the ray, in no particular order; it returns the fraction to go on with (see
    /// `Broadphase::ray`).
    void castRayAll(DVec2 origin, Vec2 translation, const QueryFilter& filter,
                    FunctionRef<Real(const CastHit&)> visit) const;
    /// First shape that a polygon meets when it is carried along `translation` without turning.
    CastHit castShape(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                      const QueryFilter& filter = {}) const;
    /// Shapes whose boxes overlap `box`; a visitor that returns false ends the query.
    void queryBox(const Aabb& box, const QueryFilter& filter, FunctionRef<bool(ShapeId)> visit) const;
    /// Shapes that overlap or touch the polygon, exactly.
    void overlapShape(const Polygon& polygon, const WorldTransform& pose, const QueryFilter& filter,
                      FunctionRef<bool(ShapeId)> visit) const;
    /// All contact points there are now.
    void visitContacts(FunctionRef<void(const ContactView&)> visit) const;

    // --- what the last step did
    /// Sorted by fraction, then by the shapes' ids, ends before begins. What calls since the step before ended (bodies and
    /// shapes destroyed or teleported) is among them, at fraction 0; ids may name what is gone. A chain is one shape here.
    std::span<const ContactEvent> contactEvents() const;
    std::span<const JointBreakEvent> jointBreaks() const;
    std::span<const LostTimeEntry> lostTime() const;
    std::span<const ImpactPose> impactPoses() const;
    const StepCounters& counters() const;
    const StageTimes& stageTimes() const;

private:
    std::unique_ptr<WorldState> state_;
};

}  // namespace swept::inline SWEPT_PRECISION
