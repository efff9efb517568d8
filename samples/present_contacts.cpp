#include "present_contacts.h"

#include <algorithm>
#include <map>
#include <string>
#include <variant>

#include "../shapes/aabb.h"
#include "../shapes/manifold.h"
#include "scene_reader.h"
#include "world_builder.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// The i-th edge of a chain, with its neighbours.
ChainSegment segmentOf(const std::vector<Polygon>& edges, std::size_t i, const ChainGeometry& chain) {
    ChainSegment segment;
    segment.p = edges[i].vertices[0];
    segment.q = edges[i].vertices[1];
    segment.radius = edges[i].radius;
    const ChainNeighbours beyond = neighboursOf(chain);
    const bool isInnerStart = chain.loop || i > 0;
    const bool isInnerEnd = chain.loop || i + 1 < edges.size();
    segment.hasBefore = isInnerStart || beyond.before;
    segment.hasAfter = isInnerEnd || beyond.after;
    segment.before =
        isInnerStart ? edges[(i + edges.size() - 1) % edges.size()].vertices[0] : beyond.before.value_or(Vec2{});
    segment.after = isInnerEnd ? edges[(i + 1) % edges.size()].vertices[1] : beyond.after.value_or(Vec2{});
    return segment;
}

}  // namespace

PresentContacts::PresentContacts(const SceneDescription& scene, const SceneWorld& built)
    : built_(built), tree_(makeBroadphase(BroadphaseKind::wideBvh)) {
    std::map<std::string, std::size_t> names;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        addBody(i, scene.bodies[i]);
        names.emplace(bodyName(scene, i), i);
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        const JointDescription& joint = scene.joints[i];
        if (joint.collideConnected || std::holds_alternative<MouseDescription>(joint.joint)) { continue; }
        const std::size_t a = names.at(joint.bodyA);
        const std::size_t b = names.at(joint.bodyB);
        jointed_.emplace(BodyPair{std::min(a, b), std::max(a, b)}, i);
    }
}

const std::vector<PresentContact>& PresentContacts::all(bool hasStepped) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) { place(i); }
    collideAsked(hasStepped);
    return contacts_;
}

const std::vector<PresentContact>& PresentContacts::ofMoved() {
    built_.world.visitMoved([this](BodyId id) { place(static_cast<std::size_t>(built_.world.userData(id))); });
    collideAsked(true);
    return contacts_;
}

void PresentContacts::addBody(std::size_t body, const BodyDescription& description) {
    const BodyId id = built_.bodies[body];
    Placed placed;
    placed.pose = built_.world.transform(id);
    placed.isDynamic = description.type == SceneBodyType::dynamic;
    placed.firstPiece = pieces_.size();
    bodies_.push_back(placed);
    built_.world.visitShapes(id, [&](ShapeId shape) {
        const auto index = static_cast<std::size_t>(shapeOrigin(built_.world.userData(shape)).shape);
        addShape(body, shape, description.shapes[index]);
    });
    bodies_.back().endPiece = pieces_.size();
}

void PresentContacts::addShape(std::size_t body, ShapeId shape, const ShapeDescription& description) {
    if (description.sensor) { return; }
    std::vector<Polygon> polygons;
    built_.world.visitPolygons(shape, [&](const Polygon& polygon) { polygons.push_back(polygon); });
    const auto* const chain = std::get_if<ChainGeometry>(&description.geometry);
    const ProxyKind kind = bodies_[body].isDynamic ? ProxyKind::dynamic : ProxyKind::fixed;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        Piece piece;
        piece.body = body;
        piece.shape = shape;
        piece.filter = built_.world.definition(shape).filter;
        piece.polygon = polygons[i];
        piece.extent = extentOf(polygons[i]);
        hasChains_ = hasChains_ || chain != nullptr;
        if (chain != nullptr) { piece.segment = segmentOf(polygons, i, *chain); }
        const Result<ProxyId> proxy = tree_->insert(boundsOf(polygons[i], bodies_[body].pose), kind);
        if (!proxy.ok()) { continue; }
        piece.proxy = proxy.value();
        pieces_.push_back(piece);  // slots of proxies are given in turn, too
    }
}

