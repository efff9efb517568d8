#include <benchmark/benchmark.h>

#include <string>

#include <swept/engine/world.h>

#include "kernel_precision.h"
#include "kernels.h"

/// What a step costs bodies that nothing holds. Compiled once per precision; flight_chipmunk.cpp is the same there.

namespace swept::bench {
namespace {

void fly(benchmark::State& state) {
    World world;
    WorldSettings settings;
    settings.gravity = {0, 0};
    settings.sleep = false;
    (void)world.configure(settings);
    for (int i = 0; i < state.range(0); ++i) {
        BodyDef body{.type = BodyType::dynamic,
                     .position = {kFlightGap * (i % kFlightWide), kFlightGap * (i / kFlightWide)},
                     .velocity = {1, 0}};
        const BodyId id = world.createBody(body).value();
        (void)world.addShape(id, makeCircle({}, Real(0.5)).value(), {});
    }
    for ([[maybe_unused]] auto _ : state) { (void)world.step(kFlightStep); }
}

void registerAllFlightKernels() {
    const std::string name = std::string("flight/") + kPrecision;
    benchmark::RegisterBenchmark(name.c_str(), fly)->Arg(1)->Arg(10000);
}

}  // namespace

#if defined(SWEPT_F64)
void registerFlightKernelsF64() { registerAllFlightKernels(); }
#else
void registerFlightKernelsF32() { registerAllFlightKernels(); }
#endif

}  // namespace swept::bench
