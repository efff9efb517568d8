#include <algorithm>
#include <cmath>

#include "../../shapes/manifold_batch.h"
#include "../../shapes/room.h"
#include "../bodies/awake.h"
#include "../bodies/body_mass.h"
#include "../bodies/body_measures.h"
#include "../bodies/flush_pieces.h"
#include "../bodies/line_skin.h"
#include "../bodies/proxies.h"
#include "../bodies/world_boxes.h"
#include "../contacts/decks.h"
#include "../contacts/pairs_of_shapes.h"
#include "../state/number_range.h"
#include "../state/world_state.h"
#include "../world.h"
#include "surfaces.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Status check(const ShapeDef& def) {
    const Status density = checkNumber(static_cast<double>(def.density), "density");
    if (!density.ok()) { return density; }
    if (def.density < 0) { return {StatusCode::negative, "density"}; }
    return checkSurface(surfaceOf(def));
}

Status checkSize(std::span<const Vec2> points, Real radius, const char* field) {
    for (const Vec2 point : points) {
        const Status status = checkNumber(point, field);
        if (!status.ok()) { return status; }
    }
    return checkNumber(static_cast<double>(radius), "radius");
}

/// Of valid points.
Status checkSurfaces(const ChainDef& def) {
    if (def.surfaces.empty()) { return Status::success(); }
    const auto count = static_cast<std::size_t>(chainSegmentCount(static_cast<int>(def.points.size()), def.loop));
    return checkSurfaces(def.surfaces, count);
}

Status check(const ChainDef& def) {
    const Status geometry = validateChain(def.points, def.loop, def.radius, def.neighbours);
    if (!geometry.ok()) { return geometry; }
    return firstFault(
        {checkSize(def.points, def.radius, "points"), checkNumber(def.neighbours.before.value_or(Vec2{}), "before"),
         checkNumber(def.neighbours.after.value_or(Vec2{}), "after"), check(def.shape), checkSurfaces(def)});
}

/// Of one shape of a dynamic body. Only in f64 does what is in range weigh more, or less, than double can tell.
Status checkMass(const Polygon& polygon, Real density) {
    if constexpr (sizeof(Real) == sizeof(double)) {
        if (density == 0 || (polygon.count == 2 && polygon.radius == 0)) { return Status::success(); }
        const MassProperties mass = massOf(polygon, density);
        if (!(mass.mass > 0) || !isWeighable(mass)) { return {StatusCode::outOfRange, "density"}; }
    }
    return Status::success();
}

Status checkShape(const Polygon& polygon, const ShapeDef& def, bool isDynamic) {
    const Status geometry = validate(polygon);
    if (!geometry.ok()) { return geometry; }
    return firstFault({checkSize(polygon.points(), polygon.radius, "vertices"), check(def),
                       isDynamic ? checkMass(polygon, def.density) : Status::success()});
}

