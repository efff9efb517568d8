#pragma once

#include <vector>

#include "recording.h"

namespace swept::measures {

/// An impact that the motion at the start of a sample leads to if nothing else happens: a body in free flight (no
/// joint, nothing within reach of it at the start) on a static or kinematic shape, by the certified time of impact.
struct ForeseenHit {
    int body = 0;
    int obstacle = 0;     ///< the other body
    double time = 0;      ///< s from the start of the run
    double wait = 0;      ///< s from the impact to the end of the sample
    bool missed = false;  ///< the motion shows no trace of it, or the body has passed by the end of the sample
    bool late = false;    ///< nothing was done about it by the end of the sample, but the two touch or overlap there
};

/// All of a run, in order of time. Only impacts that matter are told: head-on rather than grazing, faster than what
/// gravity gives within a sample, and deeper than a contact's tolerance if they were ignored. Damping is left out of
/// the flight.
std::vector<ForeseenHit> foreseenHits(const SceneDescription& scene, const Recording& recording);

}  // namespace swept::measures
