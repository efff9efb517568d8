#include <algorithm>
#include <cmath>

#include "../../shapes/manifold_batch.h"
#include "../../shapes/room.h"
#include "../bodies/awake.h"
#include "../bodies/body_mass.h"
#include "../bodies/body_measures.h"
#include "../bodies/proxies.h"
#include "../bodies/world_boxes.h"
#include "../contacts/contact_making.h"
#include "../contacts/pairs_of_shapes.h"
#include "../state/number_range.h"
#include "../state/world_state.h"
#include "../world.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Status check(const ShapeDef& def) {
    const Status numbers = firstFault({checkNumber(static_cast<double>(def.density), "density"),
                                       checkNumber(static_cast<double>(def.friction), "friction"),
                                       checkNumber(static_cast<double>(def.rollingResistance), "rollingResistance"),
                                       checkNumber(static_cast<double>(def.surfaceSpeed), "surfaceSpeed")});
    if (!numbers.ok()) { return numbers; }
    if (def.density < 0) { return {StatusCode::negative, "density"}; }
    if (def.friction < 0) { return {StatusCode::negative, "friction"}; }
    if (def.rollingResistance < 0) { return {StatusCode::negative, "rollingResistance"}; }
    if (!isFinite(def.restitution)) { return {StatusCode::notFinite, "restitution"}; }
    if (def.restitution < 0 || def.restitution > 1) { return {StatusCode::outOfRange, "restitution"}; }
    if (def.frictionMixing > MixingRule::maximum) { return {StatusCode::outOfRange, "frictionMixing"}; }
    if (def.restitutionMixing > MixingRule::maximum) { return {StatusCode::outOfRange, "restitutionMixing"}; }
    return Status::success();
}

Status checkSize(std::span<const Vec2> points, Real radius, const char* field) {
    for (const Vec2 point : points) {
        const Status status = checkNumber(point, field);
        if (!status.ok()) { return status; }
    }
    return checkNumber(static_cast<double>(radius), "radius");
}

/// All that may fail when memory runs out, before a shape is made, but for its proxy.
void makeRoomForShape(WorldState& world, Body& body) {
    world.shapes.makeRoomForOne();
    const std::size_t count = world.shapes.slotsWithOneMore();
    makeRoom(world.chainSegments, count);
    makeRoom(world.shapeMasses, count);
    makeRoom(world.proxyShapes, world.proxyShapes.size() + 1);  // the lowest free proxy is taken first
    makeRoom(world.neededBoxes, world.proxyShapes.size() + 1);
    makeRoom(body.shapes, body.shapes.size() + 1);
    if (body.isDynamic()) { makeRoom(world.massParts, body.shapes.size() + 1); }
    makeRoomToWake(world);
}

/// Longer side of their box, metres.
Real spanOf(std::span<const Vec2> points) {
    Vec2 lower = points[0];
    Vec2 upper = points[0];
    for (const Vec2 point : points) {
        lower = {std::min(lower.x, point.x), std::min(lower.y, point.y)};
        upper = {std::max(upper.x, point.x), std::max(upper.y, point.y)};
    }
    return std::max(upper.x - lower.x, upper.y - lower.y);
}

/// Puts a shape into the world: slot, proxy, list of the body.
/// @param leastExtent  of a segment of a chain without radius, which is as large as its chain: how finely a curve is
/// cut up says nothing of how far a body may sink into it
Result<ShapeId> insert(WorldState& world, std::uint32_t body, Shape shape, Real leastExtent = 0) {
    shape.body = body;
    shape.extent = std::max(leastExtent, extentOf(shape.polygon));
    shape.size = radiusAbout(shape.polygon, {});
    shape.isBatched = shape.isChainSegment ? collidesInBatches(shape.segment) : collidesInBatches(shape.polygon);
    if (shape.isBatched && shape.isChainSegment) { shape.closedEnds = closedEndsOf(shape.segment); }
    world.thinnestWall.reset();
    makeRoomForShape(world, world.bodies[body]);
    const bool hasProxy = world.bodies[body].def.enabled;
    const Result<ProxyId> proxy = hasProxy ? makeProxy(world, shape) : kNoProxy;
    if (!proxy.ok()) { return proxy.status(); }
    const std::optional<ShapeId> id = world.shapes.insert(std::move(shape));
    if (!id) {
        if (hasProxy) { (void)world.broadphase->remove(proxy.value()); }
        return Status{StatusCode::noIdsLeft, "shape"};
    }
    Shape& stored = world.shapes[id->index];
    stored.proxy = proxy.value();
    stored.head = id->index;
    if (hasProxy) { rememberProxy(world, stored.proxy, id->index); }
    world.chainSegments.resize(world.shapes.slotCount());
    world.chainSegments[id->index] = stored.isChainSegment ? 1 : 0;
    world.shapeMasses.resize(world.shapes.slotCount());
    world.bodies[body].shapes.push_back(id->index);
    if (world.bodies[body].isDynamic()) { weigh(world, std::span(&id->index, 1)); }
    countTraits(world, stored.def, 1);
    world.chainShapes += stored.isChainSegment ? 1U : 0U;
    return *id;
}

