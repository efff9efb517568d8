#include "fuzz_targets.h"

// One fuzzer for each target: SWEPT_FUZZ_TARGET names it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    swept::test::SWEPT_FUZZ_TARGET({data, size});
    return 0;
}
