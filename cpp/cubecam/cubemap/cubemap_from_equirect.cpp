#include "cubecam/core/memory.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/cubemap/equirect_reader.hpp"
#include "cubecam/cubemap/infinities.hpp"
#include "cubecam/cubemap/resample_tile.hpp"
#include "cubecam/cubemap/tap_cache.hpp"
#include "cubecam/image/result_pool.hpp"
#include "cubecam/math/fast_atan.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

namespace cubecam {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t largest_block = std::size_t{1} << 20;  ///< texels: 16 MiB a thread
constexpr std::array side_faces = {Face::pos_x, Face::neg_x, Face::pos_z, Face::neg_z};

/// The tiles of a conversion from a panorama to a cube, and their taps.
///
/// A tile lies on the left half of the side faces, or on one quarter of +Y; it also fills its
/// mirror images, which have the same angles. A tile's ranges of texels reach to the edges of the
/// tile, so that each texel of the panorama is read for some tile, also where boxes leave gaps.
class EquirectToCubePlan : public TapPlan {
public:
    EquirectToCubePlan(const EquirectGrid& panorama, Center center, int face_size)
        : grid(panorama), size(face_size), half((face_size + 1) / 2), texel_(2.0 / face_size) {
        const glm::dvec3 forward = center_forward<double>(center);
        center_azimuth_ = std::atan2(forward.x, forward.z);
        tiles_across = (half + tile_size - 1) / tile_size;
        side_tiles_ = tiles_across * ((size + tile_size - 1) / tile_size);
        own_bytes_ = sizeof *this;
    }

    struct Tile {
        bool side;
        int row;  ///< the first one
        int column;
        int rows;
        int columns;
    };

    /// The lists of a tile of the sides: `down`, with a tap for each texel, then the taps of the
    /// columns for each face of `side_faces`, and after each those of its mirror image.
    static constexpr std::size_t side_down = 0;
    static constexpr std::size_t side_across = 1;
    /// The lists of a tile of the poles, with a tap for each texel.
    static constexpr std::size_t north = 0;
    static constexpr std::size_t south = 1;
    static constexpr std::size_t pole_across = 2;

    std::size_t tiles() const {
        return static_cast<std::size_t>(side_tiles_ + tiles_across * tiles_across);
    }

    double taps_bytes() const override {
        const double n = size;
        return sizeof(BoxTap) * (n * n / 2 + n * n / 4 * (turns_by_half() ? 4 : 6));
    }

    /// Whether the taps of the columns also serve half a turn further.
    bool turns_by_half() const { return grid.period % 2 == 0; }

    Tile tile(std::size_t index) const {
        const int number = static_cast<int>(index);
        const bool side = number < side_tiles_;
        const int place = side ? number : number - side_tiles_;
        const int row = place / tiles_across * tile_size;
        const int column = place % tiles_across * tile_size;
        return {side, row, column, std::min(tile_size, (side ? size : half) - row),
                std::min(tile_size, half - column)};
    }

    void make(std::size_t index, TileTaps& taps) const {
        const Tile at = tile(index);
        if (at.side) {
            make_side(at, taps);
        } else {
            make_pole(at, taps);
        }
        for (TapList& list : taps.lists) list.close();
    }

    const EquirectGrid grid;
    const int size;
    const int half;
    int tiles_across;

private:
    /// The coordinate of a texel's center, from -1 to 1 across the face. Its edges are half a texel
    /// away.
    double coordinate(double index) const { return (index + 0.5) * texel_ - 1; }

    /// The longitude, counted from the picture's center to the right: opposite to the azimuth,
    /// which turns from +Z to +X.
    double longitude(double azimuth) const { return center_azimuth_ - azimuth; }

