#include <gtest/gtest.h>
#include <sys/stat.h>
#include <webp/demux.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <swept/samples/begun_file.h>
#include <swept/samples/render/contact_sheet.h>
#include <swept/samples/render/image_png.h>
#include <swept/samples/render/image_webp.h>

#include "../support/png_file.h"
#include "../support/random.h"
#include "render_support.h"

// Pictures as files, read back by the libraries that everybody uses.

namespace swept::test {
namespace {

std::string scratchFile(const std::string& name) {
    return (std::filesystem::path(testing::TempDir()) / ("swept_image_files_" + name)).string();
}

Image noise(int width, int height, std::uint64_t seed) {
    Image image = makeImage(width, height, 0, 0, 0);
    Random random(seed);
    for (std::uint8_t& byte : image.rgb) { byte = static_cast<std::uint8_t>(random.bits() & 255U); }
    return image;
}

TEST(PngFiles, ReadBackAsTheyWereDrawn) {
    SceneDescription scene;
    scene.name = "round trip";
    scene.bodies = {makeBody(SceneBodyType::dynamic, {0, 0}, circle(1))};
    const std::vector<Image> images{picture(scene, RenderOptions{}), noise(33, 7, 1), noise(1, 1, 2), noise(640, 3, 3)};
    const std::string path = scratchFile("round_trip.png");
    for (const Image& image : images) {
        std::string error;
        ASSERT_TRUE(writePng(image, path, error)) << error;
        EXPECT_TRUE(readPng(path) == image) << image.width << " x " << image.height;
    }
    std::filesystem::remove(path);
}

TEST(WebpFiles, HoldEveryFrameAtItsTime) {
    const std::vector<int> times{0, 40, 90, 250};
    const std::string path = scratchFile("frames.webp");
    std::vector<Image> images;
    WebpWriter writer;
    for (std::size_t i = 0; i < times.size(); ++i) {
        images.push_back(noise(48, 32, 10 + i));
        ASSERT_TRUE(writer.add(images.back(), times[i]));
    }
    std::string error;
    ASSERT_TRUE(writer.finish(path, 300, error)) << error;

    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
    WebPAnimDecoder* const decoder = WebPAnimDecoderNew(&data, nullptr);
    ASSERT_NE(decoder, nullptr);
    WebPAnimInfo info;
    ASSERT_NE(WebPAnimDecoderGetInfo(decoder, &info), 0);
    EXPECT_EQ(info.frame_count, 4u);
    EXPECT_EQ(info.loop_count, 0u) << "for ever";
    EXPECT_EQ(info.canvas_width, 48u);
    const std::vector<int> ends{40, 90, 250, 300};
    for (std::size_t i = 0; i < images.size(); ++i) {
        std::uint8_t* rgba = nullptr;
        int end = 0;
        ASSERT_NE(WebPAnimDecoderGetNext(decoder, &rgba, &end), 0);
        EXPECT_EQ(end, ends[i]);
        const std::vector<std::uint8_t> pixels(rgba, rgba + std::ptrdiff_t{4} * 48 * 32);
        EXPECT_TRUE(downsample(pixels, 48, 32, 1) == images[i]) << "frame " << i;
    }
    WebPAnimDecoderDelete(decoder);
    std::filesystem::remove(path);
}

TEST(WebpFiles, RefuseWhatMakesNoAnimation) {
    const std::string path = scratchFile("refused.webp");
    std::string error;
    EXPECT_FALSE(WebpWriter().finish(path, 10, error));
    EXPECT_NE(error.find("needs a picture"), std::string::npos) << error;
    {
        WebpWriter writer;
        EXPECT_TRUE(writer.add(noise(8, 8, 1), 0));
        EXPECT_FALSE(writer.add(noise(9, 8, 1), 10));
        EXPECT_FALSE(writer.add(noise(8, 8, 1), 20)) << "an error stays";
        EXPECT_FALSE(writer.finish(path, 30, error));
        EXPECT_NE(error.find("one size"), std::string::npos) << error;
    }
    {
        WebpWriter writer;
        EXPECT_TRUE(writer.add(noise(8, 8, 1), 0));
        EXPECT_FALSE(writer.add(noise(8, 8, 2), 0));
        EXPECT_FALSE(writer.finish(path, 30, error));
        EXPECT_NE(error.find("timestamps"), std::string::npos) << error;
    }
    EXPECT_FALSE(std::filesystem::exists(path)) << "nothing is written";
}

TEST(ImageFiles, SayWhyTheyCannotBeWritten) {
    const std::string path = scratchFile("no_such_folder") + "/picture";
    std::string error;
    EXPECT_FALSE(writePng(noise(4, 4, 1), path + ".png", error));
    EXPECT_EQ(error, path + ".png: No such file or directory");
    WebpWriter writer;
    ASSERT_TRUE(writer.add(noise(4, 4, 1), 0));
    EXPECT_FALSE(writer.finish(path + ".webp", 10, error));
    EXPECT_EQ(error, path + ".webp: No such file or directory");
    EXPECT_FALSE(writePng(Image{}, scratchFile("empty.png"), error));
    EXPECT_NE(error.find("empty"), std::string::npos) << error;
}

TEST(ImageFiles, AFullDiskIsReported) {
    if (!std::filesystem::exists("/dev/full")) { GTEST_SKIP() << "this system has no /dev/full"; }
    std::string error;
    // Through a link: what was not written completely is removed, and that must be the link.
    const std::string path = scratchFile("full.png");
    std::filesystem::remove(path);
    std::filesystem::create_symlink("/dev/full", path);
    EXPECT_FALSE(writePng(noise(300, 300, 1), path, error));
    EXPECT_EQ(error, path + ": No space left on device");
    EXPECT_FALSE(std::filesystem::is_symlink(path));
}

TEST(ImageFiles, OnlyRegularFilesAreTakenAwayAsBegun) {
    const std::string path = scratchFile("begun");
    const std::string link = scratchFile("link");
    std::filesystem::remove(path);
    std::filesystem::remove(link);
    std::ofstream(path) << "half";
    std::filesystem::create_symlink(path, link);
    removeBegunFile(link);
    EXPECT_FALSE(std::filesystem::exists(path)) << "what is half written lies behind the link";
    EXPECT_FALSE(std::filesystem::is_symlink(link));
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    removeBegunFile(path);
    EXPECT_TRUE(std::filesystem::is_fifo(path));
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    removeBegunFile(path);
    EXPECT_TRUE(std::filesystem::is_directory(path));
    std::filesystem::remove(path);
}

TEST(Images, DownsamplingRoundsTheMean) {
    std::vector<std::uint8_t> rgba(4 * 4 * 2, 0);  // 4 × 2 pixels, two of the result
    for (std::size_t i = 0; i < 8; ++i) { rgba[4 * i] = static_cast<std::uint8_t>(10 * i); }
    const Image image = downsample(rgba, 2, 1, 2);
    ASSERT_EQ(image.rgb.size(), 6u);
    EXPECT_EQ(image.rgb[0], 25);  // (0 + 10 + 40 + 50) / 4
    EXPECT_EQ(image.rgb[3], 45);  // (20 + 30 + 60 + 70) / 4
    EXPECT_EQ(image.rgb[1], 0);
}

TEST(Images, BlitClipsOnAllSides) {
    const Image stamp = makeImage(4, 4, 9, 9, 9);
    for (const auto& [x, y, covered] : {std::array{-2, -2, 4}, std::array{8, 8, 4}, std::array{3, 3, 16},
                                        std::array{-4, 0, 0}, std::array{10, 2, 0}, std::array{0, -9, 0}}) {
        Image target = makeImage(10, 10, 0, 0, 0);
        blit(stamp, target, x, y);
        EXPECT_EQ(countColor(target, {9, 9, 9, 255}), covered) << x << ", " << y;
    }
}

TEST(ContactSheets, ShowAllTilesInOrderWithCaptions) {
    std::vector<Image> tiles;
    std::vector<std::string> captions;
    for (int i = 0; i < 6; ++i) {
        tiles.push_back(makeImage(160, 90, static_cast<std::uint8_t>(20 + 30 * i), 0, 0));
        captions.push_back(timeLabel(0.5 * i, 0.1));
    }
    std::string error;
    const std::optional<Image> sheet = contactSheet(tiles, captions, 3, error);
    ASSERT_TRUE(sheet.has_value()) << error;
    EXPECT_GT(sheet->width, 3 * 160);
    EXPECT_LT(sheet->width, 4 * 160);
    for (const Image& tile : tiles) {
        EXPECT_GE(countPixels(*sheet, [&](Color c) { return c == pixel(tile, 0, 0); }), 160 * 90);
    }
    int lastRed = 0;
    for (int x = 0; x < sheet->width; ++x) {  // the first row of tiles
        const Color c = pixel(*sheet, x, 60);
        if (c.green == 0) {
            EXPECT_GE(c.red, lastRed);
            lastRed = c.red;
        }
    }
    EXPECT_EQ(lastRed, 80);
    const std::vector<std::string> noCaptions(6);
    const std::optional<Image> silent = contactSheet(tiles, noCaptions, 3, error);
    EXPECT_GT(countPixels(*sheet, [](Color c) { return near(c, style::kText, 30); }), 200);
    EXPECT_EQ(countPixels(*silent, [](Color c) { return near(c, style::kText, 20); }), 0);
}

TEST(ContactSheets, SayOnceWhatHoldsForAll) {
    const std::vector<Image> tiles(4, makeImage(160, 90, 200, 0, 0));
    const std::vector<std::string> captions(4);
    std::string error;
    const auto bare = contactSheet(tiles, captions, 2, error);
    SheetTexts texts;
    texts.title = "falling";
    const auto titled = contactSheet(tiles, captions, 2, error, texts);
    texts.legend = {dynamicLegend("dynamic")};
    const auto whole = contactSheet(tiles, captions, 2, error, texts);
    ASSERT_TRUE(bare && titled && whole) << error;
    EXPECT_EQ(titled->width, bare->width);
    EXPECT_GT(titled->height, bare->height + 10);
    EXPECT_GT(whole->height, titled->height + 10);
    const auto inked = [](const Image& image) {
        return countPixels(image, [](Color c) { return c.green > 0 && c.green < 200; });  // of letters and swatches
    };
    EXPECT_EQ(inked(*bare), 0);
    EXPECT_GT(inked(*titled), 30);
    EXPECT_GT(inked(*whole), inked(*titled) + 30);
    for (const auto& sheet : {bare, titled, whole}) {
        EXPECT_EQ(countColor(*sheet, pixel(tiles[0], 0, 0)), 4 * 160 * 90) << "nothing lies over the pictures";
    }
}

TEST(ContactSheets, RefuseWhatDoesNotFit) {
    std::string error;
    EXPECT_FALSE(contactSheet({}, {}, 2, error).has_value());
    EXPECT_NE(error, "");
    const std::vector<Image> tiles{makeImage(10, 10, 0, 0, 0), makeImage(11, 10, 0, 0, 0)};
    const std::vector<std::string> captions{"a", "b"};
    EXPECT_FALSE(contactSheet(tiles, captions, 2, error).has_value());
    EXPECT_NE(error.find("one size"), std::string::npos);
}

}  // namespace
}  // namespace swept::test
