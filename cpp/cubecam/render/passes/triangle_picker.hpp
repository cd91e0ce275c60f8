#pragma once

#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glad/gl.h>
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cubecam {

/// Indices in a buffer of TrianglePicker::bytes(), of the type of the mesh's own.
struct IndexRange {
    GLintptr offset;  ///< in bytes
    GLsizei count;
};

/// Finds the triangles of large meshes that can touch a rectangle of a picture, so that only these
/// are sent. The others cover none of its pixels, and those that are sent keep their order: the
/// pixels have the same bits as if the whole mesh were sent (docs/adr/0033-static-geometry.md).
class TrianglePicker {
public:
    explicit TrianglePicker(GpuCache& cache) : cache_(&cache) {}

    /// Forgets all indices.
    void start() { bytes_.clear(); }

    /// The triangles of a node that can touch `rect` in a picture of `size`; none: the whole mesh
    /// is to be sent. A count of 0: nothing is to be sent.
    /// @param data the node's mesh, or a level of detail of it.
    std::optional<IndexRange> pick(const NodeSnapshot& node, const MeshData& data,
                                   const GpuMesh& mesh, const View& view, const Rect& rect,
                                   const glm::ivec2& size);

    /// The indices of all picked triangles.
    const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    template <class Index>
    IndexRange append(const std::vector<glm::uvec3>& triangles, const TriangleClusters& clusters,
                      std::size_t count);

    GpuCache* cache_;
    std::vector<std::byte> bytes_;
    std::vector<TriangleClusters::Range> ranges_;
    std::vector<std::uint64_t> marks_;  ///< one bit a triangle; all are 0 between two calls
};

}  // namespace cubecam
