#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "../engine/mixing_rule.h"
#include "../shapes/dvec2.h"

/// A scene as plain data, in double, for every backend: filled by the JSON reader and by the built-in samples, consumed
/// by `makeRunner` (ours in f32 and f64, Box2D) and by the renderer. Defaults are those of the scene format. Metres,
/// kilograms, seconds, radians. Nothing here is validated; `validateScene` does that for both sources.

namespace swept {

struct BoxGeometry {
    DVec2 half;
    DVec2 center;
    double angle = 0;

    bool operator==(const BoxGeometry&) const = default;
};
struct CircleGeometry {
    DVec2 center;
    double radius = 0;

    bool operator==(const CircleGeometry&) const = default;
};
struct CapsuleGeometry {
    std::array<DVec2, 2> points;
    double radius = 0;

    bool operator==(const CapsuleGeometry&) const = default;
};
struct SegmentGeometry {
    std::array<DVec2, 2> points;

    bool operator==(const SegmentGeometry&) const = default;
};
struct PolygonGeometry {
    std::vector<DVec2> points;  ///< any order; every point must be a vertex of their hull

    bool operator==(const PolygonGeometry&) const = default;
};
/// Of one segment of a chain; what is left out is as of the shape.
struct SurfaceDescription {
    std::optional<double> friction{};
    std::optional<double> restitution{};
    std::optional<double> rollingResistance{};
    std::optional<double> surfaceSpeed{};  ///< m/s
    std::optional<MixingRule> frictionMixing{};
    std::optional<MixingRule> restitutionMixing{};

    bool operator==(const SurfaceDescription&) const = default;
};
struct ChainGeometry {
    std::vector<DVec2> points;
    bool loop = false;
    std::optional<DVec2> before{};  ///< where it goes on as another chain: the next point there, beyond the first one
    std::optional<DVec2> after{};   ///< likewise, beyond the last one
    std::vector<SurfaceDescription> surfaces{};  ///< one for each segment; none: all are as the shape

    bool operator==(const ChainGeometry&) const = default;
};
using Geometry =
    std::variant<BoxGeometry, CircleGeometry, CapsuleGeometry, SegmentGeometry, PolygonGeometry, ChainGeometry>;

struct FilterDescription {
    std::uint32_t category = 1;
    std::uint32_t mask = 0xFFFFFFFFu;
    std::int32_t group = 0;

    bool operator==(const FilterDescription&) const = default;
};

struct ShapeDescription {
    Geometry geometry = CircleGeometry{};
    double radius =
        0;  ///< grows box, polygon, segment or chain outwards; 0 for circle and capsule (they have their own)
    double density = 1;
    double friction = 0.6;
    double restitution = 0;
    double rollingResistance = 0;
    double surfaceSpeed = 0;  ///< m/s, clockwise along the outline
    MixingRule frictionMixing = MixingRule::usual;
    MixingRule restitutionMixing = MixingRule::usual;
    bool sensor = false;
    FilterDescription filter;

    bool operator==(const ShapeDescription&) const = default;
};

enum class SceneBodyType : std::uint8_t { fixed, kinematic, dynamic };  ///< `fixed` is "static" in the format
enum class SceneContinuous : std::uint8_t { off, speedLimit, speculative, stop, subStep };
enum class SceneProfile : std::uint8_t { accurate, fast };
enum class SceneBroadphase : std::uint8_t { automatic, allPairs, sortAndSweep, quadtree, grid, bvh, wideBvh };

struct BodyDescription {
    std::string name;  ///< empty: `body<index>`
    SceneBodyType type = SceneBodyType::fixed;
    DVec2 position;
    double angle = 0;
    DVec2 velocity;
    double angularVelocity = 0;
    bool bullet = false;
    bool fixedRotation = false;
    double linearDamping = 0;
    double angularDamping = 0;
    double gravityScale = 1;
    bool awake = true;
    bool allowSleep = true;
    bool enabled = true;                        ///< false: takes no part
    std::optional<SceneContinuous> continuous;  ///< omitted: the world's
    std::optional<double> mass;                 ///< overrides what the shapes give
    std::optional<double> inertia;              ///< about the centre of mass
    std::vector<ShapeDescription> shapes;

    bool operator==(const BodyDescription&) const = default;
};

struct RevoluteDescription {
    DVec2 anchor;
    std::optional<DVec2> anchorB;          ///< omitted: `anchor`
    std::optional<double> referenceAngle;  ///< of B beyond A; omitted: the initial one
    std::optional<double> lower, upper;
    std::optional<double> motorSpeed, maxMotorTorque;
    std::optional<double> hertz, dampingRatio;
    std::optional<double> springTarget;  ///< rad; omitted: 0

