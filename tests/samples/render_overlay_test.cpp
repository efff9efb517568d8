#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <swept/samples/render/plain_letters.h>
#include <swept/samples/render/stroke_font.h>

#include "render_support.h"

// What stands around the bodies: scale bar, time, texts, marks, trails, the overlay of a second run.

namespace swept::test {
namespace {

using Type = SceneBodyType;

SceneDescription oneBall(DVec2 velocity = {}) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::dynamic, {0, 0}, circle(0.5))};
    scene.bodies[0].velocity = velocity;
    return scene;
}

TEST(RenderOverlay, TheScaleBarIsAsLongAsItsLabelSays) {
    for (const double height : {0.003, 0.07, 1.0, 5.4, 9.0, 333.0, 80000.0}) {
        RenderOptions options = bareOptions();
        options.view->height = height;
        options.scaleBar = true;
        const Image image = picture(SceneDescription{}, options);
        // The bar is the longest run of its colour; its first and last pixels may be covered in part.
        double longest = 0;
        for (int y = 0; y < image.height; ++y) {
            double run = 0;
            for (int x = 0; x < image.width; ++x) {
                const double covered = (255 - pixel(image, x, y).red) / (255.0 - style::kText.red);
                run = covered > 0.06 ? run + covered : 0;
                longest = std::max(longest, run);
            }
        }
        const ScaleBar bar = scaleBar(540 / height, kScaleBarShare * 960);
        EXPECT_NEAR(longest, bar.metres * 540 / height, 0.6) << "height " << height << ", " << bar.label;
        EXPECT_LE(bar.pixels, kScaleBarShare * 960);
        EXPECT_GE(bar.pixels, 0.4 * kScaleBarShare * 960 - 1e-9);
    }
}

TEST(RenderOverlay, LengthsAreRoundAndNamed) {
    const std::vector<std::pair<double, std::string>> cases{
        {2e-6, "2 \u00B5m"}, {0.001, "1 mm"}, {0.005, "5 mm"}, {0.02, "2 cm"}, {0.5, "50 cm"},
        {1, "1 m"},          {20, "20 m"},    {500, "500 m"},  {1000, "1 km"}, {2e7, "20000 km"}};
    for (const auto& [metres, label] : cases) {
        EXPECT_EQ(lengthLabel(metres), label);
        EXPECT_NEAR(roundLengthBelow(metres), metres, 1e-9 * metres);
        EXPECT_NEAR(roundLengthBelow(1.9 * metres), metres, 1e-9 * metres);
    }
}

TEST(RenderOverlay, TimesHaveEnoughDecimals) {
    EXPECT_EQ(timeLabel(1.25, 1.0 / 60), "t = 1.25 s");
    EXPECT_EQ(timeLabel(0.0005, 0.0005), "t = 0.0005 s");
    EXPECT_EQ(timeLabel(100, 0.5), "t = 100.00 s");
    EXPECT_EQ(fixedDecimals(-0.125, 3), "-0.125");
}

TEST(StrokeFont, EveryPrintableLetterIsItself) {
    std::string error;
    const auto canvas = RenderCanvas::create(48, 48, 1, error);
    ASSERT_NE(canvas, nullptr) << error;
    const auto draw = [&canvas](const std::string& text) {
        Paint paint(48, 48);
        drawText(paint, text, {12, 14}, 24, rgb(0x000000));
        return canvas->draw(rgb(0xFFFFFF), paint.triangles());
    };
    std::vector<Image> seen{draw("\u4E2D")};  // the box for letters that the font does not have
    for (char c = ' '; c <= '~'; ++c) {
        const Image image = draw(std::string(1, c));
        EXPECT_EQ(countColor(image, rgb(0x000000)) > 0, c != ' ') << c;
        for (const Image& other : seen) { EXPECT_FALSE(image == other) << c << " looks like another letter"; }
        seen.push_back(image);
    }
    EXPECT_GT(textWidth("mm", 20), 2 * textWidth("ii", 20));
    EXPECT_NEAR(textWidth("swept", 40), 2 * textWidth("swept", 20), 1e-9);
    for (const char* digit : {"0", "1", "4", "9"}) { EXPECT_EQ(textWidth(digit, 20), textWidth("8", 20)) << digit; }
    EXPECT_EQ(textWidth("", 20), 0);
}

TEST(StrokeFont, LatinLettersLoseTheirAccents) {
    EXPECT_EQ(plainLetters("Fl\u00FCge, \u00C5se & \u0141\u00F3d\u017A"), U"Fluge, Ase & Lodz");
    EXPECT_EQ(plainLetters("Stra\u00DFe \u2013 c\u0153ur \u201Ee\u0301\u201C\u2026"), U"Strasse \u2013 coeur \"e\"...");
    EXPECT_EQ(plainLetters("3 \u00D7 4 \u00B0 \u4E2D"), U"3 \u00D7 4 \u00B0 \u4E2D");
    EXPECT_EQ(textWidth("\u00FC", 20), textWidth("u", 20));
}

