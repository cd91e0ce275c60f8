#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/geometry/mesh_data.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cubecam {

/// How a surface finds the point of the scene that a ray from it meets, in a cube that was captured
/// elsewhere.
enum class Parallax : std::uint8_t {
    none,      ///< the scene is infinitely far away
    box,       ///< the scene lies on a box
    sphere,    ///< the scene lies on the ellipsoid that a box encloses
    distance,  ///< by marching through the distances of the nearest surfaces
    layers,    ///< by marching through those of the nearest and the farthest surfaces
};

/// Names in the order of the enum.
inline constexpr NameTable<Parallax, 5> parallax_names{{{"none", Parallax::none},
                                                        {"box", Parallax::box},
                                                        {"sphere", Parallax::sphere},
                                                        {"distance", Parallax::distance},
                                                        {"layers", Parallax::layers}}};

constexpr std::string_view to_string(Parallax parallax) {
    return name_of(parallax_names[static_cast<std::size_t>(parallax)]);
}

/// How many lookups of distance a ray makes at most.
inline constexpr std::array<int, 3> parallax_fetches{6, 14, 35};

struct ParallaxValue {
    Parallax method = Parallax::none;
    std::optional<Bounds> box;               ///< of the proxy, in its own space
    std::optional<glm::dmat4> proxy_matrix;  ///< from the proxy's space to the world; none: equal
    int fetches = 14;

    bool by_proxy() const { return method == Parallax::box || method == Parallax::sphere; }
    bool by_distance() const { return method == Parallax::distance || method == Parallax::layers; }
    /// From the world to the space in which the proxy's box is from -1 to 1 on each axis.
    glm::dmat4 to_proxy() const;

    bool operator==(const ParallaxValue&) const = default;
};

/// @throws std::invalid_argument for a proxy without a box, a box whose low corner is not below its
/// high one, a matrix that is singular, not finite or a projection, or another number of fetches.
void check(const ParallaxValue& value);

}  // namespace cubecam
