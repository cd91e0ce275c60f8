#pragma once

#include "cubecam/geometry/mesh_data.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/resources/body_lookup.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/weak_cache.hpp"

#include <cstdint>

namespace cubecam {

/// Draws the inner sides of meshes through which light goes, once for each mesh, whatever number of
/// nodes shows it (docs/adr/0029).
///
/// The mesh is seen from the middle of its bounds. If that is in the body, the nearest back of a
/// surface in each direction is where rays from it leave the body. If it is outside, the nearest
/// front is where they enter it. What lies behind is not seen: a ray that starts there does not
/// find its way out.
class BodyPass {
public:
    BodyPass(const gl::Context& context, GpuCache& cache, Programs& programs);

    /// The inner side of a mesh, drawn again if its vertices moved.
    BodyLookup get(const MeshData& mesh, Stats& stats);

    void sweep() { bodies_.sweep(); }

private:
    struct Body {
        gl::Texture nearness;
        gl::Texture normals;
        BodyLookup lookup;
        std::uint64_t positions_revision = 0;
        std::uint64_t normals_revision = 0;
    };

    Body make() const;
    void draw(const MeshData& mesh, const Body& body, Stats& stats);
    /// Fills what lies beside the silhouettes of a body whose middle is outside.
    void close_rim(const Body& body, Stats& stats);

    const gl::Context* context_;
    GpuCache* cache_;
    Programs* programs_;
    gl::Texture depth_;  ///< for all bodies; made when it is first needed
    gl::Texture open_;   ///< a body whose rim is not closed yet; the same
    gl::Framebuffer framebuffer_;
    gl::Buffer record_;  ///< what vertex arrays of meshes read besides their vertices
    WeakCache<const MeshIdentity, Body> bodies_;
};

/// How often a closed surface goes round a point: 0 outside, 1 inside. The sum of the solid angles
/// of the triangles over 4 pi: A. Van Oosterom and J. Strackee, "The Solid Angle of a Plane
/// Triangle", IEEE Transactions on Biomedical Engineering 30(2), 1983.
double winding_number(const MeshData& mesh, const glm::dvec3& point);

}  // namespace cubecam
