#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../shapes/chain.h"
#include "../shapes/hull.h"
#include "../shapes/polygon.h"
#include "../shapes/status.h"
#include "../shapes/transform.h"
#include "body_def.h"
#include "chain_def.h"
#include "contact_filter.h"
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
struct SceneNames;

/// A world of rigid bodies, advanced in fixed steps.
///
/// Every call that takes input checks it first and changes nothing when it refuses (see `Status`). Getters of a stale
/// id return a default value (zeros, false). Calls must not overlap in time, except that const calls may run at once.
/// Callbacks of queries and visits may change the world: results were collected before the first callback; those that
/// were destroyed since are skipped, those that were moved or made since may be missing or out of date. A world that
/// was moved from may only be assigned to, loaded into or destroyed. The same calls give the same bits on every
/// machine, compiler and number of threads.
///
/// Where memory runs out, `std::bad_alloc` comes through (in a loop that other threads share, and in a library without
/// exceptions, it ends the program). A call that was to make a body, shape, chain or joint has made nothing then, and
/// with the default broadphase the world can be used on; `load` has changed nothing. After any other call, step and
/// assignment included, it may only be assigned to, by a snapshot for example, loaded into, or destroyed.
class World {
public:
    World();
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    /// A snapshot: everything, ids and the events of the last step included. From equal calls on, the copy and the
    /// original go on with the same bits. Copying into a world that was one of these before reuses its memory. The task
    /// system and the contact filter are the same; two worlds may be stepped at the same time if these allow that.
    World(const World& other);
    World& operator=(const World& other);
    /// A snapshot as bytes, for files and other machines: all that a copy has, with the user data. They are read by
    /// builds of the same precision and the same members of a world, in practice the same version, whatever compiler,
    /// machine and threads they are for. Copies have equal bytes. So have worlds that the same calls lead to,
    /// unless they measure their stages' times, or differ in threads or vector instructions: these change what a step
    /// knows already, but not what it does. (`stateHash` tells whether two machines agree.)
    std::vector<std::uint8_t> save() const;
    /// Becomes the world that was saved, and goes on with its bits. What the host gave stays: the task system, and the
    /// contact filter, which is not asked about contacts that there are; it is to be the one that the saved world had,
    /// or `setContactFilter` is to be called again afterwards. Changes nothing where it refuses, or memory runs out.
    /// Errors: `damaged` with "bytes" where they were cut off or changed; `otherBuild` with "precision", or with
    /// "layout" or "version" where the library has other members. Only for bytes from someone you trust: who means harm
    /// can make some that look whole.
    Status load(std::span<const std::uint8_t> bytes);

    /// Replaces all settings. Another gravity wakes all that fell asleep; so does `sleep` where it is turned off.
    /// Errors: `notFinite`, `outOfRange`, `negative`, `notPositive` with the name of the member; `notNow` with
    /// "broadphase" when another one is asked for while the world has shapes.
    Status configure(const WorldSettings& settings);
    const WorldSettings& settings() const;
    /// m/s²; all other settings stay. Wakes all that fell asleep, where it is another one. Errors: as of configure.
    Status setGravity(Vec2 gravity);
    /// Where parallel loops run; null: on the calling thread. Must outlive the world or its replacement.
    void setTaskSystem(TaskSystem* tasks);
    /// Who else decides which shapes may touch (contact_filter.h); null: nobody. Must outlive the world, its copies, or
    /// its replacement. Asks anew about all pairs of shapes, also if it is the same one, for filters that follow the
    /// state of the game: what it forbids now ends, what it allows begins, and all wakes. Takes as long as a step in
    /// which everything moved.
    void setContactFilter(const ContactFilter* filter);

    /// Advances by dt > 0 seconds. Errors: `notFinite`, `notPositive`; `outOfRange` when dt or 1/dt is above 2⁶³ (in
    /// f64 2⁵¹¹); `missingMass` when a dynamic body has neither shapes with density nor a mass of its own, or
    /// shapes so large that their mass is no number (its `mass` is 0; `bodyWithoutMass`).
    Status step(double dt);

