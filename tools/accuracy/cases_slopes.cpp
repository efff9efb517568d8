#include <algorithm>
#include <cmath>
#include <numbers>

#include <swept/samples/scene_geometry.h>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;
using build::circle;

constexpr double kDegree = std::numbers::pi / 180;

/// A slope through the origin, falling to the right, and the unit vectors along and away from it.
struct Slope {
    double angle;
    DVec2 down;
    DVec2 out;
};
Slope addSlope(SceneDescription& scene, double angle) {
    const Slope slope{angle, {std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
    addFixed(scene, "slope", -1.0 * slope.out, {box({1000, 1})}).angle = -angle;
    return slope;
}

/// A block on a slope of 30°; its way after `seconds` against the closed form, as a part of `scale` (or in metres).
Case block(const std::string& name, double friction, double seconds, bool creeps) {
    Case c{"known", name, emptyScene(name), std::lround(seconds * 60), {}, {}, false};
    const Slope slope = addSlope(c.scene, 30 * kDegree);
    addDynamic(c.scene, "block", 0.5 * slope.out, {box({0.5, 0.5})}).angle = -slope.angle;
    setSurface(c.scene, friction, 0);
    const double exact = creeps ? 0 : kGravity * (std::sin(slope.angle) - friction * std::cos(slope.angle));
    c.measures = {{creeps ? "creep" : "acceleration", creeps ? "m" : "1", [=](const Frames& frames) {
                       const double time = frames.back().time;
                       const double way =
                           dot(bodyAt(frames.back(), 1).position - bodyAt(frames.front(), 1).position, slope.down);
                       return creeps ? std::fabs(way) : std::fabs(2 * way / (time * time) / exact - 1);
                   }}};
    return c;
}

/// A disk that rolls down 20°: two thirds of what it would slide.
Case rollingDisk() {
    Case c{"known", "rolling-disk", emptyScene("rolling-disk"), 120, {}, {}, false};
    const Slope slope = addSlope(c.scene, 20 * kDegree);
    addDynamic(c.scene, "disk", 0.5 * slope.out, {circle(0.5)});
    setSurface(c.scene, 0.6, 0);
    c.measures = {{"speed", "1", [=](const Frames& frames) {
                       const double exact = kGravity * std::sin(slope.angle) * (2.0 / 3) * frames.back().time;
                       return std::fabs(dot(bodyAt(frames.back(), 1).velocity, slope.down) / exact - 1);
                   }}};
    return c;
}

/// A disk set down turning at 20 rad/s: it ends rolling at a third of its rim speed.
Case spunDisk() {
    Case c{"known", "spun-disk", emptyScene("spun-disk"), 180, {}, {}, false};
    addFixed(c.scene, "ground", {0, -1}, {box({1000, 1})});
    addDynamic(c.scene, "disk", {0, 0.5}, {circle(0.5)}).angularVelocity = -20;
    setSurface(c.scene, 0.3, 0);
    c.measures = {{"speed", "1", [](const Frames& frames) {
                       return std::fabs(bodyAt(frames.back(), 1).velocity.x / (20 * 0.5 / 3) - 1);
                   }}};
    return c;
}

/// A regular polygon that rolls down a slope from corner to corner, as a rimless wheel does (McGeer, "Passive Dynamic
/// Walking", 1990).
struct RollingPolygon {
    int sides = 6;
    double radius = 0.5;  ///< of the corners, m
    double slope = 0.3;   ///< rad
    double gyration = 0;  ///< I/(m·radius²) about a corner
    double turn() const { return 2 * std::numbers::pi / sides; }
    double side() const { return 2 * radius * std::sin(turn() / 2); }
    /// Squared rate just before a corner lands, where each landing takes what the side before it gave.
    double landingRateSquared() const {
        const double kept = (gyration - 1 + std::cos(turn())) / gyration;
        return 2 * kGravity * side() * std::sin(slope) / (gyration * radius * radius * (1 - kept * kept));
    }
    /// Mean speed over a side: the corner's pendulum from one landing to the next, by the midpoint rule.
    double speed() const {
        constexpr int kParts = 20'000;
        const double first = slope - turn() / 2;
        double time = 0;
        for (int i = 0; i < kParts; ++i) {
            const double lean = first + turn() * (i + 0.5) / kParts;
            const double fallen = radius * (std::cos(slope + turn() / 2) - std::cos(lean));
            const double rateSquared = landingRateSquared() + 2 * kGravity * fallen / (gyration * radius * radius);
            time += turn() / kParts / std::sqrt(rateSquared);
        }
        return side() / time;
    }
};

/// Without restitution, and rough enough not to slide: its mean speed over the last ten seconds.
Case rollingPolygon(const std::string& name, int sides, double radius) {
    Case c{"known", name, emptyScene(name), 900, {}, {}, false};
    RollingPolygon wheel{.sides = sides, .radius = radius};
    const Slope slope = addSlope(c.scene, wheel.slope);
    std::vector<DVec2> corners;
    for (int i = 0; i < sides; ++i) {
        const double angle = wheel.turn() * (i + 0.5) - std::numbers::pi / 2;  // the first side is below
        corners.push_back(radius * DVec2{std::cos(angle), std::sin(angle)});
    }
    const double height = radius * std::cos(wheel.turn() / 2);
    BodyDescription& body = addDynamic(c.scene, "polygon", height * slope.out, {build::polygon(corners)});
    body.angle = -slope.angle;
    const MassAndInertia mass = massOfShapes(body);
    wheel.gyration = mass.inertia / (mass.mass * radius * radius) + 1;
    body.angularVelocity = -std::sqrt(wheel.landingRateSquared());
    body.velocity = -height * body.angularVelocity * slope.down;
    setSurface(c.scene, 4, 0);
    const double exact = wheel.speed();
    c.measures = {{"speed", "1", [=](const Frames& frames) {
                       const Frame& before = frameAt(frames, frames.back().time - 10);
                       const DVec2 way = bodyAt(frames.back(), 1).position - bodyAt(before, 1).position;
                       return std::fabs(dot(way, slope.down) / (frames.back().time - before.time) / exact - 1);
                   }}};
    return c;
}

}  // namespace

std::vector<Case> slopeCases() {
    const double steep = std::tan(30 * kDegree);
    return {block("slope-0.3", 0.3, 2, false),
            block("slope-0.5", 0.5, 2, false),
            block("slope-0.99tan", 0.99 * steep, 10, false),
            block("slope-1.001tan", 1.001 * steep, 10, true),
            block("slope-1.01tan", 1.01 * steep, 10, true),
            rollingDisk(),
            spunDisk(),
            rollingPolygon("hexagon-0.1", 6, 0.1),
            rollingPolygon("hexagon-0.5", 6, 0.5),
            rollingPolygon("octagon-2", 8, 2)};
}

}  // namespace swept::accuracy
