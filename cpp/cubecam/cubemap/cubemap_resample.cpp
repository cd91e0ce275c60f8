#include "cubecam/cubemap/cubemap_resample.hpp"

#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/resample_tile.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>

namespace cubecam {

namespace {

constexpr int panorama_tile = 64;  ///< the sources of such a tile fit into one core's cache

/// One destination column of a panorama, in the coordinates of its side face.
struct PanoramaColumn {
    Face face;
    double across;  ///< horizontal coordinate on the face, -1 to 1 from left to right as seen in
                    ///< GL's picture
    double secant;  ///< of the longitude within the face
    double cosine;  ///< 1 / secant
    double x;       ///< the horizontal unit direction
    double z;
};

template <typename Pixel, int Channels>
class CubeToEquirect {
public:
    CubeToEquirect(const CubeTexels<Pixel, Channels>& cube, int width, Center center,
                   Sampling sampling, const TexelTarget<Channels>& to)
        : cube_(cube), width_(width), height_(width / 2), to_(to) {
        const EquirectAngles angles(width, center, sampling);
        lon_step_ = angles.longitude_step;
        lat_step_ = angles.latitude_step;
        for (const glm::dvec3& direction : angles.directions) {
            columns_.push_back(make_column(direction));
        }
        latitudes_ = angles.latitudes;
        for (const double latitude : latitudes_) pole_rows_.push_back(make_pole_row(latitude));
        // After a quarter turn the next side face has the same taps as the one before.
        if (sampling == Sampling::centers && width_ % 8 == 0) turns_ = 4;
    }

    void run() const {
        constexpr int tile = panorama_tile;
        std::vector<std::pair<int, int>> spans;  // of columns within one side face
        const int turn = width_ / turns_;
        for (int begin = 0; begin < turn;) {
            int end = begin + 1;
            while (end < std::min(turn, begin + tile) && column(end).face == column(begin).face) {
                ++end;
            }
            spans.emplace_back(begin, end);
            begin = end;
        }
        const std::size_t bands = static_cast<std::size_t>((height_ + tile - 1) / tile);
        parallel_for_with<Scratch>(
            0, bands * spans.size(), 1, [&](std::size_t begin, std::size_t end, Scratch& scratch) {
                for (std::size_t i = begin; i < end; ++i) {
                    const int row = static_cast<int>(i / spans.size()) * tile;
                    const auto [first, last] = spans[i % spans.size()];
                    fill_tile(row, std::min(row + tile, height_), first, last, scratch);
                }
            });
    }

private:
    /// Memory that the tiles of one thread reuse.
    struct Scratch {
        TapList down;
        TapList across;
        FilteredRows<Channels> filtered;
        Lane<Channels> line[panorama_tile];
    };

    const PanoramaColumn& column(int index) const {
        return columns_[static_cast<std::size_t>(index)];
    }
    double latitude(int row) const { return latitudes_[static_cast<std::size_t>(row)]; }

    /// One row of a panorama on +Y or -Y, where the destination's texels are turned against the
    /// texels of the face. Such a texel is sampled at several points: in each direction as many as
    /// it is texels long.
    struct PoleRow {
        struct Sample {
            float cosine;  ///< of the turn round the pole, times the radius
            float sine;
        };
        std::vector<Sample> samples;
    };

    PoleRow make_pole_row(double latitude) const {
        constexpr double half_turn = std::numbers::pi;
        const double from_pole = half_turn / 2 - std::abs(latitude);
        PoleRow row;
        if (from_pole > 1) return row;  // the faces' corners are 0.955 from the poles
        const double radius = std::tan(from_pole);
        const double half_size = cube_.size / 2.0;
        const int along = samples_for((1 + radius * radius) * lat_step_ * half_size);
        const int around = samples_for(radius * lon_step_ * half_size);
        for (int i = 0; i < along; ++i) {
            const double r = std::tan(from_pole + ((i + 0.5) / along - 0.5) * lat_step_);
            for (int j = 0; j < around; ++j) {
                const double turn = ((j + 0.5) / around - 0.5) * lon_step_;
                row.samples.push_back({static_cast<float>(r * std::cos(turn)),
                                       static_cast<float>(r * std::sin(turn))});
            }
        }
        return row;
    }

    static PanoramaColumn make_column(const glm::dvec3& d) {
        const bool on_x = std::abs(d.x) >= std::abs(d.z);
        const Face face =
            on_x ? (d.x > 0 ? Face::pos_x : Face::neg_x) : (d.z > 0 ? Face::pos_z : Face::neg_z);
        const double secant = 1 / (on_x ? std::abs(d.x) : std::abs(d.z));
        const glm::dvec3 s_axis = face_axes(face).s_axis;
        return {face, glm::dot(s_axis, d) * secant, secant, 1 / secant, d.x, d.z};
    }