    // Errors of all calls below that return a `Status` or a `Result`: `staleId` of what is not there, `notFinite` of
    // NaN and infinities, and `outOfRange` of numbers beyond ±2⁶³ (in f64 ±2⁵¹¹; of joints only points, axes and linear
    // drives are held to that). Others are listed at each. What makes something may have `noIdsLeft`, too.

    // --- bodies
    /// Errors: `negative` (damping, mass, inertia); `wrongBodyType` with "velocity" where what is static would move or
    /// turn; `outOfRange` with "angularVelocity" where rotation is fixed, and for enumerators that there are not.
    Result<BodyId> createBody(const BodyDef& def);
    /// Destroys its shapes and joints too, and wakes what touched it.
    Status destroyBody(BodyId id);
    bool isValid(BodyId id) const;
    BodyType type(BodyId id) const;
    DVec2 position(BodyId id) const;                ///< of the body origin, world
    double angle(BodyId id) const;                  ///< rad, counter-clockwise, unwrapped
    DVec2 centerOfMass(BodyId id) const;            ///< world
    WorldTransform transform(BodyId id) const;      ///< of the body frame: where its shapes are, to the bit
    Vec2 velocity(BodyId id) const;                 ///< of the centre of mass, m/s
    Vec2 velocityAt(BodyId id, DVec2 point) const;  ///< of the point of the body that is there now, world, m/s
    Real angularVelocity(BodyId id) const;          ///< rad/s
    bool isAwake(BodyId id) const;                  ///< static and disabled bodies never are, kinematic ones always
    double mass(BodyId id) const;                   ///< kg; 0 unless dynamic
    double inertia(BodyId id) const;                ///< kg·m² about the centre of mass; 0 unless dynamic
    std::uint64_t userData(BodyId id) const;
    /// As it was made or redefined; pose, velocities, `awake` and `enabled` as they are now.
    BodyDef definition(BodyId id) const;
    /// Gives a body another definition; its pose and velocities stay as they are (but for those that the new one does
    /// not allow), and so do its shapes and joints, and whether it is enabled. Wakes it, unless only `userData` changes
    /// and there is no contact filter. A new type ends the body's contacts, and new ones begin in the next step; with a
    /// contact filter another `userData` does the same. A joint is inactive while none of its bodies is dynamic (see
    /// setEnabled).
    /// Errors: as of createBody; `wrongBodyType` with "type" where it has chains and would be dynamic.
    Status redefine(BodyId id, const BodyDef& def);
    /// Changes some members of the definition of a body, shape or joint, and redefines it:
    /// `world.modify(id, [](BodyDef& def) { def.gravityScale = 0; })`. Errors: as of redefine.
    template <class Id, class Change>
    Status modify(Id id, const Change& change) {
        auto def = definition(id);
        if (isValid(id)) { change(def); }  // of a stale id it may not be what `change` expects
        return redefine(id, def);
    }
    /// Teleports a body of any type, its origin to `position` (world, metres) and turned to `angle` (rad): contacts
    /// end, and begin anew where it is. Wakes the body and what it touched. What is to push others on its way (a lift)
    /// is given a velocity instead: a static body that is put into one that sleeps does not wake it. Joints pull the
    /// rest of a jointed group after it, at any speed.
    Status setPose(BodyId id, DVec2 position, double angle);
    Status setPose(BodyId id, DVec2 position) { return setPose(id, position, angle(id)); }  ///< as it is turned now
    /// Of the centre of mass, m/s, and rad/s; wakes the body. Errors: `wrongBodyType` of static bodies; `outOfRange`
    /// with "angularVelocity" where rotation is fixed.
    Status setVelocity(BodyId id, Vec2 velocity, Real angularVelocity);
    // Of one of the two; the other stays as it is.
    Status setVelocity(BodyId id, Vec2 velocity) { return setVelocity(id, velocity, angularVelocity(id)); }
    Status setAngularVelocity(BodyId id, Real speed) { return setVelocity(id, velocity(id), speed); }
    /// Gives a kinematic body the velocities that take its origin to `position` (world, metres) and turn it to `angle`
    /// (rad) in a step of `dt` seconds; they stay until others are given. Errors: `wrongBodyType` of others;
    /// `notPositive` dt; `outOfRange` with "position" or "angle" where that is farther than a body may be fast; as of
    /// setVelocity.
    Status driveTo(BodyId id, DVec2 position, double angle, double dt);
    Status driveTo(BodyId id, DVec2 position, double dt) { return driveTo(id, position, angle(id), dt); }
    /// What is disabled takes no part: it does not move, meets nothing, no query finds it (but for those about one
    /// shape), and its joints are off. It keeps its id, shapes, joints, pose and velocities, all of which may be
    /// changed meanwhile. To disable it ends its contacts, forgets its forces, and wakes what touched it and what its
    /// joints held; enabled again it is awake, and moves on from where it is. Its joints pull their bodies together
    /// again by the shorter way round, never by more than half a turn (whole turns are forgotten), and gears go on from
    /// the present angles. For bodies that come and go, without making them anew.
    Status setEnabled(BodyId id, bool enabled);
    bool isEnabled(BodyId id) const;
    // The calls below are for dynamic bodies only; errors: `wrongBodyType` of others, `outOfRange` when the sum of the
    // forces or the new velocity is beyond that range, `disabled` where that is for bodies that take part (forces,
    // `setAwake`).
    /// N at `point` (world), for the next step only, with what was applied before; wakes the body unless told
    /// otherwise. One that depends on positions adds energy unless it is that of half a step ahead (GUIDE.md).
    Status applyForce(BodyId id, Vec2 force, DVec2 point, Wake wake = Wake::yes);
    Status applyForce(BodyId id, Vec2 force);  ///< at the centre of mass; wakes the body
    /// At the centre of mass. (A `{}` in this place stays a point: the origin.)
    Status applyForce(BodyId id, Vec2 force, std::same_as<Wake> auto wake) {
        return applyForce(id, force, centerOfMass(id), wake);
    }
    Status applyTorque(BodyId id, Real torque, Wake wake = Wake::yes);  ///< N·m, counter-clockwise; likewise
    /// N·s at `point` (world), at once; wakes the body.
    Status applyImpulse(BodyId id, Vec2 impulse, DVec2 point);
    Status applyImpulse(BodyId id, Vec2 impulse);         ///< likewise, at the centre of mass
    Status applyAngularImpulse(BodyId id, Real impulse);  ///< N·m·s, counter-clockwise; likewise
    /// Wakes it and all that fell asleep with it, or puts it alone to sleep: at rest, forces applied to it forgotten.
    Status setAwake(BodyId id, bool awake);
    std::uint32_t bodyCount() const;
    /// The first body that keeps `step` from going on (`missingMass`); the null id if there is none.
    BodyId bodyWithoutMass() const;
    /// All bodies, in the order of their slots.
    void visitBodies(FunctionRef<void(BodyId)> visit) const;
    /// The shapes of a body, in the order in which they were added; none of a stale id.
    void visitShapes(BodyId id, FunctionRef<void(ShapeId)> visit) const;
    /// The joints of a body; none of a stale id.
    void visitJoints(BodyId id, FunctionRef<void(JointId)> visit) const;

