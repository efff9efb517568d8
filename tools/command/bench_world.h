#pragma once

#include "options.h"

namespace swept {

/// `swept bench world`, and the hidden command of its children.
void addBenchWorld(Command bench);
void addWorldChildCommand(Command app);

}  // namespace swept