    /// Where a is the horizontal and y the vertical coordinate on the face: longitude = +-atan(a),
    /// latitude = atan(y cos(longitude)).
    void make_side(const Tile& at, TileTaps& taps) const {
        taps.lists.resize(side_across + 2 * side_faces.size());
        taps.reaches.clear();
        TapList& down = taps.lists[side_down];
        const int columns = at.columns;
        down.resize(static_cast<std::size_t>(at.rows * columns));
        for (int j = 0; j < columns; ++j) {
            const double a = coordinate(at.column + j);
            const double secant = std::sqrt(1 + a * a);
            for (int i = 0; i < at.rows; ++i) {
                const double t = coordinate(at.row + i) / secant;  // downwards
                const double square = 1 + t * t;
                down.set(static_cast<std::size_t>(i * columns + j),
                         grid.row_of(-fast_atan(t, std::sqrt(square))),
                         BoxWidth(texel_ / (secant * square) * grid.rows / pi));
            }
        }
        const double left = coordinate(at.column - 0.5);
        const double right = std::min(coordinate(at.column + columns - 0.5), 0.0);
        for (const double a : {left, right}) {
            for (const double row : {at.row - 0.5, at.row + at.rows - 0.5}) {
                down.cover(grid.row_of(-std::atan(coordinate(row) / std::sqrt(1 + a * a))));
            }
        }
        std::size_t list = side_across;
        for (const Face face : side_faces) {
            const glm::dvec3 major = face_axes(face).major;
            const glm::dvec3 s_axis = face_axes(face).s_axis;
            const double middle = longitude(std::atan2(major.x, major.z));
            const double sense = glm::dot(s_axis, glm::cross(major, glm::dvec3(0, 1, 0)));
            for (const bool mirrored : {false, true}) {
                TapList& across = taps.lists[list++];
                const double turn = mirrored ? -sense : sense;
                across.resize(static_cast<std::size_t>(columns));
                for (int j = 0; j < columns; ++j) {
                    const double a = coordinate(at.column + j);
                    across.set(static_cast<std::size_t>(j),
                               grid.column_of(middle + std::atan(a) * turn),
                               BoxWidth(texel_ / (1 + a * a) * grid.period / (2 * pi)));
                }
                across.cover(grid.column_of(middle + std::atan(left) * turn));
                across.cover(grid.column_of(middle + std::atan(right) * turn));
            }
        }
    }

    /// The box lies along rows and columns of the panorama: its height is the size of the texel
    /// along the meridian, its width the size across the meridian.
    void make_pole(const Tile& at, TileTaps& taps) const {
        taps.lists.resize(pole_across + (turns_by_half() ? 2 : 4));
        TapList& up = taps.lists[north];
        TapList& low = taps.lists[south];
        const auto count = static_cast<std::size_t>(at.rows * at.columns);
        up.resize(count);
        low.resize(count);
        Buffer<double> angles(count);  // azimuths, in the quarter of positive x and z
        Buffer<BoxWidth> widths;
        widths.reserve(count);
        std::size_t index = 0;
        for (int row = at.row; row < at.row + at.rows; ++row) {
            for (int column = at.column; column < at.column + at.columns; ++column, ++index) {
                const double s = -coordinate(column);  // >= 0
                const double t = -coordinate(row);
                const double square = s * s + t * t;
                const double radius = std::sqrt(square);
                const BoxWidth high(texel_ / (1 + square) * grid.rows / pi);
                const double from_pole = fast_atan(radius, std::sqrt(1 + square));
                up.set(index, grid.row_of(pi / 2 - from_pole), high);
                low.set(index, grid.row_of(from_pole - pi / 2), high);
                angles[index] = quarter_azimuth(s, t);
                widths.emplace_back(std::min(texel_ / (2 * pi * radius), 1.0) * grid.period);
            }
        }
        // The tile's corners. Beyond the middle of the face, its mirror images have the texels.
        std::array<double, 4> corners{};
        std::size_t corner = 0;
        for (const double row : {at.row - 0.5, at.row + at.rows - 0.5}) {
            for (const double column : {at.column - 0.5, at.column + at.columns - 0.5}) {
                const double s = std::max(-coordinate(column), 0.0);
                const double t = std::max(-coordinate(row), 0.0);
                const double from_pole = std::atan(std::hypot(s, t));
                up.cover(grid.row_of(pi / 2 - from_pole));
                low.cover(grid.row_of(from_pole - pi / 2));
                corners[corner++] = std::atan2(s, t);
            }
        }
        std::size_t list = pole_across;
        for (const bool acute : {false, true}) {
            for (const bool positive_x : {true, false}) {
                if (!positive_x && turns_by_half()) continue;
                const auto column_of = [&](double angle) {
                    const double azimuth = acute == positive_x ? angle : pi - angle;
                    return grid.column_of(longitude(positive_x ? azimuth : -azimuth));
                };
                TapList& across = taps.lists[list++];
                across.resize(count);
                for (std::size_t i = 0; i < count; ++i) {
                    across.set(i, column_of(angles[i]), widths[i]);
                }
                for (const double angle : corners) across.cover(column_of(angle));
            }
        }
        taps.reaches.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            taps.reaches[i] = reach_of(std::max(widths[i].texels, up.widest()));
        }
    }

