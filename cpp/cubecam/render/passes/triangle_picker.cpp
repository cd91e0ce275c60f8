#include "cubecam/render/passes/triangle_picker.hpp"

#include "cubecam/render/passes/screen_bounds.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace cubecam {
namespace {

/// What is taken for wasted while it is not known: a box that is partly in view says little.
constexpr double assumed_waste = 0.5;

constexpr std::size_t bits = 64;

bool is_parted(const NodeSnapshot& node, const MeshData& data, const PartCosts& costs) {
    if (node.unbounded || data.triangles()->size() < costs.fewest_triangles) return false;
    const MaterialTraits& traits = node.material.value.traits();
    return !traits.user_code || !traits.user_code->counts_triangles;
}

double displacement_of(const NodeSnapshot& node) {
    const MaterialTraits& traits = node.material.value.traits();
    return traits.moves_vertices() ? traits.user_code->displacement.value_or(0.0F) : 0.0;
}

}  // namespace

std::optional<IndexRange> TrianglePicker::pick(const NodeSnapshot& node, const MeshData& data,
                                               const GpuMesh& mesh, const View& view,
                                               const Rect& rect, const glm::ivec2& size) {
    const PartCosts& costs = cache_->part_costs();
    if (!is_parted(node, data, costs)) return std::nullopt;
    const PartFrustum part = Culling(view).part_frustum(node, rect, size.x, size.y);
    const Overlap overlap =
        part.frustum.overlap(node.bounds.center(), 0.5 * node.bounds.extent(), part.error);
    if (overlap == Overlap::all) return std::nullopt;
    const std::vector<glm::uvec3>& triangles = *data.triangles();
    const auto all = static_cast<double>(triangles.size());
    const TriangleClusters* clusters = cache_->clusters(data, assumed_waste * all);
    if (clusters == nullptr) return std::nullopt;
    ranges_.clear();
    const auto most = static_cast<std::size_t>(costs.most_share * all);
    const std::size_t count =
        clusters->find(part.frustum, displacement_of(node), part.error, most, ranges_);
    if (count > most) return std::nullopt;
    return mesh.index_type == GL_UNSIGNED_SHORT
               ? append<std::uint16_t>(triangles, *clusters, count)
               : append<std::uint32_t>(triangles, *clusters, count);
}

/// A table of bits sorts the triangles: it costs less than comparing them.
template <class Index>
IndexRange TrianglePicker::append(const std::vector<glm::uvec3>& triangles,
                                  const TriangleClusters& clusters, std::size_t count) {
    const std::size_t words = (triangles.size() + bits - 1) / bits;
    if (marks_.size() < words) marks_.resize(words, 0);
    const std::size_t aligned = (bytes_.size() + 3) / 4 * 4;
    bytes_.resize(aligned + 3 * count * sizeof(Index));  // before any mark: it may throw
    std::size_t first = words;
    std::size_t last = 0;
    for (const TriangleClusters::Range& range : ranges_) {
        for (std::size_t i = range.first; i < range.last; ++i) {
            const std::uint32_t triangle = clusters.order()[i];
            const std::size_t word = triangle / bits;
            marks_[word] |= std::uint64_t{1} << (triangle % bits);
            first = std::min(first, word);
            last = std::max(last, word);
        }
    }
    std::byte* to = bytes_.data() + aligned;
    for (std::size_t word = first; word <= last && word < words; ++word) {
        for (std::uint64_t marks = marks_[word]; marks != 0; marks &= marks - 1) {
            const glm::uvec3& triangle =
                triangles[word * bits + static_cast<std::size_t>(std::countr_zero(marks))];
            const Index corners[3] = {static_cast<Index>(triangle.x),
                                      static_cast<Index>(triangle.y),
                                      static_cast<Index>(triangle.z)};
            std::memcpy(to, corners, sizeof(corners));
            to += sizeof(corners);
        }
        marks_[word] = 0;
    }
    return {static_cast<GLintptr>(aligned), static_cast<GLsizei>(3 * count)};
}

}  // namespace cubecam
