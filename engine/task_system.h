#pragma once

// What a game implements to give a world threads. It stands below, since lower layers have parallel loops too.
#include "../shapes/task_system.h"