    /// atan2(s, t) for positive s and t.
    static double quarter_azimuth(double s, double t) {
        const double ratio = std::min(s, t) / std::max(std::max(s, t), 1e-300);
        const double angle = fast_atan(ratio, std::sqrt(1 + ratio * ratio));
        return s < t ? angle : pi / 2 - angle;
    }

    double texel_;  ///< the width of a texel on a face from -1 to 1
    double center_azimuth_;
    int side_tiles_;
};

/// Converts panoramas of one size by one plan.
class EquirectsToCubes {
public:
    /// @param filling  the plan keeps taps that are not made yet
    EquirectsToCubes(EquirectToCubePlan& plan, bool filling, const EquirectPixels& from, DType to,
                     std::byte* cubes)
        : plan_(plan), filling_(filling), from_(from), to_(to), cubes_(cubes),
          n_(static_cast<std::size_t>(plan.size)), finite_(from.count) {
        for (auto& each : finite_) each.store(true);
    }

    void run() {
        for_each_tile<Scratch>(
            from_.count, plan_.tiles(),
            [this](std::size_t tile, std::size_t part, std::size_t first, std::size_t last,
                   Scratch& scratch) { fill_tile(tile, part, first, last, scratch); });
    }

    /// Whether all numbers of a panorama are finite.
    bool finite(std::size_t picture) const { return finite_[picture].load(); }

private:
    /// Memory that the tiles of one thread reuse.
    struct Scratch {
        TileTaps taps;
        FilteredRows filtered;
        SourceBlock block;
        Buffer<float> numbers;
        alignas(64) Float4 line[tile_size];
    };

    /// Fills a tile of the pictures begin..end.
    void fill_tile(std::size_t tile, std::size_t part, std::size_t begin, std::size_t end,
                   Scratch& scratch) {
        const bool kept = plan_.keeps() && (!filling_ || part == 0);
        TileTaps& taps = kept ? plan_.kept(tile) : scratch.taps;
        if (!kept || filling_) plan_.make(tile, taps);
        const EquirectToCubePlan::Tile at = plan_.tile(tile);
        const std::size_t texels =
            static_cast<std::size_t>(from_.width) * static_cast<std::size_t>(from_.height);
        const auto channels = static_cast<std::size_t>(from_.channels);
        for (std::size_t i = begin; i < end; ++i) {
            const std::byte* pixels =
                from_.pixels + i * texels * channels * dtype_size(from_.dtype);
            EquirectReader reader(plan_.grid, pixels, from_.channels, from_.dtype, scratch.numbers);
            const TexelTarget to = {cubes_ + i * face_count * n_ * n_ * channels * dtype_size(to_),
                                    to_, from_.channels};
            if (at.side) {
                sides(at, taps, reader, to, scratch);
            } else {
                poles(at, taps, reader, to, scratch);
            }
            if (!reader.finite()) finite_[i].store(false);
        }
    }

