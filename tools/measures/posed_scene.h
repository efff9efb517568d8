#pragma once

#include <vector>

#include "../inspect/placed_scene.h"
#include "recording.h"

namespace swept::measures {

/// The scene's shapes where a sample puts them, in double precision, whatever engine made the sample.
class PosedScene {
public:
    /// @param scene  that `validateScene` accepts; must outlive this.
    explicit PosedScene(const SceneDescription& scene);

    void pose(const Sample& sample);
    const PlacedScene& placed() const { return placed_; }
    /// Deepest overlap of two shapes that may collide, metres; 0 when none overlap.
    double deepestOverlap() const;
    /// Centre of mass in the frame of the body.
    DVec2 localCenter(int body) const { return localCenters_[static_cast<std::size_t>(body)]; }

private:
    PlacedScene placed_;
    std::vector<DVec2> localCenters_;
};

}  // namespace swept::measures
