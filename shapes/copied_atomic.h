#pragma once

#include <atomic>

namespace swept {

/// An atomic number that what holds it may be copied with, while nobody else writes it.
template <class T>
struct CopiedAtomic : std::atomic<T> {
    using std::atomic<T>::atomic;
    using std::atomic<T>::operator=;
    CopiedAtomic() = default;
    CopiedAtomic(const CopiedAtomic& other) noexcept : std::atomic<T>(other.load(std::memory_order_relaxed)) {}
    CopiedAtomic& operator=(const CopiedAtomic& other) noexcept {
        this->store(other.load(std::memory_order_relaxed), std::memory_order_relaxed);
        return *this;
    }
    ~CopiedAtomic() = default;
};

}  // namespace swept
