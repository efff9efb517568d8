#include <gtest/gtest.h>
#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>
#include <swept/samples/scene_units.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "random_scene.h"

namespace swept {
namespace {

std::map<std::string, Dimension> unitMap() {
    std::map<std::string, Dimension> map;
    for (const FieldUnit& row : sceneUnits()) {
        EXPECT_TRUE(map.emplace(row.field, row.dimension).second) << row.field << " is listed twice";
    }
    return map;
}

TEST(SceneUnits, AreThoseOfPhysics) {
    const std::map<std::string, Dimension> units = unitMap();
    const std::map<std::string, std::string> expected{
        {"/gravity", "m/s²"},
        {"/view/center", "m"},
        {"/view/height", "m"},
        {"/settings/dt", "s"},
        {"/settings/maxSpeed", "m/s"},
        {"/settings/toiTolerance", "m"},
        {"/settings/maxPenetration", "m"},
        {"/settings/maxJointError", "m"},
        {"/settings/maxLostTime", "s"},
        {"/settings/sleepSpeed", "m/s"},
        {"/bodies/*/position", "m"},
        {"/bodies/*/angle", "1"},
        {"/bodies/*/velocity", "m/s"},
        {"/bodies/*/angularVelocity", "1/s"},
        {"/bodies/*/linearDamping", "1/s"},
        {"/bodies/*/angularDamping", "1/s"},
        {"/bodies/*/gravityScale", "1"},
        {"/bodies/*/mass", "kg"},
        {"/bodies/*/inertia", "kg·m²"},
        {"/bodies/*/shapes/*/box/half", "m"},
        {"/bodies/*/shapes/*/box/center", "m"},
        {"/bodies/*/shapes/*/box/angle", "1"},
        {"/bodies/*/shapes/*/circle/center", "m"},
        {"/bodies/*/shapes/*/circle/radius", "m"},
        {"/bodies/*/shapes/*/capsule/points/*", "m"},
        {"/bodies/*/shapes/*/capsule/radius", "m"},
        {"/bodies/*/shapes/*/segment/*", "m"},
        {"/bodies/*/shapes/*/polygon/*", "m"},
        {"/bodies/*/shapes/*/chain/points/*", "m"},
        {"/bodies/*/shapes/*/chain/before", "m"},
        {"/bodies/*/shapes/*/chain/after", "m"},
        {"/bodies/*/shapes/*/chain/surfaces/*/friction", "1"},
        {"/bodies/*/shapes/*/chain/surfaces/*/restitution", "1"},
        {"/bodies/*/shapes/*/chain/surfaces/*/rollingResistance", "1"},
        {"/bodies/*/shapes/*/chain/surfaces/*/surfaceSpeed", "m/s"},
        {"/bodies/*/shapes/*/radius", "m"},
        {"/bodies/*/shapes/*/density", "kg/m²"},
        {"/bodies/*/shapes/*/friction", "1"},
        {"/bodies/*/shapes/*/restitution", "1"},
        {"/bodies/*/shapes/*/rollingResistance", "1"},
        {"/bodies/*/shapes/*/surfaceSpeed", "m/s"},
        {"/joints/*/breakForce", "kg·m/s²"},
        {"/joints/*/breakTorque", "kg·m²/s²"},
        {"/joints/*/anchor", "m"},
        {"/joints/*/lower", "1"},
        {"/joints/*/upper", "1"},
        {"/joints/*/motorSpeed", "1/s"},
        {"/joints/*/maxMotorTorque", "kg·m²/s²"},
        {"/joints/*/hertz", "1/s"},
        {"/joints/*/dampingRatio", "1"},
        {"/joints/*/springTarget", "1"},
        {"/joints/*/anchorA", "m"},
        {"/joints/*/anchorB", "m"},
        {"/joints/*/length", "m"},
        {"/joints/*/minLength", "m"},
        {"/joints/*/maxLength", "m"},
        {"/joints/*/axis", "1"},
        {"/joints/*/lower (prismatic)", "m"},
        {"/joints/*/upper (prismatic)", "m"},
        {"/joints/*/springTarget (prismatic)", "m"},
        {"/joints/*/lower (wheel)", "m"},
        {"/joints/*/upper (wheel)", "m"},
        {"/joints/*/springTarget (wheel)", "m"},
        {"/joints/*/motorSpeed (prismatic)", "m/s"},
        {"/joints/*/maxMotorForce", "kg·m/s²"},
        {"/joints/*/linearHertz", "1/s"},
        {"/joints/*/angularHertz", "1/s"},
        {"/joints/*/linearOffset", "m"},
        {"/joints/*/angularOffset", "1"},
        {"/joints/*/linearVelocity", "m/s"},
        {"/joints/*/angularVelocity", "1/s"},
        {"/joints/*/maxForce", "kg·m/s²"},
        {"/joints/*/maxTorque", "kg·m²/s²"},
        {"/joints/*/target", "m"},
        {"/joints/*/ratio", "1"},
        {"/joints/*/groundA", "m"},
        {"/joints/*/groundB", "m"},
        {"/joints/*/referenceAngle", "1"},
    };
    EXPECT_EQ(units.size(), expected.size());
    for (const auto& [field, unit] : expected) {
        const auto row = units.find(field);
        ASSERT_NE(row, units.end()) << field;
        EXPECT_EQ(unitText(row->second), unit) << field;
    }
}

// "/bodies/3/velocity/0" → "/bodies/*/velocity": the index of a component is no part of the field.
// Where a member has another unit in some joint types, the row that has the unit of this joint's type.
std::string fieldOf(const std::string& pointer, const SceneDescription& scene,
                    const std::map<std::string, Dimension>& units) {
    std::string field;
    for (std::size_t i = 0; i < pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', i + 1), pointer.size());
        const bool isIndex = pointer[i + 1] >= '0' && pointer[i + 1] <= '9';
        field += isIndex ? "/*" : pointer.substr(i, end - i);
        i = end;
    }
    const std::string parent = field.substr(0, field.rfind('/'));
    if (units.count(parent) != 0) { return parent; }
    if (field.starts_with("/joints/*/")) {
        const JointGeometry& joint = scene.joints[std::stoul(pointer.substr(8))].joint;
        const std::string own = field + " (" + std::string(jointTypeNames()[joint.index()]) + ")";
        return units.count(own) != 0 ? own : field;
    }
    return field;
}

// Every number in the text of a scene, by its pointer.
std::map<std::string, double> numbersOf(const SceneDescription& scene) {
    std::map<std::string, double> numbers;
    const nlohmann::json flat = nlohmann::json::parse(writeScene(scene)).flatten();
    for (const auto& item : flat.items()) {
        if (item.value().is_number()) { numbers[item.key()] = item.value().get<double>(); }
    }
    return numbers;
}

// A hinge has an angle, a rail a length: the ratio of a gear is in metres per radian, the inverse of that, or a number.
std::optional<Dimension> ratioOfGear(const std::string& pointer, const SceneDescription& scene) {
    if (!pointer.starts_with("/joints/") || !pointer.ends_with("/ratio")) { return std::nullopt; }
    const auto* gear = std::get_if<GearDescription>(&scene.joints[std::stoul(pointer.substr(8))].joint);
    if (gear == nullptr) { return std::nullopt; }
    int length = 0;
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        if (std::holds_alternative<PrismaticDescription>(scene.joints[i].joint)) {
            length += jointName(scene, i) == gear->jointA ? 1 : 0;
            length -= jointName(scene, i) == gear->jointB ? 1 : 0;
        }
    }
    return Dimension{length, 0, 0};
}

TEST(SceneUnits, ScalingMultipliesEveryNumberByItsPowerOfTwo) {
    const std::map<std::string, Dimension> units = unitMap();
    const std::set<std::string> counts{"/settings/subSteps",
                                       "/settings/relaxPasses",
                                       "/settings/maxImpacts",
                                       "/bodies/*/shapes/*/filter/category",
                                       "/bodies/*/shapes/*/filter/mask",
                                       "/bodies/*/shapes/*/filter/group"};
    std::set<std::string> seen;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        test::Random random(seed);
        const int l = random.integer(-10, 10);
        const int m = random.integer(-10, 10);
        const int t = random.integer(-10, 10);
        const SceneDescription scene = test::SceneMaker(seed).make();
        const auto before = numbersOf(scene);
        const auto after = numbersOf(scaled(scene, l, m, t));
        for (const auto& [pointer, value] : before) {
            const std::string field = fieldOf(pointer, scene, units);
            ASSERT_TRUE(units.count(field) == 1 || counts.count(field) == 1) << pointer << " is not in the table";
            const Dimension inTable = units.count(field) != 0 ? units.at(field) : Dimension{};
            const Dimension d = ratioOfGear(pointer, scene).value_or(inTable);
            const double expected = std::ldexp(value, l * d.length + m * d.mass + t * d.time);
            const auto found = after.find(pointer);
            if (found == after.end()) { continue; }  // became a default by scaling
            EXPECT_EQ(found->second, expected) << "seed " << seed << ": " << pointer;
            seen.insert(field);
        }
    }
    for (const auto& row : units) { EXPECT_EQ(seen.count(row.first), 1u) << row.first << " was never scaled"; }
}

