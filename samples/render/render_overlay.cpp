#include "render_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "render_style.h"
#include "stroke_font.h"

namespace swept {

namespace {

constexpr double kGridTarget = 28;  // pixels between fine lines, at least

PixelBox panel(Paint& paint, const OverlayMetrics& m, DVec2 low, DVec2 size) {
    const PixelBox box{low, low + size};
    paint.fillBox(box, m.padding * 0.7, style::kPanel);
    return box;
}

void gridLines(Paint& paint, const PixelView& view, double spacing, int skipEvery, Color color) {
    const DVec2 halfSize = 1 / view.scale * view.middle;
    const auto lines = [&](double center, double half, auto&& draw) {
        // Counted from the line next to the centre, so that far from the origin no digit of the pixels is lost.
        const double first = std::floor((center - half) / spacing);
        const double count = std::ceil((center + half) / spacing) - first;
        for (double k = 0; k <= count; ++k) {
            const bool skipped = skipEvery > 0 && std::fmod(first + k, skipEvery) == 0;
            if (!skipped) { draw(view.scale * ((first + k) * spacing - center)); }
        }
    };
    lines(view.center.x, halfSize.x, [&](double x) {
        const double at = std::round(view.middle.x + x) + 0.5;
        paint.line({at, 0}, {at, paint.box().high.y}, 1, color);
    });
    lines(view.center.y, halfSize.y, [&](double y) {
        const double at = std::round(view.middle.y + y) + 0.5;
        paint.line({0, at}, {paint.box().high.x, at}, 1, color);
    });
}

void swatch(Paint& paint, DVec2 center, double size, const LegendEntry& entry, double pen) {
    const PixelBox box{center - 0.5 * DVec2{size, size}, center + 0.5 * DVec2{size, size}};
    const std::array<DVec2, 4> corners{{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}};
    if (entry.dashed || entry.outlineOnly) {
        if (entry.dashed) {
            paint.fillConvex(corners, entry.fill);
            paint.dashed(corners, true, 1.2 * pen, 3 * pen, 2.2 * pen, entry.edge);
        } else {
            paint.polyline(corners, true, 1.5 * pen, entry.edge);
        }
        return;
    }
    paint.fillBox(box, 2.5 * pen, entry.edge);
    const PixelBox inner = box.grownBy(-1.4 * pen);
    paint.fillBox(inner, 1.4 * pen, entry.fill);
    const auto parts = static_cast<double>(entry.moreFills.size() + 1);
    for (std::size_t i = 0; i < entry.moreFills.size(); ++i) {
        const double from = static_cast<double>(i + 1) / parts;
        const double to = static_cast<double>(i + 2) / parts;
        const double width = inner.high.x - inner.low.x;
        const PixelBox stripe{{inner.low.x + from * width, inner.low.y}, {inner.low.x + to * width, inner.high.y}};
        paint.fillBox(stripe, 0, entry.moreFills[i]);
    }
}

/// Where the entries of a legend go, in pixels.
struct LegendLayout {
    LegendLayout(double pictureWidth, const OverlayMetrics& m, std::span<const LegendEntry> entries)
        : size(1.15 * m.text), gap(1.5 * m.text), rowHeight(1.9 * m.text) {
        const double available = (1 - kScaleBarShare) * pictureWidth - 4 * m.margin - 4 * m.padding;
        for (const LegendEntry& entry : entries) {
            const double width = widthOf(entry, m);
            if (rows.empty() || rows.back() + gap + width > available) {
                rows.push_back(width);
            } else {
                rows.back() += gap + width;
            }
            rowOf.push_back(rows.size() - 1);
        }
    }

    double widthOf(const LegendEntry& entry, const OverlayMetrics& m) const {
        return 1.55 * size + textWidth(entry.label, m.text);
    }
    DVec2 panelSize(const OverlayMetrics& m) const {
        const double widest = rows.empty() ? 0 : *std::max_element(rows.begin(), rows.end());
        const double more = rows.empty() ? 0 : static_cast<double>(rows.size() - 1) * rowHeight;
        return {widest + 2 * m.padding, more + size + 2 * m.padding};
    }

