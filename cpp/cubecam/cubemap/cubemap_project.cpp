#include "cubecam/cubemap/cubemap_project.hpp"

#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/cube_texels.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/cubemap/infinities.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace cubecam {

namespace {

constexpr int project_tile = 32;
constexpr int most_samples = 64;  ///< in one direction of a texel: a texel at the rim of a ball
                                  ///< covers a great part of the world
constexpr std::size_t batch_size = std::size_t{most_samples} * most_samples;

/// A grid of texels that the projected pictures have in common: rows, columns, and where a place
/// on it lies.
struct Grid {
    int rows;
    int columns;

    /// The position of a place in texels; texel (row, column) has its center at column + 1/2.
    glm::dvec2 position(double row, double column) const {
        return {2 * column / columns - 1, 1 - 2 * row / rows};
    }
};

int samples_for_length(double texels) {
    return std::clamp(static_cast<int>(std::ceil(texels - 1e-6)), 1, most_samples);
}

/// The change from one texel to the next, by the neighbours that exist.
template <typename Vector>
struct TexelStep {
    Vector step{};
    bool known = true;      ///< false: there is no neighbour
    bool straight = false;  ///< within the texel, the step times a fraction is near enough
};

template <typename Vector>
TexelStep<Vector> step_between(const std::optional<Vector>& before, const Vector& at,
                               const std::optional<Vector>& after) {
    if (before && after) {
        const Vector step = (*after - *before) * 0.5;
        const Vector bend = *after + *before - at * 2.0;
        // At the border of the texel the error is an eighth of the bend.
        const bool straight = glm::dot(bend, bend) <= 0.0025 * glm::dot(step, step);
        return {step, true, straight};
    }
    if (after) return {*after - at};
    if (before) return {at - *before};
    return {{}, false};
}

/// Calls add(value) for each of down x across places within a texel: what its steps give if they
/// are straight, otherwise compute(down, across), which may give none; both count from the texel's
/// first corner.
template <typename Vector, typename Compute, typename Add>
void for_samples(const Vector& at, const TexelStep<Vector>& to_right,
                 const TexelStep<Vector>& to_below, int across, int down, const Compute& compute,
                 const Add& add) {
    const bool straight = to_right.straight && to_below.straight;
    for (int i = 0; i < down; ++i) {
        const double y = (i + 0.5) / down;
        for (int j = 0; j < across; ++j) {
            const double x = (j + 0.5) / across;
            if (straight) {
                add(at + to_right.step * (x - 0.5) + to_below.step * (y - 0.5));
            } else if (const std::optional<Vector> value = compute(y, x)) {
                add(*value);
            }
        }
    }
}

/// Brings directions to the plane of the face that one of them meets: there steps are lengths, and
/// what a perspective shows is straight.
class FacePlane {
public:
    explicit FacePlane(const glm::dvec3& direction) {
        const glm::dvec3 size = glm::abs(direction);
        major_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        sign_ = direction[major_] < 0 ? -1 : 1;
    }

    glm::dvec3 on_plane(const glm::dvec3& direction) const {
        return direction * (sign_ / direction[major_]);
    }
    /// None for a direction that is far from the face, too.
    std::optional<glm::dvec3> on_plane(const std::optional<glm::dvec3>& direction) const {
        if (!direction || (*direction)[major_] * sign_ < 0.1) return std::nullopt;
        return on_plane(*direction);
    }

private:
    int major_;
    double sign_;
};

/// The steps from a texel of a picture to its neighbours, on the plane of a face, where half a face
/// is 1.
struct Footprint {
    glm::dvec3 at;
    TexelStep<glm::dvec3> to_right;
    TexelStep<glm::dvec3> to_below;

    using Seen = std::optional<glm::dvec3>;

