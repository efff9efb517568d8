#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

/// The error convention of the whole library: a call that can refuse its input returns a `Status`, or a `Result` when
/// it also has something to give. Refused input changes nothing. Nothing prints or aborts, and nothing throws, but
/// where the standard library does for want of memory (`std::bad_alloc`; engine/world.h says what holds then).

namespace swept {

enum class StatusCode : std::uint8_t {
    ok,
    notFinite,        ///< a number is NaN or infinite
    negative,         ///< a number that must be at least 0 is below it
    notPositive,      ///< a number that must be above 0 is not
    outOfRange,       ///< a number lies outside the documented range
    staleId,          ///< the id is null, or what it named was destroyed
    degenerate,       ///< the geometry has no extent: all points equal, or on a line where an area is needed
    notConvex,        ///< the vertices are not those of a convex counter-clockwise polygon
    tooFewVertices,   ///< fewer points than the geometry needs
    tooManyVertices,  ///< more than `kMaxPolygonVertices` vertices on the hull
    wrongBodyType,    ///< the call does not fit the body's type (a chain on a dynamic body, a velocity on a static one)
    missingMass,      ///< a dynamic body has no mass
    wrongJointType,   ///< the call does not fit the joint's type (a target for a hinge, a gear of a rod)
    notDistinct,      ///< a joint needs two different bodies, a gear two different joints
    noIdsLeft,        ///< all ids of its kind are in use; want of memory is another matter (`std::bad_alloc`)
    disabled,         ///< the call is for bodies that take part (`World::setEnabled`)
    notNow,           ///< the call has to come at another time (another broadphase before the world has shapes)
    damaged,          ///< bytes of a world are cut off, or not those that were written (`World::load`)
    otherBuild,       ///< they are of another precision, or of a library whose worlds have other members
};
inline constexpr std::size_t kStatusCodeCount = static_cast<std::size_t>(StatusCode::otherBuild) + 1;

/// What went wrong, and with which argument. The name is that of the argument or member, with these exceptions: an id
/// goes by what it names ("body", "shape", "joint"); motors, limits of length and break limits go by what the
/// scene format calls them ("motorSpeed", "maxMotorTorque", "maxMotorForce", "minLength", "maxLength", "breakForce",
/// "breakTorque"); the two end points of a segment are "points".
struct [[nodiscard]] Status {
    StatusCode code = StatusCode::ok;
    const char* field = "";  ///< a string literal, never null

    constexpr bool ok() const { return code == StatusCode::ok; }
    constexpr explicit operator bool() const { return ok(); }
    static constexpr Status success() { return {}; }
};

/// One phrase in lower case without a full stop, to be printed behind the field's name.
constexpr const char* describe(StatusCode code) {
    switch (code) {
        case StatusCode::ok:
            return "ok";
        case StatusCode::notFinite:
            return "must be finite";
        case StatusCode::negative:
            return "must not be negative";
        case StatusCode::notPositive:
            return "must be greater than 0";
        case StatusCode::outOfRange:
            return "is out of range";
        case StatusCode::staleId:
            return "names nothing that exists";
        case StatusCode::degenerate:
            return "is degenerate (no extent)";
        case StatusCode::notConvex:
            return "is not a convex counter-clockwise polygon";
        case StatusCode::tooFewVertices:
            return "has too few points";
        case StatusCode::tooManyVertices:
            return "has more than 8 hull vertices";
        case StatusCode::wrongBodyType:
            return "does not fit the body type";
        case StatusCode::missingMass:
            return "leaves a dynamic body without mass";
        case StatusCode::wrongJointType:
            return "does not fit the joint type";
        case StatusCode::notDistinct:
            return "must differ from the first one";
        case StatusCode::noIdsLeft:
            return "has no ids left";
        case StatusCode::disabled:
            return "is disabled";
        case StatusCode::notNow:
            return "cannot be changed now";
        case StatusCode::damaged:
            return "are damaged or cut off";
        case StatusCode::otherBuild:
            return "is that of another build";
    }
    return "";  // unreachable, but GCC cannot know
}

/// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
public:
    constexpr Result(T value) : value_(std::move(value)) {}
    constexpr Result(Status status) : status_(status) { assert(!status.ok() && "a success carries a value"); }

    constexpr bool ok() const { return status_.ok(); }
    constexpr explicit operator bool() const { return ok(); }
    constexpr Status status() const { return status_; }

    /// The value; on failure a default-constructed one (a null id is refused by every call that takes an id).
    constexpr const T& value() const& { return value_; }
    /// Of a result that nobody keeps: the value itself, so that `const T& value = call().value()` is no dangling
    /// reference.
    constexpr T value() && { return std::move(value_); }

private:
    T value_{};
    Status status_{};
};

}  // namespace swept
