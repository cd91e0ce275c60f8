#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/cubemap/infinities.hpp"
#include "cubecam/cubemap/resample_tile.hpp"
#include "cubecam/math/fast_atan.hpp"

#include <glm/geometric.hpp>

#include <atomic>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace cubecam {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int tile_size = 64;  ///< the sources of such a tile fit into the cache of one core
constexpr std::size_t largest_block = std::size_t{1} << 20;  ///< texels: 16 MiB a thread

/// A panorama whose columns form a ring and whose rows continue beyond the poles.
template <typename Pixel, int Channels>
struct EquirectTexels {
    const Pixel* pixels;
    int width;
    int height;
    Center center;
    int period;     ///< columns in a full turn; a border-sampled picture repeats its first column
    double offset;  ///< column and row of an edge of the picture: -1/2; 0 with borders
    double rows;    ///< rows in half a turn

    double column_of(double longitude) const {
        return period * (0.5 + longitude / (2 * pi)) + offset;
    }
    double row_of(double latitude) const { return rows * (0.5 - latitude / pi) + offset; }

    int wrap(int column) const {
        if (column >= 0 && column < period) return column;  // the usual case, without a division
        const int rest = column % period;
        return rest < 0 ? rest + period : rest;
    }

    /// Beyond a pole the rows continue on the other side, half a turn away.
    const Pixel* row_texels(int& row, int& column) const {
        const int last = height - 1;
        const int mirror = offset < 0 ? 1 : 0;  // centres: row -1 is row 0 there; borders: row 1
        if (row < 0 || row > last) {
            row = row < 0 ? -mirror - row : 2 * last + mirror - row;
            row = std::clamp(row, 0, last);
            column += period / 2;
        }
        return pixels + static_cast<std::size_t>(row) * static_cast<std::size_t>(width) * Channels;
    }

    void read(int row, int begin, int end, Lane<Channels>* to) const {
        int column = begin;
        const Pixel* line = row_texels(row, column);
        for (int left = end - begin; left > 0;) {
            const int start = wrap(column);
            const int run = std::min(left, period - start);
            const Pixel* from = line + static_cast<std::ptrdiff_t>(start) * Channels;
            if (row + 2 < height) {
                prefetch(from + std::ptrdiff_t{2} * width * Channels,
                         static_cast<std::size_t>(run) * Channels * sizeof(Pixel));
            }
            for (int i = 1; i < run; ++i, from += Channels) {
                *to++ = load_texel_before_another<Channels>(from);
            }
            *to++ = load_texel<Channels>(from);
            column += run;
            left -= run;
        }
    }

    /// Returns where texels begin..end lie one after another as floats with another texel behind
    /// them, or null if they do not.
    const float* in_place([[maybe_unused]] int row, [[maybe_unused]] int begin,
                          [[maybe_unused]] int end) const {
        if constexpr (std::is_same_v<Pixel, float>) {
            int column = begin;
            const float* line = row_texels(row, column);
            column = wrap(column);
            if (column + (end - begin) >= period) return nullptr;
            const float* from = line + static_cast<std::ptrdiff_t>(column) * Channels;
            if (row + 2 < height) {
                prefetch(from + std::ptrdiff_t{2} * width * Channels,
                         static_cast<std::size_t>(end - begin) * Channels * sizeof(float));
            }
            return from;
        } else {
            return nullptr;
        }
    }

    /// Returns the average over a box of any size, without copying texels.
    Lane<Channels> box(const BoxTap& down, const BoxTap& across) const {
        return apply_tap<Reach::far>(down, [&](int i) {
            int row = down.first + i;
            int column = across.first;
            const Pixel* line = row_texels(row, column);
            return apply_tap<Reach::far>(across, [&](int j) {
                return load_texel<Channels>(line + static_cast<std::ptrdiff_t>(wrap(column + j)) *
                                                       Channels);
            });
        });
    }
};

template <typename Pixel, int Channels>
class EquirectToCube {
public:
    EquirectToCube(const EquirectTexels<Pixel, Channels>& source, int size,
                   const TexelTarget<Channels>& to)
        : source_(source), size_(size), texel_(2.0 / size), to_(to) {
        const glm::dvec3 forward = center_forward<double>(source.center);
        center_azimuth_ = std::atan2(forward.x, forward.z);
    }

