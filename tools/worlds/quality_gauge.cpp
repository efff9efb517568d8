#include "quality_gauge.h"

#include <algorithm>
#include <cmath>

namespace swept::worlds {
namespace {

DVec2 rotated(DVec2 v, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Where a point of the scene that is fixed to a body is now.
DVec2 movedWith(const BodyDescription& body, const BodyFrame& frame, DVec2 point) {
    return frame.position + rotated(point - body.position, frame.angle - body.angle);
}

}  // namespace

QualityGauge::QualityGauge(const BenchScene& bench)
    : scene_(bench.scene), ends_(jointEndsOf(bench.scene)), posed_(bench.scene) {}

void QualityGauge::add(const PeerSample& sample, const std::vector<bool>& isPresent) {
    addOverlaps(sample, isPresent);
    addGaps(sample, isPresent);
    quality_.energy = sample.energy;
}

Quality QualityGauge::result() const {
    Quality quality = quality_;
    quality.mean = overlaps_ > 0 ? sum_ / static_cast<double>(overlaps_) : 0;
    return quality;
}

void QualityGauge::addOverlaps(const PeerSample& sample, const std::vector<bool>& isPresent) {
    constexpr double kFarAway = 0x1p40;  // metres: what is not there lies so far out, each body at a place of its own
    constexpr double kApart = 0x1p10;
    measures::Sample posed;
    posed.bodies = sample.frame.bodies;
    for (std::size_t i = 0; i < posed.bodies.size(); ++i) {
        if (!isPresent[i]) { posed.bodies[i].position = {kFarAway + kApart * static_cast<double>(i), 0}; }
    }
    posed_.pose(posed);
    for (const NearPair& pair : nearPairs(posed_.placed(), 0)) {
        quality_.deepest = std::max(quality_.deepest, -pair.separation);
        sum_ += std::max(0.0, -pair.separation);
        ++overlaps_;
    }
}

void QualityGauge::addGaps(const PeerSample& sample, const std::vector<bool>& isPresent) {
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        const auto [a, b] = ends_[i];
        const auto* const hinge = std::get_if<RevoluteDescription>(&scene_.joints[i].joint);
        if (hinge == nullptr || !isPresent[a] || !isPresent[b]) { continue; }
        const DVec2 onA = movedWith(scene_.bodies[a], sample.frame.bodies[a], hinge->anchor);
        const DVec2 onB = movedWith(scene_.bodies[b], sample.frame.bodies[b], hinge->anchor);
        quality_.jointError = std::max(quality_.jointError, length(onB - onA));
    }
}

}  // namespace swept::worlds
