#include "proxies.h"

#include <algorithm>
#include <vector>

#include "world_boxes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

ProxyKind kindOf(const Shape& shape, BodyType type) {
    if (shape.def.sensor) { return ProxyKind::sensor; }
    switch (type) {
        case BodyType::fixed:
            return ProxyKind::fixed;
        case BodyType::kinematic:
            return ProxyKind::kinematic;
        case BodyType::dynamic:
            return ProxyKind::dynamic;
    }
    return ProxyKind::fixed;  // unreachable, but GCC cannot know
}

}  // namespace

Result<ProxyId> makeProxy(WorldState& world, const Shape& shape) {
    return world.broadphase->insert(fatBox(world, shape), kindOf(shape, world.bodies[shape.body].def.type));
}

void rememberProxy(WorldState& world, ProxyId proxy, std::uint32_t shape) {
    const auto index = static_cast<std::size_t>(proxy);
    if (world.proxyShapes.size() <= index) { world.proxyShapes.resize(index + 1, kNoIndex); }
    world.proxyShapes[index] = shape;
    world.neededBoxes.resize(world.proxyShapes.size());
    world.neededBoxes[index] = world.broadphase->box(proxy);
}

void countTraits(WorldState& world, std::uint32_t shape) {
    const ShapeDef& def = world.shapes[shape].def;
    if (def.sensor) { world.sensors.push_back(shape); }
    world.bouncyShapes += def.restitution > 0 ? 1U : 0U;
    world.rollingShapes += def.rollingResistance > 0 ? 1U : 0U;
}

void discountTraits(WorldState& world, std::uint32_t shape) {
    const ShapeDef& def = world.shapes[shape].def;
    if (def.sensor) {
        *std::find(world.sensors.begin(), world.sensors.end(), shape) = world.sensors.back();
        world.sensors.pop_back();
    }
    world.bouncyShapes -= def.restitution > 0 ? 1U : 0U;
    world.rollingShapes -= def.rollingResistance > 0 ? 1U : 0U;
}

Status addProxy(WorldState& world, std::uint32_t slot) {
    Shape& shape = world.shapes[slot];
    const Result<ProxyId> proxy = makeProxy(world, shape);
    if (!proxy.ok()) { return proxy.status(); }
    shape.proxy = proxy.value();
    rememberProxy(world, shape.proxy, slot);
    world.thinnestWall.reset();
    return Status::success();
}

void removeProxy(WorldState& world, std::uint32_t slot) {
    Shape& shape = world.shapes[slot];
    if (shape.proxy == kNoProxy) { return; }
    (void)world.broadphase->remove(shape.proxy);  // it is there: the shape owns it
    shape.proxy = kNoProxy;
    world.thinnestWall.reset();
}

void emptyShapeSlot(WorldState& world, std::uint32_t slot) {
    removeProxy(world, slot);
    discountTraits(world, slot);
    world.chainShapes -= world.shapes[slot].isChainSegment ? 1U : 0U;
    std::erase_if(world.crossed,
                  [slot](const ChainPasser& passer) { return passer.shape == slot || passer.segment == slot; });
}

void removeShapeSlot(WorldState& world, std::uint32_t slot) {
    emptyShapeSlot(world, slot);
    world.shapes.erase(world.shapes.idOf(slot));
}

void renewKinds(WorldState& world, std::span<const std::uint32_t> shapes) {
    for (const std::uint32_t slot : shapes) {
        Shape& shape = world.shapes[slot];
        if (shape.proxy == kNoProxy) { continue; }
        const Aabb box = world.broadphase->box(shape.proxy);  // which was good before
        (void)world.broadphase->remove(shape.proxy);
        shape.proxy = world.broadphase->insert(box, kindOf(shape, world.bodies[shape.body].def.type)).value();
        rememberProxy(world, shape.proxy, slot);
    }
    world.thinnestWall.reset();
}

}  // namespace swept::inline SWEPT_PRECISION
