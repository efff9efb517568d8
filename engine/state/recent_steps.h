#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// The longest of the steps of the last seconds, by two halves of them: the latter one is not over.
struct RecentSteps {
    double longestBefore = 0;  ///< s, of the half that is over
    double longest = 0;        ///< s, of the latter one
    double time = 0;           ///< s, of the latter one up to now
};

}  // namespace swept::inline SWEPT_PRECISION
