#pragma once

#include <vector>

#include "../engine/counter_list.h"
#include "frame.h"

namespace swept {

inline std::vector<NamedNumber> namedCounters(const StepCounters& counters) {
    std::vector<NamedNumber> named;
    for (const CounterEntry& counter : kCounters) {
        named.push_back({counter.name, static_cast<double>(counters.*counter.member)});
    }
    return named;
}

}  // namespace swept
