#include <cmath>
#include <numbers>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;
using build::polygon;

std::string numbered(const std::string& name, int number) { return name + "-" + std::to_string(number); }

/// Unit boxes, one on another, exactly touching, on a static one.
Case stack(int count) {
    Case c{"stacks", numbered("stack", count), emptyScene(numbered("stack", count)), 600, {}, {}, false};
    addFixed(c.scene, "ground", {0, -0.5}, {box({20, 0.5})});
    for (int i = 0; i < count; ++i) { addDynamic(c.scene, "", {0, i + 0.5}, {box({0.5, 0.5})}); }
    setSurface(c.scene, 0.6, 0);
    c.measures = {sag("sag of a box", lastBody(c.scene), count), drift(c.scene, 1), jitter(c.scene)};
    c.verdict = stands(c.scene, lastBody(c.scene), 1);
    c.isLong = count > 100;
    return c;
}

/// Rows of boxes, each shorter by one and half a column farther in; columns 1.05 apart.
Case pyramid(int rows) {
    Case c{"stacks", numbered("pyramid", rows), emptyScene(numbered("pyramid", rows)), 600, {}, {}, false};
    addFixed(c.scene, "ground", {0, -0.5}, {box({2.0 * rows, 0.5})});
    for (int row = 0; row < rows; ++row) {
        for (int i = 0; i < rows - row; ++i) {
            addDynamic(c.scene, "", {1.05 * (i - 0.5 * (rows - row - 1)), row + 0.5}, {box({0.5, 0.5})});
        }
    }
    setSurface(c.scene, 0.6, 0);
    c.measures = {worstMove(c.scene, 1)};
    c.verdict = stands(c.scene, lastBody(c.scene), 1);
    c.isLong = rows > 20;
    return c;
}

/// Tents of two cards 20° from the vertical whose top edges touch, one plank per level.
Case cards(const std::string& name, int levels, double cardLength, double thickness) {
    Case c{"stacks", name, emptyScene(name), 600, {}, {}, false};
    const double tilt = 20 * std::numbers::pi / 180;
    // A card leans with one lower corner on the plank and one upper corner at its partner's.
    const double height = cardLength * std::cos(tilt) + thickness * std::sin(tilt);
    const double width = cardLength * std::sin(tilt) + thickness * std::cos(tilt);
    const double plank = thickness;
    addFixed(c.scene, "ground", {0, -cardLength}, {box({10 * cardLength, cardLength})});
    for (int level = 0; level < levels; ++level) {
        const double base = level * (height + plank);
        const int tents = levels - level;
        for (int tent = 0; tent < tents; ++tent) {
            const double x = 2 * width * (tent - 0.5 * (tents - 1));
            for (const int side : {-1, 1}) {
                addDynamic(c.scene, "", {x + side * 0.5 * width, base + 0.5 * height},
                           {box({thickness / 2, cardLength / 2})})
                    .angle = side * tilt;
            }
        }
        addDynamic(c.scene, "", {0, base + height + plank / 2}, {box({tents * width, plank / 2})});
    }
    setSurface(c.scene, 0.7, 0);
    c.measures = {worstMove(c.scene, cardLength)};
    c.verdict = stands(c.scene, lastBody(c.scene), cardLength);
    return c;
}

/// Fifteen wedges that exactly fill a half ring.
Case arch(const std::string& name, double inner, double outer) {
    Case c{"stacks", name, emptyScene(name), 600, {}, {}, false};
    constexpr int kWedges = 15;
    addFixed(c.scene, "ground", {0, -0.5}, {box({10, 0.5})});
    for (int i = 0; i < kWedges; ++i) {
        const double from = std::numbers::pi * i / kWedges;
        const double to = std::numbers::pi * (i + 1) / kWedges;
        const DVec2 a{std::cos(from), std::sin(from)};
        const DVec2 b{std::cos(to), std::sin(to)};
        const DVec2 middle = 0.25 * (inner + outer) * (a + b);
        addDynamic(c.scene, "", middle,
                   {polygon({inner * a - middle, outer * a - middle, outer * b - middle, inner * b - middle})});
    }
    setSurface(c.scene, 0.6, 0);
    c.measures = {worstMove(c.scene, outer - inner)};
    c.verdict = stands(c.scene, 1 + kWedges / 2, outer - inner);
    return c;
}

}  // namespace

std::vector<Case> stackCases() {
    return {stack(10),
            stack(50),
            stack(100),
            stack(200),
            stack(500),
            stack(1000),
            pyramid(20),
            pyramid(50),
            cards("cards-L4", 3, 4, 0.2),
            cards("cards-L0.4", 3, 0.4, 0.02),
            cards("cards-thin", 3, 0.4, 0.002),
            arch("arch", 5, 6.5),
            arch("arch-thin", 5, 6)};
}

}  // namespace swept::accuracy
