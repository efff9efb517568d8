#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include <swept/shapes/hull.h>
#include <swept/shapes/manifold.h>
#include <swept/shapes/penetration.h>
#include <swept/shapes/ray_cast.h>

#include "kernel_precision.h"
#include "kernels.h"
#include "shapes_of_case.h"

/// Compiled once per precision.

namespace swept::bench {
namespace {

constexpr int kPairs = 1000;

struct Query {
    Polygon a;
    Polygon b;
    Transform bInA;
    Real margin = 0;
};

std::vector<Query> queriesOf(PairKind kind) {
    std::vector<Query> queries;
    for (const PairCase& pair : makePairs(kind, kPairs)) {
        queries.push_back({polygonOf(pair.a), polygonOf(pair.b), transformOf(pair.poses[0]), 0});
    }
    return queries;
}

/// The same shapes pushed together until the cores overlap by a tenth of the distance of their origins.
std::vector<Query> overlapping(std::vector<Query> queries) {
    for (Query& q : queries) {
        const Penetration apart = penetration(q.a, q.b, q.bInA);
        const Real depth = length(q.bInA.translation) / 10;
        q.bInA.translation -= (apart.separation + depth) * apart.normal;
    }
    return queries;
}

/// `answer` of every query, a query being one item.
template <typename Queries, typename Answer>
void registerKernel(const std::string& name, Queries queries, Answer answer) {
    const auto shared = std::make_shared<const Queries>(std::move(queries));
    benchmark::RegisterBenchmark((name + '/' + kPrecision).c_str(), [shared, answer](benchmark::State& state) {
        for ([[maybe_unused]] auto _ : state) {
            for (const auto& query : *shared) { benchmark::DoNotOptimize(answer(query)); }
        }
        state.counters["per_query"] =
            benchmark::Counter(static_cast<double>(shared->size()),
                               benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    });
}

void registerShapeKernels() {
    const auto depth = [](const Query& q) { return penetration(q.a, q.b, q.bInA); };
    const auto manifold = [](const Query& q) { return collide(q.a, q.b, q.bInA, q.margin); };
    const auto ray = [](const Query& q) { return rayCast(q.a, q.bInA.translation, 2 * -q.bInA.translation, 1); };
    const auto hull = [](const Query& q) { return convexHull(q.a.points()); };
    for (const PairKind kind : {PairKind::mixed, PairKind::boxes, PairKind::octagons}) {
        const std::string name(nameOf(kind));
        std::vector<Query> near = queriesOf(kind);
        for (Query& q : near) { q.margin = length(q.bInA.translation); }
        registerKernel("penetration/" + name, queriesOf(kind), depth);
        registerKernel("collide/overlapping/" + name, overlapping(queriesOf(kind)), manifold);
        registerKernel("collide/within_margin/" + name, near, manifold);
        registerKernel("ray_cast/" + name, queriesOf(kind), ray);
    }
    registerKernel("hull/8gon", queriesOf(PairKind::octagons), hull);
}

}  // namespace

#if defined(SWEPT_F64)
void registerShapeKernelsF64() { registerShapeKernels(); }
#else
void registerShapeKernelsF32() { registerShapeKernels(); }
#endif

}  // namespace swept::bench
