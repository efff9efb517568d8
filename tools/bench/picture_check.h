#pragma once

#include <string>

namespace swept::bench {

/// Whether the file of a picture has its end: gnuplot tells success when the disk was full, too. SVG by its name, else
/// PNG.
bool isCompletePicture(const std::string& path);

}  // namespace swept::bench
