#include "cubecam/lighting/filtered_cube.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/lighting/lobe_kernels.hpp"
#include "cubecam/lighting/radiance_faces.hpp"
#include "cubecam/lighting/radiance_tree.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>

// The lobe. A level for roughness r holds, for each direction N, the mean radiance
//
//   sum of L(l) w(l) / sum of w(l),   w(l) = D(h) (N.l) dl,   V = N, h = (N + l) / |N + l|
//
// (B. Karis, "Real Shading in Unreal Engine 4", 2013) with D of Trowbridge and Reitz (glTF 2.0,
// appendix B.3.2) and a = r^2:
//
//   D(h) = a^2 / (pi ((N.h)^2 (a^2 - 1) + 1)^2)
//
// As h halves the angle between N and l, (N.h)^2 = (1 + N.l) / 2, and with x = 1 - N.l
//
//   (N.h)^2 (a^2 - 1) + 1 = a^2 + (1 - a^2) x / 2 = a^2 (1 + k x),   k = (1 - a^2) / (2 a^2)
//
// so that w is proportional to (1 - x) / (1 + k x)^2. With a = 1, k = 0: the cosine of irradiance.
//
// The sum over all texels is taken over nodes of a quadtree for each face, small ones where the
// lobe varies and large ones elsewhere; each channel of a node acts as if all its light were at one
// place, its center of gravity (as stars act in J. Barnes and P. Hut, "A hierarchical O(N log N)
// force-calculation algorithm", 1986). Which nodes are summed depends on directions alone, and the
// sums of the six faces are kept apart, so that a changed face changes only its own sums.

namespace cubecam {

/// Up to 4 x 4 texels of a level.
struct FilterTile {
    std::size_t level;  ///< an index of levels_; their number stands for the irradiance
    Face face;
    int row;
    int column;
};

namespace {

constexpr int tile_edge = 4;
static_assert(tile_edge * tile_edge == static_cast<int>(tile_texels));

/// The greatest relative error of a node's weight where the lobe is strong, before lobe_kernels.cpp
/// corrects its even part. With this tolerance, lookups of filtered photographs differ from the sum
/// over all texels by .25 % rms at roughness .2 and by .12 % from .4 on.
constexpr float tolerance = 0.02F;
/// The greatest radius of a node whose weight curves at all.
constexpr float greatest_radius = 0.2F;
/// The greatest error of a node's weight where the horizon cuts it, relative to the lobe's peak.
constexpr float horizon_tolerance = 0.003F;

float sharpness_of(float roughness) {
    const double a = static_cast<double>(roughness) * static_cast<double>(roughness);
    return static_cast<float>((1 - a * a) / (2 * a * a));
}

/// Leaves that the sharpest lobe needs along an edge of a face.
int leaves_along(const std::vector<FilteredLevel>& levels) {
    int leaves = 64;
    const float roughness = levels.empty() ? 1.0F : levels.front().roughness;
    while (static_cast<float>(leaves) * roughness * roughness < 10.0F && leaves < (1 << 20)) {
        leaves *= 2;
    }
    return leaves;
}

/// Directions of a tile's texels; texels beyond the edge repeat the last one.
struct TileDirections {
    std::array<glm::vec3, tile_texels> towards;
    glm::vec3 center;
    float radius = 0;

    TileDirections(const FilterTile& tile, int size) : center(0) {
        for (std::size_t i = 0; i < tile_texels; ++i) {
            const int row = std::min(tile.row + static_cast<int>(i) / tile_edge, size - 1);
            const int column = std::min(tile.column + static_cast<int>(i) % tile_edge, size - 1);
            towards[i] = glm::vec3(glm::normalize(face_uv_to_direction<double>(
                tile.face, (column + 0.5) / size, (row + 0.5) / size)));
            center += towards[i];
        }
        center = glm::normalize(center);
        for (const glm::vec3& n : towards) radius = std::max(radius, glm::distance(center, n));
    }
};

/// A direction in the axes of a face. The axes are world axes, so this rounds nothing.
glm::vec3 to_face_axes(Face face, const glm::vec3& v) {
    const FaceAxes& axes = face_axes(face);
    return {glm::dot(v, axes.major), glm::dot(v, axes.s_axis), glm::dot(v, axes.t_axis)};
}

/// Finds the nodes of a face that a tile needs.
class Walk {
public:
    void find(const TreeShape& shape, const std::vector<RadianceNode>& nodes,
              const glm::vec3& center, float radius, float sharpness) {
        found.clear();
        shape_ = &shape;
        nodes_ = nodes.data();
        center_ = center;
        radius_ = radius;
        sharpness_ = sharpness;
        steepest_ = sharpness > 0 ? std::sqrt(2 / sharpness) : 2.0F;
        at_horizon_ = 1 / ((1 + sharpness) * (1 + sharpness));
        visit(shape.level_count() - 1, 0, 0);
    }

