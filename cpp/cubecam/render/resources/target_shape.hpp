#pragma once

#include <compare>
#include <cstdint>

namespace cubecam {

/// The arrangement of a target's layers in its textures.
struct TargetShape {
    enum class Kind : std::uint8_t {
        flat,        ///< one picture
        array,       ///< `count` pictures of one size
        cube,        ///< six square faces, which a shader looks up by direction
        cube_array,  ///< the faces of `count` cubes, cube by cube
    };

    static constexpr TargetShape flat() { return {Kind::flat, 1}; }
    static constexpr TargetShape array(int count) { return {Kind::array, count}; }
    static constexpr TargetShape cube() { return {Kind::cube, 1}; }
    static constexpr TargetShape cube_array(int count) { return {Kind::cube_array, count}; }

    constexpr bool has_faces() const { return kind == Kind::cube || kind == Kind::cube_array; }
    constexpr int layers() const { return has_faces() ? 6 * count : count; }

    auto operator<=>(const TargetShape&) const = default;

    Kind kind = Kind::flat;
    int count = 1;
};

}  // namespace cubecam
