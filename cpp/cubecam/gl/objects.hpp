#pragma once

#include "cubecam/gl/handle.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// Small functions that make OpenGL objects by direct state access (GL 4.5): they bind nothing, so
/// nothing needs to be restored. The context must be current.
namespace cubecam::gl {

/// Throws GlError that names `what` and every pending OpenGL error. Each pass calls it at its end.
void check_gl(const GladGLContext& gl, std::string_view what);

/// Returns the name of an error: "GL_INVALID_ENUM (0x0500)".
std::string gl_error_name(GLenum error);

Texture create_texture(const GladGLContext& gl, GLenum target);

/// These make immutable textures. `levels` = 0 makes the whole chain down to 1x1. They throw
/// GlError if GL refuses (no memory).
Texture create_texture_2d(const GladGLContext& gl, GLenum format, int width, int height,
                          int levels = 1);
Texture create_texture_2d_array(const GladGLContext& gl, GLenum format, int width, int height,
                                int layers, int levels = 1);
Texture create_texture_cube(const GladGLContext& gl, GLenum format, int size, int levels = 1);
/// Makes six layers for each of `count` cubes, cube by cube.
Texture create_texture_cube_array(const GladGLContext& gl, GLenum format, int size, int count,
                                  int levels = 1);
/// The samples are at fixed places, so that textures of several formats can share a framebuffer.
Texture create_texture_2d_multisample_array(const GladGLContext& gl, GLenum format, int samples,
                                            int width, int height, int layers);

/// Makes a plain 2D texture of the first layer of a 2D array, with all levels. It uses the same
/// memory, and has its own filters and wrapping.
Texture create_view_2d(const GladGLContext& gl, const Texture& array, int levels);

/// The number of levels of a full mipmap chain: floor(log2(max)) + 1, as glTexStorage defines it.
int mip_levels(int width, int height);

/// The number of rows that can be read at once: OpenGL counts the bytes of a picture as an int.
constexpr int rows_at_once(std::size_t bytes_of_row) {
    constexpr std::size_t most = (std::size_t{1} << 31) - 1;
    const std::size_t rows = bytes_of_row == 0 ? most : most / bytes_of_row;
    return static_cast<int>(rows < 1 ? 1 : rows);
}
static_assert(rows_at_once(std::size_t{32768} * 4) == 16383);

/// Reads one layer of level 0 of an array or a cube map, of `texel` bytes each, row by row from the
/// bottom.
void read_layer(const GladGLContext& gl, GLuint texture, int layer, int width, int height,
                GLenum format, GLenum type, std::size_t texel, void* to);

/// Makes a buffer of fixed size (glNamedBufferStorage). `data` may be null. A size of 0 makes a
/// buffer of one byte, since GL refuses an empty one.
Buffer create_buffer(const GladGLContext& gl, std::size_t bytes, const void* data = nullptr,
                     GLbitfield flags = 0);

template <class T, std::size_t Extent>
Buffer create_buffer(const GladGLContext& gl, std::span<T, Extent> data, GLbitfield flags = 0) {
    return create_buffer(gl, data.size_bytes(), data.data(), flags);
}

Framebuffer create_framebuffer(const GladGLContext& gl);
VertexArray create_vertex_array(const GladGLContext& gl);
/// Changes the buffer of a binding so often that Mesa takes the array for one that changes.
///
/// Mesa begins with the buffers of a vertex array as few as they can be, and gives each attribute a
/// buffer of its own when the array has changed some times. llvmpipe then compiles every vertex
/// shader again. An array whose buffer is another one in each picture had better begin with that.
/// It stays bound; no draw call draws anything.
void settle_vertex_array(const GladGLContext& gl, GLuint array, GLuint binding, GLuint buffer,
                         std::size_t stride);

/// Throws GlError that names `what` and the decoded status unless the framebuffer is complete.
void check_framebuffer(const GladGLContext& gl, const Framebuffer& framebuffer,
                       std::string_view what);

}  // namespace cubecam::gl
