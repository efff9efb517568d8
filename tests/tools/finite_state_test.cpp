#include <gtest/gtest.h>

#include <array>
#include <limits>

#include <swept/tools/writers/finite_state.h>

namespace swept {
namespace {

TEST(FiniteState, FindsTheFirstBodyWithAnyBadNumber) {
    const std::array<double BodyFrame::*, 2> scalars{&BodyFrame::angle, &BodyFrame::angularVelocity};
    const std::array<DVec2 BodyFrame::*, 2> vectors{&BodyFrame::position, &BodyFrame::velocity};
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
        for (const auto member : scalars) {
            Frame frame;
            frame.bodies.resize(3);
            frame.bodies[1].*member = bad;
            frame.bodies[2].*member = bad;
            EXPECT_EQ(firstNotFinite(frame), 1u);
        }
        for (const auto member : vectors) {
            Frame frame;
            frame.bodies.resize(3);
            (frame.bodies[2].*member).y = bad;
            EXPECT_EQ(firstNotFinite(frame), 2u);
        }
    }
}

TEST(FiniteState, AcceptsAnyFiniteState) {
    Frame frame;
    EXPECT_FALSE(firstNotFinite(frame));
    frame.bodies.resize(1);
    frame.bodies[0].position = {std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()};
    EXPECT_FALSE(firstNotFinite(frame));
}

}  // namespace
}  // namespace swept
