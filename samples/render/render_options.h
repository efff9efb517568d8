#pragma once

#include <cstddef>
#include <optional>

#include "../scene_description.h"

namespace swept {

/// What a picture of a scene shows. Every part may be switched off; what is off costs nothing.
struct RenderOptions {
    int width = 960;                      ///< pixels
    int height = 540;                     ///< pixels
    int superSampling = 3;                ///< samples per pixel and direction
    std::optional<ViewDescription> view;  ///< instead of the scene's own, or of one fitted to its bodies
    /// Index of the body with which the view moves (it does not turn). `view` is then centred so far from the body's
    /// origin; without one the origin is in the middle, and a few times the body is seen.
    std::optional<std::size_t> follow;

    bool grid = true;
    bool title = true;
    bool time = true;
    bool scaleBar = true;
    bool legend = true;
    bool joints = true;

    bool contacts = false;    ///< points and normals of `Frame::contacts`
    bool velocities = false;  ///< arrows as long as the way of `velocitySeconds`
    bool ghosts = false;      ///< bodies at the poses of `Frame::impacts`
    bool sweeps = false;      ///< the ways of `Frame::ways`, poses at impacts, normals, lost time, and what it cost
    bool sweepWork = true;    ///< the last of these; only with `sweeps`
    bool trails = false;      ///< what `SceneRenderer::addTrail` and `addStrobe` have collected
    bool labels = false;      ///< names of the bodies

    double velocitySeconds = 0.1;
    std::size_t trailPoints = 600;  ///< newest points kept per body; 0 keeps all
};

}  // namespace swept
