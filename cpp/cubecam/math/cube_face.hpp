/// This file defines the cube convention: face order, axes, texel centres. All other files refer to
/// it.
///
/// OpenGL 4.6 core profile, section 8.13, table 8.19 (first: ARB_texture_cube_map); r is the
/// direction from the cube's center, in world axes:
///
///     face   sc    tc    ma          s = (sc/|ma| + 1)/2
///     +X    -rz   -ry    rx          t = (tc/|ma| + 1)/2
///     -X    +rz   -ry    rx
///     +Y    +rx   +rz    ry          faces[f, row, col] is the texel with
///     -Y    +rx   -rz    ry              s = (col + .5)/N
///     +Z    +rx   -ry    rz              t = (row + .5)/N
///     -Z    -rx   -ry    rz
///
/// The six faces unfolded, s to the right, t (row) downwards, each edge touching its neighbour:
///
///                 +----+
///                 | +Y |
///            +----+----+----+----+
///            | -X | +Z | +X | -Z |
///            +----+----+----+----+
///                 | -Y |
///                 +----+
///
/// Row 0 of the four side faces is world up. Each face, seen as a picture, is the mirror image of
/// what someone standing in the cube sees (cubemap_layout.hpp converts to other conventions).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace cubecam {

enum class Face : int { pos_x = 0, neg_x, pos_y, neg_y, pos_z, neg_z };

inline constexpr int face_count = 6;

inline constexpr std::array<Face, face_count> all_faces = {Face::pos_x, Face::neg_x, Face::pos_y,
                                                           Face::neg_y, Face::pos_z, Face::neg_z};

/// "+x", "-x", ... in the order of the faces: the names in messages and file names.
inline constexpr std::array<const char*, face_count> face_names = {"+x", "-x", "+y",
                                                                   "-y", "+z", "-z"};

/// World axes of a face: the direction of (s, t) is major + (2s - 1) s_axis + (2t - 1) t_axis.
struct FaceAxes {
    glm::vec3 major;   ///< towards the face's center; the capture camera looks this way
    glm::vec3 s_axis;  ///< towards growing s, growing columns
    glm::vec3 t_axis;  ///< towards growing t, growing rows
};

inline constexpr std::array<FaceAxes, face_count> face_axes_table = {{
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

constexpr std::size_t face_index(Face face) { return static_cast<std::size_t>(face); }

constexpr const FaceAxes& face_axes(Face face) { return face_axes_table[face_index(face)]; }

/// The direction in which the camera that captures a face looks.
constexpr glm::vec3 face_forward(Face face) { return face_axes(face).major; }

/// The up vector of the camera that captures a face: -Y -Y +Z -Z -Y -Y. It is the t axis, since GL
/// writes row 0 of a target at the bottom of the window, and row 0 is t = 0.
constexpr glm::vec3 face_up(Face face) { return face_axes(face).t_axis; }

template <typename T>
struct FaceUv {
    Face face;
    T s;  ///< 0 at the first column's left border, 1 at the last column's right border
    T t;  ///< 0 at row 0's border
};

/// The direction, from the cube's center outwards, of (s, t) on a face. It is not normalised: its
/// largest component is 1 for s and t within [0, 1].
template <typename T>
glm::vec<3, T> face_uv_to_direction(Face face, T s, T t) {
    const FaceAxes& axes = face_axes(face);
    return glm::vec<3, T>(axes.major) + (2 * s - 1) * glm::vec<3, T>(axes.s_axis) +
           (2 * t - 1) * glm::vec<3, T>(axes.t_axis);
}

/// The face that a direction (from the center outwards, of any length but 0) meets, and where. On
/// an edge the first of x, y, z is taken: GL does not define which, and seamless lookups give the
/// same result for both.
template <typename T>
FaceUv<T> direction_to_face_uv(const glm::vec<3, T>& direction) {
    const T x = std::abs(direction.x);
    const T y = std::abs(direction.y);
    const T z = std::abs(direction.z);
    Face face;
    T sc, tc, ma;
    if (x >= y && x >= z) {
        face = direction.x >= 0 ? Face::pos_x : Face::neg_x;
        sc = direction.x >= 0 ? -direction.z : direction.z;
        tc = -direction.y;
        ma = x;
    } else if (y >= z) {
        face = direction.y >= 0 ? Face::pos_y : Face::neg_y;
        sc = direction.x;
        tc = direction.y >= 0 ? direction.z : -direction.z;
        ma = y;
    } else {
        face = direction.z >= 0 ? Face::pos_z : Face::neg_z;
        sc = direction.z >= 0 ? direction.x : -direction.x;
        tc = -direction.y;
        ma = z;
    }
    return {face, (sc / ma + 1) / 2, (tc / ma + 1) / 2};
}

}  // namespace cubecam
