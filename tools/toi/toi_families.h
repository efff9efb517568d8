#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "toi_query.h"

namespace swept {

/// Kinds of queries that are hard for one method or another. Lengths are of order one unless the comment says
/// otherwise.
enum class ToiFamily : std::uint8_t {
    generic,  ///< up to π/4 and a few sizes per step
    graze,  ///< smallest separation 10⁻³ … 10⁻⁶ of the size above or below contact, target, target − tolerance
    spin,       ///< bars that turn up to 20 times
    caWorst,    ///< a triangle turns about its vertex just above a plane, another vertex hits
    sliver,     ///< aspect ratios down to 10⁻⁶
    tinyHuge,   ///< 10⁻⁴ … 10⁻¹ against 10 … 10⁴
    shortEdge,  ///< corners cut by edges of 10⁻⁶ … 10⁻² of the side
    far,        ///< 10³ … 10⁶ from the origin, moving along together
    overlap,    ///< the polygons intersect at the start
    touch,  ///< starts within 10⁻¹² … 10⁻⁶ of contact; for half of them the target lies below, as in the engine
    atTarget,         ///< starts at the target, exactly or up to three tolerances aside
    faceFace,         ///< parallel faces, with little or no rotation
    fast,             ///< 10² … 10⁵ sizes per step
    dip,              ///< a vertex, or the whole body, comes near and is gone again within the step
    bothTurning,      ///< both up to a turn
    circlesCapsules,  ///< one and two vertices, with radius
    parabola,         ///< accelerated, thrown up and falling back
    offCenter,        ///< centres of mass outside of the shapes
    small,            ///< as generic, of size 10⁻⁹
    large,            ///< as generic, of size 10⁹
};

inline constexpr std::array kToiFamilies = {
    ToiFamily::generic,         ToiFamily::graze,     ToiFamily::spin,      ToiFamily::caWorst, ToiFamily::sliver,
    ToiFamily::tinyHuge,        ToiFamily::shortEdge, ToiFamily::far,       ToiFamily::overlap, ToiFamily::touch,
    ToiFamily::atTarget,        ToiFamily::faceFace,  ToiFamily::fast,      ToiFamily::dip,     ToiFamily::bothTurning,
    ToiFamily::circlesCapsules, ToiFamily::parabola,  ToiFamily::offCenter, ToiFamily::small,   ToiFamily::large};

/// "generic", "ca_worst" …, as on the command line.
std::string_view nameOf(ToiFamily family);
std::optional<ToiFamily> toiFamilyFrom(std::string_view name);

/// A query of the family, accepted by `validateToi`; the same one for the same arguments.
ToiQuery makeToiCase(ToiFamily family, std::uint64_t seed, std::uint64_t index);

}  // namespace swept
