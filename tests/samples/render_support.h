#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include <swept/samples/render/render_style.h>
#include <swept/samples/render/scene_renderer.h>

/// Scenes of known geometry, and questions about the pixels of their pictures.

namespace swept::test {

/// 100 pixels per metre, the origin in the middle; nothing but the bodies.
inline RenderOptions bareOptions() {
    RenderOptions options;
    options.width = 960;
    options.height = 540;
    options.superSampling = 3;
    options.view = ViewDescription{{0, 0}, 5.4};
    options.grid = options.title = options.time = options.scaleBar = options.legend = false;
    return options;
}

inline BodyDescription makeBody(SceneBodyType type, DVec2 position, Geometry geometry, double radius = 0) {
    BodyDescription body;
    body.type = type;
    body.position = position;
    body.shapes.resize(1);
    body.shapes[0].geometry = std::move(geometry);
    body.shapes[0].radius = radius;
    return body;
}

inline BoxGeometry box(double halfX, double halfY) { return {{halfX, halfY}, {}, 0}; }
inline CircleGeometry circle(double radius) { return {{}, radius}; }

/// The initial state of a scene.
inline Frame initialFrame(const SceneDescription& scene) {
    Frame frame;
    for (const BodyDescription& body : scene.bodies) {
        BodyFrame state;
        state.position = body.position;
        state.angle = body.angle;
        state.velocity = body.velocity;
        state.angularVelocity = body.angularVelocity;
        state.awake = body.awake && body.type != SceneBodyType::fixed;
        frame.bodies.push_back(state);
    }
    return frame;
}

inline std::unique_ptr<SceneRenderer> makeRenderer(const SceneDescription& scene, const RenderOptions& options) {
    std::string error;
    std::unique_ptr<SceneRenderer> renderer = SceneRenderer::create(scene, options, error);
    EXPECT_NE(renderer, nullptr) << error;
    EXPECT_EQ(error, "");
    return renderer;
}

inline Image picture(const SceneDescription& scene, const RenderOptions& options) {
    return makeRenderer(scene, options)->draw(initialFrame(scene));
}

inline Color pixel(const Image& image, int x, int y) {
    const std::uint8_t* p = image.at(x, y);
    return {p[0], p[1], p[2], 255};
}

/// The pixel at a place of the world, for pictures made with `bareOptions`.
inline Color pixelAt(const Image& image, DVec2 world) {
    return pixel(image, static_cast<int>(std::floor(480 + 100 * world.x)),
                 static_cast<int>(std::floor(270 - 100 * world.y)));
}

/// Blending rounds; two units of 255 are no difference.
inline bool near(Color a, Color b, int tolerance = 2) {
    return std::abs(a.red - b.red) <= tolerance && std::abs(a.green - b.green) <= tolerance &&
           std::abs(a.blue - b.blue) <= tolerance;
}

template <class Wanted>
int countPixels(const Image& image, Wanted&& wanted) {
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) { count += wanted(pixel(image, x, y)) ? 1 : 0; }
    }
    return count;
}

inline int countColor(const Image& image, Color color) {
    return countPixels(image, [color](Color c) { return near(c, color); });
}

}  // namespace swept::test

namespace swept {

inline std::ostream& operator<<(std::ostream& out, const Color& c) {
    return out << "rgb(" << int{c.red} << ", " << int{c.green} << ", " << int{c.blue} << ")";
}

}  // namespace swept