    Footprint(const glm::dvec3& center, const Seen& left, const Seen& right, const Seen& above,
              const Seen& below) {
        const FacePlane plane(center);
        at = plane.on_plane(center);
        to_right = step_between(plane.on_plane(left), at, plane.on_plane(right));
        to_below = step_between(plane.on_plane(above), at, plane.on_plane(below));
    }
};

/// Values of the texels of a tile with a border of one texel.
template <typename Value>
class BorderedTile {
public:
    template <typename Compute>
    void fill(int row, int column, int rows, int columns, const Compute& compute) {
        stride_ = static_cast<std::size_t>(columns) + 2;
        values_.resize((static_cast<std::size_t>(rows) + 2) * stride_);
        std::size_t at = 0;
        for (int i = -1; i <= rows; ++i) {
            for (int j = -1; j <= columns; ++j) values_[at++] = compute(row + i, column + j);
        }
    }
    const std::optional<Value>& at(int row, int column) const {
        return values_[static_cast<std::size_t>(row + 1) * stride_ +
                       static_cast<std::size_t>(column + 1)];
    }

private:
    std::vector<std::optional<Value>> values_;
    std::size_t stride_ = 0;
};

/// Collects the samples of texels, looks them up many at a time, and writes the means.
template <typename Sample>
class SampleBatch {
public:
    /// Makes room for the samples of one more texel, at most batch_size; `flush(samples, count,
    /// to)` looks up those that are there if there is none.
    template <typename Flush>
    void begin(std::size_t texel, std::size_t most, const Flush& flush) {
        if (samples_.size() + most > batch_size) flush();
        texels_.emplace_back(texel, samples_.size());
    }
    void add(const Sample& sample) { samples_.push_back(sample); }
    std::size_t added() const { return samples_.size() - texels_.back().second; }

    const std::vector<Sample>& samples() const { return samples_; }

