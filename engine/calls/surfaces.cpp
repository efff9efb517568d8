#include "surfaces.h"

#include <algorithm>

#include "../bodies/proxies.h"
#include "../contacts/contact_making.h"
#include "../contacts/pairs_of_shapes.h"
#include "../state/number_range.h"

namespace swept::inline SWEPT_PRECISION {

Status checkSurface(const Surface& surface) {
    const Status numbers = firstFault({checkNumber(static_cast<double>(surface.friction), "friction"),
                                       checkNumber(static_cast<double>(surface.rollingResistance), "rollingResistance"),
                                       checkNumber(static_cast<double>(surface.surfaceSpeed), "surfaceSpeed")});
    if (!numbers.ok()) { return numbers; }
    if (surface.friction < 0) { return {StatusCode::negative, "friction"}; }
    if (surface.rollingResistance < 0) { return {StatusCode::negative, "rollingResistance"}; }
    if (!isFinite(surface.restitution)) { return {StatusCode::notFinite, "restitution"}; }
    if (surface.restitution < 0 || surface.restitution > 1) { return {StatusCode::outOfRange, "restitution"}; }
    if (surface.frictionMixing > MixingRule::maximum) { return {StatusCode::outOfRange, "frictionMixing"}; }
    if (surface.restitutionMixing > MixingRule::maximum) { return {StatusCode::outOfRange, "restitutionMixing"}; }
    return Status::success();
}

Status checkSurfaces(std::span<const Surface> surfaces, std::size_t count) {
    if (surfaces.size() != count) { return {StatusCode::outOfRange, "surfaces"}; }
    for (const Surface& surface : surfaces) {
        const Status good = checkSurface(surface);
        if (!good.ok()) { return good; }
    }
    return Status::success();
}

bool actAlike(Surface a, const Surface& b) {
    a.material = b.material;
    return a == b;
}

void setDefinition(WorldState& world, std::uint32_t slot, const ShapeDef& def) {
    discountTraits(world, slot);
    world.shapes[slot].def = def;
    countTraits(world, slot);
}

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

}  // namespace swept::inline SWEPT_PRECISION
