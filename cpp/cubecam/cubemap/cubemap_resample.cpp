#include "cubecam/cubemap/cubemap_resample.hpp"

#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/resample_tile.hpp"

#include <iterator>
#include <stdexcept>
#include <string>

namespace cubecam {

namespace {

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
    taps.close();
}

/// Resamples all faces, in tiles: along rows first, along columns then.
void resample_all(const CubePixels& cube, Sampling from, int size, Sampling to,
                  const TexelTarget& target) {
    struct Scratch {
        TapList down;
        TapList across;
        FilteredRows filtered;
        alignas(64) Float4 line[tile_size];
    };
    constexpr int band = 32;  // rows of a face at a time
    const int bands = (size + band - 1) / band;
    const int spans = (size + tile_size - 1) / tile_size;
    const auto n = static_cast<std::size_t>(size);
    const auto fill = [&](const Face face, int row, int column, Scratch& scratch) {
        TapList& down = scratch.down;
        const int column_end = std::min(column + tile_size, size);
        const auto count = static_cast<std::size_t>(column_end - column);
        face_taps(cube.size, from, size, to, column, column_end, 1, scratch.across);
        face_taps(cube.size, from, size, to, row, std::min(row + band, size), count, down);
        FaceReader reader(cube);
        scratch.filtered.fill(
            down.range(), scratch.across, cube.channels,
            [&](int at, int begin, int end) { return reader.read(face, at, begin, end); });
        std::size_t index = (face_index(face) * n + static_cast<std::size_t>(row)) * n +
                            static_cast<std::size_t>(column);
        for (std::size_t tap = 0; tap < down.size(); tap += count, index += n) {
            scratch.filtered.filter(down, tap, 0, count, scratch.line);
            mend_texels(scratch.line, count, cube.channels, [&](std::size_t i) {
                return sum_box(cube, face, down.placed(tap + i), scratch.across.placed(i));
            });
            target.store(scratch.line, count, 1, index);
        }
    };
    parallel_for_with<Scratch>(0, static_cast<std::size_t>(face_count * bands), 1,
                               [&](std::size_t begin, std::size_t end, Scratch& scratch) {
                                   for (std::size_t i = begin; i < end; ++i) {
                                       const Face face =
                                           all_faces[i / static_cast<std::size_t>(bands)];
                                       const int row = static_cast<int>(i) % bands * band;
                                       for (int span = 0; span < spans; ++span)
                                           fill(face, row, span * tile_size, scratch);
                                   }
                               });
}

void check_face_size(int size, Sampling sampling) {
    const int least = sampling == Sampling::borders ? 2 : 1;
    if (size < least) {
        throw std::invalid_argument("size: expected at least " + std::to_string(least) + ", got " +
                                    std::to_string(size));
    }
}

}  // namespace

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
    resample_all({cube.pixels->data(), cube.size, cube.channels, cube.dtype}, from, size, to,
                 {result.data(), dtype, cube.channels});
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
