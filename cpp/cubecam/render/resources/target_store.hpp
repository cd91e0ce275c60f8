#pragma once

#include "cubecam/render/resources/target.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

namespace cubecam {

/// One target for each description of a frame or capture, the least recently used given up when
/// they fill more than `capacity` bytes. The picture in a target stays, so the same frame need not
/// be drawn again.
class TargetStore {
public:
    explicit TargetStore(std::size_t capacity) : capacity_(capacity) {}

    Target& get(const gl::Context& context, const TargetDescription& description) {
        for (auto it = targets_.begin(); it != targets_.end(); ++it) {
            if ((*it)->description() != description) continue;
            targets_.splice(targets_.begin(), targets_, it);
            return *targets_.front();
        }
        // Room is made first, so that memory never holds both.
        trim(capacity_ > description.bytes() ? capacity_ - description.bytes() : 0);
        targets_.push_front(std::make_unique<Target>(context, description));
        return *targets_.front();
    }

    /// After a call: a target larger than the whole store is not kept. Returns how many were given
    /// up that the store alone could not hold.
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
        for (const auto& target : targets_) sum += target->description().bytes();
        return sum;
    }

    std::size_t capacity_;
    std::list<std::unique_ptr<Target>> targets_;  // most recently used first
};

}  // namespace cubecam
