#pragma once

#include <string>
#include <vector>

#include "../../toi/toi_method.h"
#include "../../toi/toi_observer.h"
#include "toi_query.h"

namespace swept {

/// What there is to see of one time-of-impact query.
struct ToiAnatomy {
    struct Point {
        double fraction = 0;
        double separation = 0;
    };
    /// A look, and the bound that the search has from there: the separation is above it, for certain.
    struct Look {
        ToiStep step;
        std::vector<Point> bound;
    };

    ToiQuery query;
    Toi answer;
    std::vector<Look> looks;         ///< without the last one, which is the answer
    std::vector<Point> truth;        ///< the separation itself, over the whole sweep
    std::vector<double> plainLooks;  ///< where conservative advancement looks
};

ToiAnatomy dissectToi(const ToiQuery& query);

/// A gnuplot script that draws it, with all its data: above, the bodies as the larger one sees them, a ghost at each
/// look with the axis found there; below, separation and bounds over the fraction.
/// @param picture  the PNG that the script writes.
std::string anatomyScript(const ToiAnatomy& anatomy, const std::string& picture);

}  // namespace swept
