#pragma once

#include "cubecam/gl/handle.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// Thin helpers that make OpenGL objects by direct state access (GL 4.5): nothing is bound, so
/// nothing needs to be put back. All of them want the context to be current.
namespace cubecam::gl {

/// Throws GlError naming `what` and every pending OpenGL error; to be called after each pass.
void check_gl(const GladGLContext& gl, std::string_view what);

/// "GL_INVALID_ENUM (0x0500)".
std::string gl_error_name(GLenum error);

Texture create_texture(const GladGLContext& gl, GLenum target);

/// Immutable textures. `levels` = 0: the whole chain down to 1x1. GlError when GL refuses (no
/// memory).
Texture create_texture_2d(const GladGLContext& gl, GLenum format, int width, int height,
                          int levels = 1);
Texture create_texture_2d_array(const GladGLContext& gl, GLenum format, int width, int height,
                                int layers, int levels = 1);
Texture create_texture_cube(const GladGLContext& gl, GLenum format, int size, int levels = 1);
/// Six layers for each of `count` cubes, cube by cube.
Texture create_texture_cube_array(const GladGLContext& gl, GLenum format, int size, int count,
                                  int levels = 1);
/// The samples are at fixed places, so that textures of several formats can share a framebuffer.
Texture create_texture_2d_multisample_array(const GladGLContext& gl, GLenum format, int samples,
                                            int width, int height, int layers);

/// The first layer of a 2D array, all levels, as a plain 2D texture: the same memory, under filters
/// and wrapping of its own.
Texture create_view_2d(const GladGLContext& gl, const Texture& array, int levels);

/// Number of levels of a full mipmap chain, glTexStorage's floor(log2(max)) + 1.
int mip_levels(int width, int height);

/// A buffer of fixed size (glNamedBufferStorage). `data` may be null; a size of 0 makes one byte,
/// since GL refuses an empty store.
Buffer create_buffer(const GladGLContext& gl, std::size_t bytes, const void* data = nullptr,
                     GLbitfield flags = 0);

template <class T, std::size_t Extent>
Buffer create_buffer(const GladGLContext& gl, std::span<T, Extent> data, GLbitfield flags = 0) {
    return create_buffer(gl, data.size_bytes(), data.data(), flags);
}

Framebuffer create_framebuffer(const GladGLContext& gl);
VertexArray create_vertex_array(const GladGLContext& gl);

/// Throws GlError naming `what` and the decoded status unless the framebuffer is complete.
void check_framebuffer(const GladGLContext& gl, const Framebuffer& framebuffer,
                       std::string_view what);

}  // namespace cubecam::gl
