#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "../../samples/json_strict.h"
#include "../../toi/time_of_impact.h"

namespace swept {

/// What a line of a query file says.
struct QueryLine {
    std::string id = "null";  ///< as JSON, all digits of it
    ToiPolygon a;
    Sweep sweepA;
    ToiPolygon b;
    Sweep sweepB;
    double tMax = 1;
    std::optional<double> target;
    std::optional<double> tolerance;
};

/// Reads a line strictly: unknown and duplicate keys, missing members and wrong kinds are errors; so are polygons that
/// `validateToiPolygon` refuses. Optional are `family` (ignored), `k`, `target` and `tolerance`.
/// @param query  its `id` is filled whenever the line has one that can be read, whatever is wrong with the rest.
/// @return nothing, or what is wrong and where, as a JSON pointer or a column.
std::optional<std::string> readQueryLine(std::string_view line, QueryLine& query);

}  // namespace swept
