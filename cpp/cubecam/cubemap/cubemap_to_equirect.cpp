#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/cubemap/resample_tile.hpp"
#include "cubecam/cubemap/tap_cache.hpp"
#include "cubecam/image/result_pool.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

constexpr std::size_t largest_pole_block = std::size_t{1} << 20;  ///< texels: 16 MiB a thread

/// One destination column of a panorama, in the coordinates of its side face.
struct PanoramaColumn {
    Face face;
    double across;  ///< horizontal coordinate on the face, -1 to 1 from left to right as seen in
                    ///< GL's picture
    double secant;  ///< of the longitude within the face
    double cosine;  ///< 1 / secant
};

/// One row of a panorama on +Y or -Y, where the destination's texels are turned against the texels
/// of the face. Such a texel is sampled at several points: in each direction as many as it is
/// texels long.
struct PoleRow {
    struct Sample {
        float cosine;  ///< of the turn round the pole, times the radius
        float sine;
    };
    std::vector<Sample> samples;
};

/// The tiles of a conversion from a cube to a panorama, and their taps.
class CubeToEquirectPlan : public TapPlan {
public:
    CubeToEquirectPlan(int face_size, int columns, Center center, Sampling sampling)
        : size(face_size), width(columns), height(columns / 2) {
        const EquirectAngles angles(width, center, sampling);
        lon_step_ = angles.longitude_step;
        lat_step_ = angles.latitude_step;
        latitudes_ = angles.latitudes;
        const std::size_t all = angles.directions.size() + tile_size;
        x_.resize(all, 0.0f);
        z_.resize(all, 0.0f);
        for (std::size_t i = 0; i < angles.directions.size(); ++i) {
            const glm::dvec3& direction = angles.directions[i];
            columns_.push_back(make_column(direction));
            x_[i] = static_cast<float>(direction.x);
            z_[i] = static_cast<float>(direction.z);
        }
        for (const double each : latitudes_) pole_rows_.push_back(make_pole_row(each));
        // After a quarter turn the next side face has the same taps as the one before.
        if (sampling == Sampling::centers && width % 8 == 0) turns = 4;
        const int turn = width / turns;
        for (int begin = 0; begin < turn;) {
            int end = begin + 1;
            while (end < std::min(turn, begin + tile_size) &&
                   column(end).face == column(begin).face) {
                ++end;
            }
            spans_.emplace_back(begin, end);
            begin = end;
        }
        own_bytes_ = sizeof *this + columns_.size() * sizeof(PanoramaColumn) +
                     2 * all * sizeof(float) + latitudes_.size() * sizeof(double);
        for (const PoleRow& row : pole_rows_) {
            own_bytes_ += sizeof row + row.samples.size() * sizeof(PoleRow::Sample);
        }
    }

    /// A part of one face's columns, and of the rows.
    struct Tile {
        int row;
        int row_end;
        int column;  ///< in the first turn
        int column_end;
        std::size_t columns() const { return static_cast<std::size_t>(column_end - column); }
    };

    /// The lists of a tile: `down` has a tap for each texel on the side face, or is empty where the
    /// face has none; `across` has one for each column.
    static constexpr std::size_t down = 0;
    static constexpr std::size_t across = 1;

    std::size_t tiles() const {
        return static_cast<std::size_t>((height + tile_size - 1) / tile_size) * spans_.size();
    }

    double taps_bytes() const override {
        return static_cast<double>(sizeof(BoxTap)) * width / turns * height;
    }

    Tile tile(std::size_t index) const {
        const int row = static_cast<int>(index / spans_.size()) * tile_size;
        const auto [begin, end] = spans_[index % spans_.size()];
        return {row, std::min(row + tile_size, height), begin, end};
    }

