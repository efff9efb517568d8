#pragma once

#include <limits>
#include <tuple>
#include <type_traits>

#include "scene_description.h"

/// The one table of the scene format: every member of every object with its JSON key, its dimension and its range. The
/// reader, the writer, the validation, the scaling of units and the documentation all walk it.

namespace swept {

/// Powers of length, mass and time. Angles are numbers: all zero.
struct Dimension {
    int length = 0;
    int mass = 0;
    int time = 0;

    bool operator==(const Dimension&) const = default;
};

namespace units {
inline constexpr Dimension kNumber{};
inline constexpr Dimension kLength{1, 0, 0};
inline constexpr Dimension kMass{0, 1, 0};
inline constexpr Dimension kTime{0, 0, 1};
inline constexpr Dimension kRate{0, 0, -1};  // also angular velocity and frequency
inline constexpr Dimension kSpeed{1, 0, -1};
inline constexpr Dimension kAcceleration{1, 0, -2};
inline constexpr Dimension kDensity{-2, 1, 0};
inline constexpr Dimension kInertia{2, 1, 0};
inline constexpr Dimension kForce{1, 1, -2};
inline constexpr Dimension kTorque{2, 1, -2};
}  // namespace units

/// What a number may be; applies to each component of a vector. Every number must be finite besides.
struct Range {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool lowestExcluded = false;
};

namespace bounds {
inline constexpr double kNone = std::numeric_limits<double>::infinity();
inline constexpr Range kAnyNumber{};
inline constexpr Range kNotNegative{0, kNone, false};
inline constexpr Range kPositive{0, kNone, true};
inline constexpr Range kZeroToOne{0, 1, false};
inline constexpr Range kAtLeastOne{1, kNone, false};
inline constexpr Range kSubStepRange{1, 1024, false};
inline constexpr Range kRelaxPassRange{0, 64, false};
}  // namespace bounds

/// One member of an object of the format.
template <class Object, class Value>
struct Field {
    const char* key;
    Value Object::*member;
    Dimension dimension;
    Range range;
    bool required = false;  ///< the JSON must give it, and the writer always does
};

template <class Object, class Value>
constexpr Field<Object, Value> field(const char* key, Value Object::*member, Dimension dimension = units::kNumber,
                                     Range range = bounds::kAnyNumber) {
    return {key, member, dimension, range, false};
}
template <class Object, class Value>
constexpr Field<Object, Value> required(Field<Object, Value> f) {
    f.required = true;
    return f;
}

/// The members of `Object` in the order of the format: a tuple of `Field`; specialised below.
template <class Object>
inline constexpr int kFields = 0;

/// Whether `Object` has a table.
template <class Object>
concept Described = !std::is_same_v<std::remove_cv_t<decltype(kFields<Object>)>, int>;

/// Whether the JSON of `Object` is the bare value of its only member instead of an object.
template <class Object>
inline constexpr bool kBare = false;

/// Calls `visit(field)` for every member of `Object`, in the order of the format.
template <Described Object, class Visitor>
constexpr void forEachField(const Visitor& visit) {
    std::apply([&](const auto&... fields) { (visit(fields), ...); }, kFields<Object>);
}

template <>
inline constexpr auto kFields<BoxGeometry> =
    std::make_tuple(required(field("half", &BoxGeometry::half, units::kLength, bounds::kPositive)),
                    field("center", &BoxGeometry::center, units::kLength), field("angle", &BoxGeometry::angle));

template <>
inline constexpr auto kFields<CircleGeometry> =
    std::make_tuple(field("center", &CircleGeometry::center, units::kLength),
                    required(field("radius", &CircleGeometry::radius, units::kLength, bounds::kPositive)));

template <>
inline constexpr auto kFields<CapsuleGeometry> =
    std::make_tuple(required(field("points", &CapsuleGeometry::points, units::kLength)),
                    required(field("radius", &CapsuleGeometry::radius, units::kLength, bounds::kPositive)));

template <>
inline constexpr auto kFields<SegmentGeometry> = std::make_tuple(required(field("segment", &SegmentGeometry::points,
                                                                                units::kLength)));
template <>
inline constexpr bool kBare<SegmentGeometry> = true;

template <>
inline constexpr auto kFields<PolygonGeometry> = std::make_tuple(required(field("polygon", &PolygonGeometry::points,
                                                                                units::kLength)));
template <>
inline constexpr bool kBare<PolygonGeometry> = true;

template <>
inline constexpr auto kFields<SurfaceDescription> = std::make_tuple(
    field("friction", &SurfaceDescription::friction, units::kNumber, bounds::kNotNegative),
    field("restitution", &SurfaceDescription::restitution, units::kNumber, bounds::kZeroToOne),
    field("rollingResistance", &SurfaceDescription::rollingResistance, units::kNumber, bounds::kNotNegative),
    field("surfaceSpeed", &SurfaceDescription::surfaceSpeed, units::kSpeed),
    field("frictionMixing", &SurfaceDescription::frictionMixing),
    field("restitutionMixing", &SurfaceDescription::restitutionMixing));

template <>
inline constexpr auto kFields<ChainGeometry> =
    std::make_tuple(required(field("points", &ChainGeometry::points, units::kLength)),
                    field("loop", &ChainGeometry::loop), field("before", &ChainGeometry::before, units::kLength),
                    field("after", &ChainGeometry::after, units::kLength), field("surfaces", &ChainGeometry::surfaces));

template <>
inline constexpr auto kFields<FilterDescription> = std::make_tuple(field("category", &FilterDescription::category),
                                                                   field("mask", &FilterDescription::mask),
                                                                   field("group", &FilterDescription::group));

/// Besides these, a shape has one key that names its geometry (`geometryNames`).
template <>
inline constexpr auto kFields<ShapeDescription> = std::make_tuple(
    field("radius", &ShapeDescription::radius, units::kLength, bounds::kNotNegative),
    field("density", &ShapeDescription::density, units::kDensity, bounds::kNotNegative),
    field("friction", &ShapeDescription::friction, units::kNumber, bounds::kNotNegative),
    field("restitution", &ShapeDescription::restitution, units::kNumber, bounds::kZeroToOne),
    field("rollingResistance", &ShapeDescription::rollingResistance, units::kNumber, bounds::kNotNegative),
    field("surfaceSpeed", &ShapeDescription::surfaceSpeed, units::kSpeed),
    field("frictionMixing", &ShapeDescription::frictionMixing),
    field("restitutionMixing", &ShapeDescription::restitutionMixing), field("sensor", &ShapeDescription::sensor),
    field("filter", &ShapeDescription::filter));

template <>
inline constexpr auto kFields<BodyDescription> = std::make_tuple(
    field("name", &BodyDescription::name), field("type", &BodyDescription::type),
    field("position", &BodyDescription::position, units::kLength), field("angle", &BodyDescription::angle),
    field("velocity", &BodyDescription::velocity, units::kSpeed),
    field("angularVelocity", &BodyDescription::angularVelocity, units::kRate),
    field("bullet", &BodyDescription::bullet), field("fixedRotation", &BodyDescription::fixedRotation),
    field("linearDamping", &BodyDescription::linearDamping, units::kRate, bounds::kNotNegative),
    field("angularDamping", &BodyDescription::angularDamping, units::kRate, bounds::kNotNegative),
    field("gravityScale", &BodyDescription::gravityScale), field("awake", &BodyDescription::awake),
    field("allowSleep", &BodyDescription::allowSleep), field("enabled", &BodyDescription::enabled),
    field("continuous", &BodyDescription::continuous),
    field("mass", &BodyDescription::mass, units::kMass, bounds::kPositive),
    field("inertia", &BodyDescription::inertia, units::kInertia, bounds::kPositive),
    field("shapes", &BodyDescription::shapes));

template <>
inline constexpr auto kFields<RevoluteDescription> = std::make_tuple(
    required(field("anchor", &RevoluteDescription::anchor, units::kLength)),
    field("anchorB", &RevoluteDescription::anchorB, units::kLength),
    field("referenceAngle", &RevoluteDescription::referenceAngle), field("lower", &RevoluteDescription::lower),
    field("upper", &RevoluteDescription::upper), field("motorSpeed", &RevoluteDescription::motorSpeed, units::kRate),
    field("maxMotorTorque", &RevoluteDescription::maxMotorTorque, units::kTorque, bounds::kNotNegative),
    field("hertz", &RevoluteDescription::hertz, units::kRate, bounds::kPositive),
    field("dampingRatio", &RevoluteDescription::dampingRatio, units::kNumber, bounds::kNotNegative),
    field("springTarget", &RevoluteDescription::springTarget));

template <>
inline constexpr auto kFields<DistanceDescription> =
    std::make_tuple(required(field("anchorA", &DistanceDescription::anchorA, units::kLength)),
                    required(field("anchorB", &DistanceDescription::anchorB, units::kLength)),
                    field("length", &DistanceDescription::length, units::kLength, bounds::kPositive),
                    field("minLength", &DistanceDescription::minLength, units::kLength, bounds::kNotNegative),
                    field("maxLength", &DistanceDescription::maxLength, units::kLength, bounds::kPositive),
                    field("hertz", &DistanceDescription::hertz, units::kRate, bounds::kPositive),
                    field("dampingRatio", &DistanceDescription::dampingRatio, units::kNumber, bounds::kNotNegative));

template <>
inline constexpr auto kFields<PrismaticDescription> = std::make_tuple(
    required(field("anchor", &PrismaticDescription::anchor, units::kLength)),
    field("anchorB", &PrismaticDescription::anchorB, units::kLength),
    field("referenceAngle", &PrismaticDescription::referenceAngle),
    required(field("axis", &PrismaticDescription::axis)), field("lower", &PrismaticDescription::lower, units::kLength),
    field("upper", &PrismaticDescription::upper, units::kLength),
    field("motorSpeed", &PrismaticDescription::motorSpeed, units::kSpeed),
    field("maxMotorForce", &PrismaticDescription::maxMotorForce, units::kForce, bounds::kNotNegative),
    field("hertz", &PrismaticDescription::hertz, units::kRate, bounds::kPositive),
    field("dampingRatio", &PrismaticDescription::dampingRatio, units::kNumber, bounds::kNotNegative),
    field("springTarget", &PrismaticDescription::springTarget, units::kLength));

template <>
inline constexpr auto kFields<WheelDescription> = std::make_tuple(
    required(field("anchor", &WheelDescription::anchor, units::kLength)),
    field("anchorB", &WheelDescription::anchorB, units::kLength),
    field("referenceAngle", &WheelDescription::referenceAngle), required(field("axis", &WheelDescription::axis)),
    field("lower", &WheelDescription::lower, units::kLength), field("upper", &WheelDescription::upper, units::kLength),
    field("motorSpeed", &WheelDescription::motorSpeed, units::kRate),
    field("maxMotorTorque", &WheelDescription::maxMotorTorque, units::kTorque, bounds::kNotNegative),
    field("hertz", &WheelDescription::hertz, units::kRate, bounds::kPositive),
    field("dampingRatio", &WheelDescription::dampingRatio, units::kNumber, bounds::kNotNegative),
    field("springTarget", &WheelDescription::springTarget, units::kLength));

template <>
inline constexpr auto kFields<WeldDescription> =
    std::make_tuple(required(field("anchor", &WeldDescription::anchor, units::kLength)),
                    field("anchorB", &WeldDescription::anchorB, units::kLength),
                    field("referenceAngle", &WeldDescription::referenceAngle),
                    field("linearHertz", &WeldDescription::linearHertz, units::kRate, bounds::kPositive),
                    field("angularHertz", &WeldDescription::angularHertz, units::kRate, bounds::kPositive),
                    field("dampingRatio", &WeldDescription::dampingRatio, units::kNumber, bounds::kNotNegative));

template <>
inline constexpr auto kFields<MotorDescription> =
    std::make_tuple(field("referenceAngle", &MotorDescription::referenceAngle),
                    field("linearOffset", &MotorDescription::linearOffset, units::kLength),
                    field("angularOffset", &MotorDescription::angularOffset),
                    field("linearVelocity", &MotorDescription::linearVelocity, units::kSpeed),
                    field("angularVelocity", &MotorDescription::angularVelocity, units::kRate),
                    field("maxForce", &MotorDescription::maxForce, units::kForce, bounds::kNotNegative),
                    field("maxTorque", &MotorDescription::maxTorque, units::kTorque, bounds::kNotNegative));

template <>
inline constexpr auto kFields<MouseDescription> =
    std::make_tuple(required(field("target", &MouseDescription::target, units::kLength)),
                    field("anchor", &MouseDescription::anchor, units::kLength),
                    field("hertz", &MouseDescription::hertz, units::kRate, bounds::kPositive),
                    field("dampingRatio", &MouseDescription::dampingRatio, units::kNumber, bounds::kNotNegative),
                    field("maxForce", &MouseDescription::maxForce, units::kForce, bounds::kNotNegative));

/// The unit of `ratio` follows from the types of the two joints: see `gearRatioUnit`.
template <>
inline constexpr auto kFields<GearDescription> = std::make_tuple(required(field("jointA", &GearDescription::jointA)),
                                                                 required(field("jointB", &GearDescription::jointB)),
                                                                 field("ratio", &GearDescription::ratio));

template <>
inline constexpr auto kFields<PulleyDescription> =
    std::make_tuple(required(field("groundA", &PulleyDescription::groundA, units::kLength)),
                    required(field("groundB", &PulleyDescription::groundB, units::kLength)),
                    required(field("anchorA", &PulleyDescription::anchorA, units::kLength)),
                    required(field("anchorB", &PulleyDescription::anchorB, units::kLength)),
                    field("ratio", &PulleyDescription::ratio, units::kNumber, bounds::kPositive),
                    field("length", &PulleyDescription::length, units::kLength, bounds::kPositive));

template <>
inline constexpr auto kFields<FilterJointDescription> = std::make_tuple();

/// Besides these, a joint has `type` and the members of that type.
template <>
inline constexpr auto kFields<JointDescription> = std::make_tuple(
    field("name", &JointDescription::name), required(field("bodyA", &JointDescription::bodyA)),
    required(field("bodyB", &JointDescription::bodyB)), field("collideConnected", &JointDescription::collideConnected),
    field("breakForce", &JointDescription::breakForce, units::kForce, bounds::kPositive),
    field("breakTorque", &JointDescription::breakTorque, units::kTorque, bounds::kPositive));

template <>
inline constexpr auto kFields<SettingsDescription> =
    std::make_tuple(field("dt", &SettingsDescription::dt, units::kTime, bounds::kPositive),
                    field("profile", &SettingsDescription::profile),
                    field("subSteps", &SettingsDescription::subSteps, units::kNumber, bounds::kSubStepRange),
                    field("relaxPasses", &SettingsDescription::relaxPasses, units::kNumber, bounds::kRelaxPassRange),
                    field("continuous", &SettingsDescription::continuous),
                    field("maxImpacts", &SettingsDescription::maxImpacts, units::kNumber, bounds::kAtLeastOne),
                    field("maxSpeed", &SettingsDescription::maxSpeed, units::kSpeed, bounds::kPositive),
                    field("sleep", &SettingsDescription::sleep),
                    field("sleepSpeed", &SettingsDescription::sleepSpeed, units::kSpeed, bounds::kNotNegative),
                    field("broadphase", &SettingsDescription::broadphase),
                    field("toiTolerance", &SettingsDescription::toiTolerance, units::kLength, bounds::kPositive),
                    field("maxPenetration", &SettingsDescription::maxPenetration, units::kLength, bounds::kNotNegative),
                    field("maxJointError", &SettingsDescription::maxJointError, units::kLength, bounds::kNotNegative),
                    field("maxLostTime", &SettingsDescription::maxLostTime, units::kTime, bounds::kNotNegative));

template <>
inline constexpr auto kFields<ViewDescription> =
    std::make_tuple(field("center", &ViewDescription::center, units::kLength),
                    required(field("height", &ViewDescription::height, units::kLength, bounds::kPositive)));

template <>
inline constexpr auto kFields<SceneDescription> = std::make_tuple(
    field("name", &SceneDescription::name), field("gravity", &SceneDescription::gravity, units::kAcceleration),
    field("view", &SceneDescription::view), field("settings", &SceneDescription::settings),
    required(field("bodies", &SceneDescription::bodies)), field("joints", &SceneDescription::joints));

}  // namespace swept
