#include "../../shapes/wide_targets.h"
// after it
#include <hwy/targets.h>

/// The part of Highway's library that suites ask which instruction sets there are. Its headers alone serve a machine
/// with one, to which all calls go then without a choice: this says which it is.
static_assert((HWY_TARGETS & (HWY_TARGETS - 1)) == 0, "more than one instruction set asks for the library");

namespace hwy {

int64_t SupportedTargets() { return HWY_STATIC_TARGET; }
void SetSupportedTargetsForTest(int64_t /*targets*/) {}

}  // namespace hwy
