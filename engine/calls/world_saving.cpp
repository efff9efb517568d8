#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "../image/world_image.h"
#include "../world.h"

namespace swept::inline SWEPT_PRECISION {

std::vector<std::uint8_t> World::save() const { return imageOf(*state_); }

/// Into a world of its own, so that nothing has changed where something is refused, or memory runs out.
Status World::load(std::span<const std::uint8_t> bytes) {
    const Status whole = checkImage(bytes);
    if (!whole.ok()) { return whole; }
    auto loaded = std::make_unique<WorldState>();
    const Status status = readImage(bytes, *loaded);
    if (!status.ok()) { return status; }
    if (state_) {  // else moved from
        static_cast<Workers&>(*loaded) = *state_;
        loaded->contactFilter = state_->contactFilter;
    }
    state_ = std::move(loaded);
    return Status::success();
}

}  // namespace swept::inline SWEPT_PRECISION
