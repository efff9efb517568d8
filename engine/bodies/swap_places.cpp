#include "swap_places.h"

#include <utility>

#include "body_mass.h"

namespace swept::inline SWEPT_PRECISION {

void swapPlaces(WorldState& world, std::span<SwappedPlace> places) {
    for (SwappedPlace& place : places) {
        BodyMotion& motion = world.motions[place.slot];
        std::swap(motion.center, place.center);
        std::swap(motion.angle, place.angle);
        updatePose(world, place.slot);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
