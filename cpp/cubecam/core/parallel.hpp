/// Loops over ranges on several threads. The threads end with the call: a process that forks
/// between two calls loses none, and no thread is left when the library is unloaded.
#pragma once

#include "cubecam/core/interrupts.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace cubecam {

/// The number of cores that this process may use (within its CPU affinity), at least 1.
inline std::size_t worker_count() {
    return std::max<std::size_t>(1, std::thread::hardware_concurrency());
}

/// Calls body(begin, end, scratch) on pieces that together cover [begin, end) once. The pieces have
/// `grain` elements and run on all cores, including the calling thread, which polls for interrupts
/// before each of its pieces. Each thread makes one `Scratch` for all its pieces. When a piece
/// throws, the pieces that have not begun are skipped, and the first exception is thrown again here
/// after all threads have stopped.
template <typename Scratch, typename Body>
void parallel_for_with(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
    if (begin >= end) return;
    grain = std::max<std::size_t>(1, grain);
    const std::size_t pieces = (end - begin - 1) / grain + 1;
    const std::size_t workers = std::min(worker_count(), pieces);
    if (workers == 1) {
        Scratch scratch;
        for (std::size_t piece = 0; piece < pieces; ++piece) {
            poll_interrupts();
            const std::size_t from = begin + piece * grain;
            body(from, piece + 1 == pieces ? end : from + grain, scratch);
        }
        return;
    }

    std::atomic<std::size_t> next{0};
    std::exception_ptr error;
    std::mutex error_mutex;
    const auto work = [&]() noexcept {
        try {
            Scratch scratch;
            for (std::size_t piece = next++; piece < pieces; piece = next++) {
                poll_interrupts();  // does nothing on the other threads
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
        // The system gives no more threads: the running ones, at least this one, do all the work.
    }
    work();
    for (std::thread& thread : threads) thread.join();
    if (error) std::rethrow_exception(error);
}

/// Like parallel_for_with, for a body(begin, end) that needs no scratch memory.
template <typename Body>
void parallel_for(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
    struct Nothing {};
    parallel_for_with<Nothing>(begin, end, grain,
                               [&](std::size_t from, std::size_t to, Nothing&) { body(from, to); });
}

}  // namespace cubecam
