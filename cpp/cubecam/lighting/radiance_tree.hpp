/// The radiance of one face as a quadtree of sums. Only the .cpp files of lighting/ include this
/// header.
///
/// Directions here are in the axes of the face (cube_face.hpp): x along its major axis, y along s,
/// z along t. So the geometry is the same for all six faces.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cubecam {

/// A place where light of a square of texels acts: the mean direction, each texel weighted by its
/// light. w: (1 - |xyz|^2) / 2, by which the spread of the square raises the mean of 1 - N.l.
using LightCenter = glm::vec4;

/// A square of texels of a face. The kernels read these 96 bytes.
struct alignas(32) RadianceNode {
    LightCenter center;  ///< each texel weighted by its solid angle
    /// Of red, green and blue, so that small and coloured lamps are where they are.
    std::array<LightCenter, 3> light_centers;
    glm::vec4 radiance;  ///< integral over the square
    float solid_angle;
    float radius;  ///< from the center to the furthest corner
};

/// The exact solid angles, seen from the center of the cube, of the texels of a face, row by row:
/// integrals of (1 + a^2 + b^2)^(-3/2), where a and b go from -1 to 1 along the face.
std::vector<double> texel_solid_angles(int size);

/// Radiance that sums can hold: NaN counts as 0, infinity as 65504, the largest float16, and finite
/// numbers are clamped to 1e30.
glm::vec4 countable_radiance(const glm::vec4& value);

/// Sizes and places of the nodes of a face, without its light.
class TreeShape {
public:
    /// `leaf_size`: leaves along an edge are at most about as many. A leaf is one texel if the face
    /// has not more; else a square of several texels. `goes_on` is called now and then, on any
    /// thread; once it returned false, the shape is of no use.
    TreeShape(int size, int leaf_size, const std::function<bool()>& goes_on);

    int size() const { return size_; }
    int level_count() const { return static_cast<int>(sizes_.size()); }
    /// Nodes along an edge; level 0 has the leaves, the last level has one node.
    int nodes_along(int level) const { return sizes_[static_cast<std::size_t>(level)]; }
    std::size_t offset(int level) const { return offsets_[static_cast<std::size_t>(level)]; }
    std::size_t node_count() const { return nodes_.size(); }

    /// The nodes of a face whose texels are these: size * size, row by row. `goes_on` is called now
    /// and then; if it returns false, the result is empty.
    std::vector<RadianceNode> tree(std::span<const glm::vec4> texels,
                                   const std::function<bool()>& goes_on) const;

private:
    int size_;
    int texels_per_leaf_;  ///< along an edge
    std::vector<int> sizes_;
    std::vector<std::size_t> offsets_;
    std::vector<float> solid_angles_;    ///< of texels, one quadrant repeated: size * size
    std::vector<glm::vec3> directions_;  ///< of texels
    std::vector<RadianceNode> nodes_;    ///< without light
};

}  // namespace cubecam
