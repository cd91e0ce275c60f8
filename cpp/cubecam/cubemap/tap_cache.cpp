#include "cubecam/cubemap/tap_cache.hpp"

#include "cubecam/core/memory.hpp"

#include <algorithm>
#include <pthread.h>
#include <utility>

namespace cubecam {

namespace {

/// Keys whose taps are not kept, and plans, together.
constexpr std::size_t most_entries = 32;

std::size_t free_taps() { return TapCache::instance().clear(); }

}  // namespace

std::size_t TapPlan::bytes() const {
    std::size_t sum = own_bytes_ + kept_.capacity() * sizeof(TileTaps);
    for (const TileTaps& tile : kept_) sum += tile.bytes();
    return sum;
}

std::shared_ptr<TapPlan> TapCache::find(const TapKey& key, bool& wanted) {
    std::vector<Entry> freed;
    const std::lock_guard lock(mutex_);
    ++calls_;
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.key == key; });
    wanted = found != entries_.end();
    if (wanted) {
        found->used = calls_;
        std::rotate(entries_.begin(), found, found + 1);
    } else {
        entries_.insert(entries_.begin(), {key, nullptr, 0, calls_});
    }
    std::shared_ptr<TapPlan> plan = entries_.front().plan;
    shrink(freed);
    return plan;
}

void TapCache::add(const TapKey& key, std::shared_ptr<TapPlan> plan) {
    const std::size_t bytes = plan->bytes();
    std::vector<Entry> freed;
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.key == key; });
    if (found != entries_.end()) {
        freed.push_back(std::move(*found));
        entries_.erase(found);
    }
    entries_.insert(entries_.begin(), {key, std::move(plan), bytes, calls_});
    shrink(freed);
}

void TapCache::shrink(std::vector<Entry>& freed) {
    std::size_t sum = 0;
    std::size_t kept = 0;
    while (kept < entries_.size() && kept < most_entries) {
        const Entry& entry = entries_[kept];
        sum += entry.bytes;
        if (sum > capacity || entry.used + patience < calls_) break;
        ++kept;
    }
    const auto rest = entries_.begin() + static_cast<std::ptrdiff_t>(kept);
    freed.insert(freed.end(), std::make_move_iterator(rest),
                 std::make_move_iterator(entries_.end()));
    entries_.erase(rest, entries_.end());
}

std::size_t TapCache::clear() {
    std::vector<Entry> freed;
    const std::lock_guard lock(mutex_);
    entries_.swap(freed);
    std::size_t sum = 0;
    for (const Entry& entry : freed) sum += entry.bytes;
    return sum;
}

std::size_t TapCache::bytes() {
    const std::lock_guard lock(mutex_);
    std::size_t sum = 0;
    for (const Entry& entry : entries_) sum += entry.bytes;
    return sum;
}

TapCache& TapCache::instance() {
    // Never destroyed: threads may convert until the process ends. The lock is held over a fork, so
    // that the child finds it free and the entries whole.
    static TapCache& cache = []() -> TapCache& {
        static auto* made = new TapCache;
        pthread_atfork([] { made->mutex_.lock(); }, [] { made->mutex_.unlock(); },
                       [] { made->mutex_.unlock(); });
        add_reserve(&free_taps);
        return *made;
    }();
    return cache;
}

std::size_t kept_tap_bytes() { return TapCache::instance().bytes(); }

}  // namespace cubecam
