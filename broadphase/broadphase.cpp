#include "broadphase.h"
