#pragma once

#include <box2d/math_functions.h>

#include <swept/shapes/dvec2.h>

namespace swept::bench {

inline b2Vec2 vectorOf(DVec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

}  // namespace swept::bench
