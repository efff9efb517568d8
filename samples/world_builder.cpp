#include "world_builder.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "../shapes/chain.h"
#include "../shapes/hull.h"
#include "engine_refusal.h"
#include "joint_builder.h"
#include "scene_definitions.h"
#include "scene_reader.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

std::vector<Vec2> realPoints(const std::vector<DVec2>& points) {
    std::vector<Vec2> result;
    for (const DVec2 point : points) { result.push_back(toReal(point)); }
    return result;
}

/// All geometries that are one polygon. A chain is not among them.
struct PolygonMaker {
    Real radius;
    Result<Polygon> operator()(const BoxGeometry& g) const {
        return makeBox(toReal(g.half), toReal(g.center), g.angle, radius);
    }
    Result<Polygon> operator()(const CircleGeometry& g) const { return makeCircle(toReal(g.center), realOf(g.radius)); }
    Result<Polygon> operator()(const CapsuleGeometry& g) const {
        return makeCapsule(toReal(g.points[0]), toReal(g.points[1]), realOf(g.radius));
    }
    Result<Polygon> operator()(const SegmentGeometry& g) const {
        return makeSegment(toReal(g.points[0]), toReal(g.points[1]), radius);
    }
    Result<Polygon> operator()(const PolygonGeometry& g) const { return convexHull(realPoints(g.points), radius); }
    Result<Polygon> operator()(const ChainGeometry&) const { return Status{StatusCode::degenerate, "chain"}; }
};

Status addShape(World& world, BodyId body, const ShapeDescription& given, const ShapeDef& def) {
    const Real radius = realOf(given.radius);
    if (const auto* chain = std::get_if<ChainGeometry>(&given.geometry)) {
        const std::vector<Vec2> points = realPoints(chain->points);
        const std::vector<Surface> surfaces = surfacesOfSegments(given);
        return world
            .addChain(body, {.points = points,
                             .loop = chain->loop,
                             .shape = def,
                             .radius = radius,
                             .neighbours = neighboursOf(*chain),
                             .surfaces = surfaces})
            .status();
    }
    const Result<Polygon> polygon = std::visit(PolygonMaker{radius}, given.geometry);
    return polygon.ok() ? world.addShape(body, polygon.value(), def).status() : polygon.status();
}

bool buildBody(const SceneDescription& scene, std::size_t i, SceneWorld& built, std::string& error) {
    const std::string pointer = "/bodies/" + std::to_string(i);
    const BodyDescription& given = scene.bodies[i];
    const Result<BodyId> body = built.world.createBody(bodyDefOf(given, i));
    if (!body.ok()) {
        error = refusalText(pointer, hasKey<BodyDescription>(body.status().field), body.status());
        return false;
    }
    built.bodies[i] = body.value();
    for (std::size_t k = 0; k < given.shapes.size(); ++k) {
        const Status status = addShape(built.world, body.value(), given.shapes[k], shapeDefOf(given.shapes[k], i, k));
        if (!status.ok()) {
            error =
                refusalText(pointer + "/shapes/" + std::to_string(k), hasKey<ShapeDescription>(status.field), status);
            error += whatRoundingDid(status);
            return false;
        }
    }
    // Adding shapes wakes: what the scene lays down asleep goes to sleep when it is complete.
    if (!given.awake && given.enabled && given.type == SceneBodyType::dynamic) {
        (void)built.world.setAwake(body.value(), false);
    }
    return true;
}

bool buildBodies(const SceneDescription& scene, SceneWorld& built, std::string& error) {
    built.bodies.resize(scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!buildBody(scene, i, built, error)) { return false; }
    }
    return true;
}

BodyNames namesOfBodies(const SceneDescription& scene, const SceneWorld& built) {
    BodyNames names;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) { names.emplace(bodyName(scene, i), built.bodies[i]); }
    return names;
}

/// Gears come last: their joints may stand behind them in the scene.
bool buildJoints(const SceneDescription& scene, std::span<const std::size_t> wanted, SceneWorld& built,
                 std::string& error) {
    const BodyNames bodies = namesOfBodies(scene, built);
    JointNames joints;
    for (const bool gears : {false, true}) {
        for (const std::size_t i : wanted) {
            const JointDescription& given = scene.joints[i];
            if (std::holds_alternative<GearDescription>(given.joint) != gears) { continue; }
            const Result<JointId> joint = buildJoint(given, i, bodies, joints, built.world);
            if (!joint.ok()) {
                error =
                    refusalText("/joints/" + std::to_string(i), hasKey(given, joint.status().field), joint.status());
                return false;
            }
            joints.emplace(jointName(scene, i), joint.value());
            built.joints[i] = joint.value();
        }
    }
    return true;
}

}  // namespace

std::vector<Polygon> polygonsOf(const ShapeDescription& shape) {
    const auto* const chain = std::get_if<ChainGeometry>(&shape.geometry);
    if (chain == nullptr) { return {std::visit(PolygonMaker{realOf(shape.radius)}, shape.geometry).value()}; }
    const std::vector<Vec2> points = realPoints(chain->points);
    std::vector<Polygon> edges;
    for (int i = 0; i < chainSegmentCount(static_cast<int>(points.size()), chain->loop); ++i) {
        edges.push_back(polygonOf(chainSegment(points, chain->loop, realOf(shape.radius), i)));
    }
    return edges;
}

bool buildWorld(const SceneDescription& scene, SceneWorld& built, std::string& error) {
    const Status configured = built.world.configure(worldSettingsOf(scene));
    if (!configured.ok()) {
        const bool ofScene = hasKey<SceneDescription>(configured.field);  // gravity
        error = refusalText(ofScene ? "" : "/settings", true, configured);
        return false;
    }
    built.joints.resize(scene.joints.size());
    std::vector<std::size_t> joints(scene.joints.size());
    std::iota(joints.begin(), joints.end(), std::size_t{0});
    return buildBodies(scene, built, error) && buildJoints(scene, joints, built, error);
}

bool rebuildBodies(const SceneDescription& scene, std::span<const std::uint32_t> bodies,
                   std::span<const std::size_t> joints, SceneWorld& built, std::string& error) {
    return std::all_of(bodies.begin(), bodies.end(),
                       [&](std::uint32_t body) { return buildBody(scene, body, built, error); }) &&
           buildJoints(scene, joints, built, error);
}

}  // namespace swept::inline SWEPT_PRECISION