    /// The index of a texel among those of all six faces.
    std::size_t index_of(Face face, int row, int column) const {
        return (face_index(face) * n_ + static_cast<std::size_t>(row)) * n_ +
               static_cast<std::size_t>(column);
    }

    void sides(const EquirectToCubePlan::Tile& at, const TileTaps& taps, EquirectReader& reader,
               const TexelTarget& to, Scratch& scratch) const {
        const TapList& down = taps.lists[EquirectToCubePlan::side_down];
        const auto count = static_cast<std::size_t>(at.columns);
        std::size_t list = EquirectToCubePlan::side_across;
        const auto read = [&](int row, int begin, int end) { return reader.read(row, begin, end); };
        for (const Face face : side_faces) {
            for (const bool mirrored : {false, true}) {
                scratch.filtered.fill(down.range(), taps.lists[list++], from_.channels, read);
                const int column = mirrored ? plan_.size - 1 - at.column : at.column;
                for (int i = 0; i < at.rows; ++i) {
                    scratch.filtered.filter(down, static_cast<std::size_t>(i) * count, 0, count,
                                            scratch.line);
                    to.store(scratch.line, count, mirrored ? -1 : 1,
                             index_of(face, at.row + i, column));
                }
            }
        }
    }

    void poles(const EquirectToCubePlan::Tile& at, const TileTaps& taps, EquirectReader& reader,
               const TexelTarget& to, Scratch& scratch) const {
        const bool by_half = plan_.turns_by_half();
        const auto columns = static_cast<std::size_t>(at.columns);
        std::size_t list = EquirectToCubePlan::pole_across;
        for (const bool acute : {false, true}) {
            for (const bool positive_x : {true, false}) {
                const bool positive_z = acute == positive_x;
                const bool shifted = by_half && !positive_x;
                const TapList& across = taps.lists[shifted ? list - 1 : list++];
                const int shift = shifted ? plan_.grid.period / 2 : 0;
                for (const Face face : {Face::pos_y, Face::neg_y}) {
                    const TapList& down =
                        taps.lists[face == Face::pos_y ? EquirectToCubePlan::north
                                                       : EquirectToCubePlan::south];
                    const Boxes boxes(down, across, shift, reader, from_.channels, scratch);
                    // x grows with the column; z grows with the row on +Y, and falls with the row
                    // on -Y.
                    const bool last_rows = positive_z == (face == Face::pos_y);
                    const int column = positive_x ? plan_.size - 1 - at.column : at.column;
                    for (int i = 0; i < at.rows; ++i) {
                        const int row = at.row + i;
                        boxes.filter(taps.reaches, static_cast<std::size_t>(i) * columns, columns,
                                     scratch.line);
                        to.store(scratch.line, columns, positive_x ? -1 : 1,
                                 index_of(face, last_rows ? plan_.size - 1 - row : row, column));
                    }
                }
            }
        }
    }

    /// The boxes of one mirror image of a tile, over texels in place or over a copy of them.
    class Boxes {
    public:
        Boxes(const TapList& down, const TapList& across, int shift, EquirectReader& reader,
              int channels, Scratch& scratch)
            : down_(down), across_(across), shift_(shift), reader_(reader) {
            const TapRange rows = down.range();
            const TapRange columns = across.range().shifted(shift);
            const auto texel = channels * static_cast<std::ptrdiff_t>(sizeof(float));
            const auto read = [&](int row, int begin, int end) {
                return reader.read(row, begin, end);
            };
            if (const float* there = reader.in_place(rows, columns)) {
                texels_ = {there, static_cast<std::ptrdiff_t>(reader.row_floats() * sizeof(float)),
                           texel};
            } else if (rows.size() * columns.size() <= largest_block) {
                texels_ = scratch.block.fill(rows, columns, channels, read);
            } else {
                for (int row = rows.begin; row < rows.end; ++row) {
                    read(row, columns.begin, columns.end);  // looks for numbers that are not finite
                }
            }
        }