    /// The index of a texel in the panorama.
    std::size_t index_of(int row, int at_column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(at_column);
    }

    /// Converts a coordinate from -1 to 1 on a face into texels, whose centres lie at whole
    /// numbers.
    double texel_of(double coordinate) const { return ((coordinate + 1) * cube_.size - 1) / 2; }

    /// On a side face s is constant along a column of the panorama, and t = tan(latitude) /
    /// cos(longitude). The filter therefore runs along rows first and along columns then. A texel
    /// beyond the upper or lower edge of the side lies on +Y or -Y.
    void fill_tile(int row_begin, int row_end, int begin, int end, Scratch& scratch) const {
        TapList& down = scratch.down;
        TapList& across = scratch.across;
        FilteredRows<Channels>& filtered = scratch.filtered;
        const double half_size = cube_.size / 2.0;
        const auto columns = static_cast<std::size_t>(end - begin);
        down.resize(static_cast<std::size_t>(row_end - row_begin) * columns);
        across.resize(columns);
        for (std::size_t j = 0; j < columns; ++j) {
            const PanoramaColumn& c = column(begin + static_cast<int>(j));
            across.set(j, texel_of(c.across),
                       BoxWidth(c.secant * c.secant * lon_step_ * half_size));
        }
        std::size_t index = 0;
        for (int row = row_begin; row < row_end; ++row) {
            const double tangent = std::tan(latitude(row));
            const double step = (1 + tangent * tangent) * lat_step_ * half_size;
            const double inverse = 1 / step;
            for (int j = begin; j < end; ++j, ++index) {
                const PanoramaColumn& c = column(j);
                const double height = tangent * c.secant;
                if (std::abs(height) > 1) {
                    down.set_absent(index);
                } else {
                    down.set(index, texel_of(-height),
                             BoxWidth(step * c.secant, inverse * c.cosine));
                }
            }
        }
        for (int turn = 0; turn < turns_; ++turn) {
            const int first = begin + turn * (width_ / turns_);
            const Face face = column(first).face;
            const auto read = [&](int row, int from, int to, Lane<Channels>* line) {
                read_face_row(cube_, face, row, from, to, line);
            };
            const auto in_place = [&](int row, int from, int to) {
                return face_row_in_place(cube_, face, row, from, to);
            };
            if (turn == 0) {
                filtered.fill(down, across, read, in_place);
            } else {
                filtered.refill(across, read, in_place);
            }
            for (int row = row_begin; row < row_end; ++row) {
                const std::size_t taps = static_cast<std::size_t>(row - row_begin) * columns;
                fill_row(row, first, columns, taps, scratch);
            }
        }
    }

    /// Fills `columns` texels of a row from column `first` on; their taps in `down` begin at
    /// `taps`.
    void fill_row(int row, int first, std::size_t columns, std::size_t taps,
                  Scratch& scratch) const {
        const TapList& down = scratch.down;
        const Reach reach = reach_of(down.widest());
        for (std::size_t j = 0; j < columns;) {
            const bool pole = down.absent(taps + j);
            std::size_t until = j + 1;
            while (until < columns && down.absent(taps + until) == pole) ++until;
            const int from = first + static_cast<int>(j);
            if (pole) {
                sample_pole(row, from, until - j, scratch.line);
            } else {
                scratch.filtered.filter(reach, down, taps + j, j, until - j, scratch.line);
            }
            const std::size_t index = index_of(row, from);
            if (!to_.store(scratch.line, until - j, 1, index)) [[unlikely]] {
                mend(row, from, pole, j, until - j, taps + j, scratch);
                to_.store(scratch.line, until - j, 1, index);
            }
            j = until;
        }
    }

    /// Computes again the texels of scratch.line that are not finite: `count` texels of a row from
    /// column `first` on, whose taps begin at down[taps] and across[tap].
    [[gnu::noinline]] void mend(int row, int first, bool pole, std::size_t tap, std::size_t count,
                                std::size_t taps, Scratch& scratch) const {
        mend_texels<Channels>(scratch.line, count, [&](std::size_t i) {
            if (pole) return sum_pole(row, column(first + static_cast<int>(i)));
            return sum_box(cube_, column(first).face, scratch.down[taps + i],
                           scratch.across[tap + i]);
        });
    }

