#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <string>

#include <swept/samples/render/image.h>

namespace swept::test {

/// A PNG file, by the library that everybody uses.
inline Image readPng(const std::string& path) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&header, path.c_str()), 0) << header.message;
    EXPECT_EQ(header.format, static_cast<png_uint_32>(PNG_FORMAT_RGB)) << "8 bits, no alpha";
    header.format = PNG_FORMAT_RGB;
    Image image = makeImage(static_cast<int>(header.width), static_cast<int>(header.height), 0, 0, 0);
    EXPECT_NE(png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr), 0) << header.message;
    return image;
}

}  // namespace swept::test
