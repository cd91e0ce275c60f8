#pragma once

#include "cubecam/core/revision.hpp"

#include <cstdint>
#include <mutex>
#include <utility>

namespace cubecam {

/// A plain value behind a mutex, with the revision of its last real change.
///
/// Setting an equal value does not change the revision: the renderer compares revisions to decide
/// whether a picture is still valid, so a needless new revision would cause a needless redraw.
template <class Value>
class Versioned {
public:
    struct State {
        Value value;
        std::uint64_t revision;
    };

    explicit Versioned(Value value) : state_{std::move(value), next_revision()} {
        revision_.set(state_.revision);
    }

    /// Value and revision as they were at one moment.
    State state() const {
        const std::lock_guard lock(mutex_);
        return state_;
    }

    Value value() const { return state().value; }

    /// The revision of the state; reading it never waits for another thread.
    const Revision& revision() const { return revision_; }

    /// Applies `change` to a copy; keeps it, under a new revision, only if it differs.
    /// An exception thrown by `change` leaves the old value in place.
    template <class Change>
    void edit(Change&& change) {
        const std::lock_guard lock(mutex_);
        Value next = state_.value;
        std::forward<Change>(change)(next);
        if (!(next == state_.value)) {
            state_ = State{std::move(next), next_revision()};
            revision_.set(state_.revision);
        }
    }

private:
    mutable std::mutex mutex_;
    State state_;
    Revision revision_;
};

}  // namespace cubecam
