#pragma once

#include "cubecam/geometry/deformation.hpp"
#include "cubecam/geometry/influences.hpp"
#include "cubecam/geometry/morph_target.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cubecam {

/// Axis-aligned bounds: the lowest and the highest corner.
struct Bounds {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};

    glm::dvec3 center() const { return 0.5 * (low + high); }
    glm::dvec3 extent() const { return high - low; }

    bool operator==(const Bounds&) const = default;
};

/// The box round a transformed box: |M| * half extents round M * center
/// (J. Arvo, "Transforming Axis-Aligned Bounding Boxes", Graphics Gems, 1990).
inline Bounds transformed(const Bounds& bounds, const glm::dmat4& m) {
    const glm::dvec3 center(m * glm::dvec4(bounds.center(), 1.0));
    const glm::dvec3 half = 0.5 * bounds.extent();
    const glm::dvec3 reach = glm::abs(glm::dvec3(m[0])) * half.x +
                             glm::abs(glm::dvec3(m[1])) * half.y +
                             glm::abs(glm::dvec3(m[2])) * half.z;
    return {center - reach, center + reach};
}

/// Identifies a mesh across all its updates. It lives as long as the mesh or any of its data.
struct MeshIdentity {};

/// One value for each vertex, and the revision at which the values were set.
template <class T>
struct VertexStream {
    std::shared_ptr<const std::vector<T>> values;  ///< null: none
    std::uint64_t revision = 0;
};

class MeshData;

/// A simpler form of a mesh, a level of detail, as it is given.
struct MeshLevel {
    std::vector<glm::uvec3> triangles;  ///< between vertices of the mesh
    /// At most so far lie points of either surface from the other, in the mesh's units.
    double error;
};

/// A level of detail as it is drawn.
struct DrawnLevel {
    std::shared_ptr<const std::vector<glm::uvec3>> triangles;  ///< between vertices of the mesh
    double error;
    std::shared_ptr<const MeshData> mesh;  ///< the same surface with the vertices that it uses
};

/// New values of vertices; the mesh keeps its values where a member is absent.
struct MeshUpdate {
    std::optional<std::vector<glm::vec3>> positions;
    std::optional<std::vector<glm::vec3>>
        normals;                                ///< empty: smooth normals, also after later updates
    std::optional<std::vector<glm::vec2>> uvs;  ///< empty: none
    std::optional<std::vector<glm::vec4>> colors;                 ///< empty: none
    std::optional<std::vector<glm::vec2>> uvs1;                   ///< empty: none
    std::optional<std::vector<glm::vec4>> tangents;               ///< empty: none
    std::optional<std::shared_ptr<const Influences>> influences;  ///< null: none
    std::optional<MorphTargets> targets;
    std::optional<std::vector<MeshLevel>> levels;  ///< empty: none

    bool changes_vertices() const {
        return positions || normals || uvs || colors || uvs1 || tangents;
    }
    bool empty() const { return !changes_vertices() && !influences && !targets && !levels; }
};

/// Indexed triangles with normals and, if the mesh has them, two sets of texture coordinates,
/// colours, tangents, joints and morph targets, at one moment: the data never change. Copies share
/// the values.
class MeshData {
public:
    template <class T>
    using Array = std::shared_ptr<const std::vector<T>>;

    struct Arrays {
        std::vector<glm::vec3> positions;
        std::vector<glm::uvec3> triangles;  ///< counter-clockwise seen from outside
        std::vector<glm::vec3> normals;     ///< empty: smooth ones are computed
        std::vector<glm::vec2> uvs;         ///< empty: none
        std::vector<glm::vec4> colors;      ///< empty: none
        std::vector<glm::vec2> uvs1;        ///< empty: none
        std::vector<glm::vec4> tangents;    ///< empty: none
        std::shared_ptr<const Influences> influences = nullptr;  ///< null: none
        MorphTargets targets = {};
        std::vector<MeshLevel> levels = {};  ///< from fine to coarse
    };

    /// @throws std::invalid_argument for no triangle, a value that is not finite, lengths that
    /// differ from positions', or errors of levels that are negative or decrease;
    /// @throws std::out_of_range for an index beyond the vertices.
    explicit MeshData(Arrays arrays);

    const Array<glm::vec3>& positions() const { return positions_.values; }
    const Array<glm::uvec3>& triangles() const { return triangles_; }
    const Array<glm::vec3>& normals() const { return normals_.values; }
    const Array<glm::vec2>& uvs() const { return uvs_.values; }        ///< null: none
    const Array<glm::vec4>& colors() const { return colors_.values; }  ///< null: none
    /// A second set of texture coordinates; null: none.
    const Array<glm::vec2>& uvs1() const { return uvs1_.values; }
    /// uvs() for the set 0, uvs1() for the set 1.
    const Array<glm::vec2>& uvs(int set) const { return set == 0 ? uvs() : uvs1(); }
    /// xyz: unit vectors along +u; w: 1 or -1, the factor of cross(normal, xyz), which points along
    /// +v. Null: none.
    const Array<glm::vec4>& tangents() const { return tangents_.values; }
    /// The joints of each vertex; null: none.
    const std::shared_ptr<const Influences>& influences() const { return influences_; }
    /// Null: none.
    const std::shared_ptr<const MorphTargets>& targets() const { return targets_; }
    /// Levels of detail, from fine to coarse; null: none.
    const Array<DrawnLevel>& levels() const { return levels_; }
    std::size_t target_count() const { return targets_ ? targets_->size() : 0; }
    /// Of the positions, whatever joints and morph targets make of them.
    const Bounds& bounds() const { return bounds_; }
    std::uint64_t revision() const { return revision_; }

