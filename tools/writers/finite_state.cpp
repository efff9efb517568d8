#include "finite_state.h"

#include <cmath>

namespace swept {

std::optional<std::size_t> firstNotFinite(const Frame& frame) {
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
        const BodyFrame& body = frame.bodies[i];
        const bool isFiniteBody = isFinite(body.position) && isFinite(body.velocity) && std::isfinite(body.angle) &&
                                  std::isfinite(body.angularVelocity);
        if (!isFiniteBody) { return i; }
    }
    return std::nullopt;
}

}  // namespace swept
