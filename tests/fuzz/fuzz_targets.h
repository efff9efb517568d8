#pragma once

#include "fuzz_input.h"

namespace swept::test {

/// A scene file: an error that says where, or a scene that survives writing and reading and runs a few steps to finite
/// states.
void fuzzScene(Bytes text);
/// A cloud of points: an error, or a valid polygon that holds them all.
void fuzzHull(Bytes bytes);
/// A time-of-impact query: refused, or answered as the certificate says, as far as samples can see.
void fuzzToi(Bytes bytes);
/// Calls of a world's interface: what is refused changes nothing, what is done leaves finite states.
void fuzzWorld(Bytes bytes);

}  // namespace swept::test
