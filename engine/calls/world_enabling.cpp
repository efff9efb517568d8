#include "../../shapes/room.h"
#include "../bodies/awake.h"
#include "../bodies/body_mass.h"
#include "../bodies/proxies.h"
#include "../bodies/travel.h"
#include "../bodies/world_boxes.h"
#include "../contacts/pairs_of_shapes.h"
#include "../state/world_state.h"
#include "../world.h"
#include "joint_switch.h"

/// Bodies that leave a world, and come back, with their ids, shapes and joints: those of a pool, for example.

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What the steps so far left to the next one: nothing of it is about the time when the body comes back.
void forgetSteps(Body& body) {
    body.hasContact = false;
    body.touchesDynamic = false;
    body.groundNormal = {};
    body.fast = false;
    body.effort = {};
    body.searchDebt = 0;
    body.soughtSteps = 0;
    body.force = {};
    body.torque = 0;
}

void disable(WorldState& world, std::uint32_t slot) {
    dropContacts(world, slot);
    removeFromAwake(world, slot);
    Body& body = world.bodies[slot];
    for (const std::uint32_t shape : body.shapes) { removeProxy(world, shape); }
    countBody(world, body, -1);
    body.def.enabled = false;
    countBody(world, body, 1);
    body.awake = false;
    body.role = BodyRole::idle;
    body.nextAsleep = slot;
    forgetSteps(body);
    switchJoints(world, slot);
    noteRest(world, slot);
}

/// All that may fail when memory runs out, before anything changes.
void makeRoomToEnable(WorldState& world, const Body& body) {
    // A proxy that is free is taken before there is a new one.
    makeRoom(world.proxyShapes, world.proxyShapes.size() + body.shapes.size());
    makeRoom(world.neededBoxes, world.proxyShapes.size() + body.shapes.size());
    makeRoom(world.newJoints, world.newJoints.size() + body.joints.size());
    makeRoomToWake(world);
}

Status enable(WorldState& world, std::uint32_t slot) {
    Body& body = world.bodies[slot];
    makeRoomToEnable(world, body);
    for (std::size_t i = 0; i < body.shapes.size(); ++i) {
        const Status status = addProxy(world, body.shapes[i]);
        if (status.ok()) { continue; }
        while (i > 0) { removeProxy(world, body.shapes[--i]); }
        return status;
    }
    countBody(world, body, -1);
    body.def.enabled = true;
    notePut(body);
    countBody(world, body, 1);
    switchJoints(world, slot);
    for (const std::uint32_t joint : body.joints) { world.newJoints.push_back(world.joints.idOf(joint)); }
    rouse(world, slot);
    updateProxies(world, slot);
    if (!body.awake) { noteRest(world, slot); }  // no step does it for what is fixed
    return Status::success();
}

}  // namespace

Status World::setEnabled(BodyId id, bool enabled) {
    WorldState& world = *state_;
    const Body* body = world.bodies.find(id);
    if (body == nullptr) { return {StatusCode::staleId, "body"}; }
    if (enabled == body->def.enabled) { return Status::success(); }
    if (enabled) { return enable(world, id.index); }
    disable(world, id.index);
    return Status::success();
}

bool World::isEnabled(BodyId id) const {
    const Body* body = state_->bodies.find(id);
    return body != nullptr && body->def.enabled;
}

}  // namespace swept::inline SWEPT_PRECISION