    std::vector<const RadianceNode*> found;

private:
    void visit(int level, int row, int column) {
        const int n = shape_->nodes_along(level);
        const RadianceNode& node =
            nodes_[shape_->offset(level) + static_cast<std::size_t>(row * n + column)];
        const glm::vec3 offset = glm::vec3(node.center) - center_;
        const float squared = glm::dot(offset, offset);
        const float cosine = 1 - squared / 2 - node.center.w;
        const float reach = node.radius + radius_;
        if (cosine + reach <= 0) return;  // wholly below the horizon of each texel
        if (level == 0 || small_enough(node.radius, std::sqrt(squared), cosine - reach)) {
            found.push_back(&node);
            return;
        }
        const int below = shape_->nodes_along(level - 1);
        for (int r = 2 * row; r < std::min(2 * row + 2, below); ++r) {
            for (int c = 2 * column; c < std::min(2 * column + 2, below); ++c) {
                visit(level - 1, r, c);
            }
        }
    }

    /// With x = 1 - N.l and a node of corner radius R at the distance d, the variance of x within
    /// the node is d^2 R^2 / 6, and the lobe's curvature w''/w is 6 k^2 / (1 + k x)^2. Half their
    /// product is the relative error of the node's weight. It is greatest where k d^2 / 2 = 1.
    bool small_enough(float node_radius, float distance, float lowest_cosine) const {
        const float nearest = std::max(0.0F, distance - radius_);
        const float furthest = distance + radius_ + node_radius / 2;
        const float d = std::clamp(steepest_, nearest, furthest);
        const float kx = sharpness_ * d * d / 2;
        const float kdr = sharpness_ * d * node_radius / (1 + kx);
        const float error = kdr * kdr / 2;
        // Further out, where the lobe is weak, a greater share of it may be wrong.
        const float nearest_kx = sharpness_ * nearest * nearest / 2;
        if (sharpness_ > 0 && node_radius > greatest_radius) return false;
        if (error * error > tolerance * tolerance * (1 + nearest_kx)) return false;
        return lowest_cosine >= 0 || node_radius * at_horizon_ <= 6 * horizon_tolerance;
    }

    const TreeShape* shape_ = nullptr;
    const RadianceNode* nodes_ = nullptr;
    glm::vec3 center_{};
    float radius_ = 0;
    float sharpness_ = 0;
    float steepest_ = 0;
    float at_horizon_ = 0;
};

/// Reports progress from the calling thread alone, and not too often.
class ProgressReport {
public:
    ProgressReport(const FilteredCube::Progress& progress, std::size_t steps)
        : progress_(progress), steps_(steps), caller_(std::this_thread::get_id()) {}