TEST(SceneUnits, ScalingIncludesTheDefaults) {
    SceneDescription scene;
    scene.bodies.resize(1);
    scene.bodies[0].shapes.resize(1);
    const SceneDescription result = scaled(scene, 3, 2, 1);
    EXPECT_EQ(result.gravity, (DVec2{0, -9.81 * 8 / 4}));
    EXPECT_EQ(result.settings.dt, 2.0 / 60);
    EXPECT_EQ(result.bodies[0].shapes[0].density, 4.0 / 64);
    EXPECT_EQ(result.bodies[0].shapes[0].friction, 0.6);
    EXPECT_FALSE(result.settings.maxSpeed || result.settings.toiTolerance) << "automatic values stay automatic";
}

TEST(SceneUnits, ScalingBackGivesTheSameScene) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        const SceneDescription scene = builtin.make();
        const SceneDescription there = scaled(scene, 10, -7, 5);
        EXPECT_FALSE(there == scene) << builtin.name;
        EXPECT_TRUE(scaled(there, -10, 7, -5) == scene) << builtin.name;
        EXPECT_FALSE(validateScene(there).has_value()) << builtin.name << ": " << validateScene(there)->text();
        const SceneDescription far = scaled(scene, 100, 100, -100);
        EXPECT_FALSE(validateScene(far, std::numeric_limits<double>::max()).has_value()) << builtin.name;
    }
}

}  // namespace
}  // namespace swept
