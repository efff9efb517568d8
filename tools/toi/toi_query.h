#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "../../toi/time_of_impact.h"

namespace swept {

/// One question, whole.
struct ToiQuery {
    ToiPolygon a;
    Sweep sweepA;
    ToiPolygon b;
    Sweep sweepB;
    ToiSettings settings;
};

/// As a line of a query file, without the line break; reads back as the same query.
std::string queryLine(const ToiQuery& query, std::string_view id, std::string_view family);

/// The same, so that a failing test prints what `swept toi` reads.
std::ostream& operator<<(std::ostream& out, const ToiQuery& query);

}  // namespace swept
