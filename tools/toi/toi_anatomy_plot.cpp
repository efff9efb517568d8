#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "../writers/gnuplot_text.h"
#include "../writers/number_text.h"
#include "toi_anatomy.h"

namespace swept {
namespace {

constexpr double kPi = std::numbers::pi;

// Pixels.
constexpr double kWidth = 1200;
constexpr double kHeight = 1000;
constexpr double kSceneTop = 0.94;  // of the height; the panels' edges
constexpr double kSceneBottom = 0.46;
constexpr double kCurveTop = 0.395;
constexpr double kCurveBottom = 0.075;
constexpr double kLeft = 0.09;  // of the width
constexpr double kRight = 0.975;

using Outline = std::vector<DVec2>;

DVec2 rotated(DVec2 v, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// The rim of a polygon with radius, body frame.
Outline outlineOf(const ToiPolygon& polygon) {
    constexpr int kArc = 16;  // pieces of half a turn
    const auto at = [&polygon](int i) {
        return polygon.vertices[static_cast<std::size_t>((i + polygon.count) % polygon.count)];
    };
    const auto normalAngle = [&at](int i) {
        const DVec2 edge = at(i + 1) - at(i);
        return std::atan2(-edge.x, edge.y);
    };
    Outline rim;
    for (int i = 0; i < polygon.count; ++i) {
        const double from = polygon.count > 1 ? normalAngle(i - 1) : 0;
        double turn = polygon.count > 1 ? normalAngle(i) - from : 2 * kPi;
        if (turn < 0) { turn += 2 * kPi; }
        const int pieces = polygon.radius > 0 ? static_cast<int>(std::ceil(kArc * turn / kPi)) : 0;
        for (int j = 0; j <= pieces; ++j) {
            const double angle = from + (pieces > 0 ? turn * j / pieces : 0);
            rim.push_back(at(i) + polygon.radius * rotated({1, 0}, angle));
        }
    }
    rim.push_back(rim.front());
    return rim;
}

double reachOf(const ToiPolygon& polygon, const Sweep& sweep) {
    double reach = 0;
    for (int i = 0; i < polygon.count; ++i) {
        reach = std::max(reach, length(polygon.vertices[static_cast<std::size_t>(i)] - sweep.localCenter));
    }
    return reach + polygon.radius;
}

/// The frame in which the larger body rests, with the axes of the world at fraction 0.
struct Frame {
    Sweep sweep;

    DVec2 fromWorld(DVec2 point, double fraction) const {
        return rotated(point - centerAt(sweep, fraction), sweep.a0 - angleAt(sweep, fraction)) + sweep.c0;
    }
    DVec2 turned(DVec2 direction, double fraction) const {
        return rotated(direction, sweep.a0 - angleAt(sweep, fraction));
    }
    Outline place(const Outline& rim, const Sweep& body, double fraction) const {
        Outline placed;
        for (const DVec2 v : rim) {
            const DVec2 world = centerAt(body, fraction) + rotated(v - body.localCenter, angleAt(body, fraction));
            placed.push_back(fromWorld(world, fraction));
        }
        return placed;
    }
};

std::string text(double x) { return roundedText(x, 10); }
std::string text(DVec2 v) { return text(v.x) + ' ' + text(v.y); }

/// What is visible of the plane.
struct View {
    DVec2 low;
    DVec2 high;

    /// The box of the points with a margin, widened to the shape of the panel.
    static View around(const std::vector<Outline>& outlines) {
        View view{outlines.front().front(), outlines.front().front()};
        for (const Outline& outline : outlines) {
            for (const DVec2 p : outline) {
                view.low = {std::min(view.low.x, p.x), std::min(view.low.y, p.y)};
                view.high = {std::max(view.high.x, p.x), std::max(view.high.y, p.y)};
            }
        }
        constexpr double kShape = kWidth * (kRight - kLeft) / (kHeight * (kSceneTop - kSceneBottom));
        constexpr double kMargin = 0.62;  // of the extent, to either side of the middle
        const DVec2 middle = 0.5 * (view.low + view.high);
        const DVec2 extent = view.high - view.low;
        const double half = kMargin * std::max(extent.y, extent.x / kShape);
        return {middle - DVec2{kShape * half, half}, middle + DVec2{kShape * half, half}};
    }
    double height() const { return high.y - low.y; }

    /// The part of a convex outline that is visible: gnuplot fills only what has its corners in sight.
    Outline clipped(Outline outline) const {
        struct Side {
            double DVec2::*axis;
            double limit;
            double sign;
        };
        for (const Side& side : {Side{&DVec2::x, low.x, 1}, Side{&DVec2::x, high.x, -1}, Side{&DVec2::y, low.y, 1},
                                 Side{&DVec2::y, high.y, -1}}) {
            Outline kept;
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const DVec2 from = outline[i];
                const DVec2 to = outline[(i + 1) % outline.size()];
                const double inFrom = side.sign * (from.*side.axis - side.limit);
                const double inTo = side.sign * (to.*side.axis - side.limit);
                if (inFrom >= 0) { kept.push_back(from); }
                if ((inFrom < 0) != (inTo < 0)) { kept.push_back(from + (inFrom / (inFrom - inTo)) * (to - from)); }
            }
            outline = kept;
        }
        return outline;
    }
};

/// Numbers beside points, without those that would stand on another.
class Tags {
public:
    /// @param width, height  of the panel, in its units.
    Tags(double width, double height) : room_{0.022 * width, 0.05 * height} {}

