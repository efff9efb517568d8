#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "../measures/reference.h"
#include "limits.h"
#include "row.h"

namespace swept::tune {

/// A part of the engine that a scene may do without.
struct Feature {
    const char* name;  ///< "continuous collision", "restitution" …
    bool isModel;      ///< part of what is simulated, rather than of how well
    bool (*isPresent)(const SceneDescription& scene, const Config& config);
    /// Takes it away; settings go into the config, everything else into the scene.
    void (*remove)(SceneDescription& scene, Config& config);
};

/// All of them, in the order in which the report tells them.
std::span<const Feature> allFeatures();

/// What taking some features away does.
struct Ablated {
    std::vector<std::string> features;
    bool isPresent = true;  ///< otherwise nothing else here means anything
    Row row;                ///< errors are judged by the whole scene and its reference
    double change = 0;      ///< m, farthest that a body gets from where it is with them
    bool isNeeded = true;   ///< the outcome is another without
    std::string refusal;  ///< why the engine does not take the scene without them: whether they are needed is not known
};

struct Ablation {
    Row whole;  ///< the scene as it is
    /// Whether anything was taken away: where the scene as it is misses the errors, nothing tells what they need.
    bool isDecided = true;
    double visible = 0;           ///< m, changes up to here are not seen
    std::vector<Ablated> single;  ///< each feature off in turn
    Ablated lean;                 ///< off together in the leanest profile; none: the scene needs all that it has
};

/// Takes each feature away in turn, and then, of those whose absence changes nothing that matters, as many as can go
/// together, the most costly by counted work first. The outcome is the same when every limit holds and no body is
/// farther than `visible` from where the whole scene has it at the same time: a limit alone would let friction go from
/// a scene in which nobody asked where things slide to. Of settings that change the method and not the model
/// (continuous collision, sub-steps, relaxation, sleep) the limits alone decide. Sensors are needed when one of them
/// has something to tell.
Ablation ablate(const Subject& subject, const std::vector<Limit>& limits, const measures::Reference& reference,
                int threads, const std::function<void(std::size_t done, std::size_t all)>& watch);

void writeAblation(std::ostream& out, const std::vector<Limit>& limits, const Ablation& ablation);
/// A record for each feature, and one for the leanest profile.
void writeAblationCsv(std::ostream& out, const Ablation& ablation);

/// The scene without what the leanest profile leaves out.
SceneDescription leanScene(const Subject& subject, const Ablation& ablation);

}  // namespace swept::tune
