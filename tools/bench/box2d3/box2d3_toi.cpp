#include "box2d3_toi.h"

#include <box2d/collision.h>
#include <box2d/math_functions.h>

#include <algorithm>
#include <cmath>

#include "../engine_query.h"
#include "box2d3_vector.h"

namespace swept::bench {
namespace {

constexpr double kMostTurn = 3.14;  // half a turn has no shorter way round

b2Rot rotationOf(double angle) { return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}; }

b2Sweep toBox2d(const Sweep& sweep) {
    return {vectorOf(sweep.localCenter), vectorOf(sweep.c0), vectorOf(sweep.c1), rotationOf(sweep.a0),
            rotationOf(sweep.a1)};
}

b2ShapeProxy toBox2d(const ToiPolygon& polygon) {
    b2Vec2 points[8];
    std::transform(polygon.vertices.begin(), polygon.vertices.end(), points, [](DVec2 v) { return vectorOf(v); });
    return b2MakeProxy(points, polygon.count, static_cast<float>(polygon.radius));
}

DVec2 fromBox2d(b2Rot rotation) { return {static_cast<double>(rotation.c), static_cast<double>(rotation.s)}; }

ToiState stateFrom(b2TOIState state) {
    switch (state) {
        case b2_toiStateHit:
            return ToiState::hit;
        case b2_toiStateSeparated:
            return ToiState::separated;
        case b2_toiStateOverlapped:
            return ToiState::overlapped;
        case b2_toiStateFailed:
        case b2_toiStateUnknown:
            return ToiState::failed;
    }
    return ToiState::failed;  // unreachable, but GCC cannot know
}

/// Built by GCC 12 for AVX2, `b2TimeOfImpact` returns without `vzeroupper`. Whoever comes next, in code for SSE, waits
/// for upper halves that nobody needs: on an AMD EPYC half as long again.
void clearUpperHalves() {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx")) { asm volatile("vzeroupper"); }
#endif
}

class Box2d3Toi final : public ToiContestant {
public:
    std::string name() const override { return "Box2D 3"; }
    bool tellsIterations() const override { return false; }

    std::optional<ToiQuery> understood(const ToiQuery& query) const override {
        const auto turns = [](const Sweep& sweep) { return std::fabs(sweep.a1 - sweep.a0); };
        if (turns(query.sweepA) > kMostTurn || turns(query.sweepB) > kMostTurn) { return std::nullopt; }
        ToiQuery centered = query;
        for (Sweep* const sweep : {&centered.sweepA, &centered.sweepB}) {
            sweep->c0 = sweep->c0 - query.sweepB.c0;
            sweep->c1 = sweep->c1 - query.sweepB.c0;
        }
        return engineQuery(centered, {.slop = 0.005, .slopsInside = 1});
    }

    std::optional<MixedTurns> turnsOf(const ToiQuery& query) const override {
        const b2Sweep a = toBox2d(query.sweepA);
        const b2Sweep b = toBox2d(query.sweepB);
        return MixedTurns{fromBox2d(a.q1), fromBox2d(a.q2), fromBox2d(b.q1), fromBox2d(b.q2)};
    }

    void load(std::span<const ToiQuery> queries) override {
        inputs_.clear();
        for (const ToiQuery& q : queries) {
            inputs_.push_back({toBox2d(q.a), toBox2d(q.b), toBox2d(q.sweepA), toBox2d(q.sweepB),
                               static_cast<float>(q.settings.tMax)});
        }
    }

    void answerAll(std::span<Toi> answers) override {
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            const b2TOIOutput output = b2TimeOfImpact(&inputs_[i]);
            answers[i].state = stateFrom(output.state);
            answers[i].fraction = static_cast<double>(output.fraction);
        }
        clearUpperHalves();
    }

private:
    std::vector<b2TOIInput> inputs_;
};

}  // namespace

std::unique_ptr<ToiContestant> makeBox2d3Toi() { return std::make_unique<Box2d3Toi>(); }

}  // namespace swept::bench
