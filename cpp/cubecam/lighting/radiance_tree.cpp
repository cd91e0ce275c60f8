#include "cubecam/lighting/radiance_tree.hpp"

#include <algorithm>
#include <cmath>

namespace cubecam {

namespace {

/// From 0 to a corner: the solid angle of the rectangle with these sides at distance 1.
double corner_angle(double a, double b) { return std::atan2(a * b, std::sqrt(a * a + b * b + 1)); }

float spread(const glm::vec3& center) {
    const glm::dvec3 c(center);
    return static_cast<float>(std::max(0.0, (1 - glm::dot(c, c)) / 2));
}

float countable(float value) {
    if (std::isnan(value)) return 0.0F;
    if (std::isinf(value)) return value > 0 ? 65504.0F : -65504.0F;
    return std::clamp(value, -1e30F, 1e30F);
}

/// Sums over a square, for red, green and blue.
struct Moments {
    glm::vec3 light{0};
    glm::mat3 towards{0};  ///< column c: of the light of channel c times its direction

    void set_centers(RadianceNode& node) const {
        for (int channel = 0; channel < 3; ++channel) {
            if (!(light[channel] > 0)) continue;  // the geometric center does as well
            const glm::vec3 center = towards[channel] / light[channel];
            node.light_centers[static_cast<std::size_t>(channel)] =
                glm::vec4(center, spread(center));
        }
    }
};

}  // namespace

double texel_solid_angle(int column, int row, int size) {
    const auto at = [&](int i) { return 2.0 * i / size - 1; };
    const double left = at(column);
    const double right = at(column + 1);
    const double top = at(row);
    const double bottom = at(row + 1);
    return corner_angle(left, top) - corner_angle(left, bottom) - corner_angle(right, top) +
           corner_angle(right, bottom);
}

glm::vec4 countable_radiance(const glm::vec4& value) {
    return {countable(value.x), countable(value.y), countable(value.z), countable(value.w)};
}

TreeShape::TreeShape(int size, int leaf_size)
    : size_(size), texels_per_leaf_((size + leaf_size - 1) / leaf_size) {
    int along = (size + texels_per_leaf_ - 1) / texels_per_leaf_;
    std::size_t count = 0;
    for (;; along = (along + 1) / 2) {
        sizes_.push_back(along);
        offsets_.push_back(count);
        count += static_cast<std::size_t>(along) * static_cast<std::size_t>(along);
        if (along == 1) break;
    }
    const auto texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    solid_angles_.reserve(texels);
    directions_.reserve(texels);
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            solid_angles_.push_back(static_cast<float>(texel_solid_angle(column, row, size)));
            const glm::dvec3 towards(1, (2.0 * column + 1) / size - 1, (2.0 * row + 1) / size - 1);
            directions_.emplace_back(glm::normalize(towards));
        }
    }

    nodes_.resize(count);
    std::vector<glm::dvec3> sums(count);  // of solid angle * direction
    std::vector<double> angles(count);
    const auto add = [&](std::size_t to, const glm::dvec3& sum, double angle) {
        sums[to] += sum;
        angles[to] += angle;
    };
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const auto texel = static_cast<std::size_t>(row * size + column);
            const auto leaf = static_cast<std::size_t>(row / texels_per_leaf_ * sizes_[0] +
                                                       column / texels_per_leaf_);
            const double angle = texel_solid_angle(column, row, size);
            add(leaf, angle * glm::dvec3(directions_[texel]), angle);
        }
    }
    int covered = texels_per_leaf_;  // texels along an edge of a node
    for (std::size_t level = 0; level < sizes_.size(); ++level, covered *= 2) {
        const int n = sizes_[level];
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const std::size_t at = offsets_[level] + static_cast<std::size_t>(row * n + column);
                RadianceNode& node = nodes_[at];
                const glm::vec3 center(sums[at] / angles[at]);
                node.solid_angle = static_cast<float>(angles[at]);
                // Leaves of one texel are points: their spread is 0 but for rounding.
                node.center = glm::vec4(center, covered == 1 ? 0.0F : spread(center));
                node.light_centers.fill(node.center);
                node.radiance = glm::vec4(0);
                node.radius = 0;
                for (const int y : {row * covered, std::min(size, (row + 1) * covered)}) {
                    for (const int x : {column * covered, std::min(size, (column + 1) * covered)}) {
                        const glm::vec3 corner = glm::normalize(glm::vec3(
                            1, 2.0F * static_cast<float>(x) / static_cast<float>(size) - 1,
                            2.0F * static_cast<float>(y) / static_cast<float>(size) - 1));
                        node.radius = std::max(node.radius, glm::distance(center, corner));
                    }
                }
                if (level + 1 < sizes_.size()) {
                    add(offsets_[level + 1] +
                            static_cast<std::size_t>(row / 2 * sizes_[level + 1] + column / 2),
                        sums[at], angles[at]);
                }
            }
        }
    }
}

std::vector<RadianceNode> TreeShape::tree(std::span<const glm::vec4> texels) const {
    std::vector<RadianceNode> nodes = nodes_;
    std::vector<Moments> moments(nodes.size());
    for (int row = 0; row < size_; ++row) {
        const int leaf_row = row / texels_per_leaf_ * sizes_[0];
        for (int column = 0; column < size_; ++column) {
            const auto texel = static_cast<std::size_t>(row * size_ + column);
            const auto leaf = static_cast<std::size_t>(leaf_row + column / texels_per_leaf_);
            const glm::vec4 value = countable_radiance(texels[texel]) * solid_angles_[texel];
            nodes[leaf].radiance += value;
            const glm::vec3 light = glm::abs(glm::vec3(value));
            moments[leaf].light += light;
            for (int channel = 0; channel < 3; ++channel) {
                moments[leaf].towards[channel] += light[channel] * directions_[texel];
            }
        }
    }
    const bool points = texels_per_leaf_ == 1;
    for (std::size_t level = 0; level < sizes_.size(); ++level) {
        const int n = sizes_[level];
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const std::size_t at = offsets_[level] + static_cast<std::size_t>(row * n + column);
                if (!(points && level == 0)) moments[at].set_centers(nodes[at]);
                if (level + 1 == sizes_.size()) continue;
                const std::size_t above =
                    offsets_[level + 1] +
                    static_cast<std::size_t>(row / 2 * sizes_[level + 1] + column / 2);
                nodes[above].radiance += nodes[at].radiance;
                moments[above].light += moments[at].light;
                moments[above].towards += moments[at].towards;
            }
        }
    }
    return nodes;
}

}  // namespace cubecam
