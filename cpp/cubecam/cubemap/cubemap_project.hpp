/// Cubes as pictures of other projections (math/projections.hpp), cubes from such pictures, and
/// turned cubes: threaded, without aliasing.
///
/// A destination texel is the mean of bilinear samples, in each direction as many as it is source
/// texels long, so that enlarging is bilinear interpolation. Samples outside of the picture do not
/// count. A constant picture gives the same constant, bit for bit.
#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/cubemap/cubemap_nearest.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/math/projections.hpp"

#include <glm/mat3x3.hpp>

#include <cstddef>

namespace cubecam {

/// Returns [height][width][channels]. Texels whose center shows no direction are 0.
PixelBuffer project_cube(const CubeMapData& cube, const Projection& projection, int width,
                         int height, DType to);

/// Like project_cube, for an output of a capture: the texels that the centers meet. `outside` is
/// the texel where a center shows no direction.
PixelBuffer project_nearest(const TexelBytes& cube, const Projection& projection, int width,
                            int height, const std::byte* outside);

struct ProjectedPixels {
    const std::byte* pixels;  ///< [height][width][channels]
    int width;
    int height;
    int channels;
    DType dtype;
};

/// Returns [6][size][size][channels], "gl". Texels whose center the picture does not show are 0.
/// Near the edge of a disc only texels count whose center lies on it. Each inf counts as in
/// equirect_to_cube.
PixelBuffer picture_to_cube(const ProjectedPixels& from, const Projection& projection, int size,
                            DType to);

/// Returns the faces of a cube that shows in the direction R d what this one shows in d. Where R
/// brings axes to axes, texels are copied.
PixelBuffer rotate_faces(const CubeMapData& cube, const glm::dmat3& rotation);

/// Like rotate_faces, for an output of a capture: the nearest texels.
PixelBuffer rotate_nearest(const TexelBytes& cube, const glm::dmat3& rotation);

/// Converts the output "z" of rotate_nearest, a distance along the axis of the face on which the
/// capture saw a direction, to the axis of the face on which the direction lies now.
void rotate_z(PixelBuffer& z, int size, const glm::dmat3& rotation);

}  // namespace cubecam
