#pragma once

#include "options.h"

namespace swept {

/// `swept bench joints`.
void addBenchJoints(Command bench);

}  // namespace swept
