#pragma once

#include <algorithm>
#include <cstddef>
#include <variant>
#include <vector>

#include "../engine/mixing_rule.h"
#include "scene_description.h"

/// What shapes are to what touches them, segment by segment where a chain has it so.

namespace swept {

/// A surface with all of its members, called as those of a shape.
struct FullSurface {
    double friction = 0;
    double restitution = 0;
    double rollingResistance = 0;
    double surfaceSpeed = 0;
    MixingRule frictionMixing = MixingRule::usual;
    MixingRule restitutionMixing = MixingRule::usual;

    bool operator==(const FullSurface&) const = default;
};

/// Those of the segments of a chain; none of other shapes, and of chains that are alike all along.
inline const std::vector<SurfaceDescription>* ownSurfaces(const ShapeDescription& shape) {
    const auto* const chain = std::get_if<ChainGeometry>(&shape.geometry);
    return chain != nullptr && !chain->surfaces.empty() ? &chain->surfaces : nullptr;
}
inline std::vector<SurfaceDescription>* ownSurfaces(ShapeDescription& shape) {
    auto* const chain = std::get_if<ChainGeometry>(&shape.geometry);
    return chain != nullptr && !chain->surfaces.empty() ? &chain->surfaces : nullptr;
}

/// Of a segment: what its surface leaves out is as of the shape. @param segment  of a chain, else 0
inline FullSurface surfaceAt(const ShapeDescription& shape, std::size_t segment) {
    static const SurfaceDescription kAsOfShape{};
    const std::vector<SurfaceDescription>* const own = ownSurfaces(shape);
    const SurfaceDescription& given = own != nullptr ? own->at(segment) : kAsOfShape;
    return {.friction = given.friction.value_or(shape.friction),
            .restitution = given.restitution.value_or(shape.restitution),
            .rollingResistance = given.rollingResistance.value_or(shape.rollingResistance),
            .surfaceSpeed = given.surfaceSpeed.value_or(shape.surfaceSpeed),
            .frictionMixing = given.frictionMixing.value_or(shape.frictionMixing),
            .restitutionMixing = given.restitutionMixing.value_or(shape.restitutionMixing)};
}

/// One, or one for each segment of a chain where they differ.
inline std::vector<FullSurface> surfacesOf(const ShapeDescription& shape) {
    const std::vector<SurfaceDescription>* const own = ownSurfaces(shape);
    std::vector<FullSurface> surfaces;
    for (std::size_t i = 0; i < (own != nullptr ? own->size() : 1); ++i) { surfaces.push_back(surfaceAt(shape, i)); }
    return surfaces;
}

/// Whether a shape, or a segment of it, has such a surface.
template <class Condition>
bool anySurface(const ShapeDescription& shape, const Condition& holds) {
    const std::vector<FullSurface> surfaces = surfacesOf(shape);
    return std::any_of(surfaces.begin(), surfaces.end(), holds);
}

/// Whether friction or restitution is mixed in another way than the usual one.
inline bool hasMixingRule(const FullSurface& surface) {
    return surface.frictionMixing != MixingRule::usual || surface.restitutionMixing != MixingRule::usual;
}
inline bool hasMixingRule(const ShapeDescription& shape) {
    return anySurface(shape, [](const FullSurface& surface) { return hasMixingRule(surface); });
}
inline bool isBelt(const FullSurface& surface) { return surface.surfaceSpeed != 0; }
inline bool bounces(const FullSurface& surface) { return surface.restitution > 0; }
inline bool rubs(const FullSurface& surface) { return surface.friction > 0; }
inline bool resistsRolling(const FullSurface& surface) { return surface.rollingResistance > 0; }

}  // namespace swept