    /// Computes `count` texels of a row from column `first` on, which lie on +Y or -Y.
    void sample_pole(int row, int first, std::size_t count, Lane<Channels>* to) const {
        const auto& samples = pole_rows_[static_cast<std::size_t>(row)].samples;
        const bool up = latitude(row) > 0;
        const float y = up ? 1.0f : -1.0f;
        const Face face = up ? Face::pos_y : Face::neg_y;
        const float half_texels = static_cast<float>(cube_.size) / 2.0f;
        const float middle = half_texels - 0.5f;
        const float weight = 1.0f / static_cast<float>(samples.size());
        const PanoramaColumn* c = &column(first);
        for (std::size_t j = 0; j < count; ++j, ++c) {
            const auto column_x = static_cast<float>(c->x);
            const auto column_z = static_cast<float>(c->z);
            const auto look = [&](const auto& at) {
                const float x = column_x * at.cosine - column_z * at.sine;
                const float z = column_z * at.cosine + column_x * at.sine;
                if (std::abs(x) > 1 || std::abs(z) > 1) [[unlikely]] {
                    const FaceUv<float> uv = direction_to_face_uv(glm::vec3(x, y, z));
                    return cube_.bilinear(uv.face, uv.s, uv.t);
                }
                return cube_.between(face, x * half_texels + middle, y * z * half_texels + middle);
            };
            const Lane<Channels> one = look(samples[0]);
            if (samples.size() == 1) {
                to[j] = one;
                continue;
            }
            Lane<Channels> sum{};
            for (std::size_t i = 1; i < samples.size(); ++i) sum += look(samples[i]) - one;
            to[j] = one + sum * weight;
        }
    }

    /// Computes one texel of a row on +Y or -Y as sample_pole does, by sums of weighted texels.
    Lane<Channels> sum_pole(int row, const PanoramaColumn& column) const {
        const auto& samples = pole_rows_[static_cast<std::size_t>(row)].samples;
        const float y = latitude(row) > 0 ? 1.0f : -1.0f;
        const auto column_x = static_cast<float>(column.x);
        const auto column_z = static_cast<float>(column.z);
        Lane<Channels> sum{};
        for (const auto& at : samples) {
            const float x = column_x * at.cosine - column_z * at.sine;
            const float z = column_z * at.cosine + column_x * at.sine;
            const FaceUv<float> uv = direction_to_face_uv(glm::vec3(x, y, z));
            sum += cube_.sum_bilinear(uv.face, uv.s, uv.t) / static_cast<float>(samples.size());
        }
        return sum;
    }

    static int samples_for(double texels) {
        return std::max(1, static_cast<int>(std::ceil(texels - 1e-6)));
    }

