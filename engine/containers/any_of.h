#pragma once

namespace swept {

/// `std::any_of` as a loop: that of libstdc++ is written out four rounds at a time, and three more for what is left,
/// each with a copy of what is asked. For what a step asks once: a small world would wait for all those copies.
template <class Items, class IsMeant>
bool anyOf(const Items& items, const IsMeant& isMeant) {
    for (const auto& item : items) {
        if (isMeant(item)) { return true; }
    }
    return false;
}

template <class Items, class IsMeant>
bool noneOf(const Items& items, const IsMeant& isMeant) {
    return !anyOf(items, isMeant);
}

}  // namespace swept
