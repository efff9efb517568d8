#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace swept {

/// Writes bytes to a file; one that could not be written completely is removed again, see `removeBegunFile`.
/// @return false, and "path: reason" in `error`.
bool writeImageFile(const std::uint8_t* bytes, std::size_t size, const std::string& path, std::string& error);

}  // namespace swept