    double size;  // of a swatch
    double gap;
    double rowHeight;
    std::vector<double> rows;  // widths
    std::vector<std::size_t> rowOf;
};

}  // namespace

double roundLengthBelow(double limit) {
    const double power = std::pow(10.0, std::floor(std::log10(limit)));
    for (const double factor : {10.0, 5.0, 2.0}) {
        // A little tolerance: 10^k is not exact, and 0.5 must stay 0.5.
        if (factor * power <= limit * (1 + 1e-12)) { return factor * power; }
    }
    return power;
}

std::string lengthLabel(double metres) {
    struct Unit {
        double metres;
        const char* name;
    };
    constexpr std::array<Unit, 5> kUnits{{{1e3, " km"}, {1, " m"}, {1e-2, " cm"}, {1e-3, " mm"}, {1e-6, " \u00B5m"}}};
    for (const Unit& unit : kUnits) {
        const double count = metres / unit.metres;
        if (count > 0.999 && count < 9.99e5) { return fixedDecimals(std::round(count), 0) + unit.name; }
    }
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.0e m", metres);  // no decimals, hence no locale
    return text.data();
}

ScaleBar scaleBar(double pixelsPerMetre, double maxPixels) {
    const double metres = roundLengthBelow(maxPixels / pixelsPerMetre);
    return {metres, metres * pixelsPerMetre, lengthLabel(metres)};
}

std::string timeLabel(double time, double dt) {
    const int needed = dt > 0 ? static_cast<int>(std::ceil(-std::log10(dt))) : 2;
    return "t = " + fixedDecimals(time, std::clamp(needed, 2, 9)) + " s";
}

std::vector<LegendEntry> legendEntries(const SceneDescription& scene, const RenderOptions& options) {
    const auto any = [&scene](auto&& test) { return std::any_of(scene.bodies.begin(), scene.bodies.end(), test); };
    const auto isPlain = [](const BodyDescription& b) { return b.type == SceneBodyType::dynamic && !b.bullet; };
    const auto isSensor = [](const ShapeDescription& s) { return s.sensor; };
    std::vector<LegendEntry> entries;
    const auto add = [&entries](const style::BodyStyle& look, const char* label) {
        entries.push_back({look.fill, look.edge, label, false, false, {}});
    };
    if (any([](const BodyDescription& b) { return b.type == SceneBodyType::fixed; })) {
        add(style::bodyStyle(SceneBodyType::fixed, false, false, 0), "static");
    }
    if (any([](const BodyDescription& b) { return b.type == SceneBodyType::kinematic; })) {
        add(style::bodyStyle(SceneBodyType::kinematic, false, true, 0), "kinematic");
    }
    if (any(isPlain)) { entries.push_back(dynamicLegend("dynamic")); }
    if (any(isPlain) && scene.settings.sleep) {
        add(style::bodyStyle(SceneBodyType::dynamic, false, false, 0), "asleep");
    }
    if (any([](const BodyDescription& b) { return b.bullet && b.type == SceneBodyType::dynamic; })) {
        add(style::bodyStyle(SceneBodyType::dynamic, true, true, 0), "bullet");
    }
    if (any([&](const BodyDescription& b) { return std::any_of(b.shapes.begin(), b.shapes.end(), isSensor); })) {
        entries.push_back({withAlpha(style::kSensor, 32), style::kSensor, "sensor", true, false, {}});
    }
    if (options.sweeps) {
        const Color tone = mix(style::kBackground, style::paletteColor(0), style::kSweptTone);
        entries.push_back({tone, style::paletteColor(0), "swept", false, false, {}});
        add({style::kContact, style::kContact}, "impact normal");
    }
    if (options.ghosts || options.sweeps) {
        entries.push_back({withAlpha(style::kGhost, 36), style::kGhost, "at impact", true, false, {}});
    }
    if (options.contacts) { add({style::kContact, style::kContact}, "contact"); }
    if (options.velocities) {
        std::string label = "velocity \u00D7 " + fixedDecimals(options.velocitySeconds, 2) + " s";
        entries.push_back({style::kVelocity, style::kVelocity, label, false, false, {}});
    }
    return entries;
}

LegendEntry dynamicLegend(const std::string& label) {
    const style::BodyStyle look = style::bodyStyle(SceneBodyType::dynamic, false, true, 0);
    return {look.fill, look.edge, label, false, false, {style::paletteColor(1), style::paletteColor(2)}};
}

OverlayMetrics::OverlayMetrics(const RenderOptions& options) {
    const double scale = penScale(options);
    pen = scale;
    text = 10 * scale;
    title = 13 * scale;
    margin = 12 * scale;
    padding = 8 * scale;
}

void drawGrid(Paint& paint, const PixelView& view) {
    const double fine = roundLengthBelow(2.5 * kGridTarget / view.scale);
    const double lead = fine / std::pow(10.0, std::floor(std::log10(fine) + 1e-9));
    const int coarse = lead > 1.5 && lead < 2.5 ? 5 : 10;  // 2 → 10, 1 → 10, 5 → 50
    gridLines(paint, view, fine, coarse, style::kGridFine);
    gridLines(paint, view, coarse * fine, 0, style::kGridCoarse);
}

void drawTitle(Paint& paint, const OverlayMetrics& m, const std::string& whole, const std::string& clock) {
    const double taken = clock.empty() ? 0 : textWidth(clock, m.title) + 2 * m.padding + m.margin;
    const std::string title = cutToWidth(whole, m.title, paint.box().high.x - 2 * m.margin - 2 * m.padding - taken);
    const DVec2 size{textWidth(title, m.title) + 2 * m.padding, m.title + 2 * m.padding};
    const PixelBox box = panel(paint, m, {m.margin, paint.box().high.y - m.margin - size.y}, size);
    drawText(paint, title, box.low + DVec2{m.padding, m.padding}, m.title, style::kText);
}

double titleHeight(const OverlayMetrics& m) { return m.title + 2 * m.padding + 2 * m.margin; }

void drawTime(Paint& paint, const OverlayMetrics& m, const std::string& label) {
    const DVec2 size{textWidth(label, m.title) + 2 * m.padding, m.title + 2 * m.padding};
    const PixelBox box = panel(paint, m, paint.box().high - DVec2{m.margin, m.margin} - size, size);
    drawText(paint, label, box.low + DVec2{m.padding, m.padding}, m.title, style::kText);
}

void drawScaleBar(Paint& paint, const OverlayMetrics& m, const ScaleBar& bar) {
    const double width = std::max(bar.pixels, textWidth(bar.label, m.text));
    const DVec2 size{width + 2 * m.padding, 2.1 * m.text + 2 * m.padding};
    const PixelBox box = panel(paint, m, {m.margin, m.margin}, size);
    const DVec2 low = box.low + DVec2{m.padding + (width - bar.pixels) / 2, m.padding};
    const double thick = 2 * m.pen;
    const double tick = 0.55 * m.text;
    const auto block = [&](double left, double right, double height) {
        const std::array<DVec2, 4> corners{
            {low + DVec2{left, 0}, low + DVec2{right, 0}, low + DVec2{right, height}, low + DVec2{left, height}}};
        paint.fillConvex(corners, style::kText);
    };
    block(0, bar.pixels, thick);
    block(0, thick, tick);
    block(bar.pixels - thick, bar.pixels, tick);
    drawText(paint, bar.label, low + DVec2{bar.pixels / 2, 1.1 * m.text}, m.text, style::kText, TextAlign::center);
}

void drawLegend(Paint& paint, const OverlayMetrics& m, std::span<const LegendEntry> entries) {
    const LegendLayout layout(paint.box().high.x, m, entries);
    if (entries.empty()) { return; }
    const DVec2 panelSize = layout.panelSize(m);
    const PixelBox box = panel(paint, m, {paint.box().high.x - m.margin - panelSize.x, m.margin}, panelSize);
    double x = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::size_t row = layout.rowOf[i];
        if (i == 0 || row != layout.rowOf[i - 1]) { x = box.low.x + m.padding; }
        const double middle = box.high.y - m.padding - layout.size / 2 - static_cast<double>(row) * layout.rowHeight;
        swatch(paint, {x + layout.size / 2, middle}, layout.size, entries[i], m.pen);
        drawText(paint, entries[i].label, {x + 1.55 * layout.size, middle - m.text / 2}, m.text, style::kText);
        x += layout.widthOf(entries[i], m) + layout.gap;
    }
}

