#include "stroke_font.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "plain_letters.h"
#include "stroke_font_glyphs.h"

namespace swept {

namespace {

constexpr double kUnitsPerCapital = 20;
constexpr double kLetterGap = 4.9;      // between neighbours, in glyph units
constexpr double kStrokeWeight = 2.35;  // in glyph units
constexpr double kDotWeight = 1.35;     // of a dot, against a stroke
constexpr double kArcStep = 15;         // degrees; the chords of a 5-unit arc deviate by 0.04 units

struct Stroke {
    std::vector<DVec2> points;
    bool closed = false;
};

struct Glyph {
    char32_t letter = 0;
    double width = 0;
    std::vector<Stroke> strokes;
};

/// Reads one path of the glyph table.
class PathReader {
public:
    explicit PathReader(std::string_view path) : rest_(path) {}

    std::vector<Stroke> read() {
        while (!rest_.empty()) {
            const char command = rest_.front();
            rest_.remove_prefix(1);
            switch (command) {
                case 'M':
                    begin();
                    current().points.push_back(point());
                    break;
                case 'L':
                    current().points.push_back(point());
                    break;
                case 'A':
                    arc();
                    break;
                case 'Z':
                    current().closed = true;
                    open_ = false;
                    break;
                default:
                    break;  // blanks between commands
            }
        }
        return std::move(strokes_);
    }

private:
    void begin() {
        strokes_.emplace_back();
        open_ = true;
    }
    Stroke& current() { return strokes_.back(); }
    double number() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
        double value = 0;
        const auto result = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        rest_.remove_prefix(static_cast<std::size_t>(result.ptr - rest_.data()));
        return value;
    }
    DVec2 point() {
        const double x = number();
        return {x, number()};
    }
    void arc() {
        if (!open_) { begin(); }
        const DVec2 center = point();
        const DVec2 radii = point();
        const DVec2 range = point();
        const int steps = static_cast<int>(std::ceil(std::abs(range.y - range.x) / kArcStep));
        for (int i = 0; i <= steps; ++i) {
            const double angle = (range.x + (range.y - range.x) * i / steps) * std::numbers::pi / 180;
            current().points.push_back(center + DVec2{radii.x * std::cos(angle), radii.y * std::sin(angle)});
        }
    }

    std::string_view rest_;
    std::vector<Stroke> strokes_;
    bool open_ = false;
};

Glyph readGlyph(const GlyphPath& path) { return {path.letter, path.width, PathReader(path.path).read()}; }

const Glyph& glyphOf(char32_t letter) {
    static const std::vector<Glyph> glyphs = [] {
        std::vector<Glyph> all;
        for (const GlyphPath& path : kGlyphs) { all.push_back(readGlyph(path)); }
        return all;
    }();
    static const Glyph missing = readGlyph(kMissingGlyph);
    const auto found =
        std::find_if(glyphs.begin(), glyphs.end(), [letter](const Glyph& g) { return g.letter == letter; });
    return found != glyphs.end() ? *found : missing;
}

}  // namespace

double textWidth(std::string_view text, double height) {
    double width = 0;
    for (const char32_t letter : plainLetters(text)) { width += glyphOf(letter).width + kLetterGap; }
    return std::max(0.0, width - kLetterGap) * height / kUnitsPerCapital;
}

std::string cutToWidth(std::string_view text, double height, double width) {
    const std::string mark = "...";
    const auto isInside = [&text](std::size_t i) {  // of the bytes of one letter
        return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0u) == 0x80u;
    };
    std::string kept;
    for (std::size_t end = 0; end < text.size();) {
        do { ++end; } while (isInside(end));
        const std::string start(text.substr(0, end));
        if (textWidth(start, height) > width) { return kept + mark; }
        if (textWidth(start + mark, height) <= width) { kept = start; }
    }
    return std::string(text);
}

void drawText(Paint& paint, std::string_view text, DVec2 base, double height, Color color, TextAlign align) {
    const double scale = height / kUnitsPerCapital;
    const double width = textWidth(text, height);
    double x = base.x - (align == TextAlign::left ? 0 : align == TextAlign::center ? width / 2 : width);
    std::vector<DVec2> points;
    for (const char32_t letter : plainLetters(text)) {
        const Glyph& glyph = glyphOf(letter);
        for (const Stroke& stroke : glyph.strokes) {
            points.clear();
            for (const DVec2 p : stroke.points) { points.push_back(DVec2{x, base.y} + scale * p); }
            const bool dot = points.size() == 2 && points[0] == points[1];
            paint.polyline(points, stroke.closed, scale * kStrokeWeight * (dot ? kDotWeight : 1), color);
        }
        x += scale * (glyph.width + kLetterGap);
    }
}

std::string fixedDecimals(double value, int decimals) {
    std::array<char, 64> text{};
    const auto result =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
    return result.ec == std::errc{} ? std::string(text.data(), result.ptr) : "?";
}

}  // namespace swept
