#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include <swept/tools/toi/toi_anatomy.h>
#include <swept/tools/toi/toi_families.h>

namespace swept {
namespace {

TEST(ToiAnatomy, ShowsTheSearchAsItWas) {
    int looks = 0;
    for (const ToiFamily family : {ToiFamily::caWorst, ToiFamily::dip, ToiFamily::generic}) {
        for (std::uint64_t index = 0; index < 20; ++index) {
            const ToiQuery q = makeToiCase(family, 1, index);
            SCOPED_TRACE(::testing::Message() << nameOf(family) << ' ' << index << ' ' << q);
            const ToiAnatomy anatomy = dissectToi(q);
            EXPECT_EQ(anatomy.answer.fraction, timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings).fraction);
            EXPECT_EQ(anatomy.truth.back().fraction, q.settings.tMax);
            for (const ToiAnatomy::Look& look : anatomy.looks) {
                ++looks;
                ASSERT_EQ(look.bound.front().separation, look.step.separation);
                for (const ToiAnatomy::Point& p : look.bound) {
                    const double truth = separationAt(q.a, q.sweepA, q.b, q.sweepB, p.fraction).separation;
                    ASSERT_GE(truth, p.separation - q.settings.tolerance / 4) << "at " << p.fraction;
                }
            }
        }
    }
    EXPECT_GT(looks, 100);
}

TEST(ToiAnatomy, TheScriptHasAGhostForEachLook) {
    const ToiQuery q = makeToiCase(ToiFamily::caWorst, 1, 0);
    const ToiAnatomy anatomy = dissectToi(q);
    const std::string script = anatomyScript(anatomy, "it's here.png");
    EXPECT_NE(script.find("set output 'it''s here.png'"), std::string::npos);
    for (std::size_t i = 0; i <= anatomy.looks.size(); ++i) {
        EXPECT_NE(script.find("$ghost" + std::to_string(i) + " << EOD"), std::string::npos) << i;
    }
    EXPECT_EQ(script.find("nan"), std::string::npos);
}

/// The range of the axis of separations.
std::pair<double, double> rangeIn(const std::string& script) {
    std::size_t at = script.rfind("set yrange [") + 12;
    std::size_t length = 0;
    const double low = std::stod(script.substr(at), &length);
    at += length + 1;
    return {low, std::stod(script.substr(at))};
}

TEST(ToiAnatomy, TheAxisHasRoomForWhatTouchesFromTheStart) {
    for (const ToiFamily family : {ToiFamily::overlap, ToiFamily::touch}) {
        for (std::uint64_t index = 0; index < 20; ++index) {
            const ToiQuery q = makeToiCase(family, 1, index);
            SCOPED_TRACE(::testing::Message() << nameOf(family) << ' ' << index << ' ' << q);
            const ToiAnatomy anatomy = dissectToi(q);
            const auto [low, high] = rangeIn(anatomyScript(anatomy, "x.png"));
            EXPECT_LT(low, std::min(anatomy.answer.separation, 0.0));
            EXPECT_GT(high, anatomy.answer.separation);
            EXPECT_GE(high - low, q.settings.tolerance);
        }
    }
}

}  // namespace
}  // namespace swept
