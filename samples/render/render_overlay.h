#pragma once

#include <span>
#include <string>
#include <vector>

#include "../frame.h"
#include "../scene_description.h"
#include "render_options.h"
#include "render_paint.h"
#include "render_view.h"

/// What stands around the bodies: grid, title, time, scale bar, legend.

namespace swept {

/// 1, 2 or 5 times a power of ten, the largest that is not above `limit` (> 0).
double roundLengthBelow(double limit);

/// A length as people say it: "50 cm", "2 m", "5 km".
/// @param metres  1, 2 or 5 times a power of ten.
std::string lengthLabel(double metres);

/// Longest scale bar, as a part of the width of the picture.
inline constexpr double kScaleBarShare = 0.17;

struct ScaleBar {
    double metres = 0;
    double pixels = 0;
    std::string label;
};
/// @param maxPixels  the bar is at most so long, and at least 0.4 times.
ScaleBar scaleBar(double pixelsPerMetre, double maxPixels);

/// "t = 1.25 s", with enough decimals to tell the steps apart.
std::string timeLabel(double time, double dt);

struct LegendEntry {
    Color fill;
    Color edge;
    std::string label;
    bool dashed = false;
    bool outlineOnly = false;
    std::vector<Color> moreFills;  ///< stripes beside `fill`
};
/// Filled with the first colours of the palette.
LegendEntry dynamicLegend(const std::string& label);
/// One entry for each kind of thing that the scene has and the options show.
std::vector<LegendEntry> legendEntries(const SceneDescription& scene, const RenderOptions& options);

/// Sizes of texts and margins, in pixels; they follow the size of the picture.
struct OverlayMetrics {
    explicit OverlayMetrics(const RenderOptions& options);
    double pen;   ///< as in `PixelView`
    double text;  ///< heights of capital letters
    double title;
    double margin;
    double padding;
};

/// Fine lines at a round distance, stronger ones at five or ten times it.
void drawGrid(Paint& paint, const PixelView& view);
/// In the upper left corner; what is too long for the picture is cut off.
/// @param clock  what `drawTime` writes beside it; empty: nothing
void drawTitle(Paint& paint, const OverlayMetrics& metrics, const std::string& title, const std::string& clock);
/// Of a strip that holds the title and its margins, pixels.
double titleHeight(const OverlayMetrics& metrics);
/// In the upper right corner.
void drawTime(Paint& paint, const OverlayMetrics& metrics, const std::string& label);
/// In the lower left corner. The bar is black and begins and ends with an upright tick; its length is that between the
/// outer edges of the ticks.
void drawScaleBar(Paint& paint, const OverlayMetrics& metrics, const ScaleBar& bar);
/// In the lower right corner, in as many rows as needed beside the scale bar.
void drawLegend(Paint& paint, const OverlayMetrics& metrics, std::span<const LegendEntry> entries);
/// Of a strip of that width that holds the legend and its margins, pixels.
double legendHeight(double width, const OverlayMetrics& metrics, std::span<const LegendEntry> entries);
/// Below the title: what continuous collision did in the last step.
void drawSweepWork(Paint& paint, const OverlayMetrics& metrics, const SweepWork& work);
/// In the middle of the upper edge, in red.
void drawWarning(Paint& paint, const OverlayMetrics& metrics, const std::string& text);

}  // namespace swept
