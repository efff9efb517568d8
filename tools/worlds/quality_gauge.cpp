#include "quality_gauge.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace swept::worlds {
namespace {

DVec2 rotated(DVec2 v, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

struct MovedBody {
    const BodyDescription& start;
    const BodyFrame& now;

    /// Where a direction, or a point, of the scene that is fixed to the body is now.
    DVec2 turned(DVec2 direction) const { return rotated(direction, now.angle - start.angle); }
    DVec2 moved(DVec2 point) const { return now.position + turned(point - start.position); }
};

/// By how much a joint fails to hold points of its bodies, metres; 0 of what holds none, like springs and motors.
struct GapOf {
    MovedBody a;
    MovedBody b;

    double operator()(const RevoluteDescription& hinge) const { return length(apart(hinge)); }
    double operator()(const WeldDescription& weld) const { return weld.linearHertz ? 0 : length(apart(weld)); }
    double operator()(const DistanceDescription& rod) const {
        const double now = length(b.moved(rod.anchorB) - a.moved(rod.anchorA));
        if (!rod.hertz && !rod.minLength && !rod.maxLength) {
            return std::abs(now - rod.length.value_or(length(rod.anchorB - rod.anchorA)));
        }
        return std::max({0.0, rod.minLength.value_or(now) - now, now - rod.maxLength.value_or(now)});
    }
    double operator()(const PrismaticDescription& slider) const { return offAxis(slider); }
    double operator()(const WheelDescription& wheel) const { return offAxis(wheel); }
    double operator()(const PulleyDescription& pulley) const {
        const auto ropeLength = [&](DVec2 onA, DVec2 onB) {
            return length(onA - pulley.groundA) + pulley.ratio * length(onB - pulley.groundB);
        };
        const double most = pulley.length.value_or(ropeLength(pulley.anchorA, pulley.anchorB));
        return std::max(0.0, ropeLength(a.moved(pulley.anchorA), b.moved(pulley.anchorB)) - most);
    }
    template <class Other>
    double operator()(const Other&) const {
        return 0;
    }

private:
    template <class Members>
    DVec2 apart(const Members& joint) const {
        return b.moved(joint.anchorB.value_or(joint.anchor)) - a.moved(joint.anchor);
    }
    template <class Members>
    double offAxis(const Members& joint) const {
        return std::abs(cross(a.turned(joint.axis / length(joint.axis)), apart(joint)));
    }
};

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
        if (!isPresent[a] || !isPresent[b]) { continue; }
        const GapOf gap{{scene_.bodies[a], sample.frame.bodies[a]}, {scene_.bodies[b], sample.frame.bodies[b]}};
        quality_.jointError = std::max(quality_.jointError, std::visit(gap, scene_.joints[i].joint));
    }
}

}  // namespace swept::worlds