    /// On a side face s is constant along a column of the panorama, and t = tan(latitude) /
    /// cos(longitude). The filter therefore runs along rows first and along columns then. A texel
    /// beyond the upper or lower edge of the side lies on +Y or -Y.
    void make(std::size_t index, TileTaps& taps) const {
        const Tile at = tile(index);
        taps.lists.resize(2);
        TapList& along = taps.lists[across];
        TapList& list = taps.lists[down];
        const double half_size = size / 2.0;
        list.resize(static_cast<std::size_t>(at.row_end - at.row) * at.columns());
        along.resize(at.columns());
        for (int j = at.column; j < at.column_end; ++j) {
            const PanoramaColumn& c = column(j);
            along.set(static_cast<std::size_t>(j - at.column), texel_of(c.across),
                      BoxWidth(c.secant * c.secant * lon_step_ * half_size));
        }
        std::size_t i = 0;
        for (int row = at.row; row < at.row_end; ++row) {
            const double tangent = std::tan(latitude(row));
            const double step = (1 + tangent * tangent) * lat_step_ * half_size;
            const double inverse = 1 / step;
            for (int j = at.column; j < at.column_end; ++j, ++i) {
                const PanoramaColumn& c = column(j);
                const double up = tangent * c.secant;
                if (std::abs(up) > 1) {
                    list.set_absent(i);
                } else {
                    list.set(i, texel_of(-up), BoxWidth(step * c.secant, inverse * c.cosine));
                }
            }
        }
        if (list.range().size() == 0) list = TapList();
        list.close();
        along.close();
    }

    const PanoramaColumn& column(int index) const {
        return columns_[static_cast<std::size_t>(index)];
    }
    double latitude(int row) const { return latitudes_[static_cast<std::size_t>(row)]; }
    const PoleRow& pole_row(int row) const { return pole_rows_[static_cast<std::size_t>(row)]; }
    /// The horizontal unit directions of columns, with tile_size numbers behind the last.
    const float* x(int index) const { return x_.data() + index; }
    const float* z(int index) const { return z_.data() + index; }

    /// Converts a coordinate from -1 to 1 on a face into texels, whose centres lie at whole
    /// numbers.
    double texel_of(double coordinate) const { return ((coordinate + 1) * size - 1) / 2; }

    /// The columns that lookups of rows row..row_end need of a pole's face, from columns whose unit
    /// directions have the coordinates `from`, as x_ or z_.
    TapRange pole_range(int row, int row_end, const float* from, std::size_t count,
                        float turn) const {
        const auto [least, most] = std::minmax_element(from, from + count);
        double low = 1;
        double high = -1;
        for (const int each : {row, row_end - 1}) {
            const double from_pole = std::numbers::pi / 2 - std::abs(latitude(each));
            for (const double side : {-0.5, 0.5}) {
                const double angle = std::clamp(from_pole + side * lat_step_, -1.0, 1.0);
                const double radius = std::tan(angle);
                for (const double edge : {static_cast<double>(*least) - lon_step_,
                                          static_cast<double>(*most) + lon_step_}) {
                    const double at = std::clamp(turn * edge * radius, -1.0, 1.0);
                    low = std::min(low, at);
                    high = std::max(high, at);
                }
            }
        }
        const TapRange range = {std::max(floor_to_int(texel_of(low)) - 1, -1),
                                std::min(floor_to_int(texel_of(high)) + 3, size + 1)};
        return range;
    }

    const int size;
    const int width;
    const int height;
    int turns = 1;  ///< parts of the panorama that differ only in their faces: 4, or 1

private:
    static PanoramaColumn make_column(const glm::dvec3& d) {
        const bool on_x = std::abs(d.x) >= std::abs(d.z);
        const Face face =
            on_x ? (d.x > 0 ? Face::pos_x : Face::neg_x) : (d.z > 0 ? Face::pos_z : Face::neg_z);
        const double secant = 1 / (on_x ? std::abs(d.x) : std::abs(d.z));
        const glm::dvec3 s_axis = face_axes(face).s_axis;
        return {face, glm::dot(s_axis, d) * secant, secant, 1 / secant};
    }

