#pragma once

#include "cubecam/render/passes/surface_input.hpp"
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
    glm::vec4 origin;  ///< xyz: world position that positions in the shaders count from
};

/// A planned node and the regions it shows in.
struct SurfaceItem {
    const NodeSnapshot* node;
    const GpuMesh* mesh;
    const NodeTextures* textures;
    std::uint32_t first_region;  ///< index into SurfaceItems::regions
    std::uint32_t region_count;
};

/// All that shows in any region, in the order of drawing.
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

/// How many draw calls draw the opaque items region by region.
std::size_t count_calls(const SurfaceItems& items, std::size_t regions);

/// A draw call: one node for all the views that see it, or one view of any number of nodes.
struct SurfaceCall {
    const SurfaceItem* item;  ///< of the nodes, the first
    GLuint first;             ///< of the records that it reads
    GLsizei count;
    std::optional<GLintptr> node_block;   ///< none: the records are nodes, else they are views
    std::optional<GLintptr> constants;    ///< the block of the material's constants
    std::optional<GLintptr> environment;  ///< the block of the environment, for a user's source
};

/// What is drawn into a region, or into all regions at once.
struct SurfaceCalls {
    std::vector<SurfaceCall> opaque;
    std::vector<SurfaceCall> transparent;
    std::optional<GLintptr> view_block;  ///< of the one view; none: layered
    GLuint first_sky = 0;                ///< the view records of the skybox
    GLsizei sky_count = 0;
};

/// Draw calls, and the bytes that they read on the GPU.
class SurfaceCallBuilder {
public:
    /// `ambient` is the light that falls on everything; offsets of uniform blocks are multiples of
    /// `alignment`.
    SurfaceCallBuilder(const SurfaceInput& input, const SurfaceItems& items,
                       const glm::vec3& ambient, std::size_t alignment);

    /// For all regions at once.
    SurfaceCalls layered();
    /// For one region: nodes that follow each other and differ only in what a NodeRecord holds
    /// become one call.
    SurfaceCalls of_region(std::size_t region);

    const std::vector<ViewRecord>& view_records() const { return view_records_; }
    const std::vector<NodeRecord>& node_records() const { return node_records_; }
    const std::vector<std::byte>& blocks() const { return blocks_; }

private:
    GLintptr append(const void* block, std::size_t size);
    std::optional<GLintptr> append_constants(const NodeSnapshot& node);
    SurfaceCall alone(const SurfaceItem& item);
    void add_together(const SurfaceItem& item, std::vector<SurfaceCall>& to);
    void add_sky(std::size_t first_region, std::size_t count, SurfaceCalls& to);

    const SurfaceInput& input_;
    const SurfaceItems& items_;
    const glm::vec3 ambient_;
    const std::size_t alignment_;
    std::vector<ViewRecord> views_;  ///< of each region
    std::vector<ViewRecord> view_records_;
    std::vector<NodeRecord> node_records_;
    std::vector<std::byte> blocks_;
    std::vector<glm::vec4> constants_;
};

}  // namespace cubecam
