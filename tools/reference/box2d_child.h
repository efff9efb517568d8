#pragma once

namespace swept {

/// Name of the hidden sub-command that runs the child.
inline constexpr const char* kBox2dChildCommand = "__box2d";

/// The child's side of `makeBox2dRunner`: reads the length and the JSON of a scene and the
/// iterations from standard input, answers with a
/// sample (count and numbers) at once and after each byte that it then receives; each byte is one step. Ends with the
/// input.
/// @return exit code: 0, or 2 when the scene is not readable. Box2D may end the process by an assertion at any point.
int runBox2dChild();

}  // namespace swept
