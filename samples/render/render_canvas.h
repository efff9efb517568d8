#pragma once

#include <memory>
#include <span>
#include <string>

#include "image.h"
#include "render_paint.h"

namespace swept {

/// Most pixels of a picture in each direction.
inline constexpr int kLargestPicture = 8192;

/// An off-screen OpenGL framebuffer (OSMesa, in software: no display, no graphics card). Smooth edges come from drawing
/// several times larger and averaging, which gives the same pixels on every run.
class RenderCanvas {
public:
    /// @param width, height  of the pictures, in pixels.
    /// @param superSampling  samples per pixel and direction; lowered as far as the largest framebuffer demands.
    /// @return null, and a reason in `error`, when the size or OSMesa does not allow it.
    static std::unique_ptr<RenderCanvas> create(int width, int height, int superSampling, std::string& error);
    ~RenderCanvas();

    /// Draws triangles (three vertices each, pixel coordinates, y up from the bottom) in their order over a background.
    Image draw(Color background, std::span<const PaintVertex> triangles);

private:
    struct Target;
    explicit RenderCanvas(std::unique_ptr<Target> target);
    std::unique_ptr<Target> target_;
};

}  // namespace swept
