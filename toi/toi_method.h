#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "time_of_impact.h"

namespace swept {

/// Every way of finding a time of impact in our sources, beside our own. Each has a header that says where it comes
/// from, what it costs and where it fails.
enum class ToiMethod : std::uint8_t {
    discrete,                 ///< discrete.h
    rayCast,                  ///< ray_cast_toi.h
    shapeCast,                ///< time_of_impact.h
    conservativeAdvancement,  ///< conservative_advancement.h
    bruteForce,               ///< brute_force.h
    separatingAxisRoot,       ///< separating_axis_root.h
    speculative,              ///< speculative.h
    certified,                ///< time_of_impact.h; the default of the engine
};

struct ToiMethodInfo {
    ToiMethod method;
    std::string_view name;         ///< as in the enumeration, and on the command line
    std::string_view description;  ///< one line
};

/// In the order of the enumeration.
inline constexpr std::array<ToiMethodInfo, 8> kToiMethods{{
    {ToiMethod::discrete, "discrete", "overlap at the end of the sweep only; tunnels"},
    {ToiMethod::rayCast, "rayCast", "rays from the middles of both shapes; misses wide shapes, ignores rotation"},
    {ToiMethod::shapeCast, "shapeCast", "whole shapes along the translation; exact without rotation, ignores it"},
    {ToiMethod::conservativeAdvancement, "conservativeAdvancement",
     "distance over greatest speed, repeated; certified, slow where bodies turn"},
    {ToiMethod::bruteForce, "bruteForce", "all pairs of features, all roots; exact, slow"},
    {ToiMethod::separatingAxisRoot, "separatingAxisRoot",
     "roots along one axis after another; fast, misses what dips in and out"},
    {ToiMethod::speculative, "speculative", "approach-speed constraint at the start; stops at ghosts, misses turning"},
    {ToiMethod::certified, "certified", "third-order advancement; proves its answer"},
}};

std::string_view nameOf(ToiMethod method);
std::string_view describe(ToiMethod method);
std::optional<ToiMethod> toiMethodFrom(std::string_view name);

/// One signature for all methods. The state, the fraction and what is certain about them are the method's (see its
/// header); separation, normal and witness points are those of the whole motion at the reported fraction, except for
/// `shapeCast`, which reports the pose of its own motion, without rotation. The target is that of the settings. A
/// bracket (`fractionLower`, `separationLower`) is given by `certified`, `shapeCast`, `conservativeAdvancement`,
/// `bruteForce` and `separatingAxisRoot`, where it certifies nothing; of the others its other end is `fraction`.
/// Features are named by `certified`, `shapeCast` and `discrete`.
/// @pre as for `timeOfImpact`.
Toi timeOfImpactBy(ToiMethod method, const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                   const ToiSettings& settings);

}  // namespace swept
