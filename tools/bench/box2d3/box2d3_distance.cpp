#include <box2d/collision.h>
#include <box2d/math_functions.h>

#include <algorithm>
#include <vector>

#include "../kernels/distance_contestant.h"
#include "box2d3_vector.h"

namespace swept::bench {
namespace {

b2Transform toBox2d(const CorePose& pose) {
    return {vectorOf(pose.translation), {static_cast<float>(pose.c), static_cast<float>(pose.s)}};
}

b2ShapeProxy toBox2d(const CoreShape& shape) {
    b2Vec2 points[8];
    std::transform(shape.vertices.begin(), shape.vertices.end(), points, [](DVec2 v) { return vectorOf(v); });
    return b2MakeProxy(points, shape.count, static_cast<float>(shape.radius));
}

/// The pose of B in the frame of A, which releases name and place differently.
template <typename Input>
void setPose(Input& input, const b2Transform& pose) {
    if constexpr (requires { input.transformB; }) {
        input.transformA = b2Transform_identity;
        input.transformB = pose;
    } else {
        input.transform = pose;
    }
}

struct Query {
    b2DistanceInput input;
    std::array<b2Transform, 2> poses;
    b2SimplexCache cache;
};

class Box2d3Distance final : public DistanceContestant {
public:
    std::string name() const override { return "box2d_3"; }

    void load(std::span<const PairCase> pairs) override {
        queries_.clear();
        for (const PairCase& pair : pairs) {
            Query q{};
            q.input.proxyA = toBox2d(pair.a);
            q.input.proxyB = toBox2d(pair.b);
            q.input.useRadii = true;
            q.poses = {toBox2d(pair.poses[0]), toBox2d(pair.poses[1])};
            setPose(q.input, q.poses[0]);
            queries_.push_back(q);
        }
    }

    double coldPass() override {
        double sum = 0;
        for (const Query& q : queries_) {
            b2SimplexCache cache = b2_emptySimplexCache;
            sum += static_cast<double>(b2ShapeDistance(&q.input, &cache, nullptr, 0).distance);
        }
        return sum;
    }

    double warmPass() override {
        pose_ = 1 - pose_;
        double sum = 0;
        for (Query& q : queries_) {
            setPose(q.input, q.poses[pose_]);
            sum += static_cast<double>(b2ShapeDistance(&q.input, &q.cache, nullptr, 0).distance);
        }
        return sum;
    }

private:
    std::vector<Query> queries_;
    std::size_t pose_ = 0;
};

}  // namespace

std::unique_ptr<DistanceContestant> makeDistanceBox2d3() { return std::make_unique<Box2d3Distance>(); }

}  // namespace swept::bench
