#include <algorithm>
#include <cmath>
#include <limits>

#include <swept/samples/scene_builder.h>

#include "../writers/number_text.h"
#include "slice.h"

/// Slices of what should stay where it is.

namespace swept::envelope {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;

constexpr double kEarthGravity = 9.81;  ///< m/s² in what is told
/// Boxes are of 1 m: this matters to engines that have lengths of their own.
constexpr double kSide = 1;
/// Light boxes under the heavy one.
constexpr int kBelow = 5;
/// Parts of a side by which boxes are laid beside each other: a tower without any tests nothing.
constexpr double kOffset = 1.0 / 32;
/// The lone box falls by this part of its side, turned by so many radians, so that it has to come to rest; its last
/// quarter of the run is judged.
constexpr double kFall = 1.0 / 4;
constexpr double kTilt = 1.0 / 256;
constexpr double kJudged = 3.0 / 4;
/// Part of its side by which a box may give way: engines that let touching boxes overlap by some millimetres shall not
/// be outside everywhere.
constexpr double kGiveWay = 0.02;
/// Length of a run in times √(size/g); and its least number of steps, so that long steps show what they do.
constexpr double kNaturalTimes = 30;
constexpr double kFewestSteps = 64;

/// Nothing but gravity, with a step of √(G·size/g).
SceneDescription sceneOfStep(const std::string& name, double gravityNumber) {
    SceneDescription scene = build::scene(name, {0, 0}, 10);
    scene.gravity = {0, -kGravity};
    scene.settings.sleep = false;  // sleep hides creep
    scene.settings.dt = std::sqrt(gravityNumber * kSide / kGravity);
    return scene;
}

std::int64_t stepsOf(double gravityNumber) {
    return std::llround(std::max(kFewestSteps, kNaturalTimes / std::sqrt(gravityNumber)));
}

std::string wholeText(double number) { return std::to_string(std::llround(std::ceil(number))); }

/// Steps a second that a box of this size needs on Earth.
std::string hertzText(double gravityNumber, double size) {
    return wholeText(std::sqrt(kEarthGravity / (size * gravityNumber))) + " Hz";
}

std::string hertzOfSizes(double gravityNumber) {
    return "boxes of 1 m need " + hertzText(gravityNumber, 1) + ", of 10 cm " + hertzText(gravityNumber, 0.1) +
           ", of 1 cm " + hertzText(gravityNumber, 0.01) + ", of 1 mm " + hertzText(gravityNumber, 0.001);
}

std::vector<Trial> stackTrials(double gravityNumber, double massRatio) {
    Trial trial{sceneOfStep("stack", gravityNumber), stepsOf(gravityNumber), {}, {}};
    const double half = kSide / 2;
    addFixed(trial.scene, "ground", {0, -half}, {box({20 * kSide, half})});
    for (int i = 0; i <= kBelow; ++i) {
        addDynamic(trial.scene, "", {(i % 2) * kOffset * kSide, (i + 0.5) * kSide}, {box({half, half})});
    }
    trial.scene.bodies.back().shapes[0].density = massRatio;
    trial.error = farthestMove(trial.scene, kSide);
    return {trial};
}

/// Courses of the wall, and whole boxes in the lowest; every other course begins and ends with half a box.
constexpr int kCourses = 8;
constexpr int kBoxesOfCourse = 4;

/// Every box but the outermost has two below it and two on it: each carries through many, and the contacts close loops.
std::vector<Trial> wallTrials(double gravityNumber, double subSteps) {
    Trial trial{sceneOfStep("wall", gravityNumber), stepsOf(gravityNumber), {}, {}};
    trial.scene.settings.subSteps = static_cast<int>(subSteps);
    const double half = kSide / 2;
    const double left = -half * kBoxesOfCourse;
    addFixed(trial.scene, "ground", {0, -half}, {box({20 * kSide, half})});
    for (int course = 0; course < kCourses; ++course) {
        const double y = (course + 0.5) * kSide;
        const bool isShifted = course % 2 == 1;
        for (int i = 0; i < kBoxesOfCourse - (isShifted ? 1 : 0); ++i) {
            addDynamic(trial.scene, "", {left + (i + (isShifted ? 1 : 0.5)) * kSide, y}, {box({half, half})});
        }
        for (const double end : {left + half / 2, -left - half / 2}) {
            if (isShifted) { addDynamic(trial.scene, "", {end, y}, {box({half / 2, half})}); }
        }
    }
    trial.error = farthestMove(trial.scene, kSide);
    return {trial};
}

/// World positions are double in every build, so this is the unit of all. The map ends where they are sixteenths of the
/// side: farther out, the place of rest itself is no number.
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

std::vector<Trial> restTrials(double distanceNumber, double gravityNumber) {
    Trial trial{sceneOfStep("rest", gravityNumber), stepsOf(gravityNumber), {}, {}};
    const double half = kSide / 2;
    const double away = distanceNumber / kEpsilon * kSide;
    addFixed(trial.scene, "ground", {away, away - half}, {box({20 * kSide, half})});
    addDynamic(trial.scene, "box", {away, away + half + kFall * kSide}, {box({half, half})}).angle = kTilt;
    const DVec2 place{away, away + half};
    trial.error = [place, from = std::llround(kJudged * static_cast<double>(trial.steps))](const Frame& frame) {
        return frame.step < from ? 0 : length(frame.bodies[1].position - place) / kSide;
    };
    return {trial};
}

}  // namespace

Slice stackSlice(Grain grain) {
    const bool full = grain == Grain::full;
    return {"stack",
            "five boxes of mass 1 under one of mass R, 1/32 beside each other",
            "farthest that a box ever was from its start, over its side",
            kGiveWay * kBelow,
            {"g dt^2 / size", powers(2, -12, 2, full ? 1 : 2)},
            {"ratio of masses R", powers(10, 0, 6, full ? 0.5 : 1)},
            stackTrials,
            [](double x, double y) {
                return "five boxes under one of " + roundedText(y, 3) + " times the mass: " + hertzOfSizes(x);
            }};
}

Slice wallSlice(Grain grain) {
    const bool full = grain == Grain::full;
    return {"wall",
            "a wall of eight courses, each box on two others",
            "farthest that a box ever was from its start, over its side",
            kGiveWay * kCourses,
            {"g dt^2 / size", powers(2, -12, 2, full ? 1 : 2)},
            {"sub-steps", powers(2, 0, 6, full ? 1 : 2)},
            wallTrials,
            [](double x, double y) {
                return "with " + roundedText(y, 3) + (y == 1 ? " sub-step " : " sub-steps ") + hertzOfSizes(x);
            }};
}

Slice restSlice(Grain grain) {
    const bool full = grain == Grain::full;
    return {"rest",
            "a box that falls onto the ground by 1/4 of its side, far from the origin",
            "distance of the box from its place of rest, over its side",
            1.0 / 32,
            {"distance eps / size (eps of double)", powers(2, -52, -4, full ? 3 : 6)},
            {"g dt^2 / size", powers(2, -12, 2, full ? 1 : 2)},
            restTrials,
            [](double x, double y) {
                return "a box of 1 m at " + hertzText(y, 1) + " (of 1 cm at " + hertzText(y, 0.01) +
                       ") rests as far out as " + roundedText(x / kEpsilon, 2) + " times its size";
            }};
}

}  // namespace swept::envelope