    /// Writes the mean of each texel. `found` has `channels` numbers for each sample. Returns
    /// whether all means are finite.
    bool write(const Buffer<float>& found, std::size_t channels, DType dtype, std::byte* to) {
        bool finite = true;
        const auto end_of = [&](std::size_t i) {
            return i + 1 < texels_.size() ? texels_[i + 1].second : samples_.size();
        };
        for (std::size_t i = 0; i < texels_.size(); ++i) {
            const auto [texel, begin] = texels_[i];
            std::byte* const at = to + texel * channels * dtype_size(dtype);
            // Texels of one sample each that lie side by side are written at once.
            std::size_t run = 0;
            while (i + run < texels_.size() && texels_[i + run].first == texel + run &&
                   end_of(i + run) == begin + run + 1) {
                ++run;
            }
            if (run > 0) {
                finite &= all_finite(&found[begin * channels], run * channels);
                floats_to_pixels(dtype, &found[begin * channels], run * channels, at);
                i += run - 1;
                continue;
            }
            const std::size_t end = end_of(i);
            float mean[4];
            for (std::size_t c = 0; c < channels; ++c) {
                const float* from = &found[begin * channels + c];
                const auto count = static_cast<float>(end - begin);
                float sum = 0;  // of differences: equal samples give exactly that number
                for (std::size_t k = 1; k < end - begin; ++k) sum += from[k * channels] - from[0];
                mean[c] = from[0] + sum / count;
                if (is_finite<1>(mean[c])) continue;
                sum = 0;  // a difference of infinities is NaN
                for (std::size_t k = 0; k < end - begin; ++k) sum += from[k * channels] / count;
                mean[c] = sum;
                finite &= is_finite<1>(sum);
            }
            floats_to_pixels(dtype, mean, channels, at);
        }
        samples_.clear();
        texels_.clear();
        return finite;
    }

private:
    std::vector<Sample> samples_;
    std::vector<std::pair<std::size_t, std::size_t>> texels_;  ///< and where its samples begin
};

/// Calls body(row, column, rows, columns, scratch) for all tiles of a grid, on all cores.
template <typename Scratch, typename Body>
void for_tiles(const Grid& grid, const Body& body) {
    const int down = (grid.rows + project_tile - 1) / project_tile;
    const int across = (grid.columns + project_tile - 1) / project_tile;
    const std::size_t tiles = static_cast<std::size_t>(down) * static_cast<std::size_t>(across);
    parallel_for_with<Scratch>(
        0, tiles, 1, [&](std::size_t begin, std::size_t end, Scratch& scratch) {
            for (std::size_t i = begin; i < end; ++i) {
                const int row =
                    static_cast<int>(i / static_cast<std::size_t>(across)) * project_tile;
                const int column =
                    static_cast<int>(i % static_cast<std::size_t>(across)) * project_tile;
                body(row, column, std::min(project_tile, grid.rows - row),
                     std::min(project_tile, grid.columns - column), scratch);
            }
        });
}

/// The least length of a texel of the picture in the cube's texels, found at some of the texels.
double least_length(const Projection& projection, const Grid& grid, int size) {
    constexpr int most = 32;
    double least = 1e30;
    const int rows = std::min(grid.rows, most);
    const int columns = std::min(grid.columns, most);
    for (int i = 0; i < rows * columns; ++i) {
        const double row = (i / columns + 0.5) * grid.rows / rows;
        const double column = (i % columns + 0.5) * grid.columns / columns;
        const auto at = projection.direction_at(grid.position(row, column));
        if (!at) continue;
        const auto seen = [&](double down, double across) {
            return projection.direction_at(grid.position(row + down, column + across));
        };
        const Footprint footprint(*at, seen(0, -1), seen(0, 1), seen(-1, 0), seen(1, 0));
        for (const auto& step : {footprint.to_right, footprint.to_below}) {
            if (step.known) least = std::min(least, glm::length(step.step) * size / 2);
        }
    }
    return least;
}

void project_onto(const CubeMapData& cube, const Projection& projection, const Grid& grid,
                  DType dtype, std::byte* to) {
    struct Scratch {
        BorderedTile<glm::dvec3> seen;
        SampleBatch<glm::vec3> batch;
        Buffer<float> found;
    };
    const auto channels = static_cast<std::size_t>(cube.channels);
    const std::size_t texel_bytes = channels * dtype_size(dtype);
    const auto direction_at = [&](double row, double column) {
        return projection.direction_at(grid.position(row, column));
    };
    const double half_size = cube.size / 2.0;
    for_tiles<Scratch>(
        grid, [&](int first_row, int first_column, int rows, int columns, Scratch& scratch) {
            auto& [seen, batch, found] = scratch;
            seen.fill(first_row, first_column, rows, columns,
                      [&](int row, int column) { return direction_at(row + 0.5, column + 0.5); });
            const auto flush = [&] {
                const auto& directions = batch.samples();
                found.resize(directions.size() * channels);
                sample_cube(cube, nullptr, &directions.data()->x, directions.size(), nullptr, 0,
                            found.data());
                batch.write(found, channels, dtype, to);
            };
            for (int i = 0; i < rows; ++i) {
                for (int j = 0; j < columns; ++j) {
                    const int row = first_row + i;
                    const int column = first_column + j;
                    const std::size_t index =
                        static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                        static_cast<std::size_t>(column);
                    const auto& center = seen.at(i, j);
                    if (!center) {
                        std::memset(to + index * texel_bytes, 0, texel_bytes);
                        continue;
                    }
                    const Footprint footprint(*center, seen.at(i, j - 1), seen.at(i, j + 1),
                                              seen.at(i - 1, j), seen.at(i + 1, j));
                    const auto samples_along = [&](const TexelStep<glm::dvec3>& step) {
                        return step.known ? samples_for_length(glm::length(step.step) * half_size)
                                          : most_samples;
                    };
                    const int across = samples_along(footprint.to_right);
                    const int down = samples_along(footprint.to_below);
                    batch.begin(index, static_cast<std::size_t>(across * down), flush);
                    if (across * down > 1) {
                        for_samples(
                            footprint.at, footprint.to_right, footprint.to_below, across, down,
                            [&](double y, double x) { return direction_at(row + y, column + x); },
                            [&](const glm::dvec3& direction) { batch.add(glm::vec3(direction)); });
                    }
                    if (across * down == 1 || batch.added() == 0) batch.add(glm::vec3(*center));
                }
            }
            if (!batch.samples().empty()) flush();
        });
}

/// Calls body(projection, index of the first texel) for each face of a turned cube: the old cube,
/// seen through a square window that covers the face.
template <typename Body>
void for_turned_faces(int size, const glm::dmat3& rotation, const Body& body) {
    const glm::dmat3 back = glm::transpose(rotation);
    for (const Face face : all_faces) {
        const FaceAxes& axes = face_axes(face);
        const glm::dmat3 seen = back * glm::dmat3(glm::dvec3(axes.s_axis), -glm::dvec3(axes.t_axis),
                                                  glm::dvec3(axes.major));
        const auto n = static_cast<std::size_t>(size);
        body(Projection(ProjectionKind::perspective, std::numbers::pi / 2, 1, seen),
             face_index(face) * n * n);
    }
}

/// Whether a rotation brings axes to axes. Then it becomes exact.
bool snap_to_axes(glm::dmat3& rotation) {
    glm::dmat3 exact;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            exact[i][j] = std::round(rotation[i][j]);
            if (std::abs(rotation[i][j] - exact[i][j]) > 1e-9) return false;
        }
    }
    rotation = exact;
    return true;
}

