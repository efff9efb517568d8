#pragma once

#include <box2d/box2d.h>

#include <swept/shapes/vec2.h>

/// Vectors in the numbers of Box2D 2.4.1, which are floats.

namespace swept::test {

inline b2Vec2 toBox2d(Vec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

}  // namespace swept::test
