#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image.h"
#include "render_overlay.h"

namespace swept {

/// What a contact sheet says once, for all of its pictures.
struct SheetTexts {
    std::string title;                ///< above them; empty: none
    std::vector<LegendEntry> legend;  ///< below them; empty: none
};

/// Several pictures in one, row by row, each with a line of text below it.
/// @param tiles     of one size.
/// @param captions  as many as tiles.
/// @param columns   0 chooses the number that makes the sheet most nearly as wide as a 16:9 screen.
/// @return nothing, and a reason in `error`, when there are no tiles or they do not fit together.
std::optional<Image> contactSheet(std::span<const Image> tiles, std::span<const std::string> captions, int columns,
                                  std::string& error, const SheetTexts& texts = {});

}  // namespace swept
