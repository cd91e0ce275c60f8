#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/geometry/mesh_data.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cubecam {

/// Numbers that several states of a grid share.
template <class Number>
using SharedNumbers = std::shared_ptr<const std::vector<Number>>;

/// Light in a box, captured at the nodes of a grid (docs/adr/0031).
struct ProbeGridValue {
    Bounds box;  ///< the first and the last nodes lie on its sides
    glm::ivec3 counts{2};
    int resolution = 16;  ///< texels along an edge of a node's octahedral map of distances
    /// Integrals of radiance times the basis of sh_basis(): [nz][ny][nx][9][3].
    SharedNumbers<float> coefficients;
    /// Means of the distance and of its square round a direction: [nz][ny][nx][R][R][2].
    SharedNumbers<float> distances;
    /// 0: the node lies in a body and counts only where no other node does: [nz][ny][nx].
    SharedNumbers<std::uint8_t> active;
    int size = 32;             ///< texels along an edge of the cubes that a bake captures
    bool visibility = true;    ///< false: trilinear interpolation alone
    double normal_bias = 0.1;  ///< of the place whose visibility counts, in least steps of the grid
    double view_bias = 0.2;    ///< the same, towards the viewer

    std::size_t node_count() const;
    glm::dvec3 step() const;
    double least_step() const;

    bool operator==(const ProbeGridValue& other) const;
};

/// The largest number of texels along an edge of the grid's textures.
inline constexpr int most_grid_texels = 16384;

/// @throws std::invalid_argument for an empty or infinite box, counts below 2, a resolution outside
/// of 4..32, a size outside of 1..128, a grid that is too large for a texture, arrays of another
/// length or numbers that are not finite, and for a bias below 0.
void check(const ProbeGridValue& value);

/// A value whose arrays are those of a grid that saw nothing: black, and nothing hides anything.
ProbeGridValue empty_grid(const Bounds& box, const glm::ivec3& counts, int resolution);

class ProbeGrid {
public:
    using State = Versioned<ProbeGridValue>::State;

    explicit ProbeGrid(ProbeGridValue value);
    ProbeGrid(const ProbeGrid&) = delete;
    ProbeGrid& operator=(const ProbeGrid&) = delete;

    State state() const { return value_.state(); }
    ProbeGridValue value() const { return value_.value(); }
    const Revision& revision() const { return value_.revision(); }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](ProbeGridValue& value) {
            change(value);
            check(value);
        });
    }

private:
    Versioned<ProbeGridValue> value_;
};

}  // namespace cubecam
