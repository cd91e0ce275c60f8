#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cubecam {

/// The joints of a skin that move each vertex of a mesh, and how much.
class Influences {
public:
    /// @param count the number of joints of each vertex, a multiple of 4.
    /// @param joints `count` numbers of joints for each vertex, one vertex after the other. The
    /// number of a joint without weight means nothing and becomes 0.
    /// @param weights as many weights, of any sum.
    /// @throws std::invalid_argument for another count or length, or a weight that is negative or
    /// not finite.
    Influences(std::size_t count, std::vector<std::uint16_t> joints, std::vector<float> weights);

    std::size_t count() const { return count_; }
    std::size_t vertices() const { return weights_.size() / count_; }
    const std::vector<std::uint16_t>& joints() const { return joints_; }
    const std::vector<float>& weights() const { return weights_; }
    /// The number of joints that a skin must have at least.
    std::size_t needed_joints() const { return std::size_t{highest_} + 1; }

    /// The influences of some vertices, in this order.
    Influences gathered(const std::vector<std::uint32_t>& vertices) const;

private:
    std::size_t count_;
    std::vector<std::uint16_t> joints_;
    std::vector<float> weights_;
    std::uint16_t highest_ = 0;
};

}  // namespace cubecam
