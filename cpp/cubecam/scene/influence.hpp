#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/geometry/mesh_data.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cubecam {

/// The shape in which a probe counts fully: a box, or the ellipsoid that a box encloses.
enum class InfluenceShape : std::uint8_t { box, sphere };

/// Names in the order of the enum.
inline constexpr NameTable<InfluenceShape, 2> influence_shape_names{
    {{"box", InfluenceShape::box}, {"sphere", InfluenceShape::sphere}}};

constexpr std::string_view to_string(InfluenceShape shape) {
    return name_of(influence_shape_names[static_cast<std::size_t>(shape)]);
}

/// Where a probe counts in a ProbeBlend.
struct InfluenceValue {
    std::optional<Bounds> box;  ///< in the space of ParallaxValue::proxy_matrix; none: everywhere
    InfluenceShape shape = InfluenceShape::box;
    double blend_distance = 1.0;  ///< over which it falls to 0 outside the shape, world units

    bool operator==(const InfluenceValue&) const = default;
};

/// @throws std::invalid_argument for a box whose low corner is not below its high one, or a blend
/// distance that is not above 0.
void check(const InfluenceValue& value);

/// An influence at its place in the world. The weight of a probe is 1 in the shape, and falls by a
/// cubic from there to 0 at the blend distance.
struct Influence {
    bool everywhere = true;
    bool sphere = false;
    glm::dmat4 to_box{1.0};    ///< from the world to the space in which the box is from -1 to 1
    glm::dmat4 from_box{1.0};  ///< the inverse
    double blend_distance = 1.0;
    Bounds reach;  ///< the weight is 0 outside; in the world

    /// Whether the weight may be above 0 anywhere in these bounds.
    bool reaches(const Bounds& bounds) const;
    /// Whether the weight is 1 everywhere in these bounds.
    bool contains(const Bounds& bounds) const;

    bool operator==(const Influence& other) const;
};

/// `matrix` is from the space of the box to the world; none: that is the world.
Influence make_influence(const InfluenceValue& value, const std::optional<glm::dmat4>& matrix);

}  // namespace cubecam
