#pragma once

#include "../../shapes/real.h"
#ifdef __STDCPP_THREADS__
#include <mutex>
#endif

namespace swept::inline SWEPT_PRECISION {

/// A mutex for moments. Where a build has no threads at all (WebAssembly without its thread proposal) the standard
/// library has no mutex either, and there is nothing to wait for.
class ShortLock {
public:
#ifdef __STDCPP_THREADS__
    void lock() { mutex_.lock(); }
    void unlock() { mutex_.unlock(); }

private:
    std::mutex mutex_;
#else
    void lock() {}
    void unlock() {}
#endif
};

/// Holds a lock as long as it lives.
class HeldLock {
public:
    explicit HeldLock(ShortLock& lock) : lock_(lock) { lock_.lock(); }
    ~HeldLock() { lock_.unlock(); }
    HeldLock(const HeldLock&) = delete;
    HeldLock& operator=(const HeldLock&) = delete;

private:
    ShortLock& lock_;
};

}  // namespace swept::inline SWEPT_PRECISION
