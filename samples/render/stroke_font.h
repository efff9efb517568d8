#pragma once

#include <string>
#include <string_view>

#include "render_paint.h"

namespace swept {

enum class TextAlign : std::uint8_t { left, center, right };

/// Width of a text in pixels, from the left edge of its first letter to the right edge of its last.
/// @param text    UTF-8; of what is not printable ASCII (or ° µ × – ·), Latin letters lose their accents, and others
///                show as a box (plain_letters.h).
/// @param height  of a capital letter, in pixels.
double textWidth(std::string_view text, double height);

/// The text, or as much of its beginning as fits, with dots behind it. Never less than the dots.
std::string cutToWidth(std::string_view text, double height, double width);

/// Draws one line of text in the built-in stroke font (own design, after road-sign lettering).
/// @param base  on the base line, at the end that `align` says, in pixels.
void drawText(Paint& paint, std::string_view text, DVec2 base, double height, Color color,
              TextAlign align = TextAlign::left);

/// A number in plain decimals, independent of the locale.
std::string fixedDecimals(double value, int decimals);

}  // namespace swept