    bool operator==(const RevoluteDescription&) const = default;
};
struct DistanceDescription {
    DVec2 anchorA, anchorB;
    std::optional<double> length;  ///< omitted: the initial distance of the anchors
    std::optional<double> minLength, maxLength;
    std::optional<double> hertz, dampingRatio;

    bool operator==(const DistanceDescription&) const = default;
};
struct PrismaticDescription {
    DVec2 anchor;
    std::optional<DVec2> anchorB;          ///< omitted: `anchor`
    std::optional<double> referenceAngle;  ///< of B beyond A; omitted: the initial one
    DVec2 axis;
    std::optional<double> lower, upper;
    std::optional<double> motorSpeed, maxMotorForce;
    std::optional<double> hertz, dampingRatio;
    std::optional<double> springTarget;  ///< metres, along the axis; omitted: 0

    bool operator==(const PrismaticDescription&) const = default;
};
struct WheelDescription {
    DVec2 anchor;
    std::optional<DVec2> anchorB;          ///< omitted: `anchor`
    std::optional<double> referenceAngle;  ///< of B beyond A; omitted: the initial one
    DVec2 axis;
    std::optional<double> lower, upper;
    std::optional<double> motorSpeed, maxMotorTorque;
    std::optional<double> hertz, dampingRatio;
    std::optional<double> springTarget;  ///< as of a prismatic joint; omitted: 0

    bool operator==(const WheelDescription&) const = default;
};
struct WeldDescription {
    DVec2 anchor;
    std::optional<DVec2> anchorB;                     ///< omitted: `anchor`
    std::optional<double> referenceAngle;             ///< of B beyond A; omitted: the initial one
    std::optional<double> linearHertz, angularHertz;  ///< omitted: rigid
    std::optional<double> dampingRatio;

    bool operator==(const WeldDescription&) const = default;
};
struct MotorDescription {
    std::optional<double> referenceAngle;  ///< of B beyond A; omitted: the initial one
    std::optional<DVec2> linearOffset;     ///< in the frame of A; omitted: the initial one
    std::optional<double> angularOffset;
    std::optional<DVec2> linearVelocity;  ///< instead of an offset
    std::optional<double> angularVelocity;
    std::optional<double> maxForce, maxTorque;

    bool operator==(const MotorDescription&) const = default;
};
struct MouseDescription {
    DVec2 target;
    std::optional<DVec2> anchor;  ///< omitted: the point of B at the target
    std::optional<double> hertz, dampingRatio;
    std::optional<double> maxForce;

    bool operator==(const MouseDescription&) const = default;
};
struct GearDescription {
    std::string jointA, jointB;
    double ratio = 1;

    bool operator==(const GearDescription&) const = default;
};
struct PulleyDescription {
    DVec2 groundA, groundB;
    DVec2 anchorA, anchorB;
    double ratio = 1;
    std::optional<double> length;  ///< omitted: the initial one

    bool operator==(const PulleyDescription&) const = default;
};
struct FilterJointDescription {
    bool operator==(const FilterJointDescription&) const = default;
};
using JointGeometry =
    std::variant<RevoluteDescription, DistanceDescription, PrismaticDescription, WheelDescription, WeldDescription,
                 MotorDescription, MouseDescription, GearDescription, PulleyDescription, FilterJointDescription>;

struct JointDescription {
    std::string name;  ///< empty: `joint<index>`
    std::string bodyA, bodyB;
    bool collideConnected = false;
    std::optional<double> breakForce, breakTorque;
    JointGeometry joint = RevoluteDescription{};

    bool operator==(const JointDescription&) const = default;
};

struct SettingsDescription {
    double dt = 1.0 / 60.0;
    SceneProfile profile = SceneProfile::accurate;
    std::optional<int> subSteps;     ///< omitted: the profile's
    std::optional<int> relaxPasses;  ///< omitted: the profile's
    SceneContinuous continuous = SceneContinuous::subStep;
    int maxImpacts = 64;
    std::optional<double> maxSpeed;  ///< omitted: none
    bool sleep = true;
    double sleepSpeed = 0;  ///< m/s
    SceneBroadphase broadphase = SceneBroadphase::automatic;
    std::optional<double> toiTolerance;                                ///< metres; omitted: by extent
    std::optional<double> maxPenetration, maxJointError, maxLostTime;  ///< error budgets

    bool operator==(const SettingsDescription&) const = default;
};

struct ViewDescription {
    DVec2 center;
    double height = 0;  ///< metres, greater than 0

    bool operator==(const ViewDescription&) const = default;
};

struct SceneDescription {
    std::string name;
    DVec2 gravity{0, -9.81};
    std::optional<ViewDescription> view;  ///< omitted: fitted to the bodies
    SettingsDescription settings;
    std::vector<BodyDescription> bodies;
    std::vector<JointDescription> joints;

    bool operator==(const SceneDescription&) const = default;
};

}  // namespace swept