/// Copies the texels that the centers of a grid meet.
void nearest_onto(const TexelBytes& cube, const Projection& projection, const Grid& grid,
                  const std::byte* outside, std::byte* to) {
    const auto n = static_cast<std::size_t>(cube.size);
    const auto texel_of = [n](double coordinate) {
        return std::min(
            static_cast<std::size_t>(std::max(coordinate * static_cast<double>(n), 0.0)), n - 1);
    };
    const auto columns = static_cast<std::size_t>(grid.columns);
    const std::size_t bytes = cube.bytes;
    parallel_for(
        0, static_cast<std::size_t>(grid.rows), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                std::byte* at = to + row * columns * bytes;
                for (std::size_t column = 0; column < columns; ++column, at += bytes) {
                    const auto direction = projection.direction_at(grid.position(
                        static_cast<double>(row) + 0.5, static_cast<double>(column) + 0.5));
                    const std::byte* from = outside;
                    if (direction) {
                        const FaceUv<double> uv = direction_to_face_uv(*direction);
                        from = cube.texels +
                               ((face_index(uv.face) * n + texel_of(uv.t)) * n + texel_of(uv.s)) *
                                   bytes;
                    }
                    std::memcpy(at, from, bytes);
                }
            }
        });
}

/// The four texels round a place on a picture, with weights that add up to 1.
struct FourTexels {
    std::array<std::size_t, 4> index;
    std::array<float, 4> weight;
};

/// A picture of a projection, as a place for lookups.
class ProjectedGrid {
public:
    ProjectedGrid(const Projection& projection, const Grid& grid)
        : projection_(projection), grid_(grid) {}

    /// The place of a direction in texels, or none.
    std::optional<glm::dvec2> place_of(const glm::dvec3& direction) const {
        const auto p = projection_.position_of(direction);
        if (!p) return std::nullopt;
        return glm::dvec2((p->x + 1) / 2 * grid_.columns, (1 - p->y) / 2 * grid_.rows);
    }

    FourTexels texels_round(glm::dvec2 place) const {
        FourTexels four = weighted(place);
        // At the edge of a disc all four may lie outside: then the nearest ones inwards count.
        for (int tries = 0; tries < 8 && sum_of(four) <= 0; ++tries) {
            glm::dvec2 middle(grid_.columns / 2.0, grid_.rows / 2.0);
            if (projection_.kind() == ProjectionKind::dual_paraboloid) {
                middle.x *= place.x < middle.x ? 0.5 : 1.5;
            }
            place += glm::normalize(middle - place) * 0.5;
            four = weighted(place);
        }
        const float sum = sum_of(four);
        if (sum <= 0) return {{0, 0, 0, 0}, {0, 0, 0, 0}};
        for (float& weight : four.weight) weight /= sum;
        return four;
    }

private:
    static float sum_of(const FourTexels& four) {
        return four.weight[0] + four.weight[1] + four.weight[2] + four.weight[3];
    }

