#include "contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "render_canvas.h"
#include "render_options.h"
#include "render_paint.h"
#include "render_style.h"
#include "stroke_font.h"

namespace swept {

namespace {

constexpr Color kSheet = rgb(0xFFFFFF);
constexpr Color kFrame = rgb(0xD5D9DF);
constexpr double kWidthByHeight = 16.0 / 9.0;

struct SheetLayout {
    int columns = 1;
    int rows = 1;
    int tileWidth = 0;
    int tileHeight = 0;
    int gap = 0;      // pixels between tiles and around all
    int caption = 0;  // height of the line below a tile
    int head = 0;     // height of the title above all
    int foot = 0;     // and of the legend below

    int width() const { return columns * (tileWidth + gap) + gap; }
    int height() const { return head + rows * (tileHeight + caption) + gap + foot; }
    int left(int i) const { return gap + i % columns * (tileWidth + gap); }
    int top(int i) const { return head + gap + i / columns * (tileHeight + caption); }
};

SheetLayout layoutFor(const Image& tile, int count, int columns) {
    SheetLayout layout;
    layout.tileWidth = tile.width;
    layout.tileHeight = tile.height;
    layout.gap = std::max(6, tile.width / 40);
    layout.caption = std::max(22, tile.width / 15);
    const auto tryColumns = [&layout, count](int number) {
        layout.columns = number;
        layout.rows = (count + number - 1) / number;
    };
    tryColumns(std::clamp(columns, 1, count));
    if (columns > 0) { return layout; }
    int best = 1;
    double leastError = INFINITY;
    for (int number = 1; number <= count; ++number) {
        tryColumns(number);
        // An incomplete last row looks like a mistake, so empty places count as well.
        const double emptyShare = static_cast<double>(layout.columns * layout.rows - count) / count;
        const double error = std::abs(std::log(layout.width() / (kWidthByHeight * layout.height()))) + emptyShare;
        if (error < leastError) {
            leastError = error;
            best = number;
        }
    }
    tryColumns(best);
    return layout;
}

/// A line around a tile, so that light pictures do not run into the sheet.
void drawFrame(Image& sheet, int x, int y, int width, int height) {
    const Image across = makeImage(width + 2, 1, kFrame.red, kFrame.green, kFrame.blue);
    const Image down = makeImage(1, height + 2, kFrame.red, kFrame.green, kFrame.blue);
    blit(across, sheet, x - 1, y - 1);
    blit(across, sheet, x - 1, y + height);
    blit(down, sheet, x - 1, y - 1);
    blit(down, sheet, x + width, y - 1);
}

/// Letters as large as those of a picture of the size of the sheet.
OverlayMetrics metricsOf(const SheetLayout& layout) {
    RenderOptions options;
    options.width = layout.width();
    options.height = layout.height();
    return OverlayMetrics(options);
}

/// A strip over all of the width of the sheet, in pieces where that is more than a picture may have.
template <class Draw>
bool drawStrip(Image& sheet, int top, int height, const Draw& draw, std::string& error) {
    if (height == 0) { return true; }
    Paint paint(sheet.width, height);
    draw(paint);
    const int pieces = (sheet.width + kLargestPicture - 1) / kLargestPicture;
    const int width = (sheet.width + pieces - 1) / pieces;
    const std::unique_ptr<RenderCanvas> canvas = RenderCanvas::create(width, height, 3, error);
    if (!canvas) { return false; }
    std::vector<PaintVertex> triangles(paint.triangles().begin(), paint.triangles().end());
    for (int left = 0; left < sheet.width; left += width) {
        blit(canvas->draw(kSheet, triangles), sheet, left, top);
        for (PaintVertex& vertex : triangles) { vertex.x -= static_cast<float>(width); }
    }
    return true;
}

}  // namespace

std::optional<Image> contactSheet(std::span<const Image> tiles, std::span<const std::string> captions, int columns,
                                  std::string& error, const SheetTexts& texts) {
    if (tiles.empty() || captions.size() != tiles.size()) {
        error = "a contact sheet needs pictures, and one caption for each";
        return std::nullopt;
    }
    const Image& first = tiles.front();
    if (first.empty() || std::any_of(tiles.begin(), tiles.end(), [&first](const Image& tile) {
            return tile.width != first.width || tile.height != first.height;
        })) {
        error = "the pictures of a contact sheet must have one size";
        return std::nullopt;
    }
    SheetLayout layout = layoutFor(first, static_cast<int>(tiles.size()), columns);
    const OverlayMetrics metrics = metricsOf(layout);
    if (!texts.title.empty()) { layout.head = static_cast<int>(std::ceil(titleHeight(metrics))); }
    if (!texts.legend.empty()) {
        layout.foot = static_cast<int>(std::ceil(legendHeight(layout.width(), metrics, texts.legend)));
    }
    const std::unique_ptr<RenderCanvas> canvas = RenderCanvas::create(first.width, layout.caption - 2, 3, error);
    if (!canvas) { return std::nullopt; }
    Image sheet = makeImage(layout.width(), layout.height(), kSheet.red, kSheet.green, kSheet.blue);
    for (int i = 0; i < static_cast<int>(tiles.size()); ++i) {
        const auto index = static_cast<std::size_t>(i);
        blit(tiles[index], sheet, layout.left(i), layout.top(i));
        Paint paint(first.width, layout.caption - 2);
        const double textHeight = std::max(9.0, 0.42 * layout.caption);
        drawText(paint, captions[index], {first.width / 2.0, (layout.caption - 2 - textHeight) / 2.0}, textHeight,
                 style::kText, TextAlign::center);
        blit(canvas->draw(kSheet, paint.triangles()), sheet, layout.left(i), layout.top(i) + first.height + 1);
        drawFrame(sheet, layout.left(i), layout.top(i), first.width, first.height);
    }
    const auto addTitle = [&](Paint& paint) { drawTitle(paint, metrics, texts.title, ""); };
    const auto addLegend = [&](Paint& paint) { drawLegend(paint, metrics, texts.legend); };
    const bool isComplete = drawStrip(sheet, 0, layout.head, addTitle, error) &&
                            drawStrip(sheet, layout.height() - layout.foot, layout.foot, addLegend, error);
    return isComplete ? std::optional(std::move(sheet)) : std::nullopt;
}

}  // namespace swept
