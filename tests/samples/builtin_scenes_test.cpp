#include <gtest/gtest.h>
#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_reader.h>

#include <swept/shapes/chain.h>
#include <swept/shapes/distance.h>
#include <swept/shapes/hull.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace swept {
namespace {

// The shapes of a body as polygons; a chain as its two-sided segments.
struct PolygonsOf {
    double radius;
    std::vector<Polygon> operator()(const BoxGeometry& g) const {
        return {makeBox({g.half.x, g.half.y}, {g.center.x, g.center.y}, g.angle, radius).value()};
    }
    std::vector<Polygon> operator()(const CircleGeometry& g) const {
        return {makeCircle({g.center.x, g.center.y}, g.radius).value()};
    }
    std::vector<Polygon> operator()(const CapsuleGeometry& g) const {
        return {makeCapsule(toReal(g.points[0]), toReal(g.points[1]), g.radius).value()};
    }
    std::vector<Polygon> operator()(const SegmentGeometry& g) const {
        return {makeSegment(toReal(g.points[0]), toReal(g.points[1]), radius).value()};
    }
    std::vector<Polygon> operator()(const PolygonGeometry& g) const {
        std::vector<Vec2> points;
        for (const DVec2 point : g.points) { points.push_back(toReal(point)); }
        return {convexHull(points, radius).value()};
    }
    std::vector<Polygon> operator()(const ChainGeometry& g) const {
        std::vector<Polygon> segments;
        for (std::size_t i = 1; i < g.points.size(); ++i) {
            segments.push_back(makeSegment(toReal(g.points[i - 1]), toReal(g.points[i]), radius).value());
        }
        return segments;
    }
};

bool mayCollide(const ShapeDescription& a, const ShapeDescription& b) {
    if (a.sensor || b.sensor) { return false; }
    if (a.filter.group == b.filter.group && a.filter.group != 0) { return a.filter.group > 0; }
    return (a.filter.category & b.filter.mask) != 0 && (b.filter.category & a.filter.mask) != 0;
}

bool areJoined(const SceneDescription& scene, std::size_t a, std::size_t b) {
    const std::string nameA = bodyName(scene, a);
    const std::string nameB = bodyName(scene, b);
    for (const JointDescription& joint : scene.joints) {
        if ((joint.bodyA == nameA && joint.bodyB == nameB) || (joint.bodyA == nameB && joint.bodyB == nameA)) {
            return true;
        }
    }
    return false;
}

double smallestDistance(const BodyDescription& a, const BodyDescription& b) {
    const WorldTransform poseA{a.position, rotationFromAngle(a.angle)};
    const WorldTransform poseB{b.position, rotationFromAngle(b.angle)};
    const Transform bInA = relativeTransform(poseA, poseB);
    double smallest = std::numeric_limits<double>::infinity();
    for (const ShapeDescription& shapeA : a.shapes) {
        for (const ShapeDescription& shapeB : b.shapes) {
            if (!mayCollide(shapeA, shapeB)) { continue; }
            for (const Polygon& p : std::visit(PolygonsOf{shapeA.radius}, shapeA.geometry)) {
                for (const Polygon& q : std::visit(PolygonsOf{shapeB.radius}, shapeB.geometry)) {
                    smallest = std::min(smallest, distance(p, q, bInA).distance);
                }
            }
        }
    }
    return smallest;
}

// A scene that starts with overlaps begins with a jolt, which no reader of it would expect.
TEST(BuiltinScenes, StartWithoutOverlap) {
    int touching = 0;
    for (const BuiltinScene& builtin : builtinScenes()) {
        const SceneDescription scene = builtin.make();
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const BodyDescription& a = scene.bodies[i];
                const BodyDescription& b = scene.bodies[j];
                const bool moves = a.type == SceneBodyType::dynamic || b.type == SceneBodyType::dynamic;
                if (!moves || areJoined(scene, i, j)) { continue; }
                const double gap = smallestDistance(a, b);
                EXPECT_GE(gap, -1e-12) << builtin.name << ": " << bodyName(scene, i) << " and " << bodyName(scene, j);
                touching += gap < 1e-12 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(touching, 500) << "stacks touch from the start; was anything measured?";
}

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
