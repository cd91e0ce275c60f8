#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cubecam {

/// What a morph target adds to the vertices of a mesh at a weight of 1 (glTF 2.0, section 3.7.2.2).
/// It never changes.
class MorphTarget {
public:
    template <class T>
    using Array = std::shared_ptr<const std::vector<T>>;

    /// The values of an empty array stay as they are.
    struct Arrays {
        std::vector<glm::vec3> positions;
        std::vector<glm::vec3> normals;
        std::vector<glm::vec3> tangents;  ///< without the sign, which stays
        std::vector<glm::vec2> uvs;
        std::vector<glm::vec4> colors;
        std::vector<glm::vec2> uvs1;
    };

    /// @throws std::invalid_argument for values that are not finite, arrays of unequal lengths, or
    /// none at all.
    MorphTarget(Arrays arrays, std::string name);

    std::size_t vertices() const { return vertices_; }
    const std::string& name() const { return name_; }
    // Null: nothing is added.
    const Array<glm::vec3>& positions() const { return positions_; }
    const Array<glm::vec3>& normals() const { return normals_; }
    const Array<glm::vec3>& tangents() const { return tangents_; }
    const Array<glm::vec2>& uvs() const { return uvs_; }
    const Array<glm::vec4>& colors() const { return colors_; }
    const Array<glm::vec2>& uvs1() const { return uvs1_; }

    /// The target for a mesh of some vertices of this target's mesh, in this order.
    MorphTarget gathered(const std::vector<std::uint32_t>& vertices) const;
    /// The target for a mesh whose positions are scaled.
    MorphTarget scaled(double factor) const;

private:
    template <class T>
    Array<T> taken(std::vector<T> values, const char* name);

    std::size_t vertices_ = 0;
    std::string name_;
    Array<glm::vec3> positions_;
    Array<glm::vec3> normals_;
    Array<glm::vec3> tangents_;
    Array<glm::vec2> uvs_;
    Array<glm::vec4> colors_;
    Array<glm::vec2> uvs1_;
};

/// The morph targets of a mesh, in the order of their weights.
using MorphTargets = std::vector<std::shared_ptr<const MorphTarget>>;

}  // namespace cubecam