double legendHeight(double width, const OverlayMetrics& m, std::span<const LegendEntry> entries) {
    return LegendLayout(width, m, entries).panelSize(m).y + 2 * m.margin;
}

void drawSweepWork(Paint& paint, const OverlayMetrics& m, const SweepWork& work) {
    const auto count = [](std::uint64_t number) { return fixedDecimals(static_cast<double>(number), 0); };
    const std::array<std::string, 2> lines{
        count(work.sweeps) + (work.sweeps == 1 ? " sweep \u00B7 " : " sweeps \u00B7 ") + count(work.toiCalls) +
            " TOI \u00B7 " + count(work.toiIterations) + (work.toiIterations == 1 ? " iteration" : " iterations"),
        count(work.impacts) + (work.impacts == 1 ? " impact \u00B7 " : " impacts \u00B7 ") + "lost " +
            fixedDecimals(1000 * work.lostSeconds, 1) + " ms in all bodies"};
    const double width = std::max(textWidth(lines[0], m.text), textWidth(lines[1], m.text));
    const DVec2 size{width + 2 * m.padding, 2.9 * m.text + 2 * m.padding};
    const double top = paint.box().high.y - 1.5 * m.margin - (m.title + 2 * m.padding);
    const PixelBox box = panel(paint, m, {m.margin, top - size.y}, size);
    drawText(paint, lines[0], box.low + DVec2{m.padding, m.padding + 1.9 * m.text}, m.text, style::kText);
    drawText(paint, lines[1], box.low + DVec2{m.padding, m.padding}, m.text,
             work.lostSeconds > 0 ? style::kWarning : style::kText);
}

void drawWarning(Paint& paint, const OverlayMetrics& m, const std::string& text) {
    const DVec2 size{textWidth(text, m.title) + 2 * m.padding, m.title + 2 * m.padding};
    const PixelBox box =
        panel(paint, m, {(paint.box().high.x - size.x) / 2, paint.box().high.y - 2 * m.margin - 2 * size.y}, size);
    drawText(paint, text, box.low + DVec2{m.padding, m.padding}, m.title, style::kWarning);
}

}  // namespace swept
