#include "vec2.h"
