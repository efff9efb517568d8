#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <swept/shapes/dvec2.h>

/// The pairs on which distance functions are timed. All numbers are floats, so that every engine is asked the same.

namespace swept::bench {

struct CoreShape {
    std::array<DVec2, 8> vertices{};
    int count = 0;
    double radius = 0;
};

struct CorePose {
    DVec2 translation;
    double c = 1;
    double s = 0;
};

/// Two shapes, and B in the frame of A at two moments: about a hundredth of its size and of a radian apart, as after a
/// step. They are apart by at least a hundredth of a metre at both.
struct PairCase {
    CoreShape a;
    CoreShape b;
    std::array<CorePose, 2> poses;
};

enum class PairKind { mixed, circles, boxes, capsulePolygon, octagons };

inline constexpr std::array kPairKinds = {PairKind::mixed, PairKind::circles, PairKind::boxes, PairKind::capsulePolygon,
                                          PairKind::octagons};

std::string_view nameOf(PairKind kind);

/// Shapes of 0.2 to 2 m, centred within a tenth of it; distances from a hundredth to about twice the size. Of `mixed`
/// pairs each shape is a circle, a capsule, a box or a polygon of 3 to 8 vertices, equally often. The same list for the
/// same arguments.
std::vector<PairCase> makePairs(PairKind kind, int count);

}  // namespace swept::bench
