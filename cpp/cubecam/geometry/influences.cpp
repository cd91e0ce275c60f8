#include "cubecam/geometry/influences.hpp"

#include "cubecam/core/checks.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

Influences::Influences(std::size_t count, std::vector<std::uint16_t> joints,
                       std::vector<float> weights)
    : count_(count), joints_(std::move(joints)), weights_(std::move(weights)) {
    if (count_ == 0 || count_ % 4 != 0) {
        expect(false, "a multiple of 4 joints for each vertex", std::to_string(count_));
    }
    if (joints_.size() != weights_.size() || joints_.size() % count_ != 0) {
        expect(false, "as many joint_weights as joints, " + std::to_string(joints_.size()),
               std::to_string(weights_.size()));
    }
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        const float weight = weights_[i];
        if (!(weight >= 0.0F && weight <= std::numeric_limits<float>::max())) {
            throw std::invalid_argument("expected joint_weights of 0 or more, got " +
                                        describe(weight) + " at vertex " +
                                        std::to_string(i / count_));
        }
        if (weight == 0.0F) joints_[i] = 0;
        highest_ = std::max(highest_, joints_[i]);
    }
}

Influences Influences::gathered(const std::vector<std::uint32_t>& vertices) const {
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    joints.reserve(count_ * vertices.size());
    weights.reserve(count_ * vertices.size());
    for (const std::uint32_t vertex : vertices) {
        for (std::size_t i = count_ * vertex; i < count_ * (vertex + 1); ++i) {
            joints.push_back(joints_[i]);
            weights.push_back(weights_[i]);
        }
    }
    return {count_, std::move(joints), std::move(weights)};
}

}  // namespace cubecam
