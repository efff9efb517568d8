#pragma once

#include "options.h"

namespace swept {

/// `swept bench broadphase` and `swept bench overlap`.
void addBenchBroadphase(Command bench);

}  // namespace swept