    PoleRow make_pole_row(double from_horizon) const {
        constexpr double half_turn = std::numbers::pi;
        const double from_pole = half_turn / 2 - std::abs(from_horizon);
        PoleRow row;
        if (from_pole > 1) return row;  // the faces' corners are 0.955 from the poles
        const double radius = std::tan(from_pole);
        const double half_size = size / 2.0;
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

    static int samples_for(double texels) {
        return std::max(1, static_cast<int>(std::ceil(texels - 1e-6)));
    }

    double lon_step_;
    double lat_step_;
    std::vector<PanoramaColumn> columns_;
    std::vector<float> x_;
    std::vector<float> z_;
    std::vector<double> latitudes_;
    std::vector<PoleRow> pole_rows_;
    std::vector<std::pair<int, int>> spans_;  ///< of columns within one side face
};

/// Converts cubes of one size by one plan.
class CubesToEquirects {
public:
    /// @param filling  the plan keeps taps that are not made yet
    CubesToEquirects(CubeToEquirectPlan& plan, bool filling, const CubeFaces& from, DType to,
                     std::byte* panoramas)
        : plan_(plan), filling_(filling), from_(from), to_(to), panoramas_(panoramas) {}

    void run() {
        for_each_tile<Scratch>(
            from_.count, plan_.tiles(),
            [this](std::size_t tile, std::size_t part, std::size_t first, std::size_t last,
                   Scratch& scratch) { fill_tile(tile, part, first, last, scratch); });
    }

private:
    /// Memory that the tiles of one thread reuse.
    struct Scratch {
        TileTaps taps;
        FilteredRows filtered;
        SourceBlock blocks[2];
        BilinearTaps places;
        alignas(64) Float4 line[tile_size];
        alignas(64) Float4 first[tile_size];
        alignas(64) Float4 sum[tile_size];
    };

    /// What a tile reads of +Y or -Y.
    struct PoleTexels {
        Face face;
        PolePlane plane;
        TexelGrid texels{nullptr, 0, 0};  ///< null: too large for a copy
    };

    /// One turn of a tile of one cube.
    struct Job {
        CubeToEquirectPlan::Tile at;
        const TileTaps& taps;
        CubePixels cube;
        TexelTarget to;
        int first;            ///< the first column
        PoleTexels poles[2];  ///< +Y, -Y
    };

    /// Fills a tile of the panoramas begin..end.
    void fill_tile(std::size_t tile, std::size_t part, std::size_t begin, std::size_t end,
                   Scratch& scratch) {
        const bool kept = plan_.keeps() && (!filling_ || part == 0);
        TileTaps& taps = kept ? plan_.kept(tile) : scratch.taps;
        if (!kept || filling_) plan_.make(tile, taps);
        const auto n = static_cast<std::size_t>(plan_.size);
        const std::size_t texels =
            static_cast<std::size_t>(plan_.width) * static_cast<std::size_t>(plan_.height);
        const auto channels = static_cast<std::size_t>(from_.channels);
        for (std::size_t i = begin; i < end; ++i) {
            const std::byte* pixels =
                from_.pixels + i * face_count * n * n * channels * dtype_size(from_.dtype);
            const CubePixels cube(pixels, plan_.size, from_.channels, from_.dtype);
            const TexelTarget to = {panoramas_ + i * texels * channels * dtype_size(to_), to_,
                                    from_.channels};
            for (int turn = 0; turn < plan_.turns; ++turn) {
                const auto at = plan_.tile(tile);
                Job job{at, taps, cube, to, at.column + turn * (plan_.width / plan_.turns), {}};
                fill_turn(job, scratch);
            }
        }
    }

    void fill_turn(Job& job, Scratch& scratch) const {
        const TapList& down = job.taps.lists[CubeToEquirectPlan::down];
        const TapList& across = job.taps.lists[CubeToEquirectPlan::across];
        const Face face = plan_.column(job.first).face;
        FaceReader reader(job.cube);
        if (down.size() != 0) {
            scratch.filtered.fill(
                down.range(), across, from_.channels,
                [&](int row, int begin, int end) { return reader.read(face, row, begin, end); });
        }
        for (const bool up : {true, false}) prepare_pole(up, job, reader, scratch);
        const std::size_t columns = job.at.columns();
        for (int row = job.at.row; row < job.at.row_end; ++row) {
            const std::size_t taps = static_cast<std::size_t>(row - job.at.row) * columns;
            const auto on_pole = [&](std::size_t i) {
                return down.size() == 0 || down.absent(taps + i);
            };
            // The texels on the side face lie side by side.
            std::size_t begin = down.size() == 0 ? columns : 0;
            std::size_t end = columns;
            while (begin < end && on_pole(begin)) ++begin;
            while (begin < end && on_pole(end - 1)) --end;
            sample_pole(job, row, 0, begin, scratch);
            if (begin < end) {
                scratch.filtered.filter(down, taps + begin, begin, end - begin,
                                        scratch.line + begin);
            }
            sample_pole(job, row, end, columns - end, scratch);
            const std::size_t index =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(plan_.width) +
                static_cast<std::size_t>(job.first);
            mend_texels(scratch.line, columns, from_.channels, [&](std::size_t i) {
                if (on_pole(i)) return sum_pole(job, row, job.first + static_cast<int>(i));
                return sum_box(job.cube, face, down.placed(taps + i), across.placed(i));
            });
            job.to.store(scratch.line, columns, 1, index);
        }
    }

