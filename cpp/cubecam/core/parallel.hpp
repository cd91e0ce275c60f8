/// Loops over ranges on several threads. Threads live for one call only: a process that forks
/// between two calls loses nothing, and a library unloaded leaves nothing running.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace cubecam {

/// Cores that this process may use (its affinity counts), at least 1.
inline std::size_t worker_count() {
    return std::max<std::size_t>(1, std::thread::hardware_concurrency());
}

/// Calls body(begin, end, scratch) on pieces that together cover [begin, end) once: pieces of
/// `grain` on all cores, the calling thread among them, or all at once, here, where there is one
/// core or one piece. Each thread makes a `Scratch` of its own for all its pieces. The first
/// exception that a piece throws is thrown here once all have stopped; pieces not begun are left
/// out.
template <typename Scratch, typename Body>
void parallel_for_with(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
    if (begin >= end) return;
    grain = std::max<std::size_t>(1, grain);
    const std::size_t pieces = (end - begin - 1) / grain + 1;
    const std::size_t workers = std::min(worker_count(), pieces);
    if (workers == 1) {
        Scratch scratch;
        body(begin, end, scratch);
        return;
    }

    std::atomic<std::size_t> next{0};
    std::exception_ptr error;
    std::mutex error_mutex;
    const auto work = [&]() noexcept {
        try {
            Scratch scratch;
            for (std::size_t piece = next++; piece < pieces; piece = next++) {
                const std::size_t from = begin + piece * grain;
                body(from, piece + 1 == pieces ? end : from + grain, scratch);
            }
        } catch (...) {
            next = pieces;
            const std::lock_guard lock(error_mutex);
            if (!error) error = std::current_exception();
        }
    };

    std::vector<std::thread> threads;
    threads.reserve(workers - 1);
    try {
        for (std::size_t i = 1; i < workers; ++i) threads.emplace_back(work);
    } catch (const std::system_error&) {
        // No more threads to be had: those that run, this one at least, do all of the work.
    }
    work();
    for (std::thread& thread : threads) thread.join();
    if (error) std::rethrow_exception(error);
}

/// The same for a body(begin, end) that needs no memory of its own.
template <typename Body>
void parallel_for(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
    struct Nothing {};
    parallel_for_with<Nothing>(begin, end, grain,
                               [&](std::size_t from, std::size_t to, Nothing&) { body(from, to); });
}

}  // namespace cubecam