/// After shapes of a dynamic body changed: boxes may have to reach farther (a new centre of mass, a new radius).
/// @param first  of those that were added, in the list of the body
void refresh(WorldState& world, std::uint32_t body, std::size_t first) {
    const BodyTravel before = world.travels[body];
    updateMass(world, body);
    if (!world.bodies[body].fresh) { rouse(world, body); }  // what was made asleep sleeps on
    updateProxiesFrom(world, body, first, before);
}

/// After shapes were added. A level, or a ship, of thousands of shapes may be one body, and what is not dynamic has no
/// mass; boxes of what is kinematic are made anew as a step begins.
/// @param first  of them, in the list of the body
void refreshWith(WorldState& world, std::uint32_t body, std::size_t first) {
    if (world.bodies[body].isDynamic()) { return refresh(world, body, first); }
    measureAdded(world, body, first);
}

void refreshWithout(WorldState& world, std::uint32_t body) {
    if (world.bodies[body].isDynamic()) { return refresh(world, body, world.bodies[body].shapes.size()); }
    // As many as are taken away one after the other between two steps.
    if (world.unmeasured.empty() || world.unmeasured.back() != body) { world.unmeasured.push_back(body); }
}

/// All of one shape of the user's, which stand together in the list of its body.
void removeFromBody(Body& body, std::span<const std::uint32_t> slots) {
    const auto first = std::find(body.shapes.begin(), body.shapes.end(), slots.front());
    body.shapes.erase(first, first + static_cast<std::ptrdiff_t>(slots.size()));
}

/// Shapes that are added to a body: all of them, or none, also where memory runs out and something throws.
class AddedShapes {
public:
    AddedShapes(WorldState& world, std::uint32_t body)
        : world_(world), body_(body), first_(world.bodies[body].shapes.size()) {}
    AddedShapes(const AddedShapes&) = delete;
    AddedShapes& operator=(const AddedShapes&) = delete;
    ~AddedShapes() {
        if (!areWhole_ && world_.bodies[body_].shapes.size() > first_) { takeBack(); }
    }

    void finish() {
        refreshWith(world_, body_, first_);
        areWhole_ = true;
    }

private:
    void takeBack() {
        Body& body = world_.bodies[body_];
        while (body.shapes.size() > first_) {
            const std::uint32_t slot = body.shapes.back();
            body.shapes.pop_back();
            removeShapeSlot(world_, slot);
        }
        if (body.isDynamic()) { updateMass(world_, body_); }
    }

    WorldState& world_;
    std::uint32_t body_;
    std::size_t first_;
    bool areWhole_ = false;
};

/// What is near only may have no contact yet.
void mixSurfacesOf(WorldState& world, std::span<const std::uint32_t> places) {
    for (const std::uint32_t place : places) {
        ContactProbe* const probe = probeAt(world, place);
        if (probe == nullptr) { return; }
        Contact& contact = world.contacts[probe->contact];
        mixSurfaces(world, contact);
        probe->bounces = contact.restitution > 0;
        probe->isBelt = contact.isBelt;
        probe->resistsRolling = contact.resistsRolling;
        // Or what slides or rolls now would be in balance.
        for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
            const Real most = contact.friction * std::max(contact.normalImpulse[i], Real(0));
            contact.tangentImpulse[i] = std::clamp(contact.tangentImpulse[i], -most, most);
        }
        if (contact.manifold.count == 1) {
            const Real most = surfaceOf(world, contact).rolling * std::max(contact.normalImpulse[0], Real(0));
            contact.rollingImpulse() = std::clamp(contact.rollingImpulse(), -most, most);
        }
    }
}

}  // namespace

Result<ShapeId> World::addShape(BodyId body, const Polygon& polygon, const ShapeDef& def) {
    WorldState& world = *state_;
    if (!world.bodies.isValid(body)) { return Status{StatusCode::staleId, "body"}; }
    const Status geometry = validate(polygon);
    if (!geometry.ok()) { return geometry; }
    const Status size = checkSize(polygon.points(), polygon.radius, "vertices");
    if (!size.ok()) { return size; }
    const Status surface = check(def);
    if (!surface.ok()) { return surface; }
    Shape shape;
    shape.polygon = polygon;
    shape.def = def;
    AddedShapes added(world, body.index);
    const Result<ShapeId> id = insert(world, body.index, std::move(shape));
    if (id.ok()) { added.finish(); }
    return id;
}

