#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "../../broadphase/wide_tree.h"
#include "../../shapes/aabb.h"
#include "../../shapes/dvec2.h"
#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// A sensor and a shape that may pass it within the step.
struct SensorPair {
    std::uint32_t sensor = 0;  ///< slots
    std::uint32_t other = 0;
    auto operator<=>(const SensorPair&) const = default;
};

/// Boxes of the ways of fast shapes through the step, or of where shapes are as it begins.
struct WaysOfShapes {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> shapes;  ///< slots, likewise
};

/// The contact of such a pair.
struct ContactOfSensor {
    SensorPair pair;
    std::uint32_t contact = 0;  ///< index
    auto operator<=>(const ContactOfSensor&) const = default;
};

/// One of the `impactPoses` of a step.
struct ImpactOfBody {
    std::uint32_t body = 0;   ///< slot
    std::uint32_t place = 0;  ///< in that list
    auto operator<=>(const ImpactOfBody&) const = default;
};

/// Where the centre of a body was at a fraction of the step.
struct Waypoint {
    double fraction = 0;
    DVec2 center{};
    double angle = 0;
};

/// Scratch of mode_sensors.cpp, kept for its capacity.
struct SensorSweeps {
    std::vector<SensorPair> pairs;
    std::vector<std::uint32_t> fast;  ///< body slots
    WaysOfShapes few;                 ///< sensors as the step begins, and their ways; only of few
    WaysOfShapes ofSensors;
    WaysOfShapes ofOthers;
    WideTree tree;                          ///< of the latter
    std::vector<ContactOfSensor> contacts;  ///< by pair; of sensors
    std::vector<ImpactOfBody> impacts;      ///< by body, and in the order of the list
    std::vector<Waypoint> ofSensor;
    std::vector<Waypoint> ofOther;
    std::vector<double> fractions;
};

}  // namespace swept::inline SWEPT_PRECISION