    void step() {
        ++done_;
        goes_on();
    }
    /// Returns false if the work was cancelled.
    bool goes_on() {
        poll_interrupts();
        if (!cancelled_ && progress_ && std::this_thread::get_id() == caller_) {
            const auto now = std::chrono::steady_clock::now();
            if (now - last_ > std::chrono::milliseconds(10)) {
                last_ = now;
                const double share = static_cast<double>(done_) / static_cast<double>(steps_);
                if (!progress_(share)) cancelled_ = true;
            }
        }
        return !cancelled_;
    }
    bool cancelled() const { return cancelled_; }

private:
    const FilteredCube::Progress& progress_;
    std::size_t steps_;
    std::thread::id caller_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::atomic<std::size_t> done_{0};
    std::atomic<bool> cancelled_{false};
};

/// Bilinear lookups flatten peaks: between texels with the distance 1, they give
/// f + f'' t (1 - t) / 2, on average f + f'' / 12. Each texel is moved by -f'' / 12 in both
/// directions, so that lookups are right on average, with a third of the error. Where the cosine of
/// a small lamp ends, f'' has a peak that would make light negative; such a texel becomes 0.
void sharpen(FilteredLevel& level) {
    // Lobes that are not wider than texels have no such derivatives.
    if (static_cast<float>(level.size) * level.roughness * level.roughness < 2.5F) return;
    const int n = level.size;
    const std::size_t side = static_cast<std::size_t>(n) + 2;
    const std::vector<glm::vec4> bordered = bordered_faces(level);
    glm::vec4* to = level.texels.data();
    for (std::size_t face = 0; face < face_count; ++face) {
        for (int row = 0; row < n; ++row) {
            poll_interrupts();
            const glm::vec4* from =
                bordered.data() + (face * side + static_cast<std::size_t>(row) + 1) * side + 1;
            for (int column = 0; column < n; ++column, ++from, ++to) {
                const glm::vec4 around = (from[-1] - *from) + (from[1] - *from) +
                                         (*(from - side) - *from) + (from[side] - *from);
                *to = glm::max(*from - around / 12.0F, glm::min(*from, 0.0F));
            }
        }
    }
}

FilteredLevel empty_level(int size, float roughness) {
    const auto n = static_cast<std::size_t>(size);
    return {size, roughness, std::vector<glm::vec4>(face_count * n * n)};
}

}  // namespace

float level_roughness(int level, int levels) {
    return levels < 2 ? 0.0F : static_cast<float>(level) / static_cast<float>(levels - 1);
}

int level_size(int size, float roughness) {
    if (!(roughness > 0.0F)) return size;
    const float power = std::round(std::log2(25.6F / roughness));
    const int wanted = power >= 20 ? 1 << 20 : std::max(32, 1 << static_cast<int>(power));
    return std::min(size, wanted);
}

FilteredCube::FilteredCube(const FilterRule& rule) : rule_(rule) {
    if (rule.size < 1 || rule.levels < 1 || rule.irradiance_size < 0) {
        throw std::invalid_argument("FilterRule: expected at least 1 texel and 1 level, got " +
                                    std::to_string(rule.size) + " and " +
                                    std::to_string(rule.levels));
    }
    for (int k = 1; k < rule.levels; ++k) {
        const float roughness = level_roughness(k, rule.levels);
        levels_.push_back(empty_level(level_size(rule.size, roughness), roughness));
    }
    if (rule.irradiance_size > 0) irradiance_ = empty_level(rule.irradiance_size, 1.0F);

    const auto add_tiles = [&](std::size_t index, int size) {
        for (const Face face : all_faces) {
            for (int row = 0; row < size; row += tile_edge) {
                for (int column = 0; column < size; column += tile_edge) {
                    tiles_.push_back({index, face, row, column});
                }
            }
        }
    };
    for (std::size_t i = 0; i < levels_.size(); ++i) add_tiles(i, levels_[i].size);
    if (!copies_last_level()) add_tiles(levels_.size(), irradiance_.size);
}

/// The last level's lobe is the cosine, too: with the same size, the irradiance is a copy of it.
bool FilteredCube::copies_last_level() const {
    return !levels_.empty() && levels_.back().size == irradiance_.size;
}

FilteredCube::~FilteredCube() = default;
FilteredCube::FilteredCube(FilteredCube&&) noexcept = default;
FilteredCube& FilteredCube::operator=(FilteredCube&&) noexcept = default;

bool FilteredCube::update(const Faces& faces, const std::array<bool, face_count>& changed,
                          const Progress& progress) {
    return update_from([&](std::size_t face, std::vector<glm::vec4>&) { return faces[face]; },
                       changed, progress);
}

bool FilteredCube::update(const CubeMapData& cube, const std::array<bool, face_count>& changed,
                          const Progress& progress) {
    return update_from(
        [&](std::size_t face, std::vector<glm::vec4>& texels) {
            texels = radiance_face(cube, all_faces[face]);
            return std::span<const glm::vec4>(texels);
        },
        changed, progress);
}

bool FilteredCube::update_from(const FaceReader& read, const std::array<bool, face_count>& changed,
                               const Progress& progress) {
    std::vector<std::size_t> sources;
    for (std::size_t i = 0; i < face_count; ++i) {
        if (!complete_ || changed[i]) sources.push_back(i);
    }
    if (sources.empty() || tiles_.empty()) return true;
    const std::size_t texels =
        static_cast<std::size_t>(rule_.size) * static_cast<std::size_t>(rule_.size);

    complete_ = false;
    ProgressReport report(progress, sources.size() + tiles_.size());
    const auto goes_on = [&] { return report.goes_on(); };
    if (!shape_) {
        auto shape = std::make_shared<const TreeShape>(rule_.size, leaves_along(levels_), goes_on);
        if (report.cancelled()) return false;
        shape_ = std::move(shape);
    }
    sums_.resize(tiles_.size() * face_count);
    std::array<std::vector<RadianceNode>, face_count> trees;
    parallel_for(0, sources.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (report.cancelled()) return;
            const std::size_t face = sources[i];
            std::vector<glm::vec4> converted;
            const std::span<const glm::vec4> read_texels = read(face, converted);
            if (read_texels.size() != texels) {
                throw std::invalid_argument("faces: expected " + std::to_string(texels) +
                                            " texels for face " + face_names[face] + ", got " +
                                            std::to_string(read_texels.size()));
            }
            trees[face] = shape_->tree(read_texels, goes_on);
            report.step();
        }
    });
    parallel_for_with<Walk>(
        0, tiles_.size(), 16, [&](std::size_t begin, std::size_t end, Walk& walk) {
            for (std::size_t at = begin; at < end; ++at) {
                if (report.cancelled()) return;
                const FilterTile& tile = tiles_[at];
                const FilteredLevel& level =
                    tile.level < levels_.size() ? levels_[tile.level] : irradiance_;
                const TileDirections directions(tile, level.size);
                const float sharpness = sharpness_of(level.roughness);
                for (const std::size_t source : sources) {
                    const Face face = all_faces[source];
                    TileNormals normals;
                    for (std::size_t i = 0; i < tile_texels; ++i) {
                        const glm::vec3 n = to_face_axes(face, directions.towards[i]);
                        normals.x[i] = n.x;
                        normals.y[i] = n.y;
                        normals.z[i] = n.z;
                    }
                    walk.find(*shape_, trees[source], to_face_axes(face, directions.center),
                              directions.radius, sharpness);
                    filter_tile(normals, sharpness, walk.found.data(), walk.found.size(),
                                sums_[at * face_count + source]);
                }
                report.step();
            }
        });
    if (report.cancelled()) return false;
    combine();
    complete_ = true;
    return !progress || progress(1.0);
}

