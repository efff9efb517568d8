#include <gtest/gtest.h>
#include <swept/samples/builtin_scenes.h>
#include <swept/samples/scene_reader.h>

#include <set>
#include <string>

namespace swept {
namespace {

TEST(BuiltinScenes, AreValid) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        const auto error = validateScene(builtin.make());
        EXPECT_FALSE(error.has_value()) << builtin.name << ": " << (error ? error->text() : "");
    }
}

TEST(BuiltinScenes, HaveNamesPurposesAndViews) {
    std::set<std::string> names;
    std::set<std::string> purposes;
    for (const BuiltinScene& builtin : builtinScenes()) {
        EXPECT_TRUE(names.insert(builtin.name).second) << builtin.name;
        EXPECT_TRUE(purposes.insert(builtin.purpose).second) << builtin.purpose;
        EXPECT_EQ(std::string(builtin.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos);
        EXPECT_EQ(std::string(builtin.purpose).find('\n'), std::string::npos);
        EXPECT_LE(std::string(builtin.purpose).size(), 90u) << "one line: " << builtin.purpose;
        EXPECT_GT(builtin.duration, 0);
        const SceneDescription scene = builtin.make();
        EXPECT_FALSE(scene.name.empty());
        EXPECT_TRUE(scene.view.has_value()) << builtin.name;
        EXPECT_EQ(findBuiltinScene(builtin.name), &builtin);
    }
    EXPECT_GE(names.size(), 10u);
    EXPECT_EQ(findBuiltinScene("no-such-scene"), nullptr);
}

TEST(BuiltinScenes, AreTheSameEveryTime) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        EXPECT_TRUE(builtin.make() == builtin.make()) << builtin.name;
    }
}

// Together they show what there is to show.
TEST(BuiltinScenes, UseEveryGeometryBodyTypeAndJoint) {
    std::set<std::size_t> geometries;
    std::set<std::size_t> joints;
    std::set<SceneBodyType> types;
    bool hasSensor = false;
    bool hasLimit = false;
    for (const BuiltinScene& builtin : builtinScenes()) {
        const SceneDescription scene = builtin.make();
        for (const BodyDescription& body : scene.bodies) {
            types.insert(body.type);
            for (const ShapeDescription& shape : body.shapes) {
                geometries.insert(shape.geometry.index());
                hasSensor = hasSensor || shape.sensor;
            }
        }
        for (const JointDescription& joint : scene.joints) {
            joints.insert(joint.joint.index());
            const auto* revolute = std::get_if<RevoluteDescription>(&joint.joint);
            hasLimit = hasLimit || (revolute != nullptr && revolute->lower && revolute->upper);
        }
    }
    EXPECT_EQ(geometries.size(), std::variant_size_v<Geometry>);
    EXPECT_EQ(joints.size(), std::variant_size_v<JointGeometry>);
    EXPECT_EQ(types.size(), 3u);
    EXPECT_TRUE(hasSensor);
    EXPECT_TRUE(hasLimit);
}

}  // namespace
}  // namespace swept
