#include "cubecam/render/resources/probe_grid_block.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace cubecam {
namespace {

/// The factors of the basis of sh_basis() times 1, 2/3 and 1/4: what a cosine lobe over pi keeps of
/// each order (R. Ramamoorthi and P. Hanrahan, "An Efficient Representation for Irradiance
/// Environment Maps", SIGGRAPH 2001).
constexpr std::array<double, 9> light_factors{
    0.28209479177387814,        0.4886025119029199 * 2 / 3, 0.4886025119029199 * 2 / 3,
    0.4886025119029199 * 2 / 3, 1.0925484305920792 / 4,     1.0925484305920792 / 4,
    0.31539156525252005 / 4,    1.0925484305920792 / 4,     0.5462742152960396 / 4};

}  // namespace

ProbeGridBlock make_probe_grid_block(const ProbeGridValue& grid, const glm::dvec3& origin) {
    ProbeGridBlock block;
    const double least = grid.least_step();
    block.first = glm::vec4(grid.box.low - origin, grid.normal_bias * least);
    block.step = glm::vec4(grid.step(), grid.view_bias * least);
    block.counts = glm::ivec4(grid.counts, grid.resolution);
    return block;
}

GridPicture light_picture(const ProbeGridValue& grid) {
    GridPicture picture{9 * grid.counts.x, grid.counts.y * grid.counts.z, {}};
    // Nodes are in the order of the arrays, x fastest, then y, then z, which is that of the rows.
    const std::size_t nodes = grid.node_count();
    picture.numbers.reserve(nodes * 36);
    const std::vector<float>& light = *grid.coefficients;
    for (std::size_t node = 0; node < nodes; ++node) {
        for (std::size_t k = 0; k < 9; ++k) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const double number = light[(node * 9 + k) * 3 + channel];
                picture.numbers.push_back(static_cast<float>(number * light_factors[k]));
            }
            picture.numbers.push_back((*grid.active)[node] != 0 ? 1.0F : 0.0F);
        }
    }
    return picture;
}

GridPicture distances_picture(const ProbeGridValue& grid) {
    const int size = grid.resolution;
    const int edge = size + 2;
    const int rows = grid.counts.y * grid.counts.z;
    GridPicture picture{edge * grid.counts.x, edge * rows, {}};
    picture.numbers.resize(static_cast<std::size_t>(picture.width) *
                           static_cast<std::size_t>(picture.height) * 2);
    const std::vector<float>& maps = *grid.distances;
    for (int row = 0; row < rows; ++row) {
        for (int x = 0; x < grid.counts.x; ++x) {
            const auto node = static_cast<std::size_t>(row * grid.counts.x + x);
            for (int i = -1; i <= size; ++i) {
                for (int j = -1; j <= size; ++j) {
                    // Beyond an edge lies the same edge, mirrored.
                    const bool off_i = i < 0 || i >= size;
                    const bool off_j = j < 0 || j >= size;
                    int from_i = std::clamp(i, 0, size - 1);
                    int from_j = std::clamp(j, 0, size - 1);
                    if (off_j) from_i = size - 1 - from_i;
                    if (off_i) from_j = size - 1 - from_j;
                    const std::size_t from =
                        (node * static_cast<std::size_t>(size) + static_cast<std::size_t>(from_i)) *
                            static_cast<std::size_t>(size) +
                        static_cast<std::size_t>(from_j);
                    const auto to = static_cast<std::size_t>(row * edge + i + 1) *
                                        static_cast<std::size_t>(picture.width) +
                                    static_cast<std::size_t>(x * edge + j + 1);
                    picture.numbers[to * 2] = maps[from * 2];
                    picture.numbers[to * 2 + 1] = maps[from * 2 + 1];
                }
            }
        }
    }
    return picture;
}

}  // namespace cubecam
