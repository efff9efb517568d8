#include "placed_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include <swept/broadphase/broadphase.h>
#include <swept/samples/scene_geometry.h>
#include <swept/samples/scene_reader.h>
#include <swept/shapes/distance.h>
#include <swept/shapes/mass.h>

#include "assemblies.h"

namespace swept {
namespace {

void placePieces(PlacedScene& placed, PlacedBody& body) {
    const std::vector<ShapeDescription>& shapes = body.description->shapes;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const std::vector<Polygon> pieces = piecesOf(shapes[s]);
        const bool isChain = std::holds_alternative<ChainGeometry>(shapes[s].geometry);
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            PlacedPiece piece;
            piece.body = body.index;
            piece.shape = static_cast<int>(s);
            piece.segment = isChain ? static_cast<int>(k) : -1;
            piece.polygon = pieces[k];
            piece.bounds = boundsOf(pieces[k], body.pose);
            piece.extent = extentOf(pieces[k]);
            body.bounds = body.hasBounds ? hullOf(body.bounds, piece.bounds) : piece.bounds;
            body.hasBounds = true;
            if (!shapes[s].sensor) {
                body.extent = body.extent > 0 ? std::min(body.extent, piece.extent) : piece.extent;
            }
            placed.pieces.push_back(piece);
        }
    }
}

/// Mass, centre and what depends on them. @param pieces  of this body
void weigh(PlacedBody& body, std::span<const PlacedPiece> pieces) {
    std::vector<MassProperties> parts;
    for (const PlacedPiece& piece : pieces) {
        const ShapeDescription& shape = body.description->shapes[static_cast<std::size_t>(piece.shape)];
        parts.push_back(massOf(piece.polygon, shape.density));
    }
    const MassProperties sum = combine(parts);
    Vec2 center{sum.center.x, sum.center.y};
    if (sum.mass == 0 && body.hasBounds) {
        center = applyInverse(body.pose, 0.5 * (toDouble(body.bounds.lower) + toDouble(body.bounds.upper)));
    }
    body.center = apply(body.pose, center);
    body.mass = body.isDynamic() ? body.description->mass.value_or(sum.mass) : 0;
    if (body.isDynamic()) {
        const double scaled = sum.mass > 0 ? sum.inertia * (body.mass / sum.mass) : 0;
        body.inertia = body.description->inertia.value_or(scaled);
    }
    for (const PlacedPiece& piece : pieces) { body.reach = std::max(body.reach, radiusAbout(piece.polygon, center)); }
    body.speed = length(body.description->velocity) + std::fabs(body.description->angularVelocity) * body.reach;
}

/// m/s
double driveOf(const PlacedScene& placed, const JointDescription& joint) {
    const auto reachOf = [&placed](const std::string& name) {
        const PlacedBody& body = placed.bodies[static_cast<std::size_t>(bodyNamed(placed, name))];
        return body.isDynamic() ? body.reach : 0;
    };
    if (const auto* const slider = std::get_if<PrismaticDescription>(&joint.joint)) {
        return std::fabs(slider->motorSpeed.value_or(0));
    }
    double spin = 0;
    if (const auto* const hinge = std::get_if<RevoluteDescription>(&joint.joint)) {
        spin = hinge->motorSpeed.value_or(0);
    }
    if (const auto* const wheel = std::get_if<WheelDescription>(&joint.joint)) { spin = wheel->motorSpeed.value_or(0); }
    return std::fabs(spin) * std::max(reachOf(joint.bodyA), reachOf(joint.bodyB));
}

