#pragma once

#include "options.h"

namespace swept {

/// `swept bench threads`.
void addBenchThreads(Command bench);

}  // namespace swept
