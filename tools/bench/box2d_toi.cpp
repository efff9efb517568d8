#include "box2d_toi.h"

#include <box2d/b2_time_of_impact.h>

#include <array>

#include "engine_query.h"

// Counters of the engine that its headers do not declare.
extern B2_API int32 b2_toiIters;
extern B2_API int32 b2_toiRootIters;

namespace swept::bench {
namespace {

b2Vec2 toBox2d(DVec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

b2Sweep toBox2d(const Sweep& sweep) {
    b2Sweep result{};
    result.localCenter = toBox2d(sweep.localCenter);
    result.c0 = toBox2d(sweep.c0);
    result.c = toBox2d(sweep.c1);
    result.a0 = static_cast<float>(sweep.a0);
    result.a = static_cast<float>(sweep.a1);
    return result;
}

/// An input with the vertices it points to.
struct Question {
    std::array<b2Vec2, 8> a;
    std::array<b2Vec2, 8> b;
    b2TOIInput input;
};

void setProxy(b2DistanceProxy& proxy, std::array<b2Vec2, 8>& vertices, const ToiPolygon& polygon) {
    for (std::size_t i = 0; i < vertices.size(); ++i) { vertices[i] = toBox2d(polygon.vertices[i]); }
    proxy.Set(vertices.data(), polygon.count, static_cast<float>(polygon.radius));
}

/// What its world would make of the answer: the world looks at nothing but "touching", we name them all.
ToiState stateFrom(b2TOIOutput::State state) {
    switch (state) {
        case b2TOIOutput::e_touching:
            return ToiState::hit;
        case b2TOIOutput::e_separated:
            return ToiState::separated;
        case b2TOIOutput::e_overlapped:
            return ToiState::overlapped;
        case b2TOIOutput::e_failed:
        case b2TOIOutput::e_unknown:
            return ToiState::failed;
    }
    return ToiState::failed;  // unreachable, but GCC cannot know
}

class Box2dToi final : public ToiContestant {
public:
    std::string name() const override { return "Box2D 2.4.1"; }

    std::optional<ToiQuery> understood(const ToiQuery& query) const override { return engineQuery(query, {}); }

    void load(std::span<const ToiQuery> queries) override {
        questions_ = std::vector<Question>(queries.size());  // stays where it is: inputs point into it
        for (std::size_t i = 0; i < queries.size(); ++i) {
            Question& question = questions_[i];
            setProxy(question.input.proxyA, question.a, queries[i].a);
            setProxy(question.input.proxyB, question.b, queries[i].b);
            question.input.sweepA = toBox2d(queries[i].sweepA);
            question.input.sweepB = toBox2d(queries[i].sweepB);
            question.input.tMax = static_cast<float>(queries[i].settings.tMax);
        }
    }

    void answerAll(std::span<Toi> answers) override {
        for (std::size_t i = 0; i < questions_.size(); ++i) {
            const int before = b2_toiIters + b2_toiRootIters;
            b2TOIOutput output;
            b2TimeOfImpact(&output, &questions_[i].input);
            answers[i].state = stateFrom(output.state);
            answers[i].fraction = static_cast<double>(output.t);
            answers[i].iterations = b2_toiIters + b2_toiRootIters - before;
        }
    }

private:
    std::vector<Question> questions_;
};

}  // namespace

std::unique_ptr<ToiContestant> makeBox2dToi() { return std::make_unique<Box2dToi>(); }

}  // namespace swept::bench