/// All that may fail when memory runs out, before a shape is made, but for its proxy.
void makeRoomForShape(WorldState& world, Body& body) {
    world.shapes.makeRoomForOne();
    const std::size_t count = world.shapes.slotsWithOneMore();
    makeRoom(world.chainSegments, count);
    makeRoom(world.shapeMasses, count);
    makeRoom(world.proxyShapes, world.proxyShapes.size() + 1);  // the lowest free proxy is taken first
    makeRoom(world.neededBoxes, world.proxyShapes.size() + 1);
    makeRoom(world.sensors, world.sensors.size() + 1);
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

/// Of a chain.
/// @param leastExtent  of one without radius, as large as the chain: how finely a curve is cut up says nothing of how
/// far a body may sink into it
void measureSegment(Shape& shape, Real leastExtent) {
    shape.extent = std::max(leastExtent, extentOf(shape.polygon));
    shape.size = radiusAbout(shape.polygon, {});
    shape.isLine = !(shape.polygon.radius > 0);
    shape.isBatched = collidesInBatches(shape.segment);
    if (shape.isBatched) { shape.closedEnds = closedEndsOf(shape.segment); }
}

/// Puts a shape into the world: slot, proxy, list of the body.
/// @param leastExtent  as of `measureSegment`
Result<ShapeId> insert(WorldState& world, std::uint32_t body, Shape shape, Real leastExtent = 0) {
    shape.body = body;
    if (shape.isChainSegment) {
        measureSegment(shape, leastExtent);
    } else {
        setSkin(shape, world.bodies[body].isDynamic());
    }
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
    countTraits(world, id->index);
    world.chainShapes += stored.isChainSegment ? 1U : 0U;
    return *id;
}

/// After shapes of a dynamic body changed: boxes may have to reach farther (a new centre of mass, a new radius).
/// @param first  of those that were added, in the list of the body
void refresh(WorldState& world, std::uint32_t body, std::size_t first) {
    const BodyTravel before = world.travels[body];
    const bool isAdded = first < world.bodies[body].shapes.size();
    updateMass(world, body, isAdded && world.bodies[body].fresh);
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

/// @param attained  of `noteLoss`
void refreshWithout(WorldState& world, std::uint32_t body, std::uint32_t attained) {
    if (world.bodies[body].isDynamic()) { return refresh(world, body, world.bodies[body].shapes.size()); }
    noteLoss(world, body, attained);
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
        if (world_.bodies[body_].isDynamic()) { notePiecesOf(world_, markFlushPieces(world_, body_, first_)); }
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
        if (body.isDynamic()) { updateMass(world_, body_, body.fresh); }
    }

    WorldState& world_;
    std::uint32_t body_;
    std::size_t first_;
    bool areWhole_ = false;
};

}  // namespace

Result<ShapeId> World::addShape(BodyId body, const Polygon& polygon, const ShapeDef& def) {
    WorldState& world = *state_;
    if (!world.bodies.isValid(body)) { return Status{StatusCode::staleId, "body"}; }
    const Status good = checkShape(polygon, def, world.bodies[body.index].isDynamic());
    if (!good.ok()) { return good; }
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
    return addChain(body, {.points = points, .loop = loop, .shape = def, .radius = radius, .neighbours = neighbours});
}

Result<ShapeId> World::addChain(BodyId body, const ChainDef& def) {
    WorldState& world = *state_;
    if (!world.bodies.isValid(body)) { return Status{StatusCode::staleId, "body"}; }
    if (world.bodies[body.index].isDynamic()) { return Status{StatusCode::wrongBodyType, "body"}; }
    const Status good = check(def);
    if (!good.ok()) { return good; }
    ShapeId head;
    std::uint32_t previous = kNoIndex;
    const Real extent = def.radius > 0 ? Real(0) : spanOf(def.points);
    AddedShapes added(world, body.index);
    const int count = chainSegmentCount(static_cast<int>(def.points.size()), def.loop);
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        Shape shape;
        shape.segment = chainSegment(def.points, def.loop, def.radius, i, def.neighbours);
        shape.polygon = polygonOf(shape.segment);
        shape.isChainSegment = true;
        shape.segmentIndex = index;
        shape.def = def.surfaces.empty() ? def.shape : withSurface(def.shape, def.surfaces[index]);
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
    std::uint32_t attained = 0;
    for (const std::uint32_t slot : slots) {
        attained |= measuresAttained(world.bodies[body], world.shapes[slot]);
        removeShapeSlot(world, slot);
    }
    refreshWithout(world, body, attained);
    return Status::success();
}

