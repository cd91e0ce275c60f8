/// Conventions of six faces, and the single pictures that hold them. All of it moves texels and
/// computes nothing, so that each way there and back gives the same bytes.
#pragma once

#include "cubecam/image/pixels.hpp"
#include "cubecam/math/cube_face.hpp"
#include "cubecam/math/equirect.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cubecam {

/// How six pictures show a cube.
enum class Convention {
    gl,      ///< memory, cube_face.hpp
    inside,  ///< what one sees from within: sides of gl flipped left-right, +-Y top-bottom. OpenEXR
    three,   ///< three.js, KTX, D3D skyboxes, sampled with -x: +-X swapped, all flipped left-right
};

/// How one picture holds a cube.
enum class Layout {
    cross,           ///< 4N x 3N
    vertical_cross,  ///< 3N x 4N
    row,             ///< 6N x N, in order of the faces
    column,          ///< N x 6N
    equirect,        ///< 2H x H, resampled
    openexr,         ///< N x 6N, "inside", samples on the faces' borders: resampled
};

/// Names in any case, with '-' or ' ' for '_'. @throws std::invalid_argument listing the names.
Convention parse_convention(std::string_view name);
Layout parse_layout(std::string_view name);  ///< "horizontal_cross" is "cross"
Center parse_center(std::string_view name);  ///< "-z", "+z", "+x", "-x"
Face parse_face(std::string_view name);      ///< "+x", "px" or "pos_x", ...

std::string_view to_string(Convention convention);
std::string_view to_string(Layout layout);

/// Where a face comes from: texel (row, col) of it is texel (row or N-1-row, col or N-1-col) there.
struct FaceSource {
    Face face;
    bool flip_columns;
    bool flip_rows;
};

/// Which face, called so in `from`, is face `face` of `to`. It is its own inverse with the two
/// exchanged.
FaceSource face_source(Convention from, Convention to, Face face);

/// Copies one face, flipped as asked; `texel` bytes each.
void copy_face(const std::byte* from, int size, std::size_t texel, FaceSource flips, std::byte* to);

/// Six faces [6][N][N], `texel` bytes each, from one convention to another.
PixelBuffer convert_faces(const std::byte* faces, int size, std::size_t texel, Convention from,
                          Convention to);

struct PictureSize {
    int width;
    int height;
};

/// Of a cross, vertical cross, row or column of faces N x N.
PictureSize layout_size(Layout layout, int face_size);

/// The layout that only this shape can be: 4:3, 3:4, 6:1, 1:6 or 2:1.
/// @throws std::invalid_argument listing the shapes.
Layout recognize_layout(int width, int height);

/// N, when a picture is of this layout. @throws std::invalid_argument otherwise.
int layout_face_size(Layout layout, int width, int height);

/// Six faces of a convention into one picture of it; cells that no face covers are 0.
PixelBuffer faces_to_picture(const std::byte* faces, int size, std::size_t texel, Layout layout,
                             Convention convention);

/// The inverse; cells that no face covers are not looked at.
PixelBuffer picture_to_faces(const std::byte* picture, int width, int height, std::size_t texel,
                             Layout layout, Convention convention);

}  // namespace cubecam
