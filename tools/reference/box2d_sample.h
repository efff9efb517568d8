#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <swept/samples/frame.h>

namespace swept {

/// How hard Box2D tries in a step.
struct Box2dIterations {
    std::int32_t velocity = 8;
    std::int32_t position = 3;
};

/// What the child process tells after each step: the state, and the measures of that moment.
struct Box2dSample {
    Frame frame;                 ///< without impacts: Box2D does not tell them
    double penetration = 0;      ///< deepest, metres
    double jointError = 0;       ///< largest, metres
    double energy = 0;           ///< joules, potential 0 at y = 0
    DVec2 momentum;              ///< of dynamic bodies
    double angularMomentum = 0;  ///< about the world origin
    std::int64_t brokenJoints = 0;
    double stepSeconds = 0;  ///< processor time of all steps so far
};

/// The sample as plain numbers, and back: both ends of the pipe are the same program.
void encodeSample(const Box2dSample& sample, std::vector<double>& numbers);
/// @return nothing when the numbers do not have the form that `encodeSample` writes.
std::optional<Box2dSample> decodeSample(std::span<const double> numbers);

}  // namespace swept