Result<ShapeId> World::addChain(BodyId body, std::span<const Vec2> points, bool loop, const ShapeDef& def, Real radius,
                                const ChainNeighbours& neighbours) {
    WorldState& world = *state_;
    if (!world.bodies.isValid(body)) { return Status{StatusCode::staleId, "body"}; }
    if (world.bodies[body.index].isDynamic()) { return Status{StatusCode::wrongBodyType, "body"}; }
    const Status geometry = validateChain(points, loop, radius, neighbours);
    if (!geometry.ok()) { return geometry; }
    const Status size = checkSize(points, radius, "points");
    if (!size.ok()) { return size; }
    const Status beyond = firstFault({checkNumber(neighbours.before.value_or(Vec2{}), "before"),
                                      checkNumber(neighbours.after.value_or(Vec2{}), "after")});
    if (!beyond.ok()) { return beyond; }
    const Status surface = check(def);
    if (!surface.ok()) { return surface; }
    ShapeId head;
    std::uint32_t previous = kNoIndex;
    const Real extent = radius > 0 ? Real(0) : spanOf(points);
    AddedShapes added(world, body.index);
    for (int i = 0; i < chainSegmentCount(static_cast<int>(points.size()), loop); ++i) {
        Shape shape;
        shape.segment = chainSegment(points, loop, radius, i, neighbours);
        shape.polygon = polygonOf(shape.segment);
        shape.isChainSegment = true;
        shape.def = def;
        const Result<ShapeId> id = insert(world, body.index, std::move(shape), extent);
        if (!id.ok()) { return id.status(); }
        if (previous == kNoIndex) {
            head = id.value();
        } else {
            world.shapes[previous].nextInChain = id.value().index;
        }
        previous = id.value().index;
        world.shapes[previous].head = head.index;
    }
    added.finish();
    return head;
}

Status World::destroyShape(ShapeId id) {
    WorldState& world = *state_;
    if (!isValid(id)) { return {StatusCode::staleId, "shape"}; }
    const std::uint32_t body = world.shapes[id.index].body;
    std::vector<std::uint32_t> slots;
    listSlots(world, id.index, slots);
    const std::span<const std::uint32_t> places = pairsOfShape(world, slots);
    // Who rests on other shapes sleeps on; a body that can move wakes itself, with all that fell asleep with it.
    wakeAcross(world, body, places);
    wakeJoined(world, body);
    removePairs(world, places);
    removeFromBody(world.bodies[body], slots);
    for (const std::uint32_t slot : slots) { removeShapeSlot(world, slot); }
    refreshWithout(world, body);
    return Status::success();
}

ShapeDef World::definition(ShapeId id) const { return isValid(id) ? state_->shapes[id.index].def : ShapeDef{}; }

Status World::redefine(ShapeId id, const ShapeDef& def) {
    WorldState& world = *state_;
    if (!isValid(id)) { return {StatusCode::staleId, "shape"}; }
    const Status surface = check(def);
    if (!surface.ok()) { return surface; }
    const ShapeDef before = world.shapes[id.index].def;
    const std::uint32_t body = world.shapes[id.index].body;
    std::vector<std::uint32_t> slots;
    listSlots(world, id.index, slots);
    const bool isToldApart = world.contactFilter != nullptr && def.userData != before.userData;
    const bool meetsOthers = def.sensor != before.sensor || !(def.filter == before.filter) || isToldApart;
    const bool isOtherSurface =
        def.friction != before.friction || def.restitution != before.restitution ||
        def.rollingResistance != before.rollingResistance || def.surfaceSpeed != before.surfaceSpeed ||
        def.frictionMixing != before.frictionMixing || def.restitutionMixing != before.restitutionMixing;
    std::span<const std::uint32_t> places;
    if (meetsOthers || isOtherSurface) {
        places = pairsOfShape(world, slots);
        wakeAcross(world, body, places);
        if (meetsOthers) { removePairs(world, places); }
    }
    for (const std::uint32_t slot : slots) {
        countTraits(world, before, -1);
        world.shapes[slot].def = def;
        countTraits(world, def, 1);
    }
    if (meetsOthers) {
        renewKinds(world, slots);
    } else if (isOtherSurface) {
        mixSurfacesOf(world, places);
    }
    const bool isOtherMass = def.density != before.density || def.sensor != before.sensor;
    if (isOtherMass) {
        if (world.bodies[body].isDynamic()) { weigh(world, slots); }
        refreshWithout(world, body);
    }
    if (isOtherMass || meetsOthers || isOtherSurface) { rouse(world, body); }
    return Status::success();
}

bool World::isValid(ShapeId id) const {
    const Shape* shape = state_->shapes.find(id);
    return shape != nullptr && shape->head == id.index;
}
BodyId World::bodyOf(ShapeId id) const {
    return isValid(id) ? state_->bodies.idOf(state_->shapes[id.index].body) : BodyId{};
}
std::uint64_t World::userData(ShapeId id) const { return isValid(id) ? state_->shapes[id.index].def.userData : 0; }

}  // namespace swept::inline SWEPT_PRECISION
