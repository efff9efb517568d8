#include <benchmark/benchmark.h>
#include <chipmunk/chipmunk.h>

#include <vector>

#include "kernels.h"

namespace swept::bench {
namespace {

/// A space and what is in it, freed in the order that Chipmunk asks for.
class Space {
public:
    Space() : space_(cpSpaceNew()) {}
    Space(const Space&) = delete;
    Space& operator=(const Space&) = delete;
    ~Space() {
        cpSpaceEachShape(
            space_, [](cpShape* shape, void* list) { static_cast<Shapes*>(list)->push_back(shape); }, &shapes_);
        cpSpaceEachBody(
            space_, [](cpBody* body, void* list) { static_cast<Bodies*>(list)->push_back(body); }, &bodies_);
        for (cpShape* shape : shapes_) {
            cpSpaceRemoveShape(space_, shape);
            cpShapeFree(shape);
        }
        for (cpBody* body : bodies_) {
            cpSpaceRemoveBody(space_, body);
            cpBodyFree(body);
        }
        cpSpaceFree(space_);
    }

    void addDisk(double x, double y) {
        constexpr double kRadius = 0.5;
        cpBody* body = cpSpaceAddBody(space_, cpBodyNew(1, cpMomentForCircle(1, 0, kRadius, cpvzero)));
        cpBodySetPosition(body, cpv(x, y));
        cpBodySetVelocity(body, cpv(1, 0));
        cpSpaceAddShape(space_, cpCircleShapeNew(body, kRadius, cpvzero));
    }
    void step(double dt) { cpSpaceStep(space_, dt); }

private:
    using Shapes = std::vector<cpShape*>;
    using Bodies = std::vector<cpBody*>;
    cpSpace* space_;
    Shapes shapes_;
    Bodies bodies_;
};

void fly(benchmark::State& state) {
    Space space;
    for (int i = 0; i < state.range(0); ++i) {
        space.addDisk(kFlightGap * static_cast<double>(i % kFlightWide),
                      kFlightGap * static_cast<double>(i / kFlightWide));
    }
    for ([[maybe_unused]] auto _ : state) { space.step(kFlightStep); }
}

}  // namespace

void registerFlightChipmunk() { benchmark::RegisterBenchmark("flight/Chipmunk", fly)->Arg(1)->Arg(10000); }

}  // namespace swept::bench
