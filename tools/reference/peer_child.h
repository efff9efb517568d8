#pragma once

namespace swept {

/// Name of the hidden sub-command that runs the child.
inline constexpr const char* kPeerChildCommand = "__peer";

/// The child's side of `makePeerRunner`: reads the length and the JSON of a scene and the settings from standard input,
/// answers with a sample (count and numbers) at once and after each byte that it then receives; each byte is one step.
/// Ends with the input.
/// @return exit code: 0, or 2 when the scene is not readable or the engine is not there. The engine may end the process
///         by an assertion at any point.
int runPeerChild();

}  // namespace swept