/// What one motor drives may drive all that hangs on it.
void findDrives(PlacedScene& placed) {
    Assemblies assemblies(placed.bodies.size());
    std::vector<double> drives(placed.bodies.size());
    const auto isDynamic = [&placed](int i) { return placed.bodies[static_cast<std::size_t>(i)].isDynamic(); };
    for (const JointDescription& joint : placed.scene->joints) {
        const int a = bodyNamed(placed, joint.bodyA);
        const int b = bodyNamed(placed, joint.bodyB);
        if (isDynamic(a) && isDynamic(b)) { assemblies.join(a, b); }
        double& drive = drives[static_cast<std::size_t>(isDynamic(a) ? a : b)];
        drive = std::max(drive, driveOf(placed, joint));
    }
    for (const PlacedBody& body : placed.bodies) {
        double& whole = placed.bodies[static_cast<std::size_t>(assemblies.rootOf(body.index))].drive;
        whole = std::max(whole, drives[static_cast<std::size_t>(body.index)]);
    }
    for (PlacedBody& body : placed.bodies) {
        body.drive = placed.bodies[static_cast<std::size_t>(assemblies.rootOf(body.index))].drive;
    }
}

void countJoints(PlacedScene& placed) {
    for (const JointDescription& joint : placed.scene->joints) {
        for (const std::string* const name : {&joint.bodyA, &joint.bodyB}) {
            ++placed.bodies[static_cast<std::size_t>(bodyNamed(placed, *name))].joints;
        }
    }
}

void findFarthest(PlacedScene& placed) {
    const double gravity = length(placed.scene->gravity);
    if (!(gravity > 0)) { return; }
    for (const std::size_t against : {std::size_t{0}, std::size_t{1}}) {
        const DVec2 down = ((against == 0 ? 1 : -1) / gravity) * placed.scene->gravity;
        FarthestBodies& farthest = placed.farthest[against];
        for (const PlacedBody& body : placed.bodies) {
            if (!body.hasBounds) { continue; }
            const DVec2 lower = toDouble(body.bounds.lower);
            const DVec2 upper = toDouble(body.bounds.upper);
            const double reach =
                std::max(down.x * lower.x, down.x * upper.x) + std::max(down.y * lower.y, down.y * upper.y);
            farthest.next = std::max(farthest.next, std::min(reach, farthest.reach));
            if (reach > farthest.reach) {
                farthest.first = body.index;
                farthest.reach = reach;
            }
        }
    }
}

/// Calls `visit(i, k)` with i < k, in ascending order, for pieces of which one is of a dynamic body and whose bounds,
/// grown by the margin, overlap. Sensors are left out.
template <class Visit>
void forEachOverlap(const PlacedScene& placed, double margin, const Visit& visit) {
    const std::unique_ptr<Broadphase> tree = makeBroadphase(BroadphaseKind::wideBvh);
    std::vector<int> pieces;  // by slot, which are given in turn
    for (std::size_t i = 0; i < placed.pieces.size(); ++i) {
        const PlacedPiece& piece = placed.pieces[i];
        if (shapeOf(placed, piece).sensor) { continue; }
        const ProxyKind kind = bodyOf(placed, piece).isDynamic() ? ProxyKind::dynamic : ProxyKind::fixed;
        if (tree->insert(grown(piece.bounds, margin), kind).ok()) { pieces.push_back(static_cast<int>(i)); }
    }
    std::vector<ProxyPair> pairs;
    tree->pairs(pairs);
    for (const ProxyPair& pair : pairs) {
        visit(pieces[static_cast<std::size_t>(pair.a)], pieces[static_cast<std::size_t>(pair.b)]);
    }
}

double separationOf(const PlacedScene& placed, const PlacedPiece& a, const PlacedPiece& b) {
    const WorldTransform& poseA = placed.bodies[static_cast<std::size_t>(a.body)].pose;
    const WorldTransform& poseB = placed.bodies[static_cast<std::size_t>(b.body)].pose;
    return distance(a.polygon, b.polygon, relativeTransform(poseA, poseB)).distance;
}

}  // namespace

