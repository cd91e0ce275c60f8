/// Revisions: numbers that name one state of one object, so that "the same revision" means "the
/// same contents" and nothing needs to be compared or drawn again.
#pragma once

#include <atomic>
#include <cstdint>

namespace cubecam {

/// The next revision of this process, from 1. It never recurs, over all objects and threads; 0 can
/// stand for "none". Never pickle one: in another process it would name another state.
inline std::uint64_t next_revision() {
    static std::atomic<std::uint64_t> counter{0};
    return counter.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace cubecam