    CubeTexels<Pixel, Channels> cube_;
    int width_;
    int height_;
    double lon_step_;
    double lat_step_;
    std::vector<PanoramaColumn> columns_;
    std::vector<double> latitudes_;
    std::vector<PoleRow> pole_rows_;
    int turns_ = 1;  ///< parts of the panorama that differ only in their faces: 4, or 1
    TexelTarget<Channels> to_;
};

/// Makes the taps of one axis, from faces of n texels to texels begin..end of faces of `size`; each
/// tap is repeated `times` times.
void face_taps(int n, Sampling from, int size, Sampling to, int begin, int end, std::size_t times,
               TapList& taps) {
    const double reach = from == Sampling::borders ? n - 1.0 : n;  // texels from edge to edge
    const double offset = from == Sampling::borders ? 0.0 : -0.5;
    const double steps = to == Sampling::borders ? size - 1.0 : size;
    const double start = to == Sampling::borders ? 0.0 : 0.5;
    taps.resize(static_cast<std::size_t>(end - begin) * times);
    std::size_t index = 0;
    for (int i = begin; i < end; ++i) {
        for (std::size_t j = 0; j < times; ++j) {
            taps.set(index++, (i + start) / steps * reach + offset, BoxWidth(reach / steps));
        }
    }
}

/// Computes again the texels of a row of a face that are not finite; `down` has one tap for each.
template <typename Pixel, int Channels>
[[gnu::noinline]] void mend_face_row(const CubeTexels<Pixel, Channels>& texels, Face face,
                                     const BoxTap* down, const TapList& across,
                                     Buffer<Lane<Channels>>& line) {
    mend_texels<Channels>(line.data(), line.size(), [&](std::size_t column) {
        return sum_box(texels, face, down[column], across[column]);
    });
}

/// Resamples all faces, in bands of rows: along rows first, along columns then.
template <typename Pixel, int Channels>
void resample_all(const CubeTexels<Pixel, Channels>& texels, Sampling from, int size, Sampling to,
                  const TexelTarget<Channels>& target) {
    struct Scratch {
        TapList down;
        TapList across;
        FilteredRows<Channels> filtered;
        Buffer<Lane<Channels>> line;
    };
    constexpr int band = 32;  // rows of a face at a time
    const int bands = (size + band - 1) / band;
    const auto n = static_cast<std::size_t>(size);
    const auto fill = [&](std::size_t begin, std::size_t end, Scratch& scratch) {
        TapList& down = scratch.down;
        face_taps(texels.size, from, size, to, 0, size, 1, scratch.across);
        scratch.line.resize(n);
        for (std::size_t i = begin; i < end; ++i) {
            const Face face = all_faces[i / static_cast<std::size_t>(bands)];
            const int first = static_cast<int>(i) % bands * band;
            const int last = std::min(first + band, size);
            face_taps(texels.size, from, size, to, first, last, n, down);
            scratch.filtered.fill(
                down, scratch.across,
                [&](int row, int at, int until, Lane<Channels>* line) {
                    read_face_row(texels, face, row, at, until, line);
                },
                [&](int row, int at, int until) {
                    return face_row_in_place(texels, face, row, at, until);
                });
            std::size_t index = (face_index(face) * n + static_cast<std::size_t>(first)) * n;
            for (std::size_t tap = 0; tap < down.size(); tap += n, index += n) {
                scratch.filtered.filter(reach_of(down.widest()), down, tap, 0, n,
                                        scratch.line.data());
                if (target.store(scratch.line.data(), n, 1, index)) continue;
                mend_face_row(texels, face, &down[tap], scratch.across, scratch.line);
                target.store(scratch.line.data(), n, 1, index);
            }
        }
    };
    parallel_for_with<Scratch>(0, static_cast<std::size_t>(face_count * bands), 1, fill);
}

void check_face_size(int size, Sampling sampling) {
    const int least = sampling == Sampling::borders ? 2 : 1;
    if (size < least) {
        throw std::invalid_argument("size: expected at least " + std::to_string(least) + ", got " +
                                    std::to_string(size));
    }
}

}  // namespace

EquirectAngles::EquirectAngles(int width, Center center, Sampling sampling) {
    constexpr double half_turn = std::numbers::pi;
    const bool borders = sampling == Sampling::borders;
    const int height = width / 2;
    const double offset = borders ? 0.0 : 0.5;
    longitude_step = 2 * half_turn / (borders ? width - 1 : width);
    latitude_step = half_turn / (borders ? std::max(height - 1, 1) : height);
    const glm::dvec3 forward = center_forward<double>(center);
    const glm::dvec3 right = center_right<double>(center);
    for (int column = 0; column < width; ++column) {
        const double longitude = (column + offset) * longitude_step - half_turn;
        directions.push_back(std::sin(longitude) * right + std::cos(longitude) * forward);
    }
    for (int row = 0; row < height; ++row) {
        latitudes.push_back(half_turn / 2 - (row + offset) * latitude_step);
    }
}

void check_equirect_width(int width) {
    if (width >= 2 && width % 2 == 0) return;
    throw std::invalid_argument("width: expected an even number of at least 2, got " +
                                std::to_string(width));
}

PixelBuffer cube_to_equirect(const CubeMapData& cube, int width, Center center, Sampling sampling,
                             DType to) {
    check_equirect_width(width);
    PixelBuffer result(static_cast<std::size_t>(width) * static_cast<std::size_t>(width / 2) *
                       static_cast<std::size_t>(cube.channels) * dtype_size(to));
    with_channels(cube.channels, [&](auto constant) {
        constexpr int channels = decltype(constant)::value;
        with_pixels(cube.dtype, cube.pixels->data(), [&]<typename Pixel>(const Pixel* faces) {
            CubeToEquirect<Pixel, channels>({faces, cube.size}, width, center, sampling,
                                            {result.data(), to})
                .run();
        });
    });
    return result;
}

PixelBuffer resample_faces(const CubeMapData& cube, Sampling from, int size, Sampling to,
                           DType dtype) {
    check_face_size(cube.size, from);
    check_face_size(size, to);
    if (from == Sampling::borders && to == Sampling::borders) {
        throw std::invalid_argument("sampling: expected centers on one side at least");
    }
    const auto n = static_cast<std::size_t>(size);
    PixelBuffer result(face_count * n * n * static_cast<std::size_t>(cube.channels) *
                       dtype_size(dtype));
    with_channels(cube.channels, [&](auto constant) {
        constexpr int channels = decltype(constant)::value;
        with_pixels(cube.dtype, cube.pixels->data(), [&]<typename Pixel>(const Pixel* pixels) {
            resample_all<Pixel, channels>({pixels, cube.size}, from, size, to,
                                          {result.data(), dtype});
        });
    });
    return result;
}

PixelBuffer convert_pixels(const PixelBuffer& pixels, DType from, DType to) {
    const std::size_t count = pixels.size() / dtype_size(from);
    PixelBuffer result(count * dtype_size(to));
    parallel_for(0, count, std::size_t{1} << 18, [&](std::size_t begin, std::size_t end) {
        float line[256];
        for (std::size_t i = begin; i < end; i += std::size(line)) {
            const std::size_t length = std::min(std::size(line), end - i);
            pixels_to_floats(from, pixels.data() + i * dtype_size(from), length, line);
            floats_to_pixels(to, line, length, result.data() + i * dtype_size(to));
        }
    });
    return result;
}

}  // namespace cubecam
