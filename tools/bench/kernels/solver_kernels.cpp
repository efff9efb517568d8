#include <benchmark/benchmark.h>

#include <array>
#include <numeric>
#include <string>
#include <vector>

#include <swept/solver/contacts/contact_blocks.h>
#include <swept/solver/wide/wide_contacts.h>

#include "../bench_random.h"
#include "kernel_precision.h"
#include "kernels.h"

/// Passes of the contact solver against what the machine computes and reads at best. Compiled once per precision.

// The widest vectors of the machine, chosen when the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__ELF__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define SWEPT_WIDEST __attribute__((target_clones("avx2", "default"), optimize("O3")))
#else
#define SWEPT_WIDEST
#endif

namespace swept::bench {
namespace {

/// Additions, subtractions, products and quotients of the kernel, per point of a contact with two, counted by hand.
constexpr double kFlopsOfWarmStart = 17;
constexpr double kFlopsOfSolve = 57;
constexpr double kFlopsOfRelax = 50;
constexpr double kFlopsOfSeparation = 15;
/// Numbers that a relaxation reads and writes per point: of the block, and of its bodies.
constexpr double kNumbersOfBlock = 17.5;
constexpr double kNumbersOfBodies = 8;

/// A wall of bricks, each on two others.
struct Wall {
    SolverBatch batch;
    ConstraintGraph graph;
    ContactBlocks contacts;
    std::size_t points = 0;

    explicit Wall(int side) {
        batch.clear();
        for (int i = 0; i < side * side; ++i) { batch.addBody({}, {Real(1), Real(6)}, {}); }
        BenchRandom random(1);
        for (int row = 1; row < side; ++row) {
            for (int column = 0; column + 1 < side; ++column) {
                for (const int below : {column, column + 1}) {
                    addContact(random, 1 + row * side + column, 1 + (row - 1) * side + below);
                }
            }
        }
        points = 2 * batch.contacts.size();
        graph.colourContacts(batch);
        SerialTaskSystem loops;
        contacts.build(batch, graph, {}, loops);
    }

    void addContact(BenchRandom& random, int above, int below) {
        ContactConstraint contact;
        contact.slotA = static_cast<BodySlot>(below);
        contact.slotB = static_cast<BodySlot>(above);
        contact.normal = {0, 1};
        contact.friction = Real(0.5);
        contact.maxPushSpeed = 4;
        contact.softness = softnessOfSubStep(kContactCycles, kContactDampingRatio, Real(1) / 240);
        contact.count = 2;
        for (ContactConstraintPoint& point : contact.points) {
            point.anchorA = {static_cast<Real>(random.in(-0.5, 0.5)), Real(0.5)};
            point.anchorB = {static_cast<Real>(random.in(-0.5, 0.5)), Real(-0.5)};
            point.normalImpulse = Real(0.01);
        }
        batch.contacts.push_back(contact);
    }

    template <class Visit>
    void forColours(const Visit& visit) {
        for (const int colour : graph.activeColours()) { visit(colour, RangeCut(0, contacts.countOf(colour))); }
    }
};

template <class Pass>
void registerPass(const char* name, int side, double flops, const Pass& pass) {
    const std::string title = std::string("contacts/") + name + '/' + std::to_string(side * side) + '/' + kPrecision;
    benchmark::RegisterBenchmark(title.c_str(), [side, flops, pass](benchmark::State& state) {
        Wall wall(side);
        for ([[maybe_unused]] auto _ : state) {
            wall.forColours([&](int colour, RangeCut cut) { pass(wall, colour, cut); });
        }
        const auto points = static_cast<double>(wall.points);
        state.counters["per_point"] =
            benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
        state.counters["flops"] = benchmark::Counter(points * flops, benchmark::Counter::kIsIterationInvariantRate);
        state.counters["bytes"] = benchmark::Counter(points * (kNumbersOfBlock + kNumbersOfBodies) * sizeof(Real),
                                                     benchmark::Counter::kIsIterationInvariantRate);
    });
}

/// Independent products and sums, as many as hide their latency.
SWEPT_WIDEST void multiplyAndAdd(std::array<Real, 64>& sums, int rounds) {
    std::array<Real, 64> local = sums;
    for (int round = 0; round < rounds; ++round) {
        for (Real& sum : local) { sum = sum * Real(0.999) + Real(0.001); }
    }
    sums = local;
}

void measurePeak(benchmark::State& state) {
    constexpr int kRounds = 1000;
    std::array<Real, 64> sums{};
    for ([[maybe_unused]] auto _ : state) {
        multiplyAndAdd(sums, kRounds);
        benchmark::DoNotOptimize(sums);
    }
    state.counters["flops"] =
        benchmark::Counter(2.0 * kRounds * sums.size(), benchmark::Counter::kIsIterationInvariantRate);
}

SWEPT_WIDEST Real sumOf(const Real* values, std::size_t count) {
    std::array<Real, 64> sums{};
    for (std::size_t i = 0; i < count; i += sums.size()) {
        for (std::size_t lane = 0; lane < sums.size(); ++lane) { sums[lane] += values[i + lane]; }
    }
    return std::accumulate(sums.begin(), sums.end(), Real(0));
}

void measureReading(benchmark::State& state) {
    const std::vector<Real> values(static_cast<std::size_t>(state.range(0)) / sizeof(Real), 1);
    for ([[maybe_unused]] auto _ : state) { benchmark::DoNotOptimize(sumOf(values.data(), values.size())); }
    state.counters["bytes"] =
        benchmark::Counter(static_cast<double>(state.range(0)), benchmark::Counter::kIsIterationInvariantRate);
}

void registerAllSolverKernels() {
    constexpr Real h = Real(1) / 240;
    for (const int side : {10, 64, 400}) {
        registerPass("warmStart", side, kFlopsOfWarmStart,
                     [](Wall& wall, int colour, RangeCut cut) { wall.contacts.warmStart(wall.batch, colour, cut); });
        registerPass("solve", side, kFlopsOfSolve, [](Wall& wall, int colour, RangeCut cut) {
            wall.contacts.solve(wall.batch, colour, cut, {.h = h, .useBias = true, .hasMoved = false});
        });
        registerPass("relax", side, kFlopsOfRelax, [](Wall& wall, int colour, RangeCut cut) {
            wall.contacts.solve(wall.batch, colour, cut, {.h = h, .hasMoved = false});
        });
        registerPass(
            "relaxAfterMotion", side, kFlopsOfRelax + kFlopsOfSeparation,
            [](Wall& wall, int colour, RangeCut cut) { wall.contacts.solve(wall.batch, colour, cut, {.h = h}); });
    }
    const std::string peak = std::string("contacts/peak/") + kPrecision;
    const std::string reading = std::string("contacts/reading/") + kPrecision;
    benchmark::RegisterBenchmark(peak.c_str(), measurePeak);
    benchmark::RegisterBenchmark(reading.c_str(), measureReading)->Arg(1 << 14)->Arg(1 << 20)->Arg(1 << 26);
}

}  // namespace

#if defined(SWEPT_F64)
void registerSolverKernelsF64() { registerAllSolverKernels(); }
#else
void registerSolverKernelsF32() { registerAllSolverKernels(); }
#endif

}  // namespace swept::bench
