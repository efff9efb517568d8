#pragma once

#include <cstddef>
#include <optional>

#include <swept/samples/frame.h>

namespace swept {

/// Index of the first body whose position, angle or velocity is NaN or infinite; nothing when all are finite.
std::optional<std::size_t> firstNotFinite(const Frame& frame);

}  // namespace swept
