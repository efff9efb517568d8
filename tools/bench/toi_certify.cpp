#include "toi_certify.h"

namespace swept::bench {
namespace {

constexpr std::size_t kMostViolations = 100;

}  // namespace

std::int64_t CertifyResult::wrong() const {
    std::int64_t all = 0;
    for (const std::int64_t some : counts) { all += some; }
    return all - countOf(ToiVerdict::right) - countOf(ToiVerdict::undecided);
}

CertifyResult certifyToi(const ToiAnswerer& answerer, std::int64_t count, std::uint64_t seed,
                         const std::function<void(std::int64_t)>& progress) {
    CertifyResult result;
    const auto families = static_cast<std::int64_t>(kToiFamilies.size());
    for (std::int64_t i = 0; i < count; ++i) {
        const ToiFamily family = kToiFamilies[static_cast<std::size_t>(i % families)];
        const auto index = static_cast<std::uint64_t>(i / families);
        const ToiQuery query = makeToiCase(family, seed, index);
        const ToiVerdict verdict = judgeToi(query, answerer(query)).verdict;
        ++result.counts[static_cast<std::size_t>(verdict)];
        const bool isWrong = verdict != ToiVerdict::right && verdict != ToiVerdict::undecided;
        if (isWrong && result.violations.size() < kMostViolations) {
            result.violations.push_back({family, index, verdict});
        }
        progress(i + 1);
    }
    return result;
}

}  // namespace swept::bench
