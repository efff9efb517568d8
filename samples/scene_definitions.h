#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "../engine/world.h"
#include "scene_description.h"

/// What the numbers and words of a scene are called by the engine.

namespace swept::inline SWEPT_PRECISION {

inline Real realOf(double x) { return static_cast<Real>(x); }
inline std::optional<Real> realOf(const std::optional<double>& x) {
    return x ? std::optional<Real>(realOf(*x)) : std::nullopt;
}

WorldSettings worldSettingsOf(const SceneDescription& scene);

/// User data of a body is its index; of a shape its body's index (upper half) and its own (lower half); of a joint its
/// index.
struct ShapeOrigin {
    int body = 0;
    int shape = 0;
};
ShapeOrigin shapeOrigin(std::uint64_t userData);

BodyDef bodyDefOf(const BodyDescription& given, std::size_t index);

ShapeDef shapeDefOf(const ShapeDescription& given, std::size_t body, std::size_t shape);

/// One for each segment of a chain; none where all are as its shape.
std::vector<Surface> surfacesOfSegments(const ShapeDescription& given);

}  // namespace swept::inline SWEPT_PRECISION
