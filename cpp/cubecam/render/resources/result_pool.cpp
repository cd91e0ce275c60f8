#include "cubecam/render/resources/result_pool.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cubecam {
namespace {

/// The allocator keeps the memory of smaller blocks itself.
constexpr std::size_t least_bytes = std::size_t{64} << 10;

}  // namespace

std::shared_ptr<PixelBuffer> ResultPool::take(std::size_t bytes) {
    if (bytes < least_bytes) return std::make_shared<PixelBuffer>(bytes);
    std::unique_ptr<PixelBuffer> memory;
    {
        const std::lock_guard lock(mutex_);
        const auto found = std::find_if(held_.begin(), held_.end(), [bytes](const Held& held) {
            return held.memory->size() == bytes;
        });
        if (found != held_.end()) {
            memory = std::move(found->memory);
            held_.erase(found);
            bytes_ -= bytes;
        }
    }
    if (memory == nullptr) memory = std::make_unique<PixelBuffer>(bytes);
    return {memory.release(), [pool = weak_from_this()](PixelBuffer* at) {
                std::unique_ptr<PixelBuffer> let_go(at);
                if (const auto alive = pool.lock()) alive->give_back(std::move(let_go));
            }};
}

void ResultPool::give_back(std::unique_ptr<PixelBuffer> memory) noexcept {
    std::list<Held> freed;  // freed after the lock
    // The lock is only tried: in a forked process the thread that holds it may not exist.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || memory->size() > capacity_) return;
    try {
        const std::size_t bytes = memory->size();
        held_.push_front({std::move(memory), call_});
        bytes_ += bytes;
    } catch (...) {
        return;  // no memory for the list: the block is freed
    }
    while (bytes_ > capacity_) {
        bytes_ -= held_.back().memory->size();
        freed.splice(freed.end(), held_, std::prev(held_.end()));
    }
}

void ResultPool::next_call() {
    std::list<Held> freed;
    const std::lock_guard lock(mutex_);
    ++call_;
    while (!held_.empty() && held_.back().call + patience < call_) {
        bytes_ -= held_.back().memory->size();
        freed.splice(freed.end(), held_, std::prev(held_.end()));
    }
}

}  // namespace cubecam
