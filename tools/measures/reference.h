#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measure.h"
#include "recording.h"

namespace swept::measures {

/// What a run is compared with: the closed form of the scene, or a run of our own that was refined until it settled.
struct Reference {
    std::string source;   ///< "closed form: pendulum", "f64, steps of 0.52 ms"
    Recording recording;  ///< a sample at every tick; of a closed form, positions only
    bool isClosedForm = false;
    double dt = 0;  ///< s, of the finest run; 0 for a closed form
    /// Of each measure that needs the reference: how much it still changes when the steps of the reference are doubled.
    /// 0 for a closed form. Where it is large the scene is chaotic, and such a measure says little. `missedHits`: how
    /// many the reference itself seems to miss; what is left of such judgements' own errors.
    Values uncertainty;
};

/// Told before each refined run: which halving it is, of how many at most.
using RefinementWatcher = std::function<void(int halving, int most)>;

/// The scene's closed form where it has one; else runs in f64 without sleep, in mode `subStep`, whose steps are halved
/// until no body is anywhere farther than a thousandth of the smallest extent from where it was before the halving,
/// four times at most. The same scene gives the same bits.
/// @param ticks  length, in steps of the scene
Reference makeReference(const SceneDescription& scene, std::int64_t ticks, const RefinementWatcher& watch = {});

}  // namespace swept::measures
