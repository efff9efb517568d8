#include "joint_builder.h"
#include "world_state.h"

/// All that there is, one after the other: for editors, debug drawing, games that keep no lists of their own.

namespace swept::inline SWEPT_PRECISION {
namespace {

template <class Id, class Pool>
void visitAll(const Pool& pool, FunctionRef<void(Id)> visit) {
    for (std::uint32_t slot = 0; slot < pool.slotCount(); ++slot) {
        if (pool.isAlive(slot)) { visit(pool.idOf(slot)); }
    }
}

}  // namespace

void World::visitBodies(FunctionRef<void(BodyId)> visit) const { visitAll<BodyId>(state_->bodies, visit); }

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
            def.base = joint->base;  // its limits may have been set since
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