        /// Boxes grow towards the pole, so this filters runs of texels whose boxes have the same
        /// reach.
        void filter(const Buffer<Reach>& reaches, std::size_t begin, std::size_t count,
                    Float4* to) const {
            if (texels_.base == nullptr) {
                for (std::size_t i = 0; i < count; ++i) {
                    BoxTap across = across_.placed(begin + i);
                    across.first += shift_;
                    to[i] = reader_.box(down_.placed(begin + i), across);
                }
                return;
            }
            for (std::size_t first = 0; first < count;) {
                const Reach reach = reaches[begin + first];
                std::size_t until = first + 1;
                while (until < count && reaches[begin + until] == reach) ++until;
                filter_boxes(reach, texels_, down_.data(begin + first), across_.data(begin + first),
                             until - first, to + first);
                first = until;
            }
        }

    private:
        const TapList& down_;
        const TapList& across_;
        int shift_;
        EquirectReader& reader_;
        TexelGrid texels_{nullptr, 0, 0};
    };

    EquirectToCubePlan& plan_;
    bool filling_;
    EquirectPixels from_;
    DType to_;
    std::byte* cubes_;
    std::size_t n_;
    std::vector<std::atomic<bool>> finite_;
};

/// Converts again the pictures whose numbers are not all finite.
void convert_without_infinities(EquirectToCubePlan& plan, const EquirectPixels& from, DType to,
                                std::byte* cubes, const EquirectsToCubes& conversion) {
    const std::size_t values = static_cast<std::size_t>(from.width) *
                               static_cast<std::size_t>(from.height) *
                               static_cast<std::size_t>(from.channels);
    const auto n = static_cast<std::size_t>(plan.size);
    const std::size_t cube_bytes =
        face_count * n * n * static_cast<std::size_t>(from.channels) * dtype_size(to);
    for (std::size_t i = 0; i < from.count; ++i) {
        if (conversion.finite(i)) continue;
        const Buffer<float> numbers = without_infinities(
            from.dtype, from.pixels + i * values * dtype_size(from.dtype), values, i * values);
        EquirectPixels one = from;
        one.pixels = reinterpret_cast<const std::byte*>(numbers.data());
        one.dtype = DType::float32;
        one.count = 1;
        EquirectsToCubes(plan, false, one, to, cubes + i * cube_bytes).run();
    }
}

}  // namespace

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

void equirect_to_cube(const EquirectPixels& from, int size, DType to, std::byte* cubes) {
    check_equirect(from, size);
    const TapKey key = {true, from.width, from.height, size, from.center, from.sampling};
    bool fresh = false;
    const auto plan = plan_for<EquirectToCubePlan>(
        key,
        [&] {
            return std::make_shared<EquirectToCubePlan>(
                EquirectGrid(from.width, from.height, from.sampling), from.center, size);
        },
        fresh);
    EquirectsToCubes conversion(*plan, fresh, from, to, cubes);
    conversion.run();
    if (fresh) TapCache::instance().add(key, plan);
    convert_without_infinities(*plan, from, to, cubes, conversion);
}

std::shared_ptr<PixelBuffer> equirect_to_cube(const EquirectPixels& from, int size, DType to) {
    check_equirect(from, size);
    const auto n = static_cast<std::size_t>(size);
    auto faces = result_memory(from.count * face_count * n * n *
                               static_cast<std::size_t>(from.channels) * dtype_size(to));
    equirect_to_cube(from, size, to, faces->data());
    return faces;
}

int default_face_size(int equirect_width) {
    const double least = std::max(1.0, std::ceil(equirect_width / pi));
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(least)));
}

}  // namespace cubecam
