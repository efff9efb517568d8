#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "../../shapes/dvec2.h"

namespace swept {

struct Color {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    std::uint8_t alpha = 255;

    constexpr bool operator==(const Color&) const = default;
};

/// 0xRRGGBB.
constexpr Color rgb(std::uint32_t hex) {
    return {static_cast<std::uint8_t>(hex >> 16 & 255u), static_cast<std::uint8_t>(hex >> 8 & 255u),
            static_cast<std::uint8_t>(hex & 255u), 255};
}
constexpr Color withAlpha(Color color, std::uint8_t alpha) { return {color.red, color.green, color.blue, alpha}; }
/// `amount` 0 gives `from`, 1 gives `to`.
Color mix(Color from, Color to, double amount);

/// A corner of a triangle, in pixels, as OpenGL reads it.
struct PaintVertex {
    float x = 0;
    float y = 0;
    Color color;
};
static_assert(sizeof(PaintVertex) == 12 && std::is_standard_layout_v<PaintVertex>, "OpenGL reads it in place");

/// A rectangle in pixels that contains its edges.
struct PixelBox {
    DVec2 low;
    DVec2 high;

    bool contains(DVec2 p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
    PixelBox grownBy(double margin) const { return {low - DVec2{margin, margin}, high + DVec2{margin, margin}}; }
};

/// The part of a segment inside a box, as fractions of its length; `from > to` when there is none.
struct VisiblePart {
    double from = 1;
    double to = 0;
};
VisiblePart clipSegment(DVec2 p, DVec2 q, const PixelBox& box);

/// Cuts away what lies on the left of the directed line through `p` along `direction` (any length), in place.
/// @param points  a convex outline.
void cutLeftOf(std::vector<DVec2>& points, DVec2 p, DVec2 direction);

/// Cuts a convex outline to a box, in place; no coordinate is too large.
void clipToBox(std::vector<DVec2>& points, const PixelBox& box);

/// Collects a drawing as triangles, in painter's order. Coordinates are pixels in double, y up from the bottom left,
/// and may be as large as they like: everything is clipped to the picture before it becomes float. Drawings with a
/// coordinate that is not finite are left out. Strokes overlap themselves at their joins: draw them opaque.
class Paint {
public:
    Paint(int width, int height);

    /// @param outline  convex, in either order.
    void fillConvex(std::span<const DVec2> outline, Color color);
    /// A quadrilateral from edge `p`–`q` in `color` to edge `pFar`–`qFar` in `farColor`; not clipped.
    void fillGradient(DVec2 p, DVec2 q, DVec2 pFar, DVec2 qFar, Color color, Color farColor);
    void fillBox(const PixelBox& box, double cornerRadius, Color color);
    void disc(DVec2 center, double radius, Color color);

    /// A straight stroke with flat ends.
    void line(DVec2 p, DVec2 q, double width, Color color);
    /// A stroke with round joins and, unless closed, round ends. One point gives a dot.
    void polyline(std::span<const DVec2> points, bool closed, double width, Color color);
    void dashed(std::span<const DVec2> points, bool closed, double width, double dash, double gap, Color color);
    /// From `tail` to `tip`, whose head is at most half as long as the arrow.
    void arrow(DVec2 tail, DVec2 tip, double width, Color color);

    /// The picture.
    const PixelBox& box() const { return box_; }
    std::span<const PaintVertex> triangles() const { return triangles_; }
    void clear() { triangles_.clear(); }

private:
    void add(DVec2 p, Color color);
    void triangle(DVec2 a, DVec2 b, DVec2 c, Color color);

    PixelBox box_;
    std::vector<PaintVertex> triangles_;
    std::vector<DVec2> clipped_;
};

}  // namespace swept
