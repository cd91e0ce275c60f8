/// Cubes from panoramas, panoramas from cubes, cubes of another size: threaded, without aliasing.
///
/// One filter serves all: a box as wide as the destination texel is in the source, and never
/// narrower than one source texel. Enlarging, that is plain bilinear interpolation, exactly;
/// shrinking, each source texel counts by the area it covers; there is no step between the two.
/// Round the poles of a panorama the box is as long as its texels are narrow. (Only +Y and -Y to a
/// panorama, whose texels lie askew there, is done by bilinear samples, as many each way as the
/// destination texel is source texels long.) A constant picture comes out as the same constant,
/// bit for bit.
#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/math/equirect.hpp"

namespace cubecam {

/// Where the samples of a picture lie. borders: the first and the last of each row and column lie
/// on the picture's edges (OpenEXR's environment maps: ImfEnvmap.h), so the edges of two faces, and
/// the first and last columns of a panorama, say the same.
enum class Sampling { centers, borders };

struct EquirectPixels {
    const std::byte* pixels;  ///< [height][width][channels]
    int width;
    int height;
    int channels;
    DType dtype;
    Center center = Center::neg_z;
    Sampling sampling = Sampling::centers;
};

// Every result is of type `to`. Numbers on the way are float32, uint8 counts as value/255, and only
// the texels under way are converted: whole pictures are read and written as they are. A uint8
// result is clamped to 0..1 and rounded to nearest; a float16 result is rounded to nearest and
// becomes inf from 65520 on.

/// [6][size][size][channels], "gl". All inf count as the largest other number, at least 65504 (half
/// floats' largest, where most come from).
/// @throws std::invalid_argument unless width = 2 height (with borders: unless both are at least
///         2), channels is 1, 3 or 4, size at least 1; or for a NaN
///         that reaches the result.
PixelBuffer equirect_to_cube(const EquirectPixels& from, int size, DType to);

/// The face size that loses nothing: the next power of two from width / pi.
int default_face_size(int equirect_width);

/// [width/2][width][channels]. @throws std::invalid_argument unless width is even and positive.
PixelBuffer cube_to_equirect(const CubeMapData& cube, int width, Center center, Sampling sampling,
                             DType to);

/// Six "gl" faces of one size and sampling to another.
/// @throws std::invalid_argument for sizes below 1 (with borders: below 2), or borders on both
/// sides.
PixelBuffer resample_faces(const CubeMapData& cube, Sampling from, int size, Sampling to,
                           DType dtype);

/// The same numbers in another type.
PixelBuffer convert_pixels(const PixelBuffer& pixels, DType from, DType to);

}  // namespace cubecam