    /// Finds what the tile's rows need of one pole, if there are such rows.
    void prepare_pole(bool up, Job& job, FaceReader& reader, Scratch& scratch) const {
        int row = job.at.row;
        int row_end = job.at.row_end;
        const auto needed = [&](int each) {
            return (plan_.latitude(each) > 0) == up && !plan_.pole_row(each).samples.empty();
        };
        while (row < row_end && !needed(row)) ++row;
        while (row < row_end && !needed(row_end - 1)) --row_end;
        if (row == row_end) return;
        PoleTexels& pole = job.poles[up ? 0 : 1];
        pole.face = up ? Face::pos_y : Face::neg_y;
        const std::size_t count = job.at.columns();
        const float turn = up ? 1.0f : -1.0f;
        const TapRange columns = plan_.pole_range(row, row_end, plan_.x(job.first), count, 1.0f);
        const TapRange rows = plan_.pole_range(row, row_end, plan_.z(job.first), count, turn);
        const auto texel = from_.channels * static_cast<std::ptrdiff_t>(sizeof(float));
        const std::ptrdiff_t face_row = plan_.size * texel;
        const bool near = static_cast<double>(face_row) * static_cast<double>(rows.size()) <
                          std::numeric_limits<std::int32_t>::max();
        const float* there = near ? reader.in_place(pole.face, rows, columns) : nullptr;
        if (there) {
            pole.texels = {there, face_row, texel};
        } else if (rows.size() * columns.size() <= largest_pole_block) {
            pole.texels = scratch.blocks[up ? 0 : 1].fill(
                rows, columns, from_.channels, [&](int each, int begin, int end) {
                    return reader.read(pole.face, each, begin, end);
                });
        } else {
            return;
        }
        const float half_texels = static_cast<float>(plan_.size) / 2.0f;
        pole.plane = {half_texels,
                      half_texels - 0.5f,
                      turn,
                      columns.begin,
                      rows.begin,
                      static_cast<int>(columns.size()),
                      static_cast<int>(rows.size()),
                      static_cast<std::int32_t>(pole.texels.row),
                      static_cast<std::int32_t>(pole.texels.texel)};
    }

    /// Computes `count` texels of a row, from column `first` of the tile on, which lie on +Y or -Y.
    void sample_pole(const Job& job, int row, std::size_t first, std::size_t count,
                     Scratch& scratch) const {
        if (count == 0) return;
        const PoleTexels& pole = job.poles[plan_.latitude(row) > 0 ? 0 : 1];
        const auto& samples = plan_.pole_row(row).samples;
        const int column = job.first + static_cast<int>(first);
        Float4* to = scratch.line + first;
        if (pole.texels.base == nullptr) {
            for (std::size_t i = 0; i < count; ++i) {
                to[i] = sample_texel(job, row, column + static_cast<int>(i));
            }
            return;
        }
        BilinearTaps& places = scratch.places;
        std::fill_n(places.outside, tile_size, 0);
        const bool one = samples.size() == 1;
        const auto place = [&](const PoleRow::Sample& at) {
            place_bilinear(plan_.x(column), plan_.z(column), at.cosine, at.sine, pole.plane,
                           places);
        };
        place(samples[0]);
        look_bilinear(pole.texels, places, count, one ? to : scratch.first);
        if (!one) {
            std::fill_n(scratch.sum, tile_size, Float4{});
            for (std::size_t i = 1; i < samples.size(); ++i) {
                place(samples[i]);
                add_bilinear(pole.texels, places, count, scratch.first, scratch.sum);
            }
            const float weight = 1.0f / static_cast<float>(samples.size());
            for (std::size_t i = 0; i < count; ++i) {
                to[i] = scratch.first[i] + scratch.sum[i] * weight;
            }
        }
        int any = 0;
        for (const std::int32_t each : places.outside) any |= each;
        if (any == 0) [[likely]]
            return;
        for (std::size_t i = 0; i < count; ++i) {
            if (places.outside[i] == 0) continue;
            to[i] = sample_texel(job, row, column + static_cast<int>(i));
        }
    }