TEST(StrokeFont, LongTextsAreCutToTheRoomThereIs) {
    EXPECT_EQ(cutToWidth("short", 20, textWidth("short", 20)), "short");
    EXPECT_EQ(cutToWidth("short", 20, textWidth("short", 20) - 0.01), "sho...");
    EXPECT_EQ(cutToWidth("short", 20, 0), "...");
    EXPECT_EQ(cutToWidth("", 20, 0), "");
    EXPECT_EQ(cutToWidth("m\u00FCller", 20, textWidth("m\u00FC...", 20)), "m\u00FC...") << "no letter is cut in two";
    EXPECT_EQ(cutToWidth(std::string(1'000'000, 'm'), 20, 100), "mmmm...") << "at once";
}

TEST(RenderOverlay, ALongTitleStopsBeforeTheTime) {
    SceneDescription scene = oneBall();
    RenderOptions options = bareOptions();
    options.title = options.time = true;
    scene.name = std::string(500, 'm');
    const Image image = picture(scene, options);
    scene.name = "";
    const Image timeOnly = picture(scene, options);
    int first = 960;  // column of the panel of the time
    for (int x = 0; x < 960; ++x) {
        for (int y = 0; y < 60; ++y) {
            first = pixel(timeOnly, x, y) == style::kBackground ? first : std::min(first, x);
        }
    }
    ASSERT_LT(first, 960);
    for (int x = first - 4; x < 960; ++x) {
        for (int y = 0; y < 60; ++y) { ASSERT_EQ(pixel(image, x, y), pixel(timeOnly, x, y)) << x << ' ' << y; }
    }
}

TEST(RenderOverlay, TitleTimeAndLegendAppearWhenAskedFor) {
    SceneDescription scene = oneBall();
    scene.name = "a ball";
    RenderOptions options = bareOptions();
    const Image bare = picture(scene, options);
    const auto inkIn = [&](int x0, int y0) {
        const Image image = picture(scene, options);
        int ink = 0;
        for (int y = y0; y < y0 + 60; ++y) {
            for (int x = x0; x < x0 + 200; ++x) { ink += near(pixel(image, x, y), style::kText, 40) ? 1 : 0; }
        }
        return ink;
    };
    EXPECT_EQ(countColor(bare, style::kText), 0);
    EXPECT_EQ(inkIn(0, 0), 0);
    options.title = true;
    EXPECT_GT(inkIn(0, 0), 40);
    EXPECT_EQ(inkIn(760, 0), 0);
    options.time = true;
    EXPECT_GT(inkIn(760, 0), 40);
    EXPECT_EQ(inkIn(760, 480), 0);
    options.legend = true;
    EXPECT_GT(inkIn(760, 480), 40);
}

TEST(RenderMarks, VelocitiesContactsAndImpactsAreDrawnWhenAskedFor) {
    SceneDescription scene = oneBall({20, 0});
    Frame frame = initialFrame(scene);
    frame.contacts = {{{-2, 0}, {0, 1}, 0, 1}};
    frame.impacts = {{0, {-3, 1}, 0}};
    RenderOptions options = bareOptions();
    const Image without = makeRenderer(scene, options)->draw(frame);
    options.velocities = options.contacts = options.ghosts = true;
    const Image with = makeRenderer(scene, options)->draw(frame);
    // 20 m/s · 0.1 s: an arrow of two metres.
    EXPECT_TRUE(near(pixelAt(with, {1.5, 0}), style::kVelocity, 60)) << pixelAt(with, {1.5, 0});
    EXPECT_EQ(pixelAt(with, {2.05, 0}), style::kBackground);
    EXPECT_TRUE(near(pixelAt(with, {-2, 0}), style::kContact)) << pixelAt(with, {-2, 0});
    EXPECT_NE(pixelAt(with, {-2, 0.15}), style::kBackground);
    EXPECT_EQ(pixelAt(with, {-2, -0.15}), style::kBackground);
    EXPECT_TRUE(near(pixelAt(with, {-3, 1}), mix(style::kBackground, style::kGhost, 36.0 / 255)))
        << pixelAt(with, {-3, 1});
    for (const DVec2 place : {DVec2{1.5, 0}, DVec2{-2, 0}, DVec2{-3, 1}}) {
        EXPECT_EQ(pixelAt(without, place), style::kBackground);
    }
}