    /// Returns whether all results are finite.
    bool run() const {
        std::atomic<bool> numbers{true};
        // The loop runs over the tiles of one part of a face; each tile also fills its mirror
        // images, which have the same angles.
        const int half = (size_ + 1) / 2;
        const int across = (half + tile_size - 1) / tile_size;
        const int down = (size_ + tile_size - 1) / tile_size;
        const int side_tiles = across * down;
        const int tiles = side_tiles + across * across;
        const auto fill = [&](std::size_t begin, std::size_t end, Scratch& scratch) {
            scratch.numbers = true;
            for (int tile = static_cast<int>(begin); tile < static_cast<int>(end); ++tile) {
                if (tile < side_tiles) {
                    sides(tile / across * tile_size, tile % across * tile_size, half, scratch);
                } else {
                    const int pole = tile - side_tiles;
                    poles(pole / across * tile_size, pole % across * tile_size, half, scratch);
                }
            }
            if (!scratch.numbers) numbers = false;
        };
        parallel_for_with<Scratch>(0, static_cast<std::size_t>(tiles), 1, fill);
        return numbers;
    }

private:
    /// Memory that the tiles of one thread reuse.
    struct Scratch {
        TapList across;
        TapList down;
        TapList down_south;
        FilteredRows<Channels> filtered;
        SourceBlock<Channels> block;
        Buffer<double> angles;
        Buffer<BoxWidth> widths;
        Lane<Channels> line[tile_size];
        bool numbers;
    };

    /// The coordinate of a texel's center, from -1 to 1 across the face.
    double coordinate(int index) const { return (index + 0.5) * texel_ - 1; }

    /// The index of a texel among those of all six faces.
    std::size_t index_of(Face face, int row, int column) const {
        const auto n = static_cast<std::size_t>(size_);
        return (face_index(face) * n + static_cast<std::size_t>(row)) * n +
               static_cast<std::size_t>(column);
    }

    /// The longitude, counted from the picture's center to the right: opposite to the azimuth,
    /// which turns from +Z to +X.
    double longitude(double azimuth) const { return center_azimuth_ - azimuth; }

    /// Fills a tile of the left half of each side face, and its mirror image. Where a is the
    /// horizontal and y the vertical coordinate on the face: longitude = +-atan(a), latitude =
    /// atan(y cos(longitude)).
    void sides(int row_begin, int column_begin, int half, Scratch& scratch) const {
        TapList& across = scratch.across;
        TapList& down = scratch.down;
        FilteredRows<Channels>& filtered = scratch.filtered;
        const int rows = std::min(tile_size, size_ - row_begin);
        const int columns = std::min(tile_size, half - column_begin);
        down.resize(static_cast<std::size_t>(rows * columns));
        for (int j = 0; j < columns; ++j) {
            const double a = coordinate(column_begin + j);
            const double secant = std::sqrt(1 + a * a);
            for (int i = 0; i < rows; ++i) {
                const double t = coordinate(row_begin + i) / secant;  // downwards
                const double square = 1 + t * t;
                down.set(static_cast<std::size_t>(i * columns + j),
                         source_.row_of(-fast_atan(t, std::sqrt(square))),
                         BoxWidth(texel_ / (secant * square) * source_.rows / pi));
            }
        }
        const Reach reach = reach_of(down.widest());
        const auto read = [&](int row, int begin, int end, Lane<Channels>* to) {
            source_.read(row, begin, end, to);
        };
        const auto in_place = [&](int row, int begin, int end) {
            return source_.in_place(row, begin, end);
        };
        bool first = true;
        for (const Face face : {Face::pos_x, Face::neg_x, Face::pos_z, Face::neg_z}) {
            const glm::dvec3 major = face_axes(face).major;
            const glm::dvec3 s_axis = face_axes(face).s_axis;
            const double middle = longitude(std::atan2(major.x, major.z));
            const double sense = glm::dot(s_axis, glm::cross(major, glm::dvec3(0, 1, 0)));
            for (const bool mirrored : {false, true}) {
                across.resize(static_cast<std::size_t>(columns));
                for (int j = 0; j < columns; ++j) {
                    const double a = coordinate(column_begin + j);
                    const double turn = std::atan(a) * (mirrored ? -sense : sense);
                    across.set(static_cast<std::size_t>(j), source_.column_of(middle + turn),
                               BoxWidth(texel_ / (1 + a * a) * source_.period / (2 * pi)));
                }
                if (first) {
                    filtered.fill(down, across, read, in_place);
                } else {
                    filtered.refill(across, read, in_place);
                }
                first = false;
                const int at_column = mirrored ? size_ - 1 - column_begin : column_begin;
                for (int i = 0; i < rows; ++i) {
                    const auto count = static_cast<std::size_t>(columns);
                    filtered.filter(reach, down, static_cast<std::size_t>(i) * count, 0, count,
                                    scratch.line);
                    scratch.numbers &= to_.store(scratch.line, count, mirrored ? -1 : 1,
                                                 index_of(face, row_begin + i, at_column));
                }
            }
        }
    }

