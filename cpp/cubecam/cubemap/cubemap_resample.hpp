/// Cubes from panoramas, panoramas from cubes, cubes of another size: threaded, without aliasing.
///
/// All conversions use one filter: a box as wide as the destination texel is in the source, and
/// never narrower than one source texel. For enlarging, the box is exactly bilinear interpolation;
/// for shrinking, each source texel has the weight of the area that it covers; there is no step
/// between the two. Near the poles of a panorama the box grows as the panorama's texels become
/// narrow. (The conversion from +Y and -Y to a panorama, whose texels are turned against those of
/// the faces, uses bilinear samples: in each direction as many as the destination texel is source
/// texels long.) A constant picture gives the same constant, bit for bit.
#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/math/equirect.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace cubecam {

/// Where the samples of a picture lie. With `borders` the first and the last sample of each row and
/// column lie on the picture's edges (OpenEXR's environment maps: ImfEnvmap.h), so neighbour faces
/// have the same samples on their common edge, and so do the first and the last column of a
/// panorama.
enum class Sampling { centers, borders };

/// The angles of a panorama's texels.
struct EquirectAngles {
    std::vector<glm::dvec3> directions;  ///< of each column: horizontal, of length 1
    std::vector<double> latitudes;       ///< of each row, in radians
    double longitude_step;
    double latitude_step;

    EquirectAngles(int width, Center center, Sampling sampling);
};

/// @throws std::invalid_argument unless width is even and positive.
void check_equirect_width(int width);

struct EquirectPixels {
    const std::byte* pixels;  ///< [height][width][channels]
    int width;
    int height;
    int channels;  ///< 1 to 4
    DType dtype;
    Center center = Center::neg_z;
    Sampling sampling = Sampling::centers;
    std::size_t count = 1;  ///< pictures, one behind another
};

/// A NaN in pictures that are to be filtered.
class FoundNan : public std::invalid_argument {
public:
    /// @param at  the place of the number among those of all pictures
    explicit FoundNan(std::size_t at)
        : std::invalid_argument("image: expected no NaN, got nan at number " + std::to_string(at)),
          index(at) {}

    std::size_t index;
};

// Every result is of type `to`. The computation uses float32, where a uint8 stands for value/255;
// texels are converted as they are read and written, never a whole picture at once. A uint8 result
// is clamped to 0..1 and rounded to nearest; a float16 result is rounded to nearest and becomes inf
// from 65520 on.

/// @throws std::invalid_argument unless width = 2 height (with borders: unless both are at least 2)
///         and size is at least 1.
void check_equirect(const EquirectPixels& from, int size);

/// Returns [6][size][size][channels], "gl". Each inf counts as the largest finite number of the
/// picture, at least 65504 (the largest half float: most infinities come from half floats).
/// @throws std::invalid_argument as check_equirect does.
/// @throws FoundNan for a NaN anywhere in the panorama.
std::shared_ptr<PixelBuffer> equirect_to_cube(const EquirectPixels& from, int size, DType to);
/// The same for many panoramas of one size, into memory [count][6][size][size][channels].
void equirect_to_cube(const EquirectPixels& from, int size, DType to, std::byte* cubes);

/// The bytes of the taps that are kept for the next conversion of the same sizes (tap_cache.hpp).
std::size_t kept_tap_bytes();

/// Returns the face size that loses no detail: the smallest power of two that is at least width /
/// pi.
int default_face_size(int equirect_width);

/// Faces of cubes in "gl" layout, [count][6][size][size][channels].
struct CubeFaces {
    const std::byte* pixels;
    int size;
    int channels;  ///< 1 to 4
    DType dtype;
    std::size_t count = 1;
};

/// Returns [width/2][width][channels]. @throws std::invalid_argument unless width is even and
/// positive.
std::shared_ptr<PixelBuffer> cube_to_equirect(const CubeMapData& cube, int width, Center center,
                                              Sampling sampling, DType to);
/// The same for many cubes of one size, into memory [count][width/2][width][channels].
void cube_to_equirect(const CubeFaces& cubes, int width, Center center, Sampling sampling, DType to,
                      std::byte* panoramas);

/// Resamples six "gl" faces to another size and sampling.
/// @throws std::invalid_argument for sizes below 1 (with borders: below 2), or borders on both
/// sides.
PixelBuffer resample_faces(const CubeMapData& cube, Sampling from, int size, Sampling to,
                           DType dtype);

/// Converts pixels to another type.
PixelBuffer convert_pixels(const PixelBuffer& pixels, DType from, DType to);

}  // namespace cubecam
