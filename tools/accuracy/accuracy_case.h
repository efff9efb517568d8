#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <swept/samples/frame.h>
#include <swept/samples/scene_description.h>

/// Scenes whose outcome is known, and how far a run is from it: the same for every engine.

namespace swept::accuracy {

/// All frames of a run, step 0 included.
using Frames = std::vector<Frame>;

/// One number taken from a run. 0 is perfect; it is a magnitude, so less is better.
struct Measure {
    std::string name;  ///< "sag", "drift", "energy" …
    std::string unit;  ///< "m", "s", "1" (a part of the whole) …
    std::function<double(const Frames&)> of;
};

/// What must hold at the end for a run to count at all; the reason when it does not ("collapsed", "escaped").
using Verdict = std::function<std::string(const Frames&)>;

struct Case {
    std::string group;  ///< "stacks", "mass", "sizes", "known", "bounce", "held", "landings"
    std::string name;   ///< unique: "stack-50", "chain-R100"
    SceneDescription scene;
    std::int64_t steps = 600;
    std::vector<Measure> measures;
    Verdict verdict;      ///< may be empty
    bool isLong = false;  ///< only on request
};

/// Unit boxes and wedges that should stay where they are.
std::vector<Case> stackCases();
/// Heavy bodies on light ones and on chains of light ones.
std::vector<Case> massCases();
/// The same stack in other sizes, units and places.
std::vector<Case> sizeCases();
/// What slides and rolls on slopes, and on level ground.
std::vector<Case> slopeCases();
/// Motions with a closed form or a conserved quantity, those on slopes included.
std::vector<Case> knownCases();
/// Balls that bounce.
std::vector<Case> bounceCases();
/// Balls that bounce off what joints hold.
std::vector<Case> heldCases();
/// What comes down and does not bounce.
std::vector<Case> landingCases();
/// All of them, in this order.
std::vector<Case> allCases();

}  // namespace swept::accuracy
