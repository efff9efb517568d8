#include "broadphase_roofline.h"

#include <algorithm>
#include <array>
#include <ostream>

#include "bench_random.h"
#include "stopwatch.h"
#include "text_table.h"

// The widest vectors of the machine, chosen when the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__ELF__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define SWEPT_WIDEST __attribute__((target_clones("avx2", "default"), optimize("O3")))
#else
#define SWEPT_WIDEST
#endif

namespace swept::bench {
namespace {

constexpr std::size_t kInCache = 512;  // boxes: 8 KB

/// Coordinates apart, as a comparison of one with many wants them.
struct BoxLanes {
    std::array<float, kInCache> lowerX;
    std::array<float, kInCache> lowerY;
    std::array<float, kInCache> upperX;
    std::array<float, kInCache> upperY;
};

SWEPT_WIDEST int countOverlaps(const BoxLanes& boxes, float lowerX, float lowerY, float upperX, float upperY) {
    int count = 0;
    for (std::size_t i = 0; i < kInCache; ++i) {
        const int x = static_cast<int>(boxes.lowerX[i] <= upperX) & static_cast<int>(lowerX <= boxes.upperX[i]);
        const int y = static_cast<int>(boxes.lowerY[i] <= upperY) & static_cast<int>(lowerY <= boxes.upperY[i]);
        count += x & y;
    }
    return count;
}

SWEPT_WIDEST std::uint32_t sumOf(const std::uint32_t* values, std::size_t count) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) { sum += values[i]; }
    return sum;
}

double measureCompares() {
    constexpr int kRounds = 40;
    constexpr int kQueries = 500;
    BenchRandom random(1);
    BoxLanes boxes{};
    for (std::size_t i = 0; i < kInCache; ++i) {
        boxes.lowerX[i] = static_cast<float>(random.in(0, 10));
        boxes.lowerY[i] = static_cast<float>(random.in(0, 10));
        boxes.upperX[i] = boxes.lowerX[i] + 1;
        boxes.upperY[i] = boxes.lowerY[i] + 1;
    }
    double fastest = 1e9;
    volatile int kept = 0;  // so that the loop is not left out
    for (int round = 0; round < kRounds; ++round) {
        const Stopwatch watch;
        int count = 0;
        for (int query = 0; query < kQueries; ++query) {
            const float at = static_cast<float>(query % 10);
            count += countOverlaps(boxes, at, at, at + 1, at + 1);
        }
        fastest = std::min(fastest, watch.seconds());
        kept = kept + count;
    }
    return static_cast<double>(kInCache) * kQueries / fastest;
}

double measureBandwidth() {
    constexpr std::size_t kCount = std::size_t{1} << 25;  // 128 MB
    constexpr int kRounds = 6;
    const std::vector<std::uint32_t> values(kCount, 1);
    double fastest = 1e9;
    volatile std::uint32_t kept = 0;
    for (int round = 0; round < kRounds; ++round) {
        const Stopwatch watch;
        kept = kept + sumOf(values.data(), values.size());
        fastest = std::min(fastest, watch.seconds());
    }
    return static_cast<double>(kCount * sizeof(std::uint32_t)) / fastest;
}

}  // namespace

MachineLimits measureLimits() { return {measureBandwidth(), measureCompares()}; }

std::vector<RooflineRow> rooflineOf(std::span<const BroadphaseRow> rows, const MachineLimits& limits) {
    std::vector<RooflineRow> result;
    for (const BroadphaseRow& row : rows) {
        if (!(row.boxTests > 0)) { continue; }
        const double bytes =
            row.proxies * static_cast<double>(sizeof(Aabb)) + row.newPairs * static_cast<double>(sizeof(ProxyPair));
        result.push_back({row, 1e9 * bytes / limits.bytesPerSecond,
                          1e9 * row.boxTests * row.movedPerStep / limits.comparesPerSecond});
    }
    return result;
}

void writeRoofline(std::ostream& out, std::span<const RooflineRow> rows, const MachineLimits& limits) {
    out << "\nRoofline: this machine reads " << threeDigits(1e-9 * limits.bytesPerSecond) << " GB/s and compares "
        << threeDigits(1e-9 * limits.comparesPerSecond) << " G boxes/s in one thread; us a step\n";
    TextTable table({"", "boxes", "tests per renewed", "reading", "comparing", "pairs take", "of the limit"});
    for (const RooflineRow& roof : rows) {
        const BroadphaseRow& row = roof.row;
        table.add({row.scene + ' ' + row.method, std::to_string(row.proxies), threeDigits(row.boxTests),
                   threeDigits(1e-3 * roof.readTime), threeDigits(1e-3 * roof.compareTime),
                   threeDigits(1e-3 * row.pairTime * row.movedPerStep), threeDigits(100 * roof.share()) + " %"});
    }
    table.write(out);
}

}  // namespace swept::bench
