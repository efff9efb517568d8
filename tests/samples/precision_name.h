#pragma once

#include <string>

#include <swept/samples/runner.h>

namespace swept::test {

/// Names of parameters of suites that run in both precisions.
template <class ParamInfo>  // of GoogleTest, whose header is not needed here otherwise
std::string precisionName(const ParamInfo& info) {
    return info.param == Precision::f32 ? "f32" : "f64";
}

}  // namespace swept::test
