#include <algorithm>
#include <vector>

#include "../../shapes/bit_cast.h"
#include "../bodies/line_skin.h"
#include "../solve/joint_builder.h"
#include "../state/world_state.h"
#include "../world.h"

/// All that there is, one after the other: for editors, debug drawing, games that keep no lists of their own. What is
/// called back may change the world, so no visit holds on to anything of it meanwhile.

namespace swept::inline SWEPT_PRECISION {
namespace {

/// @param poolOf  of the world: asked anew for each, since a visit may change all of it
template <class Id, class PoolOf>
void visitAll(const PoolOf& poolOf, FunctionRef<void(Id)> visit) {
    const std::uint32_t end = poolOf().slotCount();  // what visits make must not keep this going
    for (std::uint32_t slot = 0; slot < std::min(end, poolOf().slotCount()); ++slot) {
        if (poolOf().isAlive(slot)) { visit(poolOf().idOf(slot)); }
    }
}

/// Of numbers, bit for bit, and their order.
class StateHash {
public:
    void add(std::uint64_t word) {
        sum_ = (sum_ ^ word) * 0x9E3779B97F4A7C15U;  // the golden ratio, as in Fibonacci hashing (Knuth)
        sum_ ^= sum_ >> 32U;
    }
    void add(double number) { add(bitCast<std::uint64_t>(number)); }
    std::uint64_t sum() const { return sum_; }

private:
    std::uint64_t sum_ = 0;
};

}  // namespace

void World::visitBodies(FunctionRef<void(BodyId)> visit) const {
    visitAll<BodyId>(
        [this]() -> const auto& { return state_->bodies; }, visit);
}

BodyId World::bodyWithoutMass() const {
    const auto& bodies = state_->bodies;
    for (std::uint32_t slot = 0; state_->masslessBodies > 0 && slot < bodies.slotCount(); ++slot) {
        const bool takesPart = bodies.isAlive(slot) && bodies[slot].def.enabled;
        if (takesPart && bodies[slot].isDynamic() && bodies[slot].mass <= 0) { return bodies.idOf(slot); }
    }
    return {};
}

void World::visitMoved(FunctionRef<void(BodyId)> visit) const {
    for (std::size_t i = 0; i < state_->stepped.size(); ++i) {  // by index: a visit may make it another list
        const std::uint32_t slot = state_->stepped[i];
        if (!state_->bodies.isAlive(slot)) { continue; }
        const Body& body = state_->bodies[slot];
        const BodyMotion& motion = state_->motions[slot];
        if (motion.center != body.startCenter || motion.angle != body.startAngle) { visit(state_->bodies.idOf(slot)); }
    }
}

std::uint64_t World::stateHash() const {
    StateHash hash;
    visitBodies([&](BodyId id) {
        hash.add((std::uint64_t{id.generation} << 32U) | id.index);
        const BodyMotion& motion = state_->motions[id.index];
        for (const double number : {motion.center.x, motion.center.y, motion.angle}) { hash.add(number); }
        for (const Real number : {motion.velocity.x, motion.velocity.y, motion.angularVelocity}) {
            hash.add(static_cast<double>(number));
        }
        hash.add(std::uint64_t{isAwake(id)} + (isEnabled(id) ? 0U : 2U));
    });
    return hash.sum();
}

void World::visitJoints(FunctionRef<void(JointId)> visit) const {
    visitAll<JointId>(
        [this]() -> const auto& { return state_->joints; }, visit);
}

void World::visitShapes(BodyId id, FunctionRef<void(ShapeId)> visit) const {
    const Body* body = state_->bodies.find(id);
    if (body == nullptr) { return; }
    std::vector<ShapeId> shapes;
    for (const std::uint32_t slot : body->shapes) {
        if (state_->shapes[slot].head == slot) { shapes.push_back(state_->shapes.idOf(slot)); }  // of a chain the first
    }
    for (const ShapeId shape : shapes) {
        if (isValid(shape)) { visit(shape); }
    }
}

void World::visitJoints(BodyId id, FunctionRef<void(JointId)> visit) const {
    const Body* body = state_->bodies.find(id);
    if (body == nullptr) { return; }
    std::vector<JointId> joints;
    for (const std::uint32_t slot : body->joints) { joints.push_back(state_->joints.idOf(slot)); }
    for (const JointId joint : joints) {
        if (isValid(joint)) { visit(joint); }
    }
}

void World::visitPolygons(ShapeId id, FunctionRef<void(const Polygon&)> visit) const {
    std::uint32_t slot = id.index;
    while (slot != kNoIndex && isValid(id)) {
        const Polygon polygon =
            givenPolygon(state_->shapes[slot]);  // a copy: the visit may make it move, or destroy it
        slot = state_->shapes[slot].nextInChain;
        visit(polygon);
    }
}

Aabb World::bounds(ShapeId id) const {
    if (!isValid(id)) { return {}; }
    const WorldTransform& pose = state_->motions[state_->shapes[id.index].body].pose;
    Aabb box = boundsOf(state_->shapes[id.index].polygon, pose);
    visitPolygons(id, [&](const Polygon& polygon) { box = hullOf(box, boundsOf(polygon, pose)); });
    return box;
}

BodyId World::bodyA(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? std::visit([](const auto& part) { return part.def.base.bodyA; }, joint->parts) : BodyId{};
}
BodyId World::bodyB(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? std::visit([](const auto& part) { return part.def.base.bodyB; }, joint->parts) : BodyId{};
}

std::uint64_t World::userData(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? joint->base.userData : 0;
}

AnyJointDef World::definition(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    if (joint == nullptr) { return {}; }
    return std::visit(
        [joint](const auto& part) -> AnyJointDef {
            auto def = part.def;
            def.base.breakForce = joint->base.breakForce;  // may have been set since
            def.base.breakTorque = joint->base.breakTorque;
            return def;
        },
        joint->parts);
}

DVec2 World::anchorA(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? anchorAOf(*state_, *joint) : DVec2{};
}

DVec2 World::anchorB(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? anchorBOf(*state_, *joint) : DVec2{};
}

}  // namespace swept::inline SWEPT_PRECISION