    // --- shapes
    /// The velocity of a dynamic body that was in no step yet is that of its centre, wherever shapes put that. Else,
    /// and whenever shapes go or have another density, all its points go on as they did. One of a static body wakes
    /// nobody: what sleeps where it is put sleeps on, in it, until something else wakes it. A segment without a radius
    /// collides, on a dynamic body, as if it had one of 1/4096 of its length. Errors: as of `validate` (polygon.h);
    /// `negative` (density, friction); `outOfRange` with "restitution", the two mixings, and in f64 "density" (of
    /// dynamic bodies; `isWeighable` in mass.h); `notFinite`.
    Result<ShapeId> addShape(BodyId body, const Polygon& polygon, const ShapeDef& def = {});
    /// A chain of one-sided segments, on static and kinematic bodies; one id for all of it. Solid on the left of its
    /// direction: ground is listed from right to left, a counter-clockwise loop is solid inside (to queries it is not:
    /// they see its segments). What comes from the left passes: a level one is a platform to jump onto from below.
    /// A shape that comes through is held once all of it is on the right; what turns back before that falls out again.
    /// Where it goes on as another chain (of the same body, or both fixed), `neighbours` are the next points
    /// there, in the frame of this one's body: nothing catches on where they meet, and the end stops nothing that comes
    /// from beside.
    /// Errors: `wrongBodyType` of dynamic bodies; with "points" `tooFewVertices` (fewer than 2, of a loop 3) and
    /// `degenerate` (two neighbours are equal, as where a loop repeats its first point: it closes by itself);
    /// `negative` (radius); with "before" and "after" `degenerate` (equal to that end) and `outOfRange` (of a loop); of
    /// `def` as of addShape.
    Result<ShapeId> addChain(BodyId body, std::span<const Vec2> points, bool loop, const ShapeDef& def = {},
                             Real radius = 0, const ChainNeighbours& neighbours = {});
    /// Likewise, by name, and with a surface for each segment. Errors: also `outOfRange` with "surfaces" where there
    /// are some, but not as many as segments; of each as of addShape.
    Result<ShapeId> addChain(BodyId body, const ChainDef& def);
    Status destroyShape(ShapeId id);
    bool isValid(ShapeId id) const;
    BodyId bodyOf(ShapeId id) const;
    std::uint64_t userData(ShapeId id) const;
    /// Of a chain with the surface of its first segment.
    ShapeDef definition(ShapeId id) const;
    /// Another surface, density, filter, … of the same geometry. Wakes the body, unless `userData` alone is another,
    /// and, with another surface or filter, what it touches. With another filter, or another `sensor`, all its contacts
    /// end, and those that it may have now begin in the next step. Where there is a contact filter, another `userData`
    /// counts as another filter. The segments of a chain keep surfaces of their own unless `def` has another surface
    /// than `definition` tells: then all have that. Errors: of `def` as of addShape.
    Status redefine(ShapeId id, const ShapeDef& def);
    /// Another geometry of the same shape, which keeps its id and definition: what crouches, or grows. Mass and centre
    /// are those of the new one, the velocity stays that of each point. All its contacts end, and those that it has now
    /// begin in the next step; wakes the body and what it touched. Errors: as of addShape; `notConvex` with "shape" of
    /// a chain.
    Status reshape(ShapeId id, const Polygon& polygon);
    /// Segments of a chain, in the order of its points: what has a `segment` names one of them, from 0. Of other shapes
    /// 1, of a stale id 0.
    std::uint32_t segmentCount(ShapeId id) const;
    /// Of a segment of a chain, or of another shape, which has segment 0 alone; the default one where there is none.
    Surface surface(ShapeId id, std::uint32_t segment = 0) const;
    /// Of one segment, or of all, one for each. Wakes what touches those that change, and the body, unless `material`
    /// alone is another; contacts go on. Errors: `outOfRange` with "segment", or "surfaces" where there are not as many
    /// as segments; of each surface as of addShape.
    Status setSurface(ShapeId id, std::uint32_t segment, const Surface& surface);
    Status setSurfaces(ShapeId id, std::span<const Surface> surfaces);
    /// What it is made of, in the frame of its body: one polygon, or the segments of a chain; none of a stale id.
    void visitPolygons(ShapeId id, FunctionRef<void(const Polygon&)> visit) const;
    /// The smallest box around it where it is now, world, rounded outward; of a stale id an empty one at the origin.
    Aabb bounds(ShapeId id) const;

