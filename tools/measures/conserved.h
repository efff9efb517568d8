#pragma once

#include <swept/samples/scene_description.h>

#include "measure.h"
#include "recording.h"

namespace swept::measures {

/// Energy and momentum of a run, where the scene says that they have to stay: fills `energyGain`, `energyDrift` and
/// `momentumDrift`.
/// The energy that they are measured by is what there is at the start: kinetic, and what the dynamic bodies would gain
/// if they fell to the lowest place of the scene. The momentum: what the bodies have at the start, added up as
/// magnitudes, and what gravity gives them in the time of the run.
void measureConserved(const SceneDescription& scene, const Recording& recording, Values& values);

}  // namespace swept::measures