Status World::reshape(ShapeId id, const Polygon& polygon) {
    WorldState& world = *state_;
    if (!isValid(id)) { return {StatusCode::staleId, "shape"}; }
    if (world.shapes[id.index].isChainSegment) { return {StatusCode::notConvex, "shape"}; }
    const ShapeDef def = world.shapes[id.index].def;
    const std::uint32_t owner = world.shapes[id.index].body;
    Body& body = world.bodies[owner];
    const Status good = checkShape(polygon, def, body.isDynamic());
    if (!good.ok()) { return good; }
    Shape next;
    next.polygon = polygon;
    next.def = def;
    next.body = owner;
    next.head = id.index;
    setSkin(next, body.isDynamic());
    makeRoomForShape(world, body);
    const Result<ProxyId> proxy = body.def.enabled ? makeProxy(world, next) : kNoProxy;
    if (!proxy.ok()) { return proxy.status(); }
    next.proxy = proxy.value();

    const std::span<const std::uint32_t> places = pairsOfShape(world, std::span(&id.index, 1));
    wakeAcross(world, owner, places);
    wakeJoined(world, owner);
    removePairs(world, places);
    const std::uint32_t attained = measuresAttained(body, world.shapes[id.index]);
    emptyShapeSlot(world, id.index);
    world.shapes[id.index] = next;
    if (next.proxy != kNoProxy) { rememberProxy(world, next.proxy, id.index); }
    countTraits(world, id.index);
    world.thinnestWall.reset();
    const auto place =
        static_cast<std::size_t>(std::find(body.shapes.begin(), body.shapes.end(), id.index) - body.shapes.begin());
    if (body.isDynamic()) {
        weigh(world, std::span(&id.index, 1));
        // Those that follow are compared with it as if they were new.
        (void)markFlushPieces(world, owner, place);
        notePiecesOf(world, body.shapes);
    } else {
        noteLoss(world, owner, attained);
    }
    refreshWith(world, owner, place);
    return Status::success();
}

ShapeDef World::definition(ShapeId id) const { return isValid(id) ? state_->shapes[id.index].def : ShapeDef{}; }

Status World::redefine(ShapeId id, const ShapeDef& def) {
    WorldState& world = *state_;
    if (!isValid(id)) { return {StatusCode::staleId, "shape"}; }
    const Status good = check(def);
    if (!good.ok()) { return good; }
    const ShapeDef before = world.shapes[id.index].def;
    const std::uint32_t body = world.shapes[id.index].body;
    if (world.bodies[body].isDynamic()) {
        const Status mass = checkMass(givenPolygon(world.shapes[id.index]), def.density);
        if (!mass.ok()) { return mass; }
    }
    std::vector<std::uint32_t> slots;
    listSlots(world, id.index, slots);
    const bool isToldApart = world.contactFilter != nullptr && def.userData != before.userData;
    const bool meetsOthers = def.sensor != before.sensor || !(def.filter == before.filter) || isToldApart;
    // Segments keep surfaces of their own as long as that of the definition is the same.
    const Surface surface = surfaceOf(def);
    const bool areNew = !(surface == surfaceOf(before));
    const bool isOtherSurface = areNew && std::any_of(slots.begin(), slots.end(), [&](std::uint32_t slot) {
                                    return !actAlike(surfaceOf(world.shapes[slot].def), surface);
                                });
    std::span<const std::uint32_t> places;
    if (def.sensor) { makeRoom(world.sensors, world.sensors.size() + slots.size()); }
    if (meetsOthers || isOtherSurface) {
        places = pairsOfShape(world, slots);
        wakeAcross(world, body, places);
        if (meetsOthers) { removePairs(world, places); }
    }
    for (const std::uint32_t slot : slots) {
        const ShapeDef own = world.shapes[slot].def;
        setDefinition(world, slot, areNew ? def : withSurface(def, surfaceOf(own)));
        if (!world.shapes[slot].isChainSegment) { setSkin(world.shapes[slot], world.bodies[body].isDynamic()); }
    }
    if (meetsOthers) {
        renewKinds(world, slots);
    } else if (isOtherSurface) {
        mixSurfacesOf(world, places);
    }
    const bool isOtherMass = def.density != before.density || def.sensor != before.sensor;
    if (isOtherMass) {
        if (world.bodies[body].isDynamic()) { weigh(world, slots); }
        refreshWithout(world, body, kAllMeasures);
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
