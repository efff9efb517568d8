#pragma once

#include "../../shapes/wide_targets.h"
