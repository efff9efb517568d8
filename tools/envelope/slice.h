#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <swept/samples/frame.h>
#include <swept/samples/scene_description.h>

/// Two-dimensional slices of the operating envelope. The engine obeys a power-of-two law (lengths, masses or times
/// twice as large give the same motion), so that what it can do depends on dimensionless groups alone; a slice spans
/// two of them.

namespace swept::envelope {

inline constexpr double kGravity = 10;  ///< m/s², in all scenes that have any

/// One run of a cell.
struct Trial {
    SceneDescription scene;
    std::int64_t steps = 0;
    /// Error of a state, a part of a size: 0 is perfect. That of the run is the largest after any step.
    std::function<double(const Frame&)> error;
    /// May be empty; else a state for which it is true must occur, or the run proves nothing ("never arrived").
    std::function<bool(const Frame&)> hasArrived;
};

/// A dimensionless group and the values at which it is sampled, ascending.
struct Axis {
    std::string label;
    std::vector<double> values;
};

struct Slice {
    std::string name;     ///< of the files: "stack"
    std::string title;    ///< what is in the scene
    std::string measure;  ///< what the error is, and a part of what
    double bound = 0;     ///< errors up to here are inside
    Axis x;               ///< the group whose limit is looked for: all is well at its small end
    Axis y;
    /// The runs of a cell, the worst of which counts.
    std::function<std::vector<Trial>(double x, double y)> trials;
    /// The limit in metres, kilograms and hertz: "a 1 cm box … needs 240 Hz".
    std::function<std::string(double x, double y)> told;
};

enum class Grain : std::uint8_t {
    full,
    coarse,  ///< every other value or so of the full map: quick enough for a test
};

/// Boxes under a heavy one: g·dt²/size × ratio of masses. Error: the farthest that a box ever was from its start.
Slice stackSlice(Grain grain);
/// A wall of boxes that each stand on two: g·dt²/size × sub-steps. Error: the farthest that a box ever was from its
/// start.
Slice wallSlice(Grain grain);
/// A load on a chain let go level: ratio of masses × links. Error: the largest gap of a joint.
Slice chainSlice(Grain grain);
/// Slender bodies at a wall as thick as they are: speed·dt/width × aspect ratio. Error: how far they get into it.
Slice bulletSlice(Grain grain);
/// A box that comes to rest far out: distance·ε/size × g·dt²/size. Error: its distance from the place of rest.
Slice restSlice(Grain grain);

std::vector<Slice> allSlices(Grain grain);

/// Powers of `base` with exponents first, first + step … last.
std::vector<double> powers(double base, double first, double last, double step);
/// Largest distance of any dynamic body from where the scene puts it, over `size`.
std::function<double(const Frame&)> farthestMove(const SceneDescription& scene, double size);

}  // namespace swept::envelope
