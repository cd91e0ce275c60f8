#pragma once

#include <glad/gl.h>

#include <cstddef>

/// The texture units of the shaders (shaders/README.md). OpenGL guarantees 80 units for all stages
/// together, and 16 in one stage: what counts there is the number of textures that a program looks
/// up, not their units.
namespace cubecam::texture_unit {

inline constexpr GLuint frame = 0;        ///< the picture that effects and post-processing read
inline constexpr GLuint planar = 0;       ///< what a surface's planar mirror shows
inline constexpr GLuint cube = 1;         ///< the environment
inline constexpr GLuint filtered = 2;     ///< its filtered levels and irradiance
inline constexpr GLuint brdf_table = 3;   ///< integrals of reflection models
inline constexpr GLuint box_mipmaps = 4;  ///< the environment with box-filtered levels
inline constexpr GLuint behind = 5;       ///< the scene behind transmissive surfaces
inline constexpr GLuint distances = 6;    ///< of the surfaces that a probe captured
inline constexpr GLuint farthest = 7;     ///< the farthest surfaces that a probe captured
/// The first texture of a material, or of a user's source; those that are set follow each other.
inline constexpr GLuint first_of_material = 8;
/// What reflections find on the screen, and the depths in which they are followed.
inline constexpr GLuint screen = 44;
inline constexpr GLuint screen_depths = 45;
/// The far side of a surface's body; materials that look it up have few textures of their own.
inline constexpr GLuint body_nearness = 46;
inline constexpr GLuint body_normals = 47;
/// The shadow map of the first light; the others follow.
inline constexpr GLuint first_shadow = 48;

inline constexpr GLuint grid_light = 64;      ///< of the scene's probe grid
inline constexpr GLuint grid_distances = 65;  ///< the same
/// The last of the units of further environments that a surface blends; the others come before it.
inline constexpr GLuint last_blended = 79;
inline constexpr std::size_t most_blended = 14;  ///< such units

/// The largest number of textures of one material.
inline constexpr std::size_t most_of_material = screen - first_of_material;

}  // namespace cubecam::texture_unit
