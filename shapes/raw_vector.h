#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace swept {

/// Leaves new elements as they come, where no value is given for them.
template <class T>
class RawAllocator : public std::allocator<T> {
public:
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

    template <class U>
    struct rebind {
        using other = RawAllocator<U>;
    };
    RawAllocator() = default;
    template <class U>
    RawAllocator(const RawAllocator<U>&) noexcept {}  // of vectors, which do that by themselves

    void construct(T*) noexcept {}
    template <class... Arguments>
    void construct(T* place, Arguments&&... arguments) {
        std::construct_at(place, std::forward<Arguments>(arguments)...);
    }
};

/// A vector whose `resize` makes room and no more: for arrays whose elements several workers write as a whole before
/// anybody reads them. To fill them first would be work for one, which takes every cache line from who writes it next.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace swept
