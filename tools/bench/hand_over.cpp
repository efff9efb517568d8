#include "hand_over.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include <swept/shapes/cache_line.h>

namespace swept::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kThrows = 4000;
constexpr int kTries = 5;
constexpr std::chrono::milliseconds kPatience{200};  ///< for the other one to come, and for the game
constexpr int kLooksPerClock = 1024;

/// A line that two players hand to each other.
struct Ball {
    alignas(kCacheLine) std::atomic<int> throws = 0;
    alignas(kCacheLine) std::atomic<int> players = 0;
};

/// @return whether it came before patience ended
bool waitFor(const std::atomic<int>& number, int value, Clock::time_point end) {
    for (int looks = 1; number.load(std::memory_order_acquire) < value; ++looks) {
        if (looks % kLooksPerClock == 0 && Clock::now() > end) { return false; }
    }
    return true;
}

/// @param own  0 or 1: which throws are his
/// @return whether the game came to its end
bool play(Ball& ball, int own) {
    const Clock::time_point end = Clock::now() + kPatience;
    for (int i = own; i < kThrows; i += 2) {
        if (!waitFor(ball.throws, i, end)) { return false; }
        ball.throws.store(i + 1, std::memory_order_release);
    }
    return true;
}

std::optional<double> tryOnce(TaskSystem& tasks) {
    Ball ball;
    std::optional<double> seconds;
    tasks.run(2, 1, [&](std::size_t begin, std::size_t end, int) {
        if (end - begin > 1) { return; }  // both are one worker's
        ball.players.fetch_add(1);
        if (!waitFor(ball.players, 2, Clock::now() + kPatience)) { return; }
        const Clock::time_point start = Clock::now();
        if (play(ball, static_cast<int>(begin)) && begin == 1) {  // who has the last throw
            seconds = std::chrono::duration<double>(Clock::now() - start).count() / kThrows;
        }
    });
    return seconds;
}

}  // namespace

std::optional<double> handOverSeconds(TaskSystem& tasks) {
    std::optional<double> quickest;
    for (int i = 0; i < kTries; ++i) {
        const std::optional<double> seconds = tryOnce(tasks);
        if (seconds) { quickest = std::min(quickest.value_or(*seconds), *seconds); }
    }
    return quickest;
}

}  // namespace swept::bench
