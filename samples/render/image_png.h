#pragma once

#include <string>

#include "image.h"

namespace swept {

/// Writes a picture as an 8-bit RGB PNG. A file that could not be written completely is removed again.
/// @return false, and "path: reason" in `error`, when the picture is empty or the file cannot be written.
bool writePng(const Image& image, const std::string& path, std::string& error);

}  // namespace swept