void FilteredCube::combine() {
    parallel_for(0, tiles_.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; ++at) combine(at);
    });
    parallel_for(0, levels_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sharpen(levels_[i]);
    });
    if (copies_last_level()) {
        irradiance_.texels = levels_.back().texels;
    } else {
        sharpen(irradiance_);
    }
}

void FilteredCube::combine(std::size_t at) {
    const FilterTile& tile = tiles_[at];
    FilteredLevel& level = tile.level < levels_.size() ? levels_[tile.level] : irradiance_;
    const int n = level.size;
    const TileSums* six = sums_.data() + at * face_count;
    glm::vec4* to = level.texels.data() + face_index(tile.face) * level.face(0).size();
    for (int i = 0; i < static_cast<int>(tile_texels); ++i) {
        const int row = tile.row + i / tile_edge;
        const int column = tile.column + i % tile_edge;
        if (row >= n || column >= n) continue;
        glm::vec4 sum(0);
        float weight = 0;
        for (std::size_t face = 0; face < face_count; ++face) {
            const TileSums& s = six[face];
            sum += glm::vec4(s.red[i], s.green[i], s.blue[i], s.alpha[i]);
            weight += s.weight[i];
        }
        to[row * n + column] = sum / weight;
    }
}

}  // namespace cubecam
