#pragma once

namespace swept {

/// A ball 5 m above a floor, in steps of 1/64 s.
inline constexpr const char* kBallScene = R"({"name": "ball", "gravity": [0, -8], "settings": {"dt": 0.015625},
 "bodies": [
  {"name": "floor", "shapes": [{"box": {"half": [10, 0.5]}}], "position": [0, -0.5]},
  {"name": "ball", "type": "dynamic", "position": [0, 5], "velocity": [1, 0],
   "shapes": [{"circle": {"radius": 0.5}, "restitution": 0.5}]}]})";

/// A chain with points closer together than Box2D's slop: it asserts while it builds its world.
inline constexpr const char* kSceneThatAbortsBox2d = R"({"bodies": [
  {"name": "ground", "shapes": [{"chain": {"points": [[1, 0], [0.999, 0], [-1, 0]]}}]},
  {"name": "ball", "type": "dynamic", "position": [0, 1], "shapes": [{"circle": {"radius": 0.25}}]}]})";

}  // namespace swept
