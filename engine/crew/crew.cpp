#include "crew.h"

#include <algorithm>
#include <exception>
#ifdef __STDCPP_THREADS__
#include <thread>
#endif

#include "spin_pause.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A ticket: the number of the loop in the upper half, then the first free block and the end of the free ones.
constexpr int kLoopShift = 32;
constexpr int kFrontShift = 16;
constexpr std::uint64_t kBlockMask = 0xFFFF;
constexpr std::size_t kMostBlocks = 4096;
/// How often each worker claims blocks of a loop if all are equally fast: a claim costs as much as some contacts do, so
/// that short loops are shared out at once, while long ones may be of uneven work.
constexpr std::size_t kFewBlocks = 64;
constexpr std::size_t kClaimsOfFew = 1;
constexpr std::size_t kClaimsOfMany = 8;
/// Loops are counted from 1 on; this one never comes.
constexpr std::uint64_t kOver = ~std::uint64_t{0};

/// Takes an exception from the thread of the leader to that of the caller.
class Failure {
public:
#ifdef __cpp_exceptions
    void keepThatOf(FunctionRef<void()> work) {
        try {
            work();
        } catch (...) { thrown_ = std::current_exception(); }
    }
    void rethrow() const {
        if (thrown_) { std::rethrow_exception(thrown_); }
    }

private:
    std::exception_ptr thrown_;
#else
    void keepThatOf(FunctionRef<void()> work) { work(); }
    void rethrow() const {}
#endif
};

constexpr std::uint64_t frontOf(std::uint64_t ticket) { return (ticket >> kFrontShift) & kBlockMask; }
constexpr std::uint64_t endOf(std::uint64_t ticket) { return ticket & kBlockMask; }
constexpr bool hasBlock(std::uint64_t ticket) { return frontOf(ticket) < endOf(ticket); }

/// Waits a little longer from call to call: a pause takes some 40 ns. The longest wait without leaving the processor to
/// others is below what a switch of threads costs.
class Patience {
public:
    void wait() {
        if (waits_ < kMostPauses) {
            ++waits_;
            spinPause();
        } else {
#ifdef __STDCPP_THREADS__  // without them nobody is ever waited for
            std::this_thread::yield();
#endif
        }
    }
    void renew() { waits_ = 0; }

private:
    static constexpr int kMostPauses = 256;
    int waits_ = 0;
};

}  // namespace

/// From the front or from the back: so two workers keep to the same ends of loops that follow each other, and find the
/// bodies and contacts that they had in their own caches. To fetch a block of contacts from the other's cache takes as
/// long as to solve it.
std::uint32_t Crew::takeBlocks(std::uint64_t ticket, bool fromFront, int worker) {
    while (hasBlock(ticket)) {
        // The share may be that of another loop: then it is just not the best.
        const std::uint64_t share = share_.load(std::memory_order_relaxed);
        const std::uint64_t taken = std::min(share, endOf(ticket) - frontOf(ticket));
        const std::uint64_t rest = fromFront ? ticket + (taken << kFrontShift) : ticket - taken;
        if (!ticket_.compare_exchange_weak(ticket, rest, std::memory_order_acq_rel, std::memory_order_acquire)) {
            continue;
        }
        // The loop cannot end before these blocks are done, so its description stays.
        const auto first = static_cast<std::size_t>(fromFront ? frontOf(ticket) : endOf(ticket) - taken);
        const std::size_t end = first + static_cast<std::size_t>(taken);
        (*body_)(first * blockLength_, std::min(end * blockLength_, count_), worker);
        return static_cast<std::uint32_t>(taken);
    }
    return 0;
}

void Crew::run(std::size_t count, std::size_t grain, FunctionRef<void(std::size_t, std::size_t, int)> body) {
    if (count == 0) { return; }
    const std::size_t length = std::max({grain, (count - 1) / kMostBlocks + 1, std::size_t{1}});
    const std::size_t blocks = (count - 1) / length + 1;
    const auto helpers = static_cast<std::size_t>(helpers_.load(std::memory_order_relaxed));
    // To come takes helpers some 20 µs, as long as many loops; a long one they may join while it runs.
    const bool mayCome = workers_ > 1 && blocks > kFewBlocks;
    if (blocks < 2 || (helpers == 0 && !mayCome)) {
        body(0, count, leader_);
        return;
    }
    body_ = &body;
    count_ = count;
    blockLength_ = length;
    share(blocks, std::max(helpers, std::size_t{1}));
}

void Crew::share(std::size_t blocks, std::size_t helpers) noexcept {
    done_.store(0, std::memory_order_relaxed);
    const std::size_t claims = (blocks <= kFewBlocks ? kClaimsOfFew : kClaimsOfMany) * (helpers + 1);
    const std::size_t share = (blocks - 1) / claims + 1;
    share_.store(share, std::memory_order_relaxed);
    // The first share is the leader's: nobody has to be asked for it.
    const std::uint64_t loop = (ticket_.load(std::memory_order_relaxed) >> kLoopShift) + 1;
    ticket_.store((loop << kLoopShift) | (std::uint64_t{share} << kFrontShift) | blocks, std::memory_order_release);
    (*body_)(0, std::min(share * blockLength_, count_), leader_);
    std::size_t own = share;
    while (own < blocks) {
        const std::uint32_t more = takeBlocks(ticket_.load(std::memory_order_relaxed), true, leader_);
        if (more == 0) { break; }
        own += more;
    }
    Patience patience;
    while (done_.load(std::memory_order_acquire) != blocks - own) { patience.wait(); }
}

void Crew::help(int worker) noexcept {
    const bool fromFront = helpers_.fetch_add(1, std::memory_order_relaxed) % 2 != 0;
    Patience patience;
    for (;;) {
        const std::uint64_t ticket = ticket_.load(std::memory_order_acquire);
        if (ticket == kOver) { return; }
        if (const std::uint32_t taken = takeBlocks(ticket, fromFront, worker); taken > 0) {
            done_.fetch_add(taken, std::memory_order_release);
            patience.renew();
        } else {
            patience.wait();
        }
    }
}

void Crew::lead(TaskSystem& tasks, FunctionRef<void()> work) {
    workers_ = std::max(tasks.workerCount(), 1);
    startSeconds_ = tasks.startSeconds();
    ticket_.store(0, std::memory_order_relaxed);
    helpers_.store(0, std::memory_order_relaxed);
    isLed_.store(false, std::memory_order_relaxed);
    /// Also when the work throws: nobody may wait for ever.
    struct End {
        Crew& crew;
        ~End() { crew.ticket_.store(kOver, std::memory_order_release); }
    };
    Failure failure;
    tasks.run(static_cast<std::size_t>(workers_), 1, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (isLed_.exchange(true, std::memory_order_acq_rel)) {
                help(static_cast<int>(i));
                continue;
            }
            leader_ = static_cast<int>(i);
            const End atEnd{*this};
            failure.keepThatOf(work);
        }
    });
    failure.rethrow();
}

}  // namespace swept::inline SWEPT_PRECISION
