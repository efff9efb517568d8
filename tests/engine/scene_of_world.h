#pragma once

#include <gtest/gtest.h>
#include <swept/engine/world_scene.h>
#include <swept/samples/scene_reader.h>
#include <swept/samples/world_builder.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "world_support.h"

/// Worlds, written as scenes and read again.

namespace swept::test {

/// As its bodies and joints are called in the scene that it was made of: user data are their places there.
inline SceneNames namesOf(const SceneDescription& scene, const World& world) {
    return {.scene = scene.name,
            .ofBody = [&](BodyId id) { return scene.bodies[world.userData(id)].name; },
            .ofJoint = [&](JointId id) { return jointName(scene, world.userData(id)); }};
}

inline SceneWorld rebuilt(const std::string& text, const std::string& what) {
    SceneWorld built;
    const SceneResult read = readScene(text, what, {});
    EXPECT_TRUE(read.scene.has_value()) << read.error.text() << '\n' << text;
    std::string error;
    if (read.scene) { EXPECT_TRUE(buildWorld(*read.scene, built, error)) << what << ": " << error << '\n' << text; }
    return built;
}

template <class Id, class Visit>
std::vector<Id> listOf(const Visit& visit) {
    std::vector<Id> ids;
    visit([&](Id id) { ids.push_back(id); });
    return ids;
}
inline std::vector<BodyId> bodiesOf(const World& world) {
    return listOf<BodyId>([&](auto visit) { world.visitBodies(visit); });
}
inline std::vector<JointId> jointsOf(const World& world) {
    return listOf<JointId>([&](auto visit) { world.visitJoints(visit); });
}
inline std::vector<ShapeId> shapesOf(const World& world, BodyId body) {
    return listOf<ShapeId>([&](auto visit) { world.visitShapes(body, visit); });
}

/// All vertices and radii: a hull may begin with another vertex.
inline std::vector<std::vector<double>> pointsOf(const World& world, ShapeId shape) {
    std::vector<std::vector<double>> points;
    world.visitPolygons(shape, [&](const Polygon& polygon) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
            const DVec2 vertex = toDouble(polygon.vertices[i]);
            points.push_back({vertex.x, vertex.y, static_cast<double>(polygon.radius)});
        }
    });
    std::sort(points.begin(), points.end());
    return points;
}

inline void expectSameShapes(const World& world, BodyId body, const World& other, BodyId twin,
                             const std::string& what) {
    const std::vector<ShapeId> mine = shapesOf(world, body);
    const std::vector<ShapeId> others = shapesOf(other, twin);
    ASSERT_EQ(mine.size(), others.size()) << what;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        EXPECT_EQ(pointsOf(world, mine[i]), pointsOf(other, others[i])) << what;
        const ShapeDef a = world.definition(mine[i]);
        const ShapeDef b = other.definition(others[i]);
        const auto fields = [](const ShapeDef& def) {
            return std::tuple{def.density,      def.friction,       def.restitution,       def.rollingResistance,
                              def.surfaceSpeed, def.frictionMixing, def.restitutionMixing, def.sensor};
        };
        EXPECT_EQ(fields(a), fields(b)) << what;
        EXPECT_TRUE(a.filter == b.filter) << what;
        ASSERT_EQ(world.segmentCount(mine[i]), other.segmentCount(others[i])) << what;
        for (std::uint32_t k = 0; k < world.segmentCount(mine[i]); ++k) {
            EXPECT_EQ(world.surface(mine[i], k), other.surface(others[i], k)) << what << ", segment " << k;
        }
    }
}

inline void expectSameBodies(const World& world, const World& other, const std::string& what) {
    const std::vector<BodyId> mine = bodiesOf(world);
    const std::vector<BodyId> others = bodiesOf(other);
    ASSERT_EQ(mine.size(), others.size()) << what;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        BodyDef a = world.definition(mine[i]);
        BodyDef b = other.definition(others[i]);
        // The world goes by centres of mass.
        const double rounding = 1e-15 * (1 + length(a.position)) +
                                (kIsDouble ? 1e-15 : 1e-6) * length(a.position - world.centerOfMass(mine[i]));
        EXPECT_LE(length(a.position - b.position), rounding) << what << ", body " << i;
        b.position = a.position;
        a.userData = b.userData = 0;
        if (a.type != BodyType::dynamic) { a.awake = b.awake; }  // the format has that of dynamic ones
        EXPECT_TRUE(a == b) << what << ", body " << i;
        // A hull may begin with another vertex, and its area is summed from there.
        EXPECT_NEAR(world.mass(mine[i]), other.mass(others[i]), (kIsDouble ? 1e-6 : 1e-3) * world.mass(mine[i]))
            << what << ", body " << i;
        expectSameShapes(world, mine[i], other, others[i], what + ", body " + std::to_string(i));
    }
}

}  // namespace swept::test
