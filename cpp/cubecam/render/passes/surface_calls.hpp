#pragma once

#include "cubecam/render/passes/surface_input.hpp"
#include "cubecam/render/passes/triangle_picker.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/node_record.hpp"
#include "cubecam/render/resources/view_record.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cubecam {

/// The uniform block `View` of shaders/include/view.glsl, std140.
struct ViewBlock {
    ViewRecord view;
    glm::vec4 origin;  ///< xyz: world position of the origin of positions in the shaders
};

/// A planned node and the regions in which it is visible.
struct SurfaceItem {
    const NodeSnapshot* node;
    const MeshData* data;  ///< the node's mesh, or a level of detail of it
    const GpuMesh* mesh;   ///< of these data
    const NodeTextures* textures;
    std::uint32_t first_region;  ///< index into SurfaceItems::regions
    std::uint32_t region_count;
};

/// All nodes that are visible in any region, in the order of drawing.
struct SurfaceItems {
    std::vector<SurfaceItem> opaque;
    std::vector<SurfaceItem> transparent;
    std::vector<std::uint32_t> regions;  ///< indices into SurfaceInput::regions, ascending for each
};

SurfaceItems find_items(const SurfaceInput& input, GpuCache& cache);

/// Whether the constants of a node's material go to the fragment shader as flat inputs.
bool has_flat_constants(const NodeSnapshot& node);
/// Whether a mesh has so many triangles that each is small: constants stay in their blocks.
bool is_dense(const NodeSnapshot& node);

/// The number of draw calls for the opaque items if each region is drawn alone.
std::size_t count_calls(const SurfaceItems& items, std::size_t regions);

/// A draw call: one node for all views that see it, or any number of nodes for one view.
struct SurfaceCall {
    const SurfaceItem* item;  ///< the first of the nodes
    GLuint first;             ///< the first record that it reads
    GLsizei count;
    std::optional<GLintptr> node_block;   ///< none: the records are nodes; otherwise views
    std::optional<GLintptr> constants;    ///< the block of the material's constants
    std::optional<GLintptr> environment;  ///< the block of the environment, if the shader reads it
    /// The block of the influences, then those of the other environments; empty: there is one.
    std::vector<GLintptr> blend;
    std::optional<IndexRange> indices = std::nullopt;  ///< none: those of the whole mesh
};

/// The draw calls for one region, or for all regions at once.
struct SurfaceCalls {
    std::vector<SurfaceCall> opaque;
    std::vector<SurfaceCall> transparent;
    std::optional<GLintptr> view_block;  ///< the block of the only view; none: layered
    GLuint first_sky = 0;                ///< the view records of the skybox
    GLsizei sky_count = 0;
    std::optional<GLintptr> sky_environment;  ///< the block of the skybox; none: it is plain
};

/// Builds draw calls, and the bytes that they read on the GPU.
class SurfaceCallBuilder {
public:
    /// `size` is that of the pictures in pixels; `ambient` is the light that falls on everything;
    /// offsets of uniform blocks are multiples of `alignment`; `picker` gets the indices of meshes
    /// that are drawn in part.
    SurfaceCallBuilder(const SurfaceInput& input, const SurfaceItems& items, const glm::ivec2& size,
                       const glm::vec3& ambient, std::size_t alignment, TrianglePicker& picker);

    /// Makes the calls for all regions at once.
    SurfaceCalls layered();
    /// Makes the calls for one region: one call draws all nodes that follow each other and differ
    /// only in the values of a NodeRecord.
    SurfaceCalls of_region(std::size_t region);

    const std::vector<ViewRecord>& view_records() const { return view_records_; }
    const std::vector<NodeRecord>& node_records() const { return node_records_; }
    const std::vector<std::byte>& blocks() const { return blocks_; }

private:
    GLintptr append(const void* block, std::size_t size);
    std::optional<GLintptr> append_constants(const NodeSnapshot& node);
    std::optional<GLintptr> append_environment(const SurfaceItem& item);
    std::vector<GLintptr> append_blend(const SurfaceItem& item);
    SurfaceCall alone(const SurfaceItem& item);
    std::optional<IndexRange> pick(const SurfaceItem& item, std::size_t region);
    void add_together(const SurfaceItem& item, std::optional<IndexRange> indices,
                      std::vector<SurfaceCall>& to);
    void add_sky(std::size_t first_region, std::size_t count, SurfaceCalls& to);

    const SurfaceInput& input_;
    const SurfaceItems& items_;
    const glm::ivec2 size_;
    const glm::vec3 ambient_;
    const std::size_t alignment_;
    TrianglePicker& picker_;
    std::vector<ViewRecord> views_;  ///< of each region
    std::vector<ViewRecord> view_records_;
    std::vector<NodeRecord> node_records_;
    std::vector<std::byte> blocks_;
    std::vector<glm::vec4> constants_;
};

}  // namespace cubecam
