#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <swept/samples/render/contact_sheet.h>

#include "render_support.h"

// What is far larger than the picture, and what is more than a picture may be.

namespace swept::test {
namespace {

using Type = SceneBodyType;

void expectFewAndFinite(const Paint& paint, const std::string& what) {
    EXPECT_GT(paint.triangles().size(), 0U) << what;
    EXPECT_LT(paint.triangles().size(), 3'000U) << what;
    for (const PaintVertex& vertex : paint.triangles()) {
        ASSERT_TRUE(std::isfinite(vertex.x) && std::isfinite(vertex.y)) << what;
    }
}

TEST(RenderLarge, DiscsAndLinesCostNoMoreThanSmallOnes) {
    for (const double radius : {10.0, 1e4, 1e5, 1e11, 1e18, 1e40, 1e300}) {
        Paint discs(960, 540);
        discs.disc({480, 270}, radius, style::kContact);
        expectFewAndFinite(discs, "disc of " + std::to_string(radius));
        Paint lines(960, 540);
        lines.line({400, 200}, {500, 300}, 2 * radius, style::kContact);
        expectFewAndFinite(lines, "line of " + std::to_string(radius));
    }
    Paint none(960, 540);
    none.disc({480, 270}, std::nan(""), style::kContact);
    EXPECT_TRUE(none.triangles().empty());
}

TEST(RenderLarge, DiscsEndWhereTheyShould) {
    SceneDescription scene;
    BodyDescription body = makeBody(Type::fixed, {0, 0}, ChainGeometry{{{1e4, -1e4}, {-1e4, -1e4}}}, 1e4);
    scene.bodies = {body};
    const Image image = picture(scene, bareOptions());  // 100 pixels per metre: the ball of each end is 10⁶ wide
    EXPECT_EQ(pixelAt(image, {0, 1}), style::kBackground);
    EXPECT_NE(pixelAt(image, {0, -1}), style::kBackground);
    scene.bodies[0].shapes[0].geometry = ChainGeometry{{{1, 0}, {-1, 0}}};
    scene.bodies[0].shapes[0].radius = 1e12;
    const Color inside = pixelAt(picture(scene, bareOptions()), {0, 0});
    EXPECT_NE(inside, style::kBackground);
    EXPECT_EQ(pixelAt(picture(scene, bareOptions()), {4, 2}), inside) << "all of the picture is in it";
}

/// A drum is hollow, and a sensor stops nothing.
TEST(RenderLarge, SweptAreasAreThoseOfSolidShapes) {
    SceneDescription scene;
    const std::vector<DVec2> drum{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};
    scene.bodies = {makeBody(Type::kinematic, {0, 0}, ChainGeometry{drum, true}),
                    makeBody(Type::dynamic, {0, 0}, circle(0.25)), makeBody(Type::kinematic, {3, 0}, box(0.5, 0.5))};
    scene.bodies[2].shapes[0].sensor = true;
    RenderOptions options = bareOptions();
    options.sweeps = true;
    options.sweepWork = false;
    Frame frame = initialFrame(scene);
    for (int body = 0; body < 3; ++body) {
        WayFrame way;
        way.body = body;
        PoseFrame pose;
        pose.position = scene.bodies[static_cast<std::size_t>(body)].position;
        way.poses.push_back(pose);
        pose.position.y += 0.75;
        pose.angle = 1e20 * (body == 1 ? 1 : 0);  // a ball that turns faster than any int counts
        way.poses.push_back(pose);
        frame.ways.push_back(way);
    }
    frame.ways.push_back({});  // of nobody, and without a pose
    const Image image = makeRenderer(scene, options)->draw(frame);
    EXPECT_EQ(pixelAt(image, {0.6, 0.1}), style::kBackground) << "in the drum";
    EXPECT_NE(pixelAt(image, {0.1, 0.6}), style::kBackground) << "where the ball went";
    EXPECT_EQ(pixelAt(image, {3.2, 1}), style::kBackground) << "where the sensor went";
}

TEST(RenderLarge, ContactSheetsMayBeWiderThanAPicture) {
    const std::vector<Image> tiles(5, makeImage(1920, 30, 200, 0, 0));
    const std::vector<std::string> captions(5);
    std::string error;
    SheetTexts texts;
    texts.title =
        "a title so long that it has letters on all of the sheet, or at least on a good part of its left side";
    texts.legend = {};
    const std::optional<Image> sheet = contactSheet(tiles, captions, 5, error, texts);
    ASSERT_TRUE(sheet.has_value()) << error;
    EXPECT_GT(sheet->width, 8192);
    int inked = 0;
    for (int x = 0; x < sheet->width; ++x) {
        for (int y = 0; y < sheet->height / 2; ++y) { inked += pixel(*sheet, x, y).green < 100 ? 1 : 0; }
    }
    EXPECT_GT(inked, 5 * 1920 * 5) << "tiles and letters";
}

}  // namespace
}  // namespace swept::test