    /// Whether the normals are smooth normals, computed again whenever the positions change.
    bool smooth() const { return smooth_; }
    /// Whether any vertex colour has an alpha below one.
    bool translucent_colors() const { return translucent_colors_; }

    // The GPU cache uses these: the identity finds its copy of the mesh, and it uploads the streams
    // whose revision differs.

    const std::shared_ptr<const MeshIdentity>& identity() const { return identity_; }
    const VertexStream<glm::vec3>& position_stream() const { return positions_; }
    const VertexStream<glm::vec3>& normal_stream() const { return normals_; }
    const VertexStream<glm::vec2>& uv_stream() const { return uvs_; }
    const VertexStream<glm::vec4>& color_stream() const { return colors_; }
    const VertexStream<glm::vec2>& uv1_stream() const { return uvs1_; }
    const VertexStream<glm::vec4>& tangent_stream() const { return tangents_; }

    /// The same mesh after an update. New positions without normals keep normals that were given;
    /// smooth normals are computed again. New values of vertices end the levels of detail.
    /// @throws std::invalid_argument for another number of vertices, or a value that is not finite.
    MeshData updated(MeshUpdate update) const;

    /// The same triangles without shared vertices, so that their smooth normals are those of their
    /// planes. The vertices of triangle i are 3 i, 3 i + 1 and 3 i + 2. The result has no morph
    /// targets: they are applied first.
    /// @param before the result for an earlier moment of this mesh: the new one is the same mesh
    /// after an update, so that the GPU gets only the arrays that changed. Null: none.
    MeshData flat_shaded(const MeshData* before = nullptr) const;

    /// The same triangles with the tangents of MikkTSpace (tangents.hpp) for one of the sets of
    /// texture coordinates. A vertex that needs several tangents becomes several vertices: the
    /// first keeps its place, the others follow all vertices. The result has no morph targets.
    /// @param uv_set 0: uvs(), 1: uvs1(); the mesh must have them.
    /// @param before as for flat_shaded().
    MeshData with_tangents(int uv_set, const MeshData* before = nullptr) const;

    /// The same data as a new mesh, with an identity of its own.
    MeshData of_new_mesh() &&;

    /// This mesh with weights of its morph targets; targets without a weight are not added. The
    /// result has no morph targets.
    /// @param before the result for other weights or an earlier moment of this mesh, as for
    /// flat_shaded().
    MeshData morphed(std::span<const float> weights, const MeshData* before = nullptr) const;

    /// This mesh, which has joints, as these matrices place it. Smooth normals are those of the new
    /// shape.
    /// @param joints a matrix for each joint that the mesh names.
    /// @param before the result for other matrices or another form of the mesh: if the triangles
    /// are the same, the new one is the same mesh after an update. Null: none.
    MeshData skinned(std::span<const JointMatrix> joints, const MeshData* before = nullptr) const;

    /// This mesh, which flat_shaded() or with_tangents() made of `base`, with its morph targets.
    MeshData with_targets_of(const MeshData& base) &&;

    /// A copy that is centred at the origin and scaled so that its largest extent is `size`.
    /// @throws std::invalid_argument for a mesh of no extent, and for one with joints.
    MeshData centered_and_scaled(double size) const;

private:
    void set_positions(std::vector<glm::vec3> positions);
    void set_normals(std::vector<glm::vec3> normals);
    void set_uvs(std::vector<glm::vec2> uvs);
    void set_uvs1(std::vector<glm::vec2> uvs);
    void set_tangents(std::vector<glm::vec4> tangents);
    void set_colors(std::vector<glm::vec4> colors);
    void set_influences(std::shared_ptr<const Influences> influences);
    void set_targets(MorphTargets targets);
    void set_levels(const std::vector<MeshLevel>& levels);
    /// Makes the drawn forms of the levels again, with errors multiplied by `factor`.
    void make_levels_again(double factor);
    DrawnLevel drawn_level(Array<glm::uvec3> level_triangles, double error) const;
    /// Sets positions or normals that a deformation made, which need no checks.
    void set_deformed_positions(std::vector<glm::vec3> positions);
    void set_deformed_normals(std::vector<glm::vec3> normals, bool lost);
    void set_deformed_tangents(std::vector<glm::vec4> tangents, bool lost);

    std::shared_ptr<const MeshIdentity> identity_;
    Array<glm::uvec3> triangles_;
    VertexStream<glm::vec3> positions_;
    VertexStream<glm::vec3> normals_;
    VertexStream<glm::vec2> uvs_;
    VertexStream<glm::vec4> colors_;
    VertexStream<glm::vec2> uvs1_;
    VertexStream<glm::vec4> tangents_;
    /// For each vertex the vertex of another mesh from which with_tangents() made it; null: no such
    /// mesh, or all vertices are its vertices.
    Array<std::uint32_t> sources_;
    std::shared_ptr<const Influences> influences_;
    /// Those of the mesh from which flat_shaded() or with_tangents() made `influences_`.
    std::shared_ptr<const Influences> influences_of_;
    std::shared_ptr<const MorphTargets> targets_;
    Array<DrawnLevel> levels_;
    Bounds bounds_;
    bool smooth_ = false;
    bool translucent_colors_ = false;
    std::uint64_t revision_;
};

/// Vertex normals as the sum of the triangles' normals weighted by the angle at the vertex
/// (G. Thuermer, C. Wuethrich, "Computing Vertex Normals from Polygonal Facets", JGT 3(1), 1998).
/// A vertex of no triangle, or of degenerate ones only, gets +Y.
std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& positions,
                                      const std::vector<glm::uvec3>& triangles);

}  // namespace cubecam