    /// Fills a tile of one quarter of +Y, and its mirror images on +Y and -Y. The box lies along
    /// rows and columns of the panorama: its height is the size of the texel along the meridian,
    /// its width the size across the meridian.
    void poles(int row_begin, int column_begin, int half, Scratch& scratch) const {
        TapList& across = scratch.across;
        TapList& north = scratch.down;
        TapList& south = scratch.down_south;
        Buffer<double>& angles = scratch.angles;  // azimuths, in the quarter of positive x and z
        Buffer<BoxWidth>& widths = scratch.widths;
        SourceBlock<Channels>& block = scratch.block;
        const int rows = std::min(tile_size, half - row_begin);
        const int columns = std::min(tile_size, half - column_begin);
        const auto count = static_cast<std::size_t>(rows * columns);
        north.resize(count);
        south.resize(count);
        angles.resize(count);
        widths.clear();
        widths.reserve(count);
        for (int row = row_begin; row < row_begin + rows; ++row) {
            for (int column = column_begin; column < column_begin + columns; ++column) {
                const double s = -coordinate(column);  // >= 0
                const double t = -coordinate(row);
                const double square = s * s + t * t;
                const double radius = std::sqrt(square);
                const BoxWidth high(texel_ / (1 + square) * source_.rows / pi);
                const double from_pole = fast_atan(radius, std::sqrt(1 + square));
                const double ratio = std::min(s, t) / std::max(std::max(s, t), 1e-300);
                const double angle = fast_atan(ratio, std::sqrt(1 + ratio * ratio));
                const std::size_t index = widths.size();
                north.set(index, source_.row_of(pi / 2 - from_pole), high);
                south.set(index, source_.row_of(from_pole - pi / 2), high);
                angles[index] = s < t ? angle : pi / 2 - angle;
                widths.emplace_back(std::min(texel_ / (2 * pi * radius), 1.0) * source_.period);
            }
        }
        const bool even = source_.period % 2 == 0;  // the same taps serve half a turn further
        for (const bool acute : {false, true}) {
            for (const bool positive_x : {true, false}) {
                const bool positive_z = acute == positive_x;
                const int shift = even && !positive_x ? source_.period / 2 : 0;
                if (positive_x || !even) {
                    across.resize(count);
                    for (std::size_t i = 0; i < count; ++i) {
                        const double azimuth = positive_z ? angles[i] : pi - angles[i];
                        across.set(i, source_.column_of(longitude(positive_x ? azimuth : -azimuth)),
                                   widths[i]);
                    }
                }
                for (const Face face : {Face::pos_y, Face::neg_y}) {
                    TapList& down = face == Face::pos_y ? north : south;
                    const bool copied =
                        down.range().size() * across.range().size() <= largest_block;
                    if (copied) {
                        block.fill(down, across,
                                   [&](int row, int begin, int end, Lane<Channels>* to) {
                                       source_.read(row, begin + shift, end + shift, to);
                                   });
                    }
                    // x grows with the column; z grows with the row on +Y, and falls with the row
                    // on -Y.
                    const bool last_rows = positive_z == (face == Face::pos_y);
                    const int at_column = positive_x ? size_ - 1 - column_begin : column_begin;
                    for (int i = 0; i < rows; ++i) {
                        const int row = row_begin + i;
                        const std::size_t begin = static_cast<std::size_t>(i * columns);
                        const std::size_t end = begin + static_cast<std::size_t>(columns);
                        if (copied) {
                            filter_runs(block, down, across, widths, begin, end, scratch.line);
                        } else {
                            for (std::size_t k = begin; k < end; ++k) {
                                scratch.line[k - begin] =
                                    source_.box(down[k], shifted(across[k], shift));
                            }
                        }
                        scratch.numbers &=
                            to_.store(scratch.line, end - begin, positive_x ? -1 : 1,
                                      index_of(face, last_rows ? size_ - 1 - row : row, at_column));
                    }
                }
            }
        }
    }

