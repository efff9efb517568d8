#pragma once

#include <vector>

#include "../measures/posed_scene.h"
#include "../reference/joint_ends.h"
#include "../reference/peer_sample.h"
#include "bench_scene.h"
#include "quality.h"

namespace swept::worlds {

/// Gathers samples of one run.
class QualityGauge {
public:
    /// @param bench  outlives this
    explicit QualityGauge(const BenchScene& bench);

    /// @param isPresent  by body: what is not there meets nothing
    void add(const PeerSample& sample, const std::vector<bool>& isPresent);
    Quality result() const;

private:
    void addOverlaps(const PeerSample& sample, const std::vector<bool>& isPresent);
    void addGaps(const PeerSample& sample, const std::vector<bool>& isPresent);

    const SceneDescription& scene_;
    std::vector<JointEnds> ends_;
    measures::PosedScene posed_;
    Quality quality_;
    double sum_ = 0;
    std::size_t overlaps_ = 0;
};

}  // namespace swept::worlds
