#include "place_order.h"

#include <algorithm>

#include "../containers/key_sort.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Every second bit, from the lowest on.
std::uint64_t spreadBits(std::uint32_t bits) {
    std::uint64_t spread = bits;
    spread = (spread | (spread << 16U)) & 0x0000FFFF0000FFFFU;
    spread = (spread | (spread << 8U)) & 0x00FF00FF00FF00FFU;
    spread = (spread | (spread << 4U)) & 0x0F0F0F0F0F0F0F0FU;
    spread = (spread | (spread << 2U)) & 0x3333333333333333U;
    return (spread | (spread << 1U)) & 0x5555555555555555U;
}

/// Along an axis, of the curve; and the smallest square that it fills, metres.
constexpr double kCells = 65535;
constexpr double kSmallest = 0x1p-60;

}  // namespace

void orderByPlace(WorldState& world, std::vector<std::uint32_t>& slots) {
    BodyPlaces& places = world.bodyPlaces;
    if (slots.size() < 2) { return; }
    DVec2 lower = world.motions[slots.front()].center;
    DVec2 upper = lower;
    for (const std::uint32_t slot : slots) {
        const DVec2 center = world.motions[slot].center;
        lower = {std::min(lower.x, center.x), std::min(lower.y, center.y)};
        upper = {std::max(upper.x, center.x), std::max(upper.y, center.y)};
    }
    const double cells = kCells / std::max({upper.x - lower.x, upper.y - lower.y, kSmallest});
    const auto cellOf = [cells](double way) {
        return spreadBits(static_cast<std::uint32_t>(std::min(kCells, std::max(0.0, cells * way))));
    };
    places.order.clear();
    for (const std::uint32_t slot : slots) {
        const DVec2 way = world.motions[slot].center - lower;
        places.order.push_back({cellOf(way.x) | (cellOf(way.y) << 1U), slot});
    }
    sortByKeys(places.order, places.spare, [](const BodyPlace& a, const BodyPlace& b) { return a.slot < b.slot; });
    std::transform(places.order.begin(), places.order.end(), slots.begin(),
                   [](const BodyPlace& one) { return one.slot; });
}

}  // namespace swept::inline SWEPT_PRECISION
