#include "body_type.h"

#include "../bodies/awake.h"
#include "../bodies/body_mass.h"
#include "../bodies/flush_pieces.h"
#include "../bodies/line_skin.h"
#include "../contacts/pairs_of_shapes.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

void changeType(WorldState& world, std::uint32_t slot, BodyType type) {
    dropContacts(world, slot);
    Body& body = world.bodies[slot];
    if (type == BodyType::fixed) {
        removeFromAwake(world, slot);
        body.awake = false;
        body.role = BodyRole::idle;
        world.motions[slot].velocity = {};
        world.motions[slot].angularVelocity = 0;
    }
    body.force = {};
    body.torque = 0;
    body.groundNormal = {};
    body.def.type = type;
    body.mass = 0;
    for (const std::uint32_t index : body.shapes) {
        Shape& shape = world.shapes[index];
        if (!shape.isChainSegment) { setSkin(shape, body.isDynamic()); }
    }
    if (body.isDynamic()) {
        weigh(world, body.shapes);
        markFlushPieces(world, slot, 0);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
