#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace swept {

/// A picture of 8-bit RGB pixels, rows from top to bottom, without padding.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  ///< 3 · width · height bytes

    /// The first byte of a pixel; x to the right and y *down*, both inside the picture.
    std::uint8_t* at(int x, int y) { return rgb.data() + offset(x, y); }
    const std::uint8_t* at(int x, int y) const { return rgb.data() + offset(x, y); }
    bool empty() const { return width == 0 || height == 0; }
    bool operator==(const Image&) const = default;

private:
    std::size_t offset(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
};

/// A picture of one colour.
Image makeImage(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// Copies `source` into `target` with its top-left corner at (x, y); what sticks out is left away.
void blit(const Image& source, Image& target, int x, int y);

/// Each pixel of the result is the rounded mean of `factor` × `factor` pixels of an RGBA buffer (alpha is ignored).
/// @param rgba  4 · (width · factor) · (height · factor) bytes, rows from top to bottom.
Image downsample(const std::vector<std::uint8_t>& rgba, int width, int height, int factor);

}  // namespace swept
