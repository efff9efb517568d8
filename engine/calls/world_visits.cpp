#include "../../shapes/bit_cast.h"
#include "../solve/joint_builder.h"
#include "../state/world_state.h"

/// All that there is, one after the other: for editors, debug drawing, games that keep no lists of their own.

namespace swept::inline SWEPT_PRECISION {
namespace {

template <class Id, class Pool>
void visitAll(const Pool& pool, FunctionRef<void(Id)> visit) {
    for (std::uint32_t slot = 0; slot < pool.slotCount(); ++slot) {
        if (pool.isAlive(slot)) { visit(pool.idOf(slot)); }
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

void World::visitBodies(FunctionRef<void(BodyId)> visit) const { visitAll<BodyId>(state_->bodies, visit); }

BodyId World::bodyWithoutMass() const {
    const auto& bodies = state_->bodies;
    for (std::uint32_t slot = 0; state_->masslessBodies > 0 && slot < bodies.slotCount(); ++slot) {
        const bool takesPart = bodies.isAlive(slot) && bodies[slot].def.enabled;
        if (takesPart && bodies[slot].isDynamic() && bodies[slot].mass <= 0) { return bodies.idOf(slot); }
    }
    return {};
}

void World::visitMoved(FunctionRef<void(BodyId)> visit) const {
    for (const std::uint32_t slot : state_->stepped) {
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

void World::visitJoints(FunctionRef<void(JointId)> visit) const { visitAll<JointId>(state_->joints, visit); }

void World::visitShapes(BodyId id, FunctionRef<void(ShapeId)> visit) const {
    const Body* body = state_->bodies.find(id);
    if (body == nullptr) { return; }
    for (const std::uint32_t slot : body->shapes) {
        if (state_->shapes[slot].head == slot) { visit(state_->shapes.idOf(slot)); }  // of a chain the first segment
    }
}

void World::visitJoints(BodyId id, FunctionRef<void(JointId)> visit) const {
    const Body* body = state_->bodies.find(id);
    if (body == nullptr) { return; }
    for (const std::uint32_t slot : body->joints) { visit(state_->joints.idOf(slot)); }
}

void World::visitPolygons(ShapeId id, FunctionRef<void(const Polygon&)> visit) const {
    if (!isValid(id)) { return; }
    for (std::uint32_t slot = id.index; slot != kNoIndex; slot = state_->shapes[slot].nextInChain) {
        visit(state_->shapes[slot].polygon);
    }
}

Aabb World::bounds(ShapeId id) const {
    if (!isValid(id)) { return {}; }
    const WorldTransform& pose = state_->motions[state_->shapes[id.index].body].pose;
    Aabb box = boundsOf(state_->shapes[id.index].polygon, pose);
    visitPolygons(id, [&](const Polygon& polygon) { box = hullOf(box, boundsOf(polygon, pose)); });
    return box;
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
