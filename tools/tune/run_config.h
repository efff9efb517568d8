#pragma once

#include "../measures/reference.h"
#include "row.h"

namespace swept::tune {

/// Runs the scene with these settings, once to measure errors and a few times more for its cost.
Row runConfig(const Subject& subject, const Config& config, const measures::Reference& reference);

}  // namespace swept::tune
