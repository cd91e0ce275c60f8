#include "cubecam/geometry/triangle_clusters.hpp"

#include "cubecam/core/interrupts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cubecam {
namespace {

/// Triangles of a box of the lowest level. Fewer take more boxes to look at, more lie farther from
/// the frustum's sides (docs/adr/0033-static-geometry.md has what was measured).
constexpr std::size_t smallest = 16;
/// Boxes of a box above.
constexpr std::size_t fan = 8;

constexpr int bits_of_axis = 18;
constexpr int bits_of_pass = 11;
constexpr int passes = (3 * bits_of_axis + bits_of_pass - 1) / bits_of_pass;

struct Placed {
    std::uint64_t place;  ///< along the curve
    std::uint32_t triangle;
};

/// Moves bit i to bit 3 i, for 21 bits.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32U) & 0x1F00000000FFFFU;
    x = (x | x << 16U) & 0x1F0000FF0000FFU;
    x = (x | x << 8U) & 0x100F00F00F00F00FU;
    x = (x | x << 4U) & 0x10C30C30C30C30C3U;
    return (x | x << 2U) & 0x1249249249249249U;
}

/// Sorts by place; equal places keep their order.
void sort_by_place(std::vector<Placed>& triangles) {
    constexpr std::size_t buckets = std::size_t{1} << bits_of_pass;
    std::vector<Placed> sorted(triangles.size());
    for (int pass = 0; pass < passes; ++pass) {
        poll_interrupts();
        const auto digit = [shift = pass * bits_of_pass](const Placed& triangle) {
            return static_cast<std::size_t>(triangle.place >> shift) & (buckets - 1);
        };
        std::array<std::size_t, buckets> next{};
        for (const Placed& triangle : triangles) ++next[digit(triangle)];
        std::size_t before = 0;
        for (std::size_t& first : next) before += std::exchange(first, before);
        for (const Placed& triangle : triangles) sorted[next[digit(triangle)]++] = triangle;
        triangles.swap(sorted);
    }
}

}  // namespace

TriangleClusters::TriangleClusters(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles)
    : order_(triangles.size()) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    // The sum of the corners' coordinates: the same order as that of the middles.
    const auto sum = [&](const glm::uvec3& triangle) {
        return glm::dvec3(positions[triangle.x]) + glm::dvec3(positions[triangle.y]) +
               glm::dvec3(positions[triangle.z]);
    };
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        poll_interrupts(i);
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& position = positions[triangles[i][corner]];
            finite_ = finite_ && std::isfinite(position.x) && std::isfinite(position.y) &&
                      std::isfinite(position.z);
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
    }
    if (!finite_) return;
    constexpr double cells = (1 << bits_of_axis) - 1;
    const glm::dvec3 extent = glm::dvec3(high) - glm::dvec3(low);
    glm::dvec3 scale(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (extent[axis] > 0.0) scale[axis] = cells / (3.0 * extent[axis]);
    }
    std::vector<Placed> placed(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        poll_interrupts(i);
        const glm::dvec3 cell = (sum(triangles[i]) - 3.0 * glm::dvec3(low)) * scale;
        std::uint64_t place = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto along = static_cast<std::uint64_t>(std::clamp(cell[axis], 0.0, cells));
            place |= spread(along) << static_cast<unsigned>(axis);
        }
        placed[i] = {place, static_cast<std::uint32_t>(i)};
    }
    sort_by_place(placed);
    for (std::size_t i = 0; i < placed.size(); ++i) order_[i] = placed[i].triangle;
    make_levels(positions, triangles);
}

void TriangleClusters::make_levels(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles) {
    constexpr Box nothing{glm::vec3(std::numeric_limits<float>::infinity()),
                          glm::vec3(-std::numeric_limits<float>::infinity())};
    Level lowest{smallest, std::vector<Box>((order_.size() + smallest - 1) / smallest, nothing)};
    for (std::size_t i = 0; i < order_.size(); ++i) {
        poll_interrupts(i);
        Box& box = lowest.boxes[i / smallest];
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& position = positions[triangles[order_[i]][corner]];
            box.low = glm::min(box.low, position);
            box.high = glm::max(box.high, position);
        }
    }
    levels_.push_back(std::move(lowest));
    while (levels_.back().boxes.size() > 1) {
        const Level& below = levels_.back();
        Level level{fan * below.triangles,
                    std::vector<Box>((below.boxes.size() + fan - 1) / fan, nothing)};
        for (std::size_t i = 0; i < below.boxes.size(); ++i) {
            Box& box = level.boxes[i / fan];
            box.low = glm::min(box.low, below.boxes[i].low);
            box.high = glm::max(box.high, below.boxes[i].high);
        }
        levels_.push_back(std::move(level));
    }
}

std::size_t TriangleClusters::find(const Frustum& frustum, double growth, const glm::dvec4& error,
                                   std::size_t most, std::vector<Range>& found) const {
    struct Place {
        std::size_t level;
        std::size_t box;
    };
    std::size_t count = 0;
    std::vector<Place> open{{levels_.size() - 1, 0}};
    while (!open.empty() && count <= most) {
        const Place here = open.back();
        open.pop_back();
        const Level& level = levels_[here.level];
        const Box& box = level.boxes[here.box];
        const glm::dvec3 low(box.low);
        const glm::dvec3 high(box.high);
        const Overlap overlap =
            frustum.overlap(0.5 * (low + high), 0.5 * (high - low) + growth, error);
        if (overlap == Overlap::none) continue;
        if (overlap == Overlap::some && here.level > 0) {
            const std::size_t end =
                std::min((here.box + 1) * fan, levels_[here.level - 1].boxes.size());
            // The last that goes in comes out first.
            for (std::size_t i = end; i-- > here.box * fan;) open.push_back({here.level - 1, i});
            continue;
        }
        const std::size_t first = here.box * level.triangles;
        const std::size_t last = std::min(first + level.triangles, order_.size());
        count += last - first;
        if (!found.empty() && found.back().last == first) {
            found.back().last = last;
        } else {
            found.push_back({first, last});
        }
    }
    return count;
}

}  // namespace cubecam
