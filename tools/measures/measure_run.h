#pragma once

#include <swept/samples/scene_description.h>

#include "measure.h"
#include "recording.h"

namespace swept::measures {

struct Reference;

/// The measures that a run shows by itself: those that survive chaos. The scene tells which of them mean something:
/// energy may grow where springs, motors or kinematic bodies bring it in, must stay only where nothing rubs and all
/// bounces are elastic, and momentum stays only where nothing static takes part.
/// @param recording  of a run whose runner was told to `measure`; at least two samples
Values measuredAlone(const SceneDescription& scene, const Recording& recording);

/// The measures of one run against another of the same scene, over the ticks of which both have a sample.
/// @param truth  `position` alone is found where it has no velocities (a closed form)
Values measuredAgainst(const SceneDescription& scene, const Recording& recording, const Recording& truth,
                       bool truthHasPositionsOnly = false);

/// Both. Of a run that did not end, nothing.
Values measured(const SceneDescription& scene, const Recording& recording, const Reference& reference);

}  // namespace swept::measures
