#include <box2d/b2_distance.h>

#include <algorithm>
#include <vector>

#include "distance_contestant.h"

namespace swept::bench {
namespace {

b2Vec2 toBox2d(DVec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

b2Transform toBox2d(const CorePose& pose) {
    b2Transform result;
    result.p = toBox2d(pose.translation);
    result.q.c = static_cast<float>(pose.c);
    result.q.s = static_cast<float>(pose.s);
    return result;
}

/// An input with the vertices it points to.
struct Query {
    std::array<b2Vec2, 8> a;
    std::array<b2Vec2, 8> b;
    b2DistanceInput input;
    std::array<b2Transform, 2> poses;
    b2SimplexCache cache;
};

void setProxy(b2DistanceProxy& proxy, std::array<b2Vec2, 8>& vertices, const CoreShape& shape) {
    std::transform(shape.vertices.begin(), shape.vertices.end(), vertices.begin(), [](DVec2 v) { return toBox2d(v); });
    proxy.Set(vertices.data(), shape.count, static_cast<float>(shape.radius));
}

class Box2dDistance final : public DistanceContestant {
public:
    std::string name() const override { return "box2d_2.4.1"; }

    void load(std::span<const PairCase> pairs) override {
        queries_.resize(pairs.size());
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            Query& q = queries_[i];
            setProxy(q.input.proxyA, q.a, pairs[i].a);
            setProxy(q.input.proxyB, q.b, pairs[i].b);
            q.input.transformA.SetIdentity();
            q.poses = {toBox2d(pairs[i].poses[0]), toBox2d(pairs[i].poses[1])};
            q.input.transformB = q.poses[0];
            q.input.useRadii = true;
            q.cache.count = 0;
        }
    }

    double coldPass() override {
        double sum = 0;
        for (const Query& q : queries_) {
            b2SimplexCache cache;
            cache.count = 0;
            b2DistanceOutput output;
            b2Distance(&output, &cache, &q.input);
            sum += static_cast<double>(output.distance);
        }
        return sum;
    }

    double warmPass() override {
        pose_ = 1 - pose_;
        double sum = 0;
        for (Query& q : queries_) {
            q.input.transformB = q.poses[pose_];
            b2DistanceOutput output;
            b2Distance(&output, &q.cache, &q.input);
            sum += static_cast<double>(output.distance);
        }
        return sum;
    }

private:
    std::vector<Query> queries_;
    std::size_t pose_ = 0;
};

}  // namespace

std::unique_ptr<DistanceContestant> makeDistanceBox2d() { return std::make_unique<Box2dDistance>(); }

}  // namespace swept::bench
