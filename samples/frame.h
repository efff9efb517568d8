#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "../shapes/dvec2.h"

/// What a run shows of itself, in double, whatever the backend and its precision.

namespace swept {

struct BodyFrame {
    DVec2 position;    ///< body origin, world
    double angle = 0;  ///< unwrapped
    DVec2 velocity;    ///< of the centre of mass
    double angularVelocity = 0;
    bool awake = false;  ///< static bodies: false
};

/// Where two bodies touch at the poses of the frame.
struct ContactFrame {
    DVec2 point;
    DVec2 normal;  ///< from a to b
    double separation = 0;
    double impulse = 0;  ///< normal impulse of the step, N·s; of our engine, whose contacts are found anew, 0
};

/// A pose at which a body met something within the step (continuous collision).
struct ImpactFrame {
    int body = 0;
    DVec2 position;
    double angle = 0;
};

/// A pose at a fraction of the step.
struct PoseFrame {
    DVec2 position;
    double angle = 0;
    double fraction = 0;
};

/// The way of a body through the last step: start, impacts, end.
struct WayFrame {
    int body = 0;
    std::vector<PoseFrame> poses;
    double lostSeconds = 0;
};

/// An impact of the last step.
struct HitFrame {
    DVec2 point;
    DVec2 normal;  ///< from a to b
};

/// What continuous collision did in the last step.
struct SweepWork {
    std::uint64_t sweeps = 0;
    std::uint64_t toiCalls = 0;
    std::uint64_t toiIterations = 0;
    std::uint64_t impacts = 0;
    double lostSeconds = 0;
};

/// The state after `step` steps; bodies in scene order.
struct Frame {
    std::int64_t step = 0;
    double time = 0;  ///< step · dt
    std::vector<BodyFrame> bodies;
    std::vector<ContactFrame> contacts;
    std::vector<ImpactFrame> impacts;  ///< by body, in the order of time
    // Only where `RunnerOptions::ways` asked for them:
    std::vector<WayFrame> ways;  ///< of all bodies that moved
    std::vector<HitFrame> hits;
    SweepWork work;
};

enum class SceneEventType : std::uint8_t { begin, end, hit, sensorBegin, sensorEnd, jointBreak };

/// One event of a step. `a`, `b` are indices of bodies in the scene (for jointBreak the joint's bodies), `shapeA`,
/// `shapeB` indices within the body's shapes.
struct SceneEvent {
    std::int64_t step = 0;
    double time = 0;  ///< (step − 1 + fraction) · dt
    double fraction = 0;
    SceneEventType type = SceneEventType::begin;
    int a = 0;
    int b = 0;
    int shapeA = 0;
    int shapeB = 0;
    DVec2 point;
    DVec2 normal;  ///< from a to b
    double approachSpeed = 0;
    double impulse = 0;
    int joint = -1;              ///< of a jointBreak: index of the joint in the scene
    std::uint32_t segmentA = 0;  ///< of a chain, from 0 in the order of its points; of other shapes 0
    std::uint32_t segmentB = 0;
};

/// A named count, in the order in which the backend reports it.
struct NamedNumber {
    std::string name;
    double value = 0;
};

struct LostTime {
    int body = 0;
    double seconds = 0;
    std::string reason;  ///< "stop", "budget", "stuck", "clamp", "speedLimit"
};

/// Between which bodies of the scene the deepest overlap was, and when.
struct DeepestPair {
    double time = 0;
    int a = 0;
    int b = 0;
};

/// Which joint of the scene had the largest error, and when.
struct WorstJoint {
    double time = 0;
    int joint = 0;
};

/// Totals of a run so far.
struct RunReport {
    std::vector<NamedNumber> counters;  ///< sums over all steps
    std::vector<LostTime> lostTime;
    double deepestPenetration = 0;           ///< metres, largest of the start and the ends of all steps
    double largestJointError = 0;            ///< metres, likewise
    std::optional<DeepestPair> deepestPair;  ///< where there was an overlap, of engines that tell
    std::optional<WorstJoint> worstJoint;    ///< likewise
    double startEnergy = 0;                  ///< kinetic and potential, joules (potential 0 at y = 0)
    double endEnergy = 0;
    DVec2 startMomentum;  ///< of dynamic bodies
    DVec2 endMomentum;
    double startAngularMomentum = 0;  ///< about the world origin
    double endAngularMomentum = 0;
    double stepSeconds = 0;                  ///< wall time of the steps alone, of our engine where it measures
    std::optional<std::uint64_t> stateHash;  ///< at the end, of engines that have one
    std::string refusal;                     ///< why the engine refused a step; empty: it did not
    bool finite = true;                      ///< no NaN or infinity in any body's state
};

}  // namespace swept
