#include "cubecam/lighting/radiance_tree.hpp"

#include "cubecam/core/parallel.hpp"

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

std::vector<double> texel_solid_angles(int size) {
    const auto n = static_cast<std::size_t>(size);
    std::vector<double> angles(n * n);
    parallel_for(0, n, 16, [&](std::size_t begin, std::size_t end) {
        const auto at = [&](std::size_t i) {
            return 2 * static_cast<double>(i) / static_cast<double>(size) - 1;
        };
        std::vector<double> above(n + 1);
        std::vector<double> below(n + 1);
        for (std::size_t i = 0; i <= n; ++i) below[i] = corner_angle(at(i), at(begin));
        for (std::size_t row = begin; row < end; ++row) {
            above.swap(below);
            for (std::size_t i = 0; i <= n; ++i) below[i] = corner_angle(at(i), at(row + 1));
            for (std::size_t i = 0; i < n; ++i) {
                angles[row * n + i] = above[i] - above[i + 1] - below[i] + below[i + 1];
            }
        }
    });
    return angles;
}

glm::vec4 countable_radiance(const glm::vec4& value) {
    return {countable(value.x), countable(value.y), countable(value.z), countable(value.w)};
}

TreeShape::TreeShape(int size, int leaf_size, const std::function<bool()>& goes_on)
    : size_(size), texels_per_leaf_((size + leaf_size - 1) / leaf_size) {
    int along = (size + texels_per_leaf_ - 1) / texels_per_leaf_;
    std::size_t count = 0;
    for (;; along = (along + 1) / 2) {
        sizes_.push_back(along);
        offsets_.push_back(count);
        count += static_cast<std::size_t>(along) * static_cast<std::size_t>(along);
        if (along == 1) break;
    }
    const std::vector<double> exact = texel_solid_angles(size);
    solid_angles_.assign(exact.begin(), exact.end());
    directions_.resize(exact.size());
    nodes_.resize(count);

    // Of nodes: the solid angle, and the sum of solid angle * direction.
    std::vector<glm::dvec4> sums(count);
    const auto each_row = [&](int rows, const auto& body) {
        parallel_for(0, static_cast<std::size_t>(rows), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end && goes_on(); ++row) {
                body(static_cast<int>(row));
            }
        });
    };
    each_row(sizes_[0], [&](int leaf_row) {
        const int first = leaf_row * texels_per_leaf_;
        for (int row = first; row < std::min(size, first + texels_per_leaf_); ++row) {
            for (int column = 0; column < size; ++column) {
                const auto texel = static_cast<std::size_t>(row * size + column);
                const glm::dvec3 towards(1, (2.0 * column + 1) / size - 1,
                                         (2.0 * row + 1) / size - 1);
                directions_[texel] = glm::vec3(glm::normalize(towards));
                sums[static_cast<std::size_t>(leaf_row * sizes_[0] + column / texels_per_leaf_)] +=
                    exact[texel] * glm::dvec4(directions_[texel], 1);
            }
        }
    });
    int covered = texels_per_leaf_;  // texels along an edge of a node
    for (std::size_t level = 0; level < sizes_.size(); ++level, covered *= 2) {
        const int n = sizes_[level];
        each_row(n, [&](int row) {
            for (int column = 0; column < n; ++column) {
                const std::size_t at = offsets_[level] + static_cast<std::size_t>(row * n + column);
                if (level > 0) {
                    const int below = sizes_[level - 1];
                    for (int r = 2 * row; r < std::min(2 * row + 2, below); ++r) {
                        for (int c = 2 * column; c < std::min(2 * column + 2, below); ++c) {
                            sums[at] +=
                                sums[offsets_[level - 1] + static_cast<std::size_t>(r * below + c)];
                        }
                    }
                }
                RadianceNode& node = nodes_[at];
                const glm::vec3 center{sums[at] / sums[at].w};
                node.solid_angle = static_cast<float>(sums[at].w);
                // Leaves of one texel are points: their spread is 0 but for rounding.
                node.center = glm::vec4(center, covered == 1 ? 0.0F : spread(center));
                node.light_centers.fill(node.center);
                node.radiance = glm::vec4(0);
                node.radius = 0;
                for (const int y : {row * covered, std::min(size, (row + 1) * covered)}) {
                    for (const int x : {column * covered, std::min(size, (column + 1) * covered)}) {
                        const glm::dvec3 corner(1, 2.0 * x / size - 1, 2.0 * y / size - 1);
                        node.radius = std::max(
                            node.radius, glm::distance(center, glm::vec3(glm::normalize(corner))));
                    }
                }
            }
        });
    }
}

std::vector<RadianceNode> TreeShape::tree(std::span<const glm::vec4> texels,
                                          const std::function<bool()>& goes_on) const {
    std::vector<RadianceNode> nodes = nodes_;
    std::vector<Moments> moments(nodes.size());
    for (int row = 0; row < size_; ++row) {
        if (row % 64 == 63 && !goes_on()) return {};
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
