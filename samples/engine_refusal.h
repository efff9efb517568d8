#pragma once

#include <string>
#include <string_view>

#include "../engine/state/number_range.h"
#include "scene_fields.h"
#include "scene_names.h"

/// What the engine does not take of a scene, told in the words of the scene.

namespace swept::inline SWEPT_PRECISION {

/// Whether `Object` has a member of that key.
template <Described Object>
bool hasKey(std::string_view key) {
    bool found = false;
    forEachField<Object>([&](const auto& field) { found = found || key == field.key; });
    return found;
}

inline bool hasKey(const JointDescription& joint, std::string_view key) {
    return hasKey<JointDescription>(key) ||
           std::visit([key]<class Members>(const Members&) { return hasKey<Members>(key); }, joint.joint);
}

/// "/bodies/1/angle: is out of range: …". The engine calls most of its arguments as the scene does; what it calls
/// otherwise follows the pointer of the object.
inline std::string refusalText(const std::string& object, bool isMember, Status status) {
    std::string text =
        object + (isMember ? "/" : ": ") + status.field + (isMember ? ": " : " ") + describe(status.code);
    // All other ranges were looked at when the scene was read.
    if (status.code == StatusCode::outOfRange) {
        text += std::string(": ") + (sizeof(Real) == sizeof(float) ? "f32" : "f64") + " takes numbers up to " +
                shortestNumber(kLargestNumber) + " here";
    }
    return text;
}

/// What to add to the refusal of a shape's points, which were not refused in double; empty for what else is wrong.
inline std::string whatRoundingDid(const Status& status) {
    const bool isFlattened = status.code == StatusCode::degenerate || status.code == StatusCode::notConvex ||
                             status.code == StatusCode::tooFewVertices;
    if (!isFlattened || sizeof(Real) != sizeof(float)) { return ""; }
    return ": f32 cannot tell its points apart so far from the body's origin; --precision f64 can, or put the origin "
           "nearer";
}

}  // namespace swept::inline SWEPT_PRECISION
