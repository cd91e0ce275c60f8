/// The inner loops of resampling (clones.hpp). Only the .cpp files of
/// cubemap/ include this header.
///
/// A texel is four floats wherever it is read: of a picture of fewer channels, the lanes behind
/// them hold the numbers that follow in memory, and nobody reads what is computed of them. So three
/// floats behind the last texel must be readable.
#pragma once

#include "cubecam/cubemap/tap_list.hpp"

#include <cstddef>
#include <cstdint>

namespace cubecam {

/// The taps of a row of a tile, which many rows share, with their places in memory.
struct alignas(64) RowTaps {
    float near[tile_size];
    float last[tile_size];
    std::int32_t first_at[tile_size];  ///< bytes from the beginning of the row
    std::int32_t last_at[tile_size];   ///< bytes from the first texel of the tap to its last
    const TapList* taps;
    std::ptrdiff_t texel;  ///< bytes from a texel to the next one
    std::size_t count;

    /// Takes at most tile_size taps of a closed list, for texels of `texel_bytes` bytes.
    void set(const TapList& list, std::ptrdiff_t texel_bytes);
};

/// to[i] = the box taps[i] over texels of the row at `row`, for all taps.
void filter_row(const float* row, const RowTaps& taps, Float4* to);

/// to[i] = the box taps[i] over rows of tile_size texels, in column i.
void filter_columns(Reach reach, const Float4* rows, const BoxTap* taps, std::size_t count,
                    Float4* to);

/// Texels in memory: `texel` bytes from one to the next, `row` bytes from one row to the next.
struct TexelGrid {
    const float* base;
    std::ptrdiff_t row;
    std::ptrdiff_t texel;
};

/// to[i] = the box across[i] by down[i].
void filter_boxes(Reach reach, const TexelGrid& texels, const BoxTap* down, const BoxTap* across,
                  std::size_t count, Float4* to);

/// Places of bilinear lookups.
struct alignas(64) BilinearTaps {
    float right[tile_size];
    float bottom[tile_size];
    std::int32_t at[tile_size];       ///< bytes from the base to the texel at the upper left
    std::int32_t outside[tile_size];  ///< not 0: beyond the square; no call sets it back to 0
};

/// Where lookups round a pole find their texels: a direction (x, z), with y = +-1, lies at column
/// x scale + middle and row turn z scale + middle of the face. The grid begins at column0 and row0.
struct PolePlane {
    float scale;
    float middle;
    float turn;  ///< 1 on +Y, -1 on -Y
    int column0;
    int row0;
    int columns;  ///< of the grid, at least 2
    int rows;
    std::int32_t row;  ///< bytes, as in TexelGrid
    std::int32_t texel;
};

/// Finds the places of tile_size horizontal directions, each turned about the pole: cosine and sine
/// of the angle, both times the distance from the pole.
void place_bilinear(const float* x, const float* z, float cosine, float sine,
                    const PolePlane& plane, BilinearTaps& taps);

/// first[i] = the lookup taps[i].
void look_bilinear(const TexelGrid& texels, const BilinearTaps& taps, std::size_t count,
                   Float4* first);
/// sum[i] += the lookup taps[i] - first[i].
void add_bilinear(const TexelGrid& texels, const BilinearTaps& taps, std::size_t count,
                  const Float4* first, Float4* sum);

}  // namespace cubecam
