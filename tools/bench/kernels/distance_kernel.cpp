#include <vector>

#include <swept/shapes/distance.h>

#include "distance_contestant.h"
#include "shapes_of_case.h"

/// Compiled once per precision.

namespace swept::bench {
namespace {

class SweptDistance final : public DistanceContestant {
public:
    std::string name() const override { return sizeof(Real) == sizeof(float) ? "f32" : "f64"; }

    void load(std::span<const PairCase> pairs) override {
        queries_.clear();
        for (const PairCase& pair : pairs) {
            queries_.push_back(
                {polygonOf(pair.a), polygonOf(pair.b), {transformOf(pair.poses[0]), transformOf(pair.poses[1])}, {}});
        }
    }

    double coldPass() override {
        double sum = 0;
        for (const Query& q : queries_) { sum += static_cast<double>(distance(q.a, q.b, q.poses[0]).distance); }
        return sum;
    }

    double warmPass() override {
        pose_ = 1 - pose_;
        double sum = 0;
        for (Query& q : queries_) { sum += static_cast<double>(distance(q.a, q.b, q.poses[pose_], &q.cache).distance); }
        return sum;
    }

private:
    struct Query {
        Polygon a;
        Polygon b;
        std::array<Transform, 2> poses;
        SimplexCache cache;
    };

    std::vector<Query> queries_;
    std::size_t pose_ = 0;
};

}  // namespace

#if defined(SWEPT_F64)
std::unique_ptr<DistanceContestant> makeDistanceF64() { return std::make_unique<SweptDistance>(); }
#else
std::unique_ptr<DistanceContestant> makeDistanceF32() { return std::make_unique<SweptDistance>(); }
#endif

}  // namespace swept::bench