    FourTexels weighted(const glm::dvec2& place) const {
        const double x = place.x - 0.5;
        const double y = place.y - 0.5;
        const int column = static_cast<int>(std::floor(x));
        const int row = static_cast<int>(std::floor(y));
        const auto right = static_cast<float>(x - column);
        const auto bottom = static_cast<float>(y - row);
        const bool inside = !projection_.is_disc() || is_deep_inside(place);
        FourTexels four;
        for (int k = 0; k < 4; ++k) {
            const int j = column + k % 2;
            const int i = row + k / 2;
            const float weight = (k % 2 ? right : 1 - right) * (k / 2 ? bottom : 1 - bottom);
            const auto slot = static_cast<std::size_t>(k);
            const bool counts = inside || on_disc(i, j, place);
            four.weight[slot] = counts ? weight : 0.0f;
            four.index[slot] = counts ? index_of(i, j) : 0;
        }
        return four;
    }

    /// Whether all texels round a place lie on the disc, so that they need no test.
    bool is_deep_inside(const glm::dvec2& place) const {
        const double radius = grid_.rows / 2.0;
        const bool two = projection_.kind() == ProjectionKind::dual_paraboloid;
        const double middle = !two ? radius : place.x < 2 * radius ? radius : 3 * radius;
        return glm::length(place - glm::dvec2(middle, radius)) < radius - 2;
    }

    /// Whether a texel's center lies on the disc that a place lies on.
    bool on_disc(int row, int column, const glm::dvec2& place) const {
        if (row < 0 || row >= grid_.rows || column < 0 || column >= grid_.columns) return false;
        if (projection_.kind() == ProjectionKind::dual_paraboloid &&
            (2 * column < grid_.columns) != (2 * place.x < grid_.columns)) {
            return false;
        }
        return projection_.contains(grid_.position(row + 0.5, column + 0.5));
    }

    std::size_t index_of(int row, int column) const {
        if (projection_.kind() == ProjectionKind::octahedral) {
            // The map continues at its border, mirrored at the middle of the border.
            if (column < 0 || column >= grid_.columns) {
                column = std::clamp(column, 0, grid_.columns - 1);
                row = grid_.rows - 1 - row;
            }
            if (row < 0 || row >= grid_.rows) {
                row = std::clamp(row, 0, grid_.rows - 1);
                column = grid_.columns - 1 - column;
            }
        } else if (projection_.is_ring()) {
            column = (column + grid_.columns) % grid_.columns;
        }
        row = std::clamp(row, 0, grid_.rows - 1);
        column = std::clamp(column, 0, grid_.columns - 1);
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) +
               static_cast<std::size_t>(column);
    }

    const Projection& projection_;
    Grid grid_;
};

/// Looks up places on a picture, bilinear.
template <int Channels, typename Pixel>
void look_up(const Pixel* pixels, const std::vector<FourTexels>& places, float* to) {
    for (const FourTexels& four : places) {
        Lane<Channels> texel[4];
        for (std::size_t k = 0; k < 4; ++k) {
            texel[k] = load_texel<Channels>(pixels + four.index[k] * Channels);
        }
        // The texel of the greatest weight, so that differences to it are exact where it is alone.
        const auto most = static_cast<std::size_t>(
            std::max_element(four.weight.begin(), four.weight.end()) - four.weight.begin());
        Lane<Channels> sum{};
        for (std::size_t k = 0; k < 4; ++k) {
            if (four.weight[k] > 0) sum += (texel[k] - texel[most]) * four.weight[k];
        }
        store_texel<Channels>(texel[most] + sum, to);
        to += Channels;
    }
}

