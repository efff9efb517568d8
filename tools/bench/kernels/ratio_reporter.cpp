#include "ratio_reporter.h"

#include <iomanip>
#include <ostream>
#include <vector>

namespace swept::bench {

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
    ConsoleReporter::ReportRuns(runs);
    const std::string prefix = "distance/";
    for (const Run& run : runs) {
        const std::string& name = run.run_name.function_name;
        if (run.aggregate_name != "median" || name.rfind(prefix, 0) != 0) { continue; }
        const std::size_t last = name.rfind('/');
        medians_[name.substr(prefix.size(), last - prefix.size())][name.substr(last + 1)] =
            1e9 * run.counters.at("per_query").value;
    }
}

void RatioReporter::printRatios(std::ostream& out) const {
    for (const auto& [row, times] : medians_) {
        out << std::left << std::setw(24) << row << std::right << std::fixed;
        for (const auto& [who, ns] : times) {
            out << "  " << who << std::setw(7) << std::setprecision(1) << ns << " ns";
        }
        for (const auto& [ours, ns] : times) {
            for (const auto& [theirs, theirNs] : times) {
                if (ours[0] == 'f' && theirs[0] != 'f') {
                    out << "  " << theirs << '/' << ours << ' ' << std::setprecision(2) << theirNs / ns;
                }
            }
        }
        out << '\n';
    }
}

}  // namespace swept::bench
