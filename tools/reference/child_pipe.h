#pragma once

#include <cstddef>

/// The child's end of a `ChildProcess`: its standard input and output.

namespace swept {

/// Reads exactly `size` bytes. @return false at the end of the input
bool readAll(void* target, std::size_t size);
/// @return false when nobody reads
bool writeAll(const void* source, std::size_t size);
/// No memory dump when an engine aborts: an abort is a result here, not a crash to be studied.
void forbidDumps();

}  // namespace swept
