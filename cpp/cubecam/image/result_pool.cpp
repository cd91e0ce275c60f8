#include "cubecam/image/result_pool.hpp"

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
        // Here and below the lock is only tried: in a forked process the thread that holds it may
        // not exist.
        const std::unique_lock lock(mutex_, std::try_to_lock);
        auto found = held_.end();
        if (lock) {
            found = std::find_if(held_.begin(), held_.end(), [bytes](const Held& held) {
                return held.memory->size() == bytes;
            });
        }
        if (lock && found != held_.end()) {
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
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    ++call_;
    while (!held_.empty() && held_.back().call + patience < call_) {
        bytes_ -= held_.back().memory->size();
        freed.splice(freed.end(), held_, std::prev(held_.end()));
    }
}

std::size_t ResultPool::clear() {
    std::list<Held> freed;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return 0;
    held_.swap(freed);
    return std::exchange(bytes_, 0);
}

std::shared_ptr<PixelBuffer> result_memory(std::size_t bytes) {
    // Never destroyed: results may live until the process ends.
    static const auto& pool = *new auto(std::make_shared<ResultPool>(conversion_results));
    static const bool reserve = [] {
        add_reserve([] { return pool->clear(); });
        return true;
    }();
    static_cast<void>(reserve);
    pool->next_call();
    return pool->take(bytes);
}

}  // namespace cubecam
