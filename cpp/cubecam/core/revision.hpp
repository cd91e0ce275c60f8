/// Revisions: numbers that name one state of one object. The same revision means the same contents,
/// so the renderer compares no contents and draws nothing again.
#pragma once

#include <atomic>
#include <cstdint>

namespace cubecam {

/// The only revision counter of this process.
inline std::atomic<std::uint64_t>& revision_counter() {
    static std::atomic<std::uint64_t> counter{0};
    return counter;
}

/// The next revision of this process, from 1. No object and no thread gets the same number twice; 0
/// can stand for "none". Never pickle a revision: in another process it would name another state.
inline std::uint64_t next_revision() {
    return revision_counter().fetch_add(1, std::memory_order_relaxed) + 1;
}

/// The newest revision of this process. While it stays the same, no object has changed.
inline std::uint64_t newest_revision() {
    return revision_counter().load(std::memory_order_acquire);
}

/// The revision of an object that can change; reading it does not need the object's mutex.
class Revision {
public:
    std::uint64_t value() const { return value_.load(std::memory_order_acquire); }
    void set(std::uint64_t value) {
        value_.store(value, std::memory_order_release);
        // Another thread may have checked a snapshot after `value` was taken from the counter and
        // before it was stored here. That snapshot must not look newest afterwards.
        next_revision();
    }

private:
    std::atomic<std::uint64_t> value_{0};
};

/// The revision of an object at the time when something was made from it: outdated as soon as the
/// object's revision differs.
struct SeenRevision {
    const Revision* revision;  ///< the holder of this record keeps its object alive
    std::uint64_t seen;

    bool outdated() const { return revision->value() != seen; }
};

}  // namespace cubecam
