#include "image.h"

#include <algorithm>

namespace swept {

Image makeImage(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    Image image{width, height, {}};
    image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        image.rgb[i] = red;
        image.rgb[i + 1] = green;
        image.rgb[i + 2] = blue;
    }
    return image;
}

void blit(const Image& source, Image& target, int x, int y) {
    const int left = std::max(0, x);
    const int right = std::min(target.width, x + source.width);
    if (left >= right) { return; }
    const std::size_t bytes = 3 * static_cast<std::size_t>(right - left);
    for (int row = std::max(0, y); row < std::min(target.height, y + source.height); ++row) {
        std::copy_n(source.at(left - x, row - y), bytes, target.at(left, row));
    }
}

Image downsample(const std::vector<std::uint8_t>& rgba, int width, int height, int factor) {
    Image image{width, height, {}};
    image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto side = static_cast<std::size_t>(factor);
    const std::size_t stride = 4 * side * static_cast<std::size_t>(width);
    const auto samples = static_cast<unsigned>(factor * factor);
    std::vector<unsigned> sums(3 * static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        std::fill(sums.begin(), sums.end(), samples / 2);
        for (std::size_t line = 0; line < side; ++line) {
            const std::uint8_t* from = rgba.data() + (static_cast<std::size_t>(y) * side + line) * stride;
            for (std::size_t x = 0; x < sums.size(); x += 3) {
                for (std::size_t i = 0; i < side; ++i, from += 4) {
                    sums[x] += from[0];
                    sums[x + 1] += from[1];
                    sums[x + 2] += from[2];
                }
            }
        }
        std::uint8_t* to = image.at(0, y);
        for (std::size_t x = 0; x < sums.size(); ++x) { to[x] = static_cast<std::uint8_t>(sums[x] / samples); }
    }
    return image;
}

}  // namespace swept