    // --- joints
    /// Errors: `notDistinct` with "bodyB", and with "jointB" of a gear; `wrongBodyType` with "bodyB" where neither body
    /// is dynamic, or B of a mouse joint is not; `wrongJointType` of what cannot be geared; `notPositive` (hertz, break
    /// force and torque, the length of a rod, spring or pulley); `negative` (damping, strengths, shortest length, ratio
    /// of a pulley); `degenerate` with "axis"; `outOfRange` where an upper limit is below the lower one, of a ratio of
    /// 0, or one that makes the sum of lengths or coordinates too large, and where a drive has both offset and
    /// velocity.
    Result<JointId> createJoint(const RevoluteJointDef& def);
    Result<JointId> createJoint(const DistanceJointDef& def);
    Result<JointId> createJoint(const PrismaticJointDef& def);
    Result<JointId> createJoint(const WheelJointDef& def);
    Result<JointId> createJoint(const WeldJointDef& def);
    Result<JointId> createJoint(const MotorJointDef& def);
    Result<JointId> createJoint(const MouseJointDef& def);
    Result<JointId> createJoint(const GearJointDef& def);
    Result<JointId> createJoint(const PulleyJointDef& def);
    Result<JointId> createJoint(const FilterJointDef& def);
    /// Destroys the gears that it is part of, too, and wakes its bodies.
    Status destroyJoint(JointId id);
    bool isValid(JointId id) const;
    JointType type(JointId id) const;
    std::uint64_t userData(JointId id) const;
    /// As it was made, with the points of that time, and what setters changed since. (A gear names the bodies that it
    /// found.) Of a stale id a hinge of no bodies.
    AnyJointDef definition(JointId id) const;
    BodyId bodyA(JointId id) const;  ///< the null id of a stale one
    BodyId bodyB(JointId id) const;
    /// Gives a joint another definition of its kind, and touches only what is other in it: limits, motors, springs,
    /// lengths, drives and targets as their setters do, strengths, ratios, `collideConnected`, break limits,
    /// `userData`. Its bodies, points, axes, reference angles, geared joints and the rope of a pulley stay, whatever
    /// `def` says of them, and so does a length where it has none. Another ratio begins where the bodies are: the error
    /// of a gear and the slack of a pulley stay as they are. Wakes the bodies, unless break limits and `userData` alone
    /// are others. Errors: `wrongJointType` of another kind; `outOfRange` of a ratio that would leave the rope of a
    /// pulley no length, as it may be where it is stretched far beyond it; else as of createJoint.
    Status redefine(JointId id, const AnyJointDef& def);
    DVec2 anchorA(JointId id) const;  ///< where on A it holds now, world; of a mouse joint its target
    DVec2 anchorB(JointId id) const;
    // Setters of one part wake the bodies of the joint. Errors: `wrongJointType` where the joint has no such part; else
    // as of createJoint. Limits, and lengths of rods, that are set anew before every step move on smoothly within each:
    // what they hold goes along, and gets their speed, of this step or the one before, whichever is less. What is set
    // for a single step, or moved by more than the bodies are wide, draws them there and gives them no speed.
    Status setAngularMotor(JointId id, std::optional<AngularMotor> motor);             ///< revolute, wheel
    Status setLinearMotor(JointId id, std::optional<LinearMotor> motor);               ///< prismatic
    Status setAngleLimits(JointId id, std::optional<AngleLimits> limits);              ///< revolute
    Status setTranslationLimits(JointId id, std::optional<TranslationLimits> limits);  ///< prismatic, wheel
    Status setLengthLimits(JointId id, std::optional<LengthLimits> limits);            ///< distance
    Status setLength(JointId id, Real length);                                         ///< distance: rod, spring
    Status setSpring(JointId id, std::optional<Spring> spring);  ///< revolute, distance, prismatic, wheel, mouse
    /// Rad or metres, as limits are. What it holds is drawn there by the spring, also from far away, and by whole
    /// turns: `jointAngle` tells how many there are. Errors: `notFinite` and `outOfRange` with "springTarget".
    Status setSpringTarget(JointId id, Real target);  ///< revolute, prismatic, wheel
    Status setWeldSprings(JointId id, std::optional<Spring> linear, std::optional<Spring> angular);
    Status setTarget(JointId id, DVec2 target);            ///< mouse
    Status setDrive(JointId id, const MotorDrive& drive);  ///< motor
    /// Does not wake: what a sleeping joint bears it bore before.
    Status setBreakLimits(JointId id, std::optional<Real> force, std::optional<Real> torque);
    /// How far the joint is from holding at the present poses, metres: gap of the anchors, distance from the axis,
    /// violation of rod, rope or limits of length, slip of a gear that begins with a prismatic joint. What is a spring
    /// or a drive has no error, and limits of angles and translations do not count.
    Real jointError(JointId id) const;
    Real jointAngleError(JointId id) const;  ///< likewise, rad: prismatic, weld, gears that begin with a revolute joint
    double jointAngle(JointId id) const;     ///< of B relative to A (joint_def.h), unwrapped
    Real jointTranslation(
        JointId id) const;  ///< of B's anchor from A's: along the axis where there is one, else the distance
    // How fast these two grow, by the present velocities.
    Real jointAngularVelocity(JointId id) const;  ///< rad/s
    Real jointSpeed(JointId id) const;            ///< of jointTranslation, m/s; of a mouse joint as if its target stood
    Vec2 jointForce(JointId id) const;            ///< on B at its anchor, mean of the last step, N
    Real jointTorque(JointId id) const;           ///< on B, mean of the last step, N·m
    std::uint32_t jointCount() const;
    /// All joints, in the order of their slots.
    void visitJoints(FunctionRef<void(JointId)> visit) const;

