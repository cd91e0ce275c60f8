/// Revisions: numbers that name one state of one object, so that "the same revision" means "the
/// same contents" and nothing needs to be compared or drawn again.
#pragma once

#include <atomic>
#include <cstdint>

namespace cubecam {

/// The one counter of this process.
inline std::atomic<std::uint64_t>& revision_counter() {
    static std::atomic<std::uint64_t> counter{0};
    return counter;
}

/// The next revision of this process, from 1. It never recurs, over all objects and threads; 0 can
/// stand for "none". Never pickle one: in another process it would name another state.
inline std::uint64_t next_revision() {
    return revision_counter().fetch_add(1, std::memory_order_relaxed) + 1;
}

/// The newest revision of this process. While it stays the same, no object has changed.
inline std::uint64_t newest_revision() {
    return revision_counter().load(std::memory_order_acquire);
}

/// The revision of an object that changes, readable without the object's mutex.
class Revision {
public:
    std::uint64_t value() const { return value_.load(std::memory_order_acquire); }
    void set(std::uint64_t value) {
        value_.store(value, std::memory_order_release);
        // A snapshot that was found true after the new revision was drawn and before it was stored
        // here must not look newest afterwards.
        next_revision();
    }

private:
    std::atomic<std::uint64_t> value_{0};
};

/// A state of an object that something was made from: outdated once the object's revision differs.
struct SeenRevision {
    const Revision* revision;  ///< of an object that whoever holds this keeps alive
    std::uint64_t seen;

    bool outdated() const { return revision->value() != seen; }
};

}  // namespace cubecam
