#pragma once

#include <vector>

#include "limits.h"
#include "row.h"

namespace swept::tune {

/// What the search may try, besides steps and sub-steps.
struct SearchSpace {
    std::vector<SceneContinuous> modes;        ///< beside the scene's own; empty when nothing there is fast
    std::vector<double> toiTolerances;         ///< m, beside the scene's own; likewise
    std::vector<SceneBroadphase> broadphases;  ///< beside the scene's own
};
SearchSpace searchSpaceOf(const SceneDescription& scene);

/// A part of the search that depends on nothing but its own rows: one engine at one step.
struct Track {
    Engine engine = Engine::f32;
    int dtPower = 0;
};
/// All of them, those first that other engines and steps are compared with.
std::vector<Track> allTracks();

/// What to run next, given what is known: a pure function of errors and counted work, never of a clock, so that one
/// process and many, an interrupted run and a whole one, run the same. Nothing when the track is done.
///
/// Of a track of ours: bisection for the fewest sub-steps that keep the limits; in single precision then, from there,
/// one change at a time of relaxation passes, continuous mode and tolerance; then the best of each together.
std::vector<Config> nextOf(const Track& track, const Subject& subject, const SearchSpace& space,
                           const std::vector<Limit>& limits, const Knowledge& known);

/// When all tracks are done: other broadphases for the settings that keep the limits with the least work (of those with
/// next to no more, the strongest continuous mode).
std::vector<Config> lastOf(const Subject& subject, const SearchSpace& space, const std::vector<Limit>& limits,
                           const Knowledge& known);

}  // namespace swept::tune
