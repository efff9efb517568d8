#pragma once

#include <memory>
#include <span>
#include <string>

#include "pair_cases.h"

namespace swept::bench {

/// A distance function under the stop-watch. One call of a pass asks it about every loaded pair.
class DistanceContestant {
public:
    virtual ~DistanceContestant() = default;

    virtual std::string name() const = 0;
    virtual void load(std::span<const PairCase> pairs) = 0;

    /// Without a cache, at the first pose. @return the sum of the distances, radii included: so that no call can be
    /// left out, and all contestants can be seen to answer the same question.
    virtual double coldPass() = 0;
    /// At the two poses in turns, with the cache that the last pass left.
    virtual double warmPass() = 0;
};

std::unique_ptr<DistanceContestant> makeDistanceF32();
std::unique_ptr<DistanceContestant> makeDistanceF64();
/// `b2Distance` of Box2D 2.4.1.
std::unique_ptr<DistanceContestant> makeDistanceBox2d();
/// `b2ShapeDistance` of Box2D 3.x; linked where one is installed.
std::unique_ptr<DistanceContestant> makeDistanceBox2d3();

}  // namespace swept::bench
