#pragma once

#include "cubecam/math/frustum.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cubecam {

/// The triangles of a mesh in small groups that lie close together, each with its bounds, in a tree
/// of bounds: it finds the triangles that a frustum may show without looking at the others.
///
/// The triangles are sorted along a curve through space that keeps near points together (G. Morton,
/// "A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing", IBM, 1966). A
/// box of the lowest level has the next few of them, a box above has the next few boxes.
class TriangleClusters {
public:
    /// Memory that the constructor takes for each triangle, at its largest.
    static constexpr std::size_t bytes_of_making = 40;

    /// Polls for interrupts. There must be at least one triangle.
    TriangleClusters(const std::vector<glm::vec3>& positions,
                     const std::vector<glm::uvec3>& triangles);

    /// Whether all corners are finite; if not, nothing can be found.
    bool finite() const { return finite_; }

    /// Numbers of triangles, in the order of the boxes.
    std::span<const std::uint32_t> order() const { return order_; }

    /// A part of order(): from `first` up to `last`, which is excluded.
    struct Range {
        std::size_t first;
        std::size_t last;
    };

    /// Finds all triangles that the frustum may show, and some others, as parts of order() that do
    /// not overlap. Gives up once they have more than `most` triangles.
    /// @param growth by how much each corner may lie beside its place, in the mesh's units.
    /// @param error see Frustum::may_show.
    /// @return the number of triangles; more than `most`: it gave up.
    std::size_t find(const Frustum& frustum, double growth, const glm::dvec4& error,
                     std::size_t most, std::vector<Range>& found) const;

private:
    struct Box {
        glm::vec3 low;
        glm::vec3 high;
    };
    struct Level {
        std::size_t triangles;  ///< of each box but the last
        std::vector<Box> boxes;
    };

    void make_levels(const std::vector<glm::vec3>& positions,
                     const std::vector<glm::uvec3>& triangles);

    std::vector<std::uint32_t> order_;
    std::vector<Level> levels_;  ///< the last has one box
    bool finite_ = true;
};

}  // namespace cubecam
