#include "image_png.h"

#include <png.h>

#include "image_file.h"

namespace swept {

bool writePng(const Image& image, const std::string& path, std::string& error) {
    if (image.empty()) {
        error = path + ": the picture is empty";
        return false;
    }
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    // Flat colours compress to a few kilobytes either way; the slow filters would take longer than the drawing.
    header.flags = PNG_IMAGE_FLAG_FAST;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(header));
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0) {
        error = path + ": " + header.message;
        png_image_free(&header);
        return false;
    }
    return writeImageFile(bytes.data(), size, path, error);
}

}  // namespace swept
