#pragma once

#include <span>
#include <string>

#include "broadphase_bench.h"
#include "broadphase_margin.h"

namespace swept::bench {

/// Writes data and scripts and draws: time against the number of proxies for every distribution, time on the scenes,
/// what margins trade. @return what was drawn, or why not; `error` when something could not be written
std::string plotBroadphase(const std::string& directory, std::span<const BroadphaseRow> distributions,
                           std::span<const BroadphaseRow> peers, std::span<const MarginRow> margins,
                           std::string& error);

}  // namespace swept::bench
