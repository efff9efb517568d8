#include <algorithm>
#include <array>
#include <cmath>

#include <swept/samples/scene_builder.h>

#include "../writers/number_text.h"
#include "slice.h"

/// Slices of what swings and flies.

namespace swept::envelope {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;
using build::circle;
using build::hinge;

constexpr double kLink = 0.5;  ///< m, length of a link
constexpr double kBall = 0.5;  ///< m, radius of the load
constexpr double kChainStep = 1.0 / 60;
/// Length of a run in times √(length/g): down, up on the other side, and back.
constexpr double kSwingTimes = 6;

/// Of the joints of a chain whose bodies are pivot, links, load; over the length of a link.
double largestGap(const Frame& frame) {
    double worst = 0;
    DVec2 end{0, 0};
    for (std::size_t i = 1; i < frame.bodies.size(); ++i) {
        const BodyFrame& body = frame.bodies[i];
        const bool isLoad = i + 1 == frame.bodies.size();
        const DVec2 along{std::cos(body.angle), std::sin(body.angle)};
        const DVec2 half = (isLoad ? kBall : kLink / 2) * along;
        worst = std::max(worst, length(body.position - half - end));
        end = body.position + half;
    }
    return worst / kLink;
}

/// Links of 1 kg under a fixed pivot, then a load of `massRatio` kg, let go level.
std::vector<Trial> chainTrials(double massRatio, double linkCount) {
    const int links = static_cast<int>(std::lround(linkCount));
    const double reach = links * kLink + kBall;
    Trial trial{build::scene("chain", {0, 0}, 10), 0, {}, {}};
    SceneDescription& scene = trial.scene;
    scene.gravity = {0, -kGravity};
    scene.settings.sleep = false;
    scene.settings.dt = kChainStep;
    trial.steps = std::llround(kSwingTimes * std::sqrt(reach / kGravity) / kChainStep);
    addFixed(scene, "pivot", {0, 0}, {circle(0.05)});
    std::string before = "pivot";
    for (int i = 0; i < links; ++i) {
        const std::string link = "link" + std::to_string(i);
        addDynamic(scene, link, {kLink * (i + 0.5), 0}, {box({kLink / 2, 0.05})}).mass = 1;
        hinge(scene, before, link, {kLink * i, 0});
        before = link;
    }
    addDynamic(scene, "load", {reach, 0}, {circle(kBall)}).mass = massRatio;
    hinge(scene, before, "load", {kLink * links, 0});
    // Neighbours overlap at their joints; the chain shall not collide with itself.
    for (BodyDescription& body : scene.bodies) { body.shapes[0].filter.group = -1; }
    trial.error = largestGap;
    return {trial};
}

/// m, of bullet and wall: small, for engines that limit the way of a step to so many metres.
constexpr double kWidth = 0.125;
constexpr double kBulletStep = 1.0 / 64;
/// They meet at this many steps from the start, if nothing turns, and have the rest to do what they like.
constexpr double kStepsToWall = 1.4;
constexpr std::int64_t kBulletSteps = 16;
/// Bound of "near the wall", in widths.
constexpr double kNear = 1;

/// How a bullet flies: the flat side first at angle 0; spin in radians a step.
struct Flight {
    double angle;
    double spin;
};
constexpr std::array<Flight, 4> kFlights{{{0, 0}, {0.4, 0}, {1.5, 0.5}, {1.1, -2}}};

/// Wall's near face at x = 0; no friction, so that nothing gets around its ends.
Trial bulletTrial(double speedNumber, double aspect, const Flight& flight) {
    Trial trial{build::scene("bullet", {0, 0}, 10), kBulletSteps, {}, {}};
    SceneDescription& scene = trial.scene;
    scene.gravity = {0, 0};
    scene.settings.sleep = false;
    scene.settings.dt = kBulletStep;
    const double half = kWidth / 2;
    const DVec2 halves{half, aspect * half};
    const auto reachOf = [halves](double angle) {
        return std::fabs(std::cos(angle)) * halves.x + std::fabs(std::sin(angle)) * halves.y;
    };
    const double way = speedNumber * kWidth;
    addFixed(scene, "wall", {half, 0}, {box({half, 4 * (aspect + 1) * kWidth})});
    BodyDescription& bullet =
        addDynamic(scene, "bullet", {-reachOf(flight.angle) - kStepsToWall * way, 0}, {box(halves)});
    bullet.angle = flight.angle;
    bullet.velocity = {way / kBulletStep, 0};
    bullet.angularVelocity = flight.spin / kBulletStep;
    bullet.bullet = true;
    for (BodyDescription& body : scene.bodies) { body.shapes[0].friction = 0; }
    trial.error = [reachOf](const Frame& frame) {
        const BodyFrame& now = frame.bodies[1];
        return std::max(0.0, now.position.x + reachOf(now.angle)) / kWidth;
    };
    trial.hasArrived = [reachOf](const Frame& frame) {
        const BodyFrame& now = frame.bodies[1];
        return now.velocity.x < 0 || now.position.x + reachOf(now.angle) > -kNear * kWidth;
    };
    return trial;
}

std::vector<Trial> bulletTrials(double speedNumber, double aspect) {
    std::vector<Trial> trials;
    for (const Flight& flight : kFlights) { trials.push_back(bulletTrial(speedNumber, aspect, flight)); }
    return trials;
}

}  // namespace

Slice chainSlice(Grain grain) {
    const bool full = grain == Grain::full;
    std::vector<double> links{1, 2, 4, 8, 16, 20, 32};  // 20: among the hardest
    if (full) { links.push_back(64); }
    return {"chain",
            "a load of mass R on a chain of links of mass 1, let go level (60 Hz, links of 0.5 m)",
            "largest gap of a joint, over the length of a link",
            0.01,
            {"ratio of masses R", powers(10, 0, 6, full ? 0.25 : 1)},
            {"links", links},
            chainTrials,
            [](double x, double y) {
                return "a chain of " + roundedText(y, 3) + (y == 1 ? " link" : " links") +
                       " of 1 kg swings a load of " + roundedText(x, 3) + " kg";
            }};
}

Slice bulletSlice(Grain grain) {
    const bool full = grain == Grain::full;
    return {"bullet",
            "a body of aspect ratio A, flying and spinning, at a wall as thick as it is",
            "farthest that it ever got into the wall, over the wall's thickness",
            0.1,
            {"speed dt / width", powers(2, -2, 20, full ? 1 : 2)},
            {"aspect ratio A", powers(10, 0, 3, full ? 0.5 : 1)},
            bulletTrials,
            [](double x, double y) {
                constexpr double kTold = 0.01;  // m
                constexpr double kHertz = 60;
                return "a wall of 1 cm at 60 Hz holds a rod of 1 cm x " + roundedText(100 * y * kTold) + " cm up to " +
                       roundedText(x * kTold * kHertz, 2) + " m/s";
            }};
}

}  // namespace swept::envelope
