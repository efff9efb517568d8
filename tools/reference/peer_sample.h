#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <swept/samples/frame.h>

namespace swept {

/// What the child process tells after each step: the state, and the measures of that moment.
struct PeerSample {
    Frame frame;                 ///< without impacts: no peer tells them
    double penetration = 0;      ///< deepest, metres
    double jointError = 0;       ///< largest, metres
    double energy = 0;           ///< joules, potential 0 at y = 0
    DVec2 momentum;              ///< of dynamic bodies
    double angularMomentum = 0;  ///< about the world origin
    std::int64_t brokenJoints = 0;
    double stepSeconds = 0;  ///< processor time of all steps so far
};

/// A dynamic body at one moment, for the sums of a sample.
struct BodyMotion {
    double mass = 0;
    double inertia = 0;  ///< about the centre of mass; 0 for what does not turn
    DVec2 center;        ///< of mass, world
    DVec2 velocity;      ///< of the centre of mass
    double angularVelocity = 0;
    DVec2 gravity;  ///< as this body feels it
};

/// Adds a body to energy, momentum and angular momentum.
void addMotion(const BodyMotion& body, PeerSample& sample);

/// The sample as plain numbers, and back: both ends of the pipe are the same program.
void encodeSample(const PeerSample& sample, std::vector<double>& numbers);
/// @return nothing when the numbers do not have the form that `encodeSample` writes.
std::optional<PeerSample> decodeSample(std::span<const double> numbers);

}  // namespace swept
