#pragma once

#include "options.h"

namespace swept {

/// `swept bench accuracy`.
void addBenchAccuracy(Command bench);

}  // namespace swept