    // --- queries, at the present poses; nothing is found for what is no number, a translation of 0, a bad polygon.
    // Chains are met from either side.
    CastHit castRay(DVec2 origin, Vec2 translation, const QueryFilter& filter = {}) const;
    /// Where the ray meets one shape, a sensor or disabled as it may be, whatever else is on its way; nothing for a
    /// stale id.
    CastHit castRay(ShapeId id, DVec2 origin, Vec2 translation) const;
    /// Calls `visit` for every shape on the ray, the nearest first. It returns the fraction of the ray to go on with: 1
    /// goes on, that of the hit shortens the ray to it, 0 ends the query. Of a chain for each segment, from either
    /// side.
    void castRayAll(DVec2 origin, Vec2 translation, const QueryFilter& filter,
                    FunctionRef<Real(const CastHit&)> visit) const;
    /// First shape that a polygon meets when it is carried along `translation` without turning. It is stopped about
    /// 1/1024 of the smaller shape's extent before it touches. What it is in contact with at the start (as near as
    /// that, or overlapping by up to 1/8 of that extent) stops it at fraction 0 if the way leads against the normal of
    /// that contact, and is passed over otherwise: a character may look ahead from where it stands, over seams of its
    /// ground as well. So it is free along what stopped it: a way without the part into the normal passes, though
    /// beside a sharp corner only the next such way may. What overlaps deeper stops it at fraction 0, whatever the way,
    /// without a normal: `CastHit::wayOut` leads out.
    CastHit castShape(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                      const QueryFilter& filter = {}) const;
    /// Calls `visit` with where each shape is met, as by castShape, and in the manner of castRayAll.
    void castShapeAll(const Polygon& polygon, const WorldTransform& pose, Vec2 translation, const QueryFilter& filter,
                      FunctionRef<Real(const CastHit&)> visit) const;
    /// Shapes whose boxes overlap `box`, which may be infinite; a visitor that returns false ends the query.
    void queryBox(const Aabb& box, const QueryFilter& filter, FunctionRef<bool(ShapeId)> visit) const;
    /// Shapes that overlap or touch the polygon, exactly; a visitor that returns false ends the query.
    void overlapShape(const Polygon& polygon, const WorldTransform& pose, const QueryFilter& filter,
                      FunctionRef<bool(ShapeId)> visit) const;
    /// The shape that is nearest to a point, or to a polygon, no farther than `reach` metres (finite). Of those that
    /// overlap it the one that is deepest. It costs least where something is near, whatever the reach.
    NearestShape nearest(DVec2 point, Real reach, const QueryFilter& filter = {}) const;
    NearestShape nearest(const Polygon& polygon, const WorldTransform& pose, Real reach,
                         const QueryFilter& filter = {}) const;
    /// Where one shape is nearest to a point, however far; nothing for a stale id.
    NearestShape nearest(ShapeId id, DVec2 point) const;
    /// All contact points there are now, also of what is near and does not touch: `separation` tells. They were found
    /// as the last step began (of what went from impact to impact, later in it: before its `begin` is told), and their
    /// bodies moved since.
    void visitContacts(FunctionRef<void(const ContactView&)> visit) const;
    // What one body touches, or overlaps a sensor. The third of these calls after a step lists all contacts by shape;
    // from then on each takes as long as its answer.
    /// The contact points of one body, A and B as in the list of all; none of a stale id.
    void visitContacts(BodyId id, FunctionRef<void(const ContactView&)> visit) const;
    /// What overlaps a sensor: all whose `sensorBegin` was reported, and not its end, but for what calls put elsewhere
    /// or took away since. None of a stale id, or of what is no sensor.
    void visitOverlaps(ShapeId sensor, FunctionRef<void(ShapeId)> visit) const;

