#pragma once

#include "options.h"

namespace swept {

/// `swept bench effort`.
void addBenchEffort(Command bench);

}  // namespace swept