bool filtersCollide(const FilterDescription& a, const FilterDescription& b) {
    if (a.group != 0 && a.group == b.group) { return a.group > 0; }
    return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

std::set<std::pair<int, int>> jointedPairs(const PlacedScene& placed) {
    std::set<std::pair<int, int>> pairs;
    for (const JointDescription& joint : placed.scene->joints) {
        const bool isMouse = std::holds_alternative<MouseDescription>(joint.joint);  // keeps nobody apart
        if (!joint.collideConnected && !isMouse) {
            const int a = bodyNamed(placed, joint.bodyA);
            const int b = bodyNamed(placed, joint.bodyB);
            pairs.insert({std::min(a, b), std::max(a, b)});
        }
    }
    return pairs;
}

bool mayCollide(const PlacedScene& placed, const PlacedPiece& a, const PlacedPiece& b) {
    const PlacedBody& bodyA = placed.bodies[static_cast<std::size_t>(a.body)];
    const PlacedBody& bodyB = placed.bodies[static_cast<std::size_t>(b.body)];
    const ShapeDescription& shapeA = bodyA.description->shapes[static_cast<std::size_t>(a.shape)];
    const ShapeDescription& shapeB = bodyB.description->shapes[static_cast<std::size_t>(b.shape)];
    const bool takePart = bodyA.description->enabled && bodyB.description->enabled;
    return a.body != b.body && takePart && (bodyA.isDynamic() || bodyB.isDynamic()) && !shapeA.sensor &&
           !shapeB.sensor && filtersCollide(shapeA.filter, shapeB.filter);
}

bool isBehindChain(const PlacedScene& placed, const PlacedPiece& edge, const PlacedPiece& other) {
    if (edge.segment < 0) { return false; }
    const WorldTransform& pose = placed.bodies[static_cast<std::size_t>(edge.body)].pose;
    const DVec2 p = apply(pose, edge.polygon.vertices[0]);
    const DVec2 q = apply(pose, edge.polygon.vertices[1]);
    const DVec2 along = q - p;
    const DVec2 to = placed.bodies[static_cast<std::size_t>(other.body)].center - p;
    return along.x * to.y - along.y * to.x > 0;  // the left-hand side is solid
}

PlacedScene place(const SceneDescription& scene) {
    PlacedScene placed;
    placed.scene = &scene;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        PlacedBody body;
        body.index = static_cast<int>(i);
        body.name = bodyName(scene, i);
        body.description = &scene.bodies[i];
        body.pose = {scene.bodies[i].position, rotationFromAngle(scene.bodies[i].angle)};
        body.center = scene.bodies[i].position;
        const std::size_t first = placed.pieces.size();
        placePieces(placed, body);
        weigh(body, std::span<const PlacedPiece>(placed.pieces).subspan(first));
        placed.byName.emplace(body.name, body.index);
        placed.bodies.push_back(body);
    }
    countJoints(placed);
    findDrives(placed);
    findFarthest(placed);
    return placed;
}

std::vector<NearPair> nearPairs(const PlacedScene& placed, double margin) {
    const auto pieceAt = [&](int i) -> const PlacedPiece& { return placed.pieces[static_cast<std::size_t>(i)]; };
    const std::set<std::pair<int, int>> jointed = jointedPairs(placed);
    std::vector<NearPair> found;
    forEachOverlap(placed, margin, [&](int i, int k) {
        const PlacedPiece& a = pieceAt(i);
        const PlacedPiece& b = pieceAt(k);
        const std::pair<int, int> bodies{std::min(a.body, b.body), std::max(a.body, b.body)};
        if (!overlaps(grown(a.bounds, margin), b.bounds) || !mayCollide(placed, a, b) || jointed.contains(bodies) ||
            isBehindChain(placed, a, b) || isBehindChain(placed, b, a)) {
            return;
        }
        const double separation = separationOf(placed, a, b);
        if (separation <= margin) { found.push_back({i, k, separation}); }
    });
    return found;
}

int bodyNamed(const PlacedScene& placed, const std::string& name) {
    const auto found = placed.byName.find(name);
    return found == placed.byName.end() ? -1 : found->second;
}

std::string pointerOf(const PlacedBody& body) { return "/bodies/" + std::to_string(body.index); }

std::string pointerOf(const PlacedPiece& piece) {
    return "/bodies/" + std::to_string(piece.body) + "/shapes/" + std::to_string(piece.shape);
}

}  // namespace swept