    // --- what the last step did
    // The lists stay as they are until the next step, whatever is destroyed while one goes through them, or until the
    // world is assigned to, loaded into or destroyed.
    /// Sorted by fraction, then by the lower index of the two shapes' ids, then by the higher one, ends before begins.
    /// What calls between the step before and this one ended (bodies and shapes destroyed or teleported) is among them,
    /// at fraction 0; ids may name what is gone. A chain is one shape here.
    std::span<const ContactEvent> contactEvents() const;
    /// All bodies that the step moved or turned, and none that it left where it was, so that a game need not ask each.
    /// What fell asleep is among them, if that step still moved it. What was put elsewhere since may be, what was
    /// destroyed is not.
    void visitMoved(FunctionRef<void(BodyId)> visit) const;
    std::span<const JointBreakEvent> jointBreaks() const;
    /// Bodies whose state overflowed in the last step: they are at rest where they were before it.
    std::span<const BodyId> bodiesPutBack() const;
    /// Bodies that fell asleep at the end of the last step, whether it still moved them or not, in the order of their
    /// slots. What `setAwake` puts to sleep is not among them.
    std::span<const BodyId> bodiesFellAsleep() const;
    std::span<const LostTimeEntry> lostTime() const;
    std::span<const ImpactPose> impactPoses() const;
    const StepCounters& counters() const;
    const StageTimes& stageTimes() const;

    /// Of ids, poses, velocities and sleep of all bodies, bit for bit, in the order of their slots: two machines that
    /// compare it after each step, or a replay, know at once where they began to differ.
    std::uint64_t stateHash() const;

private:
    friend std::string sceneOf(const World& world, const SceneNames& names);  // world_scene.h

    std::unique_ptr<WorldState> state_;
};

}  // namespace swept::inline SWEPT_PRECISION
