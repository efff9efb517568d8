#pragma once

#include <cstdlib>

/// How many random cases a test tries.

namespace swept::test {

/// All of them; a third, the first ones, where the environment has SWEPT_FEW_CASES. `tools/test.sh` sets it, unless it
/// is to run what takes longer, too: then each change is tried on some cases, and all of them are tried now and then.
template <class Count>
Count someOf(Count all) {
    static const bool isFew = std::getenv("SWEPT_FEW_CASES") != nullptr;
    return isFew ? (all + 2) / 3 : all;
}

}  // namespace swept::test