/// Looks up places on a picture and writes the numbers of all channels.
using LookUp = std::function<void(const std::vector<FourTexels>&, float*)>;

template <typename Pixel>
LookUp look_up_in(const Pixel* pixels, int channels) {
    return with_channels(channels, [pixels](auto constant) -> LookUp {
        return [pixels](const std::vector<FourTexels>& places, float* to) {
            look_up<decltype(constant)::value>(pixels, places, to);
        };
    });
}

/// Returns whether all results are finite.
bool fill_cube(const LookUp& look_up, const ProjectedPixels& from, const Projection& projection,
               int size, DType dtype, std::byte* to) {
    struct Scratch {
        BorderedTile<glm::dvec2> places;
        SampleBatch<FourTexels> batch;
        Buffer<float> found;
    };
    const auto channels = static_cast<std::size_t>(from.channels);
    const std::size_t texel_bytes = channels * dtype_size(dtype);
    const ProjectedGrid picture(projection, {from.height, from.width});
    std::atomic<bool> all_numbers{true};
    const auto place_at = [&](Face face, double row, double column) {
        return picture.place_of(face_uv_to_direction(face, column / size, row / size));
    };
    // The distance to the neighbour that is nearer: across a seam of the picture it is far.
    const auto samples_along = [](const std::optional<glm::dvec2>& before, const glm::dvec2& at,
                                  const std::optional<glm::dvec2>& after) {
        double length = 1e30;
        if (before) length = glm::length(at - *before);
        if (after) length = std::min(length, glm::length(*after - at));
        return samples_for_length(std::min(length, 1e6));
    };
    for (const Face face : all_faces) {
        std::byte* const face_texels = to + face_index(face) * static_cast<std::size_t>(size) *
                                                static_cast<std::size_t>(size) * texel_bytes;
        for_tiles<Scratch>({size, size}, [&](int first_row, int first_column, int rows, int columns,
                                             Scratch& scratch) {
            auto& [places, batch, found] = scratch;
            places.fill(first_row, first_column, rows, columns, [&](int row, int column) {
                return place_at(face, row + 0.5, column + 0.5);
            });
            const auto flush = [&] {
                found.resize(batch.samples().size() * channels);
                look_up(batch.samples(), found.data());
                if (!batch.write(found, channels, dtype, face_texels)) all_numbers = false;
            };
            for (int i = 0; i < rows; ++i) {
                for (int j = 0; j < columns; ++j) {
                    const int row = first_row + i;
                    const int column = first_column + j;
                    const std::size_t index =
                        static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                        static_cast<std::size_t>(column);
                    const auto& center = places.at(i, j);
                    if (!center) {
                        std::memset(face_texels + index * texel_bytes, 0, texel_bytes);
                        continue;
                    }
                    const auto& before = places.at(i, j - 1);
                    const auto& after = places.at(i, j + 1);
                    const auto& above = places.at(i - 1, j);
                    const auto& below = places.at(i + 1, j);
                    const int across = samples_along(before, *center, after);
                    const int down = samples_along(above, *center, below);
                    batch.begin(index, static_cast<std::size_t>(across * down), flush);
                    if (across * down > 1) {
                        for_samples(
                            *center, step_between(before, *center, after),
                            step_between(above, *center, below), across, down,
                            [&](double y, double x) { return place_at(face, row + y, column + x); },
                            [&](const glm::dvec2& place) {
                                batch.add(picture.texels_round(place));
                            });
                    }
                    if (across * down == 1 || batch.added() == 0) {
                        batch.add(picture.texels_round(*center));
                    }
                }
            }
            if (!batch.samples().empty()) flush();
        });
    }
    return all_numbers;
}

}  // namespace

