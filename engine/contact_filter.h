#pragma once

#include <cstdint>

#include "ids.h"

namespace swept {

/// What a contact filter is told of a shape, and of its body.
struct FilteredShape {
    ShapeId shape{};  ///< of a chain the one id of all its segments
    BodyId body{};
    std::uint64_t userData = 0;  ///< of the shape
    std::uint64_t bodyUserData = 0;
};

/// Decides which shapes may touch, where categories, masks and groups do not suffice: a game implements it and gives it
/// to a world (`World::setContactFilter`). What it forbids passes through each other in every mode, and is told by no
/// event and no sensor.
///
/// It is asked where `Filter` and joints allow a contact, so it can only forbid: when two shapes come near each other,
/// and again within a step by what flies, as often as that looks where it gets to, by several threads at once. A
/// contact is kept without asking until the two part. So the answer is to follow from what it is told, or from what
/// does not change: the same for the same two shapes. Where it follows from more (the state of the game), the world
/// must be told when it is another one: `redefine` with another `userData` asks anew about a shape, or about all shapes
/// of a body; `setContactFilter` asks about all. If it changes without that, some contacts are of the old answer and
/// some of the new one, until their shapes part. Queries do not ask it.
class ContactFilter {
public:
    virtual ~ContactFilter() = default;

    /// Whether these two may touch. A is the one whose id has the lower index. It neither throws nor calls the world.
    virtual bool mayTouch(const FilteredShape& a, const FilteredShape& b) const noexcept = 0;
};

}  // namespace swept