    std::string at(DVec2 place, std::size_t number, const std::string& colour) {
        const auto isNear = [&](DVec2 other) {
            return std::fabs(other.x - place.x) < room_.x && std::fabs(other.y - place.y) < room_.y;
        };
        if (std::any_of(taken_.begin(), taken_.end(), isNear)) { return ""; }
        taken_.push_back(place);
        const std::string tag = std::to_string(number);
        return "set label " + tag + " '" + tag + "' at " + text(place.x) + ',' + text(place.y) +
               " center font ',13' tc rgb '#" + colour + "' front\n";
    }

private:
    DVec2 room_;
    Outline taken_;
};

/// From blue at the start to red at the answer.
std::string colourOf(std::size_t look, std::size_t last) {
    constexpr std::array<std::array<double, 3>, 4> kStops{
        {{70, 130, 200}, {60, 165, 120}, {225, 150, 30}, {205, 40, 40}}};
    const double place = last == 0 ? 3 : 3.0 * static_cast<double>(look) / static_cast<double>(last);
    const auto stop = std::min<std::size_t>(2, static_cast<std::size_t>(place));
    const double part = place - static_cast<double>(stop);
    std::array<int, 3> rgb{};
    for (std::size_t i = 0; i < 3; ++i) {
        rgb[i] = static_cast<int>(std::lround((1 - part) * kStops[stop][i] + part * kStops[stop + 1][i]));
    }
    char colour[8];
    std::snprintf(colour, sizeof(colour), "%02x%02x%02x", static_cast<unsigned>(rgb[0]) & 255U,
                  static_cast<unsigned>(rgb[1]) & 255U, static_cast<unsigned>(rgb[2]) & 255U);
    return colour;
}

std::string block(const std::string& name, const Outline& points) {
    std::string script = "$" + name + " << EOD\n";
    for (const DVec2 p : points) { script += text(p) + '\n'; }
    return script + "EOD\n";
}

std::string block(const std::string& name, const std::vector<ToiAnatomy::Point>& points) {
    Outline pairs;
    for (const ToiAnatomy::Point& p : points) { pairs.push_back({p.fraction, p.separation}); }
    return block(name, pairs);
}

const char* wordFor(ToiState state) {
    switch (state) {
        case ToiState::hit:
            return "hit";
        case ToiState::separated:
            return "separated";
        case ToiState::overlapped:
            return "overlapped";
        case ToiState::failed:
            return "failed";
    }
    return "";  // unreachable, but GCC cannot know
}

DVec2 topOf(const Outline& outline) {
    // The left one of two that are equally high.
    return *std::max_element(outline.begin(), outline.end(),
                             [](DVec2 a, DVec2 b) { return a.y - 1e-3 * a.x < b.y - 1e-3 * b.x; });
}

/// One after the other: all looks, the answer last.
struct Sight {
    double fraction = 0;
    double separation = 0;
    DVec2 normal;
    DVec2 pointA;
    DVec2 pointB;
};

std::vector<Sight> sightsOf(const ToiAnatomy& anatomy) {
    std::vector<Sight> sights;
    for (const ToiAnatomy::Look& look : anatomy.looks) {
        const ToiStep& s = look.step;
        sights.push_back({s.fraction, s.separation, s.normal, s.pointA, s.pointB});
    }
    const Toi& answer = anatomy.answer;
    sights.push_back({answer.fraction, answer.separation, answer.normal, answer.pointA, answer.pointB});
    return sights;
}

std::string panel(double bottom, double top) {
    return "set lmargin at screen " + text(kLeft) + "\nset rmargin at screen " + text(kRight) +
           "\nset bmargin at screen " + text(bottom) + "\nset tmargin at screen " + text(top) + '\n';
}

/// Ghosts, axes and witness points.
std::string sceneOf(const ToiAnatomy& anatomy) {
    const ToiQuery& q = anatomy.query;
    const bool aRests = reachOf(q.a, q.sweepA) >= reachOf(q.b, q.sweepB);
    const Sweep& resting = aRests ? q.sweepA : q.sweepB;
    const Sweep& moving = aRests ? q.sweepB : q.sweepA;
    const Frame frame{resting};
    const Outline rim = outlineOf(aRests ? q.b : q.a);
    const std::vector<Sight> sights = sightsOf(anatomy);
    const std::size_t last = sights.size() - 1;

    std::vector<Outline> ghosts;
    for (const Sight& sight : sights) { ghosts.push_back(frame.place(rim, moving, sight.fraction)); }
    const Outline start = frame.place(rim, moving, 0);
    const Outline end = frame.place(rim, moving, q.settings.tMax);
    std::vector<Outline> shown = ghosts;
    shown.insert(shown.end(), {start, end});
    const View view = View::around(shown);
    Outline path;
    for (int i = 0; i <= 200; ++i) {
        const double fraction = q.settings.tMax * i / 200;
        path.push_back(frame.fromWorld(centerAt(moving, fraction), fraction));
    }
    std::string script =
        panel(kSceneBottom, kSceneTop) + "unset key\nunset tics\nset clip two\nset border 15 lc rgb '#bbbbbb'\n";
    script += "set xrange [" + text(view.low.x) + ':' + text(view.high.x) + "]\nset yrange [" + text(view.low.y) + ':' +
              text(view.high.y) + "]\n";
    const Outline rest = frame.place(outlineOf(aRests ? q.a : q.b), resting, 0);
    const Outline visible = view.clipped(rest);
    script += block("resting", rest) + block("visible", visible) + block("path", path);
    std::string plot = "plot ";
    if (!visible.empty()) {  // of a block without points gnuplot warns
        plot += "$visible with filledcurves closed fs solid fc rgb '#d9dde3' notitle, \\\n  ";
    }
    plot +=
        "$resting with lines lw 2 lc rgb '#59616b' notitle, \\\n"
        "  $path with lines dt 3 lw 1.5 lc rgb '#999999' notitle";
    script += block("start", start) + block("end", end);
    plot +=
        ", \\\n  $start with lines lw 1 dt 2 lc rgb '#999999' notitle, \\\n"
        "  $end with lines lw 1 dt 2 lc rgb '#999999' notitle";
    const double arm = 0.16 * view.height();
    for (std::size_t i = 0; i <= last; ++i) {
        const std::string id = std::to_string(i);
        const std::string colour = colourOf(i, last);
        const Sight& sight = sights[i];
        const DVec2 normal = frame.turned(sight.normal, sight.fraction);
        const DVec2 a = frame.fromWorld(sight.pointA, sight.fraction);
        const DVec2 b = frame.fromWorld(sight.pointB, sight.fraction);
        script += block("ghost" + id, ghosts[i]);
        script += block("axis" + id, Outline{a - arm * normal, b + arm * normal});
        script += block("points" + id, Outline{a, b});
        // Alpha grows towards the answer.
        const char* const alpha = i == last ? "90" : "d8";
        plot += ", \\\n  $ghost" + id + " with filledcurves closed fs solid fc rgb '#" + alpha + colour +
                "' notitle, \\\n  $ghost" + id + " with lines lw " + (i == last ? "2.5" : "1.5") + " lc rgb '#" +
                colour + "' notitle, \\\n  $axis" + id + " with lines dt 2 lw 1.2 lc rgb '#" + colour +
                "' notitle, \\\n  $points" + id + " with points pt 7 ps 0.7 lc rgb '#" + colour + "' notitle";
    }
    Tags tags(view.high.x - view.low.x, view.height());
    for (std::size_t i = last + 1; i-- > 0;) {
        script += tags.at(topOf(ghosts[i]) + DVec2{0, 0.035 * view.height()}, i + 1, colourOf(i, last));
    }
    return script + plot + "\nunset label\n";
}

/// What the separations go through, upwards.
struct Range {
    double low;
    double high;
};

/// From somewhat below 0 to the highest look. Where even that is about at the target (bodies that touch from the start)
/// there is no search to be seen: then all that the separation does.
Range separationsShown(const ToiAnatomy& anatomy, const std::vector<Sight>& sights) {
    const ToiSettings& settings = anatomy.query.settings;
    const double atTarget = std::fabs(settings.target) + 2 * settings.tolerance;
    double low = 0;
    double high = 0;
    for (const Sight& sight : sights) { high = std::max(high, sight.separation); }
    for (const ToiAnatomy::Point& p : anatomy.truth) { low = std::min(low, p.separation); }
    if (high > atTarget) {
        low = std::max(low, -0.3 * high);
    } else {
        high = std::max(high, atTarget);
        for (const ToiAnatomy::Point& p : anatomy.truth) { high = std::max(high, p.separation); }
        for (const Sight& sight : sights) { low = std::min(low, sight.separation); }
    }
    const double margin = 0.06 * (high - low);
    return {low - margin, high + 2 * margin};
}

/// Separation, bounds, looks.
std::string curvesOf(const ToiAnatomy& anatomy) {
    const ToiQuery& q = anatomy.query;
    const std::vector<Sight> sights = sightsOf(anatomy);
    const std::size_t last = sights.size() - 1;
    const auto [low, high] = separationsShown(anatomy, sights);
    std::string script = panel(kCurveBottom, kCurveTop) +
                         "set xtics nomirror auto\nset ytics nomirror auto\nset border 3 lc rgb '#555555'\n"
                         "set key at screen 0.5,0.43 center horizontal reverse Left samplen 2.5 width 2\n"
                         "set xlabel 'fraction of the step'\n"
                         // Where the numbers leave room for it, however wide they are.
                         "set label 101 'separation, m' at screen 0.015,0.235 center rotate\n"
                         "set format y '%g'\nset xrange [0:" +
                         text(q.settings.tMax) + "]\nset yrange [" + text(low) + ':' + text(high) + "]\n";
    script += "set object 1 rectangle from 0," + text(q.settings.target - q.settings.tolerance) + " to " +
              text(q.settings.tMax) + ',' + text(q.settings.target + q.settings.tolerance) +
              " fs solid 0.35 noborder fc rgb '#f2b84b' behind\n";
    script += block("truth", anatomy.truth);
    std::string plot = "plot $truth with lines lw 2.5 lc rgb '#222222' title 'separation'";
    Outline rug;
    for (const double fraction : anatomy.plainLooks) { rug.push_back({fraction, low + 0.035 * (high - low)}); }
    for (std::size_t i = 0; i < anatomy.looks.size(); ++i) {
        const std::string id = std::to_string(i);
        script += block("bound" + id, anatomy.looks[i].bound);
        plot += ", \\\n  $bound" + id + " with lines lw 2 lc rgb '#" + colourOf(i, last) + "' " +
                (i == 0 ? "title 'bound, certain at each look'" : "notitle");
    }
    for (std::size_t i = 0; i <= last; ++i) {
        const std::string id = std::to_string(i);
        script += block("look" + id, Outline{{sights[i].fraction, sights[i].separation}});
        script += "set arrow from " + text(sights[i].fraction) + ',' + text(low) + " to " + text(sights[i].fraction) +
                  ',' + text(sights[i].separation) + " nohead dt 3 lw 1.2 lc rgb '#" + colourOf(i, last) + "'\n";
        plot += ", \\\n  $look" + id + " with points pt " + (i == last ? "7 ps 2" : "7 ps 1.3") + " lc rgb '#" +
                colourOf(i, last) + "' notitle";
    }
    Tags tags(q.settings.tMax, high - low);
    for (std::size_t i = last + 1; i-- > 0;) {
        const double above = sights[i].separation + 0.07 * (high - low);
        script += tags.at({sights[i].fraction + 0.008 * q.settings.tMax, above}, i + 1, colourOf(i, last));
    }
    if (!rug.empty()) {
        script += block("rug", rug);
        plot += ", \\\n  $rug with points pt 2 ps 0.5 lc rgb '#8a8a8a' title '" + std::to_string(rug.size() + 1) +
                " looks of conservative advancement'";
    }
    return script + plot +
           ", \\\n  NaN with boxes fs solid 0.35 noborder fc rgb '#f2b84b' title 'target ± tolerance'\n";
}

}  // namespace

std::string anatomyScript(const ToiAnatomy& anatomy, const std::string& picture) {
    const Toi& answer = anatomy.answer;
    const std::size_t looks = anatomy.looks.size() + 1;
    return "set terminal pngcairo size " + text(kWidth) + ',' + text(kHeight) +
           " font 'sans,12' background rgb 'white'\nset output " + gnuplotQuoted(picture) +
           "\nset encoding utf8\nset multiplot\n" + "set label 100 '" + wordFor(answer.state) + " at " +
           roundedText(answer.fraction, 6) + ", after " + std::to_string(looks) + (looks == 1 ? " look" : " looks") +
           "' at screen 0.5,0.968 center font ',15'\n" + sceneOf(anatomy) + curvesOf(anatomy) + "unset multiplot\n";
}

}  // namespace swept