void PresentContacts::place(std::size_t body) {
    Placed& placed = bodies_[body];
    placed.pose = built_.world.transform(built_.bodies[body]);
    placed.isAsked = true;
    for (std::size_t i = placed.firstPiece; i < placed.endPiece; ++i) {
        (void)tree_->move(pieces_[i].proxy, boundsOf(pieces_[i].polygon, placed.pose));  // else it stays where it was
    }
}

void PresentContacts::listChainPairs() {
    chainPairs_.clear();
    built_.world.visitContacts([this](const ContactView& contact) {
        chainPairs_.emplace_back(contact.shapeA.index, contact.shapeB.index);  // of a chain and another, it is A
    });
    std::sort(chainPairs_.begin(), chainPairs_.end());
}

void PresentContacts::collideAsked(bool hasStepped) {
    contacts_.clear();
    knowsChainPairs_ = hasStepped;
    if (hasStepped && hasChains_) { listChainPairs(); }
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
        if (!bodies_[body].isAsked) { continue; }
        for (std::size_t i = bodies_[body].firstPiece; i < bodies_[body].endPiece; ++i) { collideWithOthers(i); }
    }
    for (Placed& body : bodies_) { body.isAsked = false; }
}

void PresentContacts::collideWithOthers(std::size_t i) {
    const Piece& piece = pieces_[i];
    others_.clear();
    tree_->query(grown(tree_->box(piece.proxy), kTouchRatio * piece.extent), [&](ProxyId proxy) {
        others_.push_back(static_cast<std::size_t>(proxy));
        return true;
    });
    std::sort(others_.begin(), others_.end());  // the tree tells them in any order
    for (const std::size_t k : others_) {
        const Placed& other = bodies_[pieces_[k].body];
        // Of two that are asked for, the first one has found the pair.
        if (!(other.isAsked && pieces_[k].body < piece.body) && mayMeet(piece, pieces_[k])) {
            const bool isFirst = isA(piece, pieces_[k]);
            collidePair(isFirst ? piece : pieces_[k], isFirst ? pieces_[k] : piece);
        }
    }
}

/// Chains before others, ground before what moves, then by the number of the body.
bool PresentContacts::isA(const Piece& a, const Piece& b) const {
    if (a.segment.has_value() != b.segment.has_value()) { return a.segment.has_value(); }
    const bool dynamicA = bodies_[a.body].isDynamic;
    return dynamicA != bodies_[b.body].isDynamic ? !dynamicA : a.body < b.body;
}

bool PresentContacts::mayMeet(const Piece& a, const Piece& b) const {
    if (a.body == b.body || !(bodies_[a.body].isDynamic || bodies_[b.body].isDynamic)) { return false; }
    if (!shouldCollide(a.filter, b.filter)) { return false; }
    for (const Piece* piece : {&a, &b}) {
        if (!built_.world.isEnabled(built_.bodies[piece->body])) { return false; }
    }
    const auto [first, last] = jointed_.equal_range({std::min(a.body, b.body), std::max(a.body, b.body)});
    return std::none_of(first, last,
                        [this](const auto& joint) { return built_.world.isValid(built_.joints[joint.second]); });
}

void PresentContacts::collidePair(const Piece& a, const Piece& b) {
    if (a.segment && knowsChainPairs_ &&
        !std::binary_search(chainPairs_.begin(), chainPairs_.end(), ShapePair{a.shape.index, b.shape.index})) {
        return;
    }
    const WorldTransform& poseA = bodies_[a.body].pose;
    const Transform bInA = relativeTransform(poseA, bodies_[b.body].pose);
    const Real margin = kTouchRatio * std::min(a.extent, b.extent);
    const Manifold manifold =
        a.segment ? collide(*a.segment, b.polygon, bInA, margin) : collide(a.polygon, b.polygon, bInA, margin);
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        const ManifoldPoint& point = manifold.points[i];
        contacts_.push_back({static_cast<int>(a.body), static_cast<int>(b.body), apply(poseA, point.point),
                             rotate(poseA.rotation, manifold.normal), point.separation});
    }
}

}  // namespace swept::inline SWEPT_PRECISION
