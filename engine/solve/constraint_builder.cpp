#include "constraint_builder.h"

namespace swept::inline SWEPT_PRECISION {
ContactConstraint constraintOf(const Manifold& manifold, const ContactFrame& frame, const MixedSurface& surface,
                               Real maxPushSpeed) {
    ContactConstraint constraint;
    constraint.normal = rotate(frame.rotation, manifold.normal);
    constraint.friction = surface.friction;
    constraint.restitution = surface.restitution;
    constraint.surfaceSpeed = surface.speed;
    constraint.rolling = surface.rolling;
    constraint.maxPushSpeed = maxPushSpeed;
    constraint.count = manifold.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        constraint.points[i] = constraintPointOf(manifold.points[i], frame);
    }
    return constraint;
}

}  // namespace swept::inline SWEPT_PRECISION
