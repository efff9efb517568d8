#pragma once

#include <optional>

#include "../toi/toi_query.h"

namespace swept::bench {

/// How far an engine stays away from contact, in metres.
struct EngineContract {
    double slop = 0.005;
    double slopsInside = 3;  ///< target max(slop, R − slopsInside · slop) for the distance without radii
};

/// A query in the numbers of an engine that calculates in float, with target and tolerance of its contract. Empty when
/// the motion is accelerated, when the sizes are far from metres, or when a shape is none any more in float.
std::optional<ToiQuery> engineQuery(const ToiQuery& query, const EngineContract& contract);

}  // namespace swept::bench
