#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include <swept/tools/bench/run_time.h>
#include <swept/tools/bench/stopwatch.h>

namespace swept::bench {
namespace {

/// Each step takes so long.
class SlowRunner final : public Runner {
public:
    explicit SlowRunner(double seconds) : seconds_(seconds) {}
    bool step() override {
        const Stopwatch watch;
        while (watch.seconds() < seconds_) {}
        return true;
    }
    void read(Frame&, bool) const override {}
    const std::vector<SceneEvent>& events() const override { return events_; }
    RunReport report() const override { return {}; }
    std::vector<std::string> approximations() const override { return {}; }

private:
    double seconds_;
    std::vector<SceneEvent> events_;
};

TEST(RunTime, IsThatOfTheFastestOfThreeRuns) {
    const std::vector<double> seconds{0.02, 0.001, 0.01};
    std::size_t made = 0;
    const double fastest = fastestRun([&] { return std::make_unique<SlowRunner>(seconds[made++]); }, 4);
    EXPECT_EQ(made, 3U);
    EXPECT_GE(fastest, 4 * 0.001);
    EXPECT_LT(fastest, 4 * 0.01);
    EXPECT_EQ(fastestRun([] { return std::unique_ptr<Runner>(); }, 4), 0) << "a scene that is refused";
}

}  // namespace
}  // namespace swept::bench
