#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cubecam {

/// Axis-aligned bounds; `empty()` until a point was added.
struct Bounds {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};

    glm::dvec3 center() const { return 0.5 * (low + high); }
    glm::dvec3 extent() const { return high - low; }
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

/// Indexed triangles with smooth normals, and texture coordinates and colours where there are some.
///
/// Immutable, so that threads and renderers share it: the GPU copy is keyed by `revision()`.
class Mesh {
public:
    template <class T>
    using Array = std::shared_ptr<const std::vector<T>>;

    struct Arrays {
        std::vector<glm::vec3> positions;
        std::vector<glm::uvec3> triangles;  ///< counter-clockwise seen from outside
        std::vector<glm::vec3> normals;     ///< empty: smooth ones are computed
        std::vector<glm::vec2> uvs;         ///< empty: none
        std::vector<glm::vec4> colors;      ///< empty: none
    };

    /// @throws std::invalid_argument for no triangle, a value that is not finite, or lengths that
    /// differ from positions';
    /// @throws std::out_of_range for an index beyond the vertices.
    explicit Mesh(Arrays arrays);

    const Array<glm::vec3>& positions() const { return positions_; }
    const Array<glm::uvec3>& triangles() const { return triangles_; }
    const Array<glm::vec3>& normals() const { return normals_; }
    const Array<glm::vec2>& uvs() const { return uvs_; }        ///< null: none
    const Array<glm::vec4>& colors() const { return colors_; }  ///< null: none
    const Bounds& bounds() const { return bounds_; }
    std::uint64_t revision() const { return revision_; }

    /// Whether any vertex colour has an alpha below one.
    bool translucent_colors() const { return translucent_colors_; }

private:
    Array<glm::vec3> positions_;
    Array<glm::uvec3> triangles_;
    Array<glm::vec3> normals_;
    Array<glm::vec2> uvs_;
    Array<glm::vec4> colors_;
    Bounds bounds_;
    bool translucent_colors_ = false;
    std::uint64_t revision_;
};

/// Vertex normals as the sum of the triangles' normals weighted by the angle at the vertex
/// (G. Thuermer, C. Wuethrich, "Computing Vertex Normals from Polygonal Facets", JGT 3(1), 1998).
/// A vertex of no triangle, or of degenerate ones only, gets +Y.
std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& positions,
                                      const std::vector<glm::uvec3>& triangles);

/// The same mesh centred at the origin and scaled so that its largest extent is `size`.
Mesh centred_and_scaled(const Mesh& mesh, double size);

}  // namespace cubecam
