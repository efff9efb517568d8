#pragma once

#include <cstddef>
#include <cstdint>

#include "../../broadphase/broadphase.h"
#include "decode.h"
#include "encode.h"

namespace swept::inline SWEPT_PRECISION {

/// What is written of a broadphase: all of the structure, so that it finds what it finds in the same order, and at the
/// same cost. @param kind  of the broadphase
std::size_t encodedSize(BroadphaseKind kind, const Broadphase& broadphase);
void encode(Encoder& to, BroadphaseKind kind, const Broadphase& broadphase);
void decode(Decoder& from, BroadphaseKind kind, Broadphase& broadphase);
/// Hash of the layouts of all kinds.
std::uint64_t layoutOfBroadphases();

}  // namespace swept::inline SWEPT_PRECISION
