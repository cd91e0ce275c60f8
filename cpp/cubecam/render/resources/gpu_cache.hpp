#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/geometry/mesh.hpp"
#include "cubecam/geometry/triangle_clusters.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/image/image.hpp"
#include "cubecam/render/resources/weak_cache.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <array>
#include <cstdint>
#include <memory>

namespace cubecam {

/// Vertex attribute numbers, `layout(location =)` in the shaders. The attributes of a view advance
/// once for each instance: on llvmpipe this costs a fraction of a lookup by gl_InstanceID in a
/// storage buffer (docs/adr/0002).
namespace attribute {
inline constexpr GLuint position = 0;
inline constexpr GLuint normal = 1;
inline constexpr GLuint uv = 2;
inline constexpr GLuint color = 3;
inline constexpr GLuint view_matrix = 4;  ///< four columns
inline constexpr GLuint view_eye = 8;
inline constexpr GLuint view_position = 9;
inline constexpr GLuint view_forward = 10;
// If the instances are nodes, these attributes have the numbers of a view's.
inline constexpr GLuint model = 4;          ///< four columns
inline constexpr GLuint normal_matrix = 8;  ///< three columns
inline constexpr GLuint material = 11;      ///< two vectors
inline constexpr GLuint id_and_label = 13;
// The attributes of a vertex that few materials read.
inline constexpr GLuint tangent = 14;
inline constexpr GLuint uv1 = 15;
}  // namespace attribute

/// Binding points of vertex buffers in every vertex array.
namespace vertex_buffer {
inline constexpr GLuint positions = 0;
inline constexpr GLuint records = 1;  ///< of views or of nodes, one for each instance
inline constexpr GLuint normals = 2;
inline constexpr GLuint uvs = 3;
inline constexpr GLuint colors = 4;
inline constexpr GLuint tangents = 5;
inline constexpr GLuint uvs1 = 6;
}  // namespace vertex_buffer

/// The GPU's copy of a VertexStream.
struct GpuStream {
    gl::Buffer buffer;
    std::size_t bytes = 0;
    std::uint64_t revision = 0;  ///< of its values
    bool writable = false;       ///< since the first update
};

struct GpuMesh {
    gl::VertexArray array;      ///< with the attributes of a view
    gl::VertexArray instanced;  ///< with the attributes of a node
    // Whether gl::settle_vertex_array() has seen them.
    mutable bool array_settled = false;
    mutable bool instanced_settled = false;
    gl::Buffer indices;
    GLenum index_type = GL_UNSIGNED_SHORT;
    GLsizei index_count = 0;
    std::uint64_t revision = 0;  ///< of its data
    // Each stream has a buffer of its own, so that an update uploads only this stream, without
    // repacking.
    GpuStream positions;
    GpuStream normals;
    GpuStream uvs;
    GpuStream colors;
    GpuStream tangents;
    GpuStream uvs1;
    // The parts of the mesh, made when they are worth it (GpuCache::clusters).
    struct Clusters {
        std::uint64_t revision = 0;  ///< of the positions
        std::uint64_t first = 0;     ///< the renderer's call in which these positions came
        double wasted = 0.0;         ///< triangles that calls sent for nothing
        std::unique_ptr<const TriangleClusters> made;
    };
    Clusters clusters;
};

/// When sending a part of a mesh costs less than sending all of it.
struct PartCosts {
    std::size_t fewest_triangles;  ///< meshes with fewer are always sent as a whole
    double most_share;             ///< a greater share of a mesh is not worth picking
    double making;                 ///< making TriangleClusters costs as much as so many sendings
};

struct GpuTexture {
    gl::Texture texture;
    bool mipmaps = false;
};

/// The textures of shaders/include/probe_grid.glsl.
struct GpuProbeGrid {
    gl::Texture light;
    gl::Texture distances;
    std::uint64_t revision = 0;
};

/// The GPU's copies of the meshes, images and cubemaps that were drawn.
class GpuCache {
public:
    explicit GpuCache(const gl::Context& context);

    /// Uploads only the streams that changed since the last time. Within one call of the renderer a
    /// mesh must have one state: other data of the same mesh overwrite the copy that was returned
    /// before.
    const GpuMesh& mesh(const MeshData& mesh);
    /// Of this driver.
    const PartCosts& part_costs() const;
    /// The triangles of a mesh in groups; null: they are not made yet. Making them costs as much as
    /// sending the mesh PartCosts::making times, so they are made once so much was sent for
    /// nothing, which is at most twice what the best choice would have cost (A. Karlin et al.,
    /// "Competitive Snoopy Caching", Algorithmica 3, 1988); and not in the first call that sees
    /// these positions, since a mesh may have others in each call.
    /// @param wasted triangles that this draw call sends for nothing if the result is null.
    const TriangleClusters* clusters(const MeshData& mesh, double wasted);
    /// @throws std::invalid_argument that names the driver's limit, for a larger picture; cube()
    /// does the same.
    /// @param colors whether a map of colours looks it up, which gets decoded numbers if the image
    /// decodes (Image::decodes).
    const GpuTexture& image(const std::shared_ptr<const Image>& image, bool colors = false);
    /// Uploads only the faces that changed since the last time.
    const GpuTexture& cube(const CubeSnapshot& cube);
    /// The same with box-filtered levels, whether the cubemap has mipmaps or not.
    const GpuTexture& box_mipmaps(const CubeSnapshot& cube);

    /// Makes the textures again where the grid changed since the last time.
    const GpuProbeGrid& probe_grid(const ProbeGridSnapshot& grid);

    /// Each call of the renderer begins with it.
    void sweep();

    /// A vertex array with only the attributes of a view, for a skybox.
    const gl::VertexArray& views_only() const { return views_only_; }

private:
    struct GpuCube {
        GpuTexture texture;
        std::array<std::uint64_t, 6> face_revisions{};
    };

    const GpuTexture& upload(WeakCache<CubeMap, GpuCube>& to, const CubeSnapshot& cube,
                             bool mipmaps);

    const gl::Context* context_;
    const GladGLContext* gl_;
    std::uint64_t calls_ = 0;  ///< of the renderer
    gl::VertexArray views_only_;
    WeakCache<const MeshIdentity, GpuMesh> meshes_;
    WeakCache<const Image, GpuTexture> images_;
    WeakCache<const Image, GpuTexture> decoded_images_;
    WeakCache<CubeMap, GpuCube> cubes_;
    WeakCache<CubeMap, GpuCube> box_mipmaps_;  ///< of cubemaps without mipmaps
    WeakCache<ProbeGrid, GpuProbeGrid> probe_grids_;
};

}  // namespace cubecam