    /// Calls body(direction) for the samples of one texel of a row on +Y or -Y.
    template <typename Body>
    void for_pole_samples(int row, int column, const Body& body) const {
        const float y = plan_.latitude(row) > 0 ? 1.0f : -1.0f;
        const float column_x = *plan_.x(column);
        const float column_z = *plan_.z(column);
        for (const PoleRow::Sample& at : plan_.pole_row(row).samples) {
            body(glm::vec3(column_x * at.cosine - column_z * at.sine, y,
                           column_z * at.cosine + column_x * at.sine));
        }
    }

    /// Computes one texel of a row on +Y or -Y, of which some samples may lie on a side.
    Float4 sample_texel(const Job& job, int row, int column) const {
        const float half_texels = static_cast<float>(plan_.size) / 2.0f;
        const float middle = half_texels - 0.5f;
        const auto count = static_cast<float>(plan_.pole_row(row).samples.size());
        bool begun = false;
        Float4 one{};
        Float4 sum{};
        for_pole_samples(row, column, [&](const glm::vec3& d) {
            Float4 found;
            if (std::abs(d.x) > 1 || std::abs(d.z) > 1) {
                const FaceUv<float> uv = direction_to_face_uv(d);
                found = job.cube.bilinear(uv.face, uv.s, uv.t);
            } else {
                found =
                    job.cube.between(d.y > 0 ? Face::pos_y : Face::neg_y,
                                     d.x * half_texels + middle, d.y * d.z * half_texels + middle);
            }
            if (begun) {
                sum += found - one;
            } else {
                one = found;
            }
            begun = true;
        });
        return one + sum * (1.0f / count);
    }

    /// Computes one texel of a row on +Y or -Y as sample_texel does, by sums of weighted texels.
    Float4 sum_pole(const Job& job, int row, int column) const {
        const auto count = static_cast<float>(plan_.pole_row(row).samples.size());
        Float4 sum{};
        for_pole_samples(row, column, [&](const glm::vec3& d) {
            const FaceUv<float> uv = direction_to_face_uv(d);
            sum += job.cube.sum_bilinear(uv.face, uv.s, uv.t) / count;
        });
        return sum;
    }

    CubeToEquirectPlan& plan_;
    bool filling_;
    CubeFaces from_;
    DType to_;
    std::byte* panoramas_;
};

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

void cube_to_equirect(const CubeFaces& cubes, int width, Center center, Sampling sampling, DType to,
                      std::byte* panoramas) {
    check_equirect_width(width);
    const TapKey key = {false, width, width / 2, cubes.size, center, sampling};
    bool fresh = false;
    const auto plan = plan_for<CubeToEquirectPlan>(
        key,
        [&] { return std::make_shared<CubeToEquirectPlan>(cubes.size, width, center, sampling); },
        fresh);
    CubesToEquirects(*plan, fresh, cubes, to, panoramas).run();
    if (fresh) TapCache::instance().add(key, plan);
}

std::shared_ptr<PixelBuffer> cube_to_equirect(const CubeMapData& cube, int width, Center center,
                                              Sampling sampling, DType to) {
    check_equirect_width(width);
    auto panorama =
        result_memory(static_cast<std::size_t>(width) * static_cast<std::size_t>(width / 2) *
                      static_cast<std::size_t>(cube.channels) * dtype_size(to));
    cube_to_equirect({cube.pixels->data(), cube.size, cube.channels, cube.dtype}, width, center,
                     sampling, to, panorama->data());
    return panorama;
}

}  // namespace cubecam
