#pragma once

#include "cubecam/render/resources/target.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

namespace cubecam {

/// Holds one target for each description of a frame or capture, and drops the least recently used
/// ones if they take more than `capacity` bytes. A target keeps its picture, so the same frame need
/// not be drawn again.
class TargetStore {
public:
    explicit TargetStore(std::size_t capacity) : capacity_(capacity) {}

    /// `result_bytes`: what is read from the target afterwards, which the memory must hold, too.
    Target& get(const gl::Context& context, const TargetDescription& description,
                std::size_t result_bytes = 0) {
        for (auto it = targets_.begin(); it != targets_.end(); ++it) {
            if ((*it)->description() != description) continue;
            targets_.splice(targets_.begin(), targets_, it);
            return *targets_.front();
        }
        // Old targets are dropped first, so that memory never holds the old and the new one.
        trim(capacity_ > description.bytes() ? capacity_ - description.bytes() : 0);
        check_target_memory(context, description, result_bytes);
        targets_.push_front(std::make_unique<Target>(context, description));
        return *targets_.front();
    }

    /// Drops targets after a call. Returns how many of them were larger than the whole store.
    std::int64_t trim() {
        const auto too_large = [this](const std::unique_ptr<Target>& target) {
            return target->description().bytes() > capacity_;
        };
        const auto count = std::count_if(targets_.begin(), targets_.end(), too_large);
        trim(capacity_);
        return count;
    }

private:
    void trim(std::size_t limit) {
        while (!targets_.empty() && bytes() > limit) targets_.pop_back();
    }

    std::size_t bytes() const {
        std::size_t sum = 0;
        for (const auto& target : targets_) sum += target->bytes();
        return sum;
    }

    std::size_t capacity_;
    std::list<std::unique_ptr<Target>> targets_;  // most recently used first
};

}  // namespace cubecam