PixelBuffer project_cube(const CubeMapData& cube, const Projection& projection, int width,
                         int height, DType to) {
    const Grid grid{height, width};
    PixelBuffer result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                       static_cast<std::size_t>(cube.channels) * dtype_size(to));
    // A picture much smaller than the cube is made of a smaller cube, of which each texel still
    // takes two samples in each direction.
    int factor = 1;
    const double least = least_length(projection, grid, cube.size);
    while (factor * 4 <= least && factor * 4 <= cube.size) factor *= 2;
    if (factor == 1) {
        project_onto(cube, projection, grid, to, result.data());
        return result;
    }
    CubeMapData reduced = cube;
    reduced.size = cube.size / factor;
    reduced.dtype = DType::float32;
    reduced.mipmaps = false;
    reduced.pixels = std::make_shared<PixelBuffer>(
        resample_faces(cube, Sampling::centers, reduced.size, Sampling::centers, DType::float32));
    project_onto(reduced, projection, grid, to, result.data());
    return result;
}

PixelBuffer project_nearest(const TexelBytes& cube, const Projection& projection, int width,
                            int height, const std::byte* outside) {
    PixelBuffer result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                       cube.bytes);
    nearest_onto(cube, projection, {height, width}, outside, result.data());
    return result;
}

PixelBuffer picture_to_cube(const ProjectedPixels& from, const Projection& projection, int size,
                            DType to) {
    const auto n = static_cast<std::size_t>(size);
    const auto channels = static_cast<std::size_t>(from.channels);
    PixelBuffer result(face_count * n * n * channels * dtype_size(to));
    const auto fill = [&](const LookUp& look_up) {
        return fill_cube(look_up, from, projection, size, to, result.data());
    };
    with_pixels(from.dtype, from.pixels, [&](const auto* pixels) {
        if (fill(look_up_in(pixels, from.channels))) return;
        const std::size_t values =
            static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height) * channels;
        const auto finite = without_infinities(from.dtype, from.pixels, values, 0);
        fill(look_up_in(finite.data(), from.channels));
    });
    return result;
}

PixelBuffer rotate_nearest(const TexelBytes& cube, const glm::dmat3& rotation) {
    glm::dmat3 turn = rotation;
    snap_to_axes(turn);
    const auto n = static_cast<std::size_t>(cube.size);
    PixelBuffer result(face_count * n * n * cube.bytes);
    for_turned_faces(cube.size, turn, [&](const Projection& seen, std::size_t first) {
        nearest_onto(cube, seen, {cube.size, cube.size}, nullptr,
                     result.data() + first * cube.bytes);
    });
    return result;
}

PixelBuffer rotate_faces(const CubeMapData& cube, const glm::dmat3& rotation) {
    const std::size_t texel = static_cast<std::size_t>(cube.channels) * dtype_size(cube.dtype);
    glm::dmat3 turn = rotation;
    if (snap_to_axes(turn)) return rotate_nearest({cube.pixels->data(), cube.size, texel}, turn);
    PixelBuffer result(face_count * cube.face_bytes());
    for_turned_faces(cube.size, rotation, [&](const Projection& seen, std::size_t first) {
        project_onto(cube, seen, {cube.size, cube.size}, cube.dtype, result.data() + first * texel);
    });
    return result;
}

void rotate_z(PixelBuffer& z, int size, const glm::dmat3& rotation) {
    auto* numbers = reinterpret_cast<float*>(z.data());
    const glm::dmat3 back = glm::transpose(rotation);
    const auto n = static_cast<std::size_t>(size);
    parallel_for(0, face_count * n, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t line = begin; line < end; ++line) {
            const double t = (static_cast<double>(line % n) + 0.5) / size;
            for (int column = 0; column < size; ++column) {
                // The largest component is 1 on the new face.
                const glm::dvec3 seen = glm::abs(
                    back * face_uv_to_direction(all_faces[line / n], (column + 0.5) / size, t));
                numbers[line * n + static_cast<std::size_t>(column)] /=
                    static_cast<float>(std::max({seen.x, seen.y, seen.z}));
            }
        }
    });
}

}  // namespace cubecam
