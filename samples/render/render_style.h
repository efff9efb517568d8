#pragma once

#include <cstddef>

#include "../scene_description.h"
#include "render_paint.h"

/// The colours of all pictures, in one place.

namespace swept::style {

inline constexpr Color kBackground = rgb(0xFAFAFA);
inline constexpr Color kGridFine = rgb(0xEFF1F3);
inline constexpr Color kGridCoarse = rgb(0xE1E4E9);
inline constexpr Color kText = rgb(0x2F343B);
inline constexpr Color kPanel = withAlpha(rgb(0xFFFFFF), 205);
inline constexpr Color kJoint = rgb(0x3D434C);
inline constexpr Color kContact = rgb(0xC2255C);
inline constexpr Color kVelocity = rgb(0x1864AB);
inline constexpr Color kGhost = rgb(0xE8590C);
inline constexpr Color kReference = rgb(0xC2255C);
inline constexpr Color kWarning = rgb(0xC92A2A);
inline constexpr Color kSensor = rgb(0xB08900);

/// How much of its own colour a body leaves on what it swept.
inline constexpr double kSweptTone = 0.38;

/// Pixels in a picture of 960 × 540; see `PixelView::pen`.
inline constexpr double kEdgeWidth = 1.6;

struct BodyStyle {
    Color fill;
    Color edge;
};

/// @param index  of the body among the dynamic ones: picks from the palette.
BodyStyle bodyStyle(SceneBodyType type, bool bullet, bool awake, std::size_t index);

/// The fill of the dynamic body of this index while it is awake.
Color paletteColor(std::size_t index);

}  // namespace swept::style
