#include "cubecam/render/call_line.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/context.hpp"

#include <atomic>
#include <chrono>

namespace cubecam {
namespace {

constexpr std::chrono::milliseconds one_look{20};

std::uint64_t next_line() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

/// The line that this thread serves; 0: none.
thread_local constinit std::uint64_t served_line = 0;

/// The innermost turn of this thread.
thread_local constinit CallLine::Turn* innermost_turn = nullptr;

}  // namespace

CallLine::CallLine() : number_(next_line()) {}

CallLine::Place::Place(CallLine& line) : line_(line) {
    const std::lock_guard lock(line.mutex_);
    line.places_.push_back(this);
}

CallLine::Place::~Place() {
    if (gl::in_forked_child()) return;  // a thread that does not exist here may hold the lock
    {
        const std::lock_guard lock(line_.mutex_);
        std::erase(line_.places_, this);
    }
    line_.changed_.notify_all();
}

void CallLine::Place::wait() {
    std::unique_lock lock(line_.mutex_);
    while (line_.places_.front() != this) {
        line_.changed_.wait_for(lock, one_look);
        lock.unlock();
        poll_interrupts();
        lock.lock();
    }
}

CallLine::Turn::Turn(CallLine& line) : line_(line), outer_(innermost_turn) {
    if (!line.served_here() && !gl::in_forked_child()) {
        if (Place* const held = line.place_here()) {
            held->wait();
        } else {
            place_.emplace(line);
        }
    }
    innermost_turn = this;
    if (!place_) return;
    try {
        place_->wait();
    } catch (...) {
        innermost_turn = outer_;
        throw;
    }
}

CallLine::Turn::~Turn() { innermost_turn = outer_; }

void CallLine::serve_here() const { served_line = number_; }

bool CallLine::served_here() const { return served_line == number_; }

bool CallLine::called_here() const { return place_here() != nullptr; }

CallLine::Place* CallLine::place_here() const {
    for (Turn* turn = innermost_turn; turn != nullptr; turn = turn->outer_) {
        if (&turn->line_ == this && turn->place_) return &*turn->place_;
    }
    return nullptr;
}

}  // namespace cubecam
