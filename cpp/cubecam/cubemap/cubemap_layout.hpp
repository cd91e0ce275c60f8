/// Conventions of six faces, and layouts of single pictures that hold six faces. These functions
/// only move texels, so a conversion and its inverse give the same bytes.
#pragma once

#include "cubecam/core/parse_name.hpp"
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
    gl,      ///< as in memory, see cube_face.hpp
    inside,  ///< as seen from inside: gl with sides flipped left-right, +-Y top-bottom. OpenEXR
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

inline constexpr NameTable<Convention, 3> convention_names{
    {{"gl", Convention::gl}, {"inside", Convention::inside}, {"three", Convention::three}}};
inline constexpr NameTable<Layout, 6> layout_names{{{"cross", Layout::cross},
                                                    {"vertical_cross", Layout::vertical_cross},
                                                    {"row", Layout::row},
                                                    {"column", Layout::column},
                                                    {"equirect", Layout::equirect},
                                                    {"openexr", Layout::openexr}}};
inline constexpr NameTable<Center, 4> center_names{
    {{"-z", Center::neg_z}, {"+z", Center::pos_z}, {"+x", Center::pos_x}, {"-x", Center::neg_x}}};
/// Three names of every face.
inline constexpr NameTable<Face, 18> face_words{{{"+x", Face::pos_x},
                                                 {"-x", Face::neg_x},
                                                 {"+y", Face::pos_y},
                                                 {"-y", Face::neg_y},
                                                 {"+z", Face::pos_z},
                                                 {"-z", Face::neg_z},
                                                 {"px", Face::pos_x},
                                                 {"nx", Face::neg_x},
                                                 {"py", Face::pos_y},
                                                 {"ny", Face::neg_y},
                                                 {"pz", Face::pos_z},
                                                 {"nz", Face::neg_z},
                                                 {"pos_x", Face::pos_x},
                                                 {"neg_x", Face::neg_x},
                                                 {"pos_y", Face::pos_y},
                                                 {"neg_y", Face::neg_y},
                                                 {"pos_z", Face::pos_z},
                                                 {"neg_z", Face::neg_z}}};

/// These accept names in any letter case, with '-' or ' ' in place of '_'.
/// @throws std::invalid_argument that lists the names.
Convention parse_convention(std::string_view name);
Layout parse_layout(std::string_view name);  ///< "horizontal_cross" is "cross"
Center parse_center(std::string_view name);  ///< "-z", "+z", "+x", "-x"
Face parse_face(std::string_view name);      ///< "+x", "px" or "pos_x", ...

std::string_view to_string(Convention convention);
std::string_view to_string(Layout layout);

/// The source of a face: its texel (row, col) is texel (row or N-1-row, col or N-1-col) of `face`.
struct FaceSource {
    Face face;
    bool flip_columns;
    bool flip_rows;
};

/// Returns which face of convention `from` is face `face` of convention `to`. With `from` and `to`
/// exchanged the function is its own inverse.
FaceSource face_source(Convention from, Convention to, Face face);

/// Copies one face with the given flips; a texel has `texel` bytes.
void copy_face(const std::byte* from, int size, std::size_t texel, FaceSource flips, std::byte* to);

/// Converts six faces [6][N][N], of texels of `texel` bytes, from one convention to another.
PixelBuffer convert_faces(const std::byte* faces, int size, std::size_t texel, Convention from,
                          Convention to);

struct PictureSize {
    int width;
    int height;
};

/// The size of a cross, vertical cross, row or column of faces N x N.
PictureSize layout_size(Layout layout, int face_size);

/// Returns the only layout with this shape: 4:3, 3:4, 6:1, 1:6 or 2:1.
/// @throws std::invalid_argument that lists the shapes.
Layout recognize_layout(int width, int height);

/// Returns N of a picture of this layout. @throws std::invalid_argument if its size does not fit
/// the layout.
int layout_face_size(Layout layout, int width, int height);

/// Puts six faces of a convention into one picture; cells without a face are 0.
PixelBuffer faces_to_picture(const std::byte* faces, int size, std::size_t texel, Layout layout,
                             Convention convention);

/// The inverse of faces_to_picture; it ignores cells without a face.
PixelBuffer picture_to_faces(const std::byte* picture, int width, int height, std::size_t texel,
                             Layout layout, Convention convention);

}  // namespace cubecam
