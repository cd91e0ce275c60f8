/// The places at which a long calculation can be ended from outside, for example by Ctrl-C.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>

namespace cubecam {

/// Looks whether the calculation of this thread is to end, and throws an exception of its own if
/// so. It may also never return.
using InterruptCheck = void (*)();

namespace interrupts {

using Clock = std::chrono::steady_clock;

/// A check is made at most once in so many milliseconds: it may have to wait for Python's lock.
inline constinit std::atomic<int> pause_ms{50};
inline std::chrono::nanoseconds pause() noexcept {
    return std::chrono::milliseconds(pause_ms.load(std::memory_order_relaxed));
}

inline constinit std::atomic<InterruptCheck> check{nullptr};
inline thread_local constinit Clock::time_point next{};

/// How many UninterruptedScopes this thread is in.
inline thread_local constinit int uninterrupted = 0;

}  // namespace interrupts

/// While it lives, poll_interrupts() does nothing on this thread. A function that holds a lock
/// while it calls something that polls has one: a check may run a signal handler of the user, which
/// may need that lock on the same thread.
class UninterruptedScope {
public:
    UninterruptedScope() noexcept { ++interrupts::uninterrupted; }
    ~UninterruptedScope() { --interrupts::uninterrupted; }

    UninterruptedScope(const UninterruptedScope&) = delete;
    UninterruptedScope& operator=(const UninterruptedScope&) = delete;
};

/// The host of the library (the Python bindings) sets its check once; null switches checks off.
inline void set_interrupt_check(InterruptCheck check) noexcept {
    interrupts::check.store(check, std::memory_order_release);
}

/// Called where a calculation begins: calculations shorter than the pause are never checked.
inline void start_interrupt_pause() noexcept {
    interrupts::next = interrupts::Clock::now() + interrupts::pause();
}

/// Every calculation that may last longer than a tenth of a second calls this between its parts
/// (faces, tiles, rows, batches of draws), at places where an exception leaves all objects
/// consistent. Costs 30 ns; does nothing on threads that the library started.
/// @throws what the host's check throws. Nothing may swallow it: it is no failure of the call.
inline void poll_interrupts() {
    const InterruptCheck check = interrupts::check.load(std::memory_order_acquire);
    if (check == nullptr) return;
    const auto begin = interrupts::Clock::now();
    if (begin < interrupts::next || interrupts::uninterrupted > 0) return;
    // A check that waited long (for Python's lock) is made less often, so that checks never take
    // more than a tenth of the time; but no later than a fifth of a second.
    const std::chrono::nanoseconds pause = interrupts::pause();
    interrupts::next = begin + pause;
    check();
    const auto end = interrupts::Clock::now();
    const std::chrono::nanoseconds longer = 10 * (end - begin);
    interrupts::next = end + std::clamp(longer, pause, 4 * pause);
}

/// Whether poll_interrupts() looks at all on this thread.
inline bool may_be_interrupted() noexcept {
    return interrupts::check.load(std::memory_order_acquire) != nullptr &&
           interrupts::uninterrupted == 0;
}

/// For loops over many small steps: polls once in 65,536 of them.
inline void poll_interrupts(std::size_t step) {
    if ((step & 0xFFFF) == 0xFFFF) poll_interrupts();
}

}  // namespace cubecam