    static BoxTap shifted(BoxTap tap, int columns) {
        tap.first += columns;
        return tap;
    }

    /// Boxes grow towards the pole, so this filters runs of texels whose boxes have the same reach.
    static void filter_runs(const SourceBlock<Channels>& block, const TapList& down,
                            const TapList& across, const Buffer<BoxWidth>& widths,
                            std::size_t begin, std::size_t end, Lane<Channels>* to) {
        const auto reach_at = [&](std::size_t i) {
            return reach_of(std::max(widths[i].texels, down.widest()));
        };
        for (std::size_t i = begin; i < end;) {
            const Reach reach = reach_at(i);
            std::size_t until = i + 1;
            while (until < end && reach_at(until) == reach) ++until;
            block.filter(reach, down, across, i, until - i, to + (i - begin));
            i = until;
        }
    }

    EquirectTexels<Pixel, Channels> source_;
    int size_;
    double texel_;  ///< the width of a texel on a face from -1 to 1
    double center_azimuth_;
    TexelTarget<Channels> to_;
};

void check_equirect(const EquirectPixels& from, int size) {
    const bool borders = from.sampling == Sampling::borders;
    const bool good = borders ? from.width >= 2 && from.height >= 2
                              : from.height >= 1 && from.width == 2 * from.height;
    if (!good) {
        throw std::invalid_argument(std::string("equirect: expected a picture ") +
                                    (borders ? "of at least 2 x 2" : "twice as wide as high") +
                                    ", got width " + std::to_string(from.width) + " and height " +
                                    std::to_string(from.height));
    }
    if (size < 1) {
        throw std::invalid_argument("size: expected at least 1, got " + std::to_string(size));
    }
}

}  // namespace

PixelBuffer equirect_to_cube(const EquirectPixels& from, int size, DType to) {
    check_equirect(from, size);
    const bool borders = from.sampling == Sampling::borders;
    const auto n = static_cast<std::size_t>(size);
    const auto channels = static_cast<std::size_t>(from.channels);
    const auto values =
        static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height) * channels;
    PixelBuffer result(face_count * n * n * channels * dtype_size(to));
    with_channels(from.channels, [&](auto constant) {
        constexpr int count = decltype(constant)::value;
        const auto fill = [&]<typename Pixel>(const Pixel* pixels) {
            const EquirectTexels<Pixel, count> source = {pixels,
                                                         from.width,
                                                         from.height,
                                                         from.center,
                                                         borders ? from.width - 1 : from.width,
                                                         borders ? 0.0 : -0.5,
                                                         borders ? from.height - 1.0 : from.height};
            return EquirectToCube<Pixel, count>(source, size, {result.data(), to}).run();
        };
        with_pixels(from.dtype, from.pixels, [&](const auto* pixels) {
            if (!fill(pixels))
                fill(without_infinities(pixels, values, from.width, from.channels).data());
        });
    });
    return result;
}

int default_face_size(int equirect_width) {
    const double least = std::max(1.0, std::ceil(equirect_width / pi));
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(least)));
}

}  // namespace cubecam