TEST(MotionTrails, LinesAndStrobesFollowTheBody) {
    const SceneDescription scene = oneBall();
    RenderOptions options = bareOptions();
    options.trails = true;
    const auto moved = [&scene](double x) {
        Frame frame = initialFrame(scene);
        frame.bodies[0].position.x = x;
        return frame;
    };
    const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, options);
    const Image before = renderer->draw(moved(3));
    for (int i = 0; i <= 60; ++i) { renderer->addTrail(moved(-3 + 0.1 * i)); }
    const Image line = renderer->draw(moved(3));
    EXPECT_EQ(pixelAt(before, {0, 0}), style::kBackground);
    EXPECT_NE(pixelAt(line, {0, 0}), style::kBackground);
    EXPECT_GT(pixelAt(line, {-2, 0}).green, pixelAt(line, {2, 0}).green) << "older is paler";
    EXPECT_EQ(pixelAt(line, {0, 0.2}), style::kBackground);
    renderer->addStrobe(moved(-1));
    EXPECT_NE(pixelAt(renderer->draw(moved(3)), {-1, 0.3}), style::kBackground);
    renderer->clearTrails();
    EXPECT_TRUE(renderer->draw(moved(3)) == before);
}

/// What turned round within a step did so where it met something.
TEST(MotionTrails, LinesGoByTheImpacts) {
    const SceneDescription scene = oneBall();
    RenderOptions options = bareOptions();
    options.trails = true;
    const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, options);
    Frame frame = initialFrame(scene);
    frame.bodies[0].position = {-3, 0};
    renderer->addTrail(frame);
    frame.impacts = {{0, {2, 0}, 0}, {1, {2, 2}, 0}, {-1, {2, -2}, 0}};
    frame.bodies[0].position = {-3, 1};
    renderer->addTrail(frame);
    const Image image = renderer->draw(frame);
    EXPECT_NE(pixelAt(image, {1.5, 0}), style::kBackground);
    EXPECT_EQ(pixelAt(image, {2.5, 0}), style::kBackground);
    for (const double y : {2.0, -2.0}) { EXPECT_EQ(pixelAt(image, {1.5, y}), style::kBackground) << "of no body"; }
}

TEST(MotionTrails, KeepNoMorePointsThanAsked) {
    const SceneDescription scene = oneBall();
    RenderOptions options = bareOptions();
    options.trails = true;
    options.trailPoints = 11;
    const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, options);
    for (int i = 0; i <= 60; ++i) {
        Frame frame = initialFrame(scene);
        frame.bodies[0].position.x = -3 + 0.1 * i;
        renderer->addTrail(frame);
    }
    Frame last = initialFrame(scene);
    last.bodies[0].position.y = 2;
    const Image image = renderer->draw(last);
    EXPECT_NE(pixelAt(image, {2.5, 0}), style::kBackground);
    EXPECT_EQ(pixelAt(image, {1.8, 0}), style::kBackground);
}

TEST(RenderCompare, TheReferenceIsAnOutlineOnTop) {
    const SceneDescription scene = oneBall();
    RenderOptions options = bareOptions();
    options.legend = true;
    const Frame ours = initialFrame(scene);
    Frame theirs = ours;
    theirs.bodies[0].position.x = 2;
    const Image image = makeRenderer(scene, options)->draw(ours, {&theirs, "swept", "Box2D 2.4.1"});
    EXPECT_TRUE(near(pixelAt(image, {0, 0.25}), style::paletteColor(0)));
    EXPECT_EQ(pixelAt(image, {2, 0.25}), style::kBackground) << "outlines are not filled";
    EXPECT_GT(countPixels(image, [](Color c) { return near(c, style::kReference, 40); }), 250);
    EXPECT_EQ(countPixels(picture(scene, options), [](Color c) { return near(c, style::kReference, 40); }), 0);
}

TEST(RenderErrors, UnusableSizesAndViewsAreRefused) {
    const SceneDescription scene = oneBall();
    const auto refusal = [&scene](auto&& change) {
        RenderOptions options = bareOptions();
        change(options);
        std::string error;
        EXPECT_EQ(SceneRenderer::create(scene, options, error), nullptr);
        return error;
    };
    EXPECT_NE(refusal([](RenderOptions& o) { o.width = 0; }).find("pixels"), std::string::npos);
    EXPECT_NE(refusal([](RenderOptions& o) { o.height = -5; }).find("pixels"), std::string::npos);
    EXPECT_NE(refusal([](RenderOptions& o) { o.width = 100000; }).find("pixels"), std::string::npos);
    EXPECT_NE(refusal([](RenderOptions& o) { o.view->height = 0; }).find("view"), std::string::npos);
    EXPECT_NE(refusal([](RenderOptions& o) { o.view->height = -1; }).find("view"), std::string::npos);
    EXPECT_NE(refusal([](RenderOptions& o) { o.view->height = NAN; }).find("view"), std::string::npos);
    EXPECT_NE(refusal([](RenderOptions& o) { o.view->center.x = INFINITY; }).find("view"), std::string::npos);
}

}  // namespace
}  // namespace swept::test
