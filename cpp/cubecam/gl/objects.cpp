#include "cubecam/gl/objects.hpp"

#include "cubecam/core/error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>

namespace cubecam::gl {

namespace {

// A lost context may report its error again and again.
constexpr int most_errors = 16;

constexpr std::array error_names{"GL_INVALID_ENUM",
                                 "GL_INVALID_VALUE",
                                 "GL_INVALID_OPERATION",
                                 "GL_STACK_OVERFLOW",
                                 "GL_STACK_UNDERFLOW",
                                 "GL_OUT_OF_MEMORY",
                                 "GL_INVALID_FRAMEBUFFER_OPERATION",
                                 "GL_CONTEXT_LOST"};

std::string hexadecimal(GLenum value) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "0x%04X", value);
    return text.data();
}

const char* framebuffer_status_name(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_UNDEFINED: return "GL_FRAMEBUFFER_UNDEFINED";
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT: return "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT";
        case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER: return "GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER";
        case GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER: return "GL_FRAMEBUFFER_INCOMPLETE_READ_BUFFER";
        case GL_FRAMEBUFFER_UNSUPPORTED: return "GL_FRAMEBUFFER_UNSUPPORTED";
        case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE: return "GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE";
        case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
            return "GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS";
        default: return "framebuffer status";
    }
}

int levels_or_all(int levels, int width, int height) {
    return levels > 0 ? levels : mip_levels(width, height);
}

}  // namespace

std::string gl_error_name(GLenum error) {
    const GLenum place = error - GL_INVALID_ENUM;
    return std::string(place < error_names.size() ? error_names[place] : "GL error") + " (" +
           hexadecimal(error) + ")";
}

void check_gl(const GladGLContext& gl, std::string_view what) {
    GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return;

    const GLenum first = error;
    bool out_of_memory = false;
    std::string names;
    for (int i = 0; i < most_errors && error != GL_NO_ERROR; ++i) {
        if (!names.empty()) names += ", ";
        names += gl_error_name(error);
        out_of_memory = out_of_memory || error == GL_OUT_OF_MEMORY;
        // After GL_CONTEXT_LOST every further call returns the same error.
        error = error == GL_CONTEXT_LOST ? GLenum{GL_NO_ERROR} : gl.GetError();
    }
    std::string text = std::string(what) + ": " + names;
    if (out_of_memory)
        text += ": no memory left for this; use smaller sizes, fewer samples or fewer outputs";
    throw GlError(text, first);
}

int mip_levels(int width, int height) {
    return std::bit_width(static_cast<unsigned>(std::max({width, height, 1})));
}

Texture create_texture(const GladGLContext& gl, GLenum target) {
    GLuint id = 0;
    gl.CreateTextures(target, 1, &id);
    return Texture(gl, id);
}

Texture create_texture_2d(const GladGLContext& gl, GLenum format, int width, int height,
                          int levels) {
    Texture texture = create_texture(gl, GL_TEXTURE_2D);
    gl.TextureStorage2D(texture.id(), levels_or_all(levels, width, height), format, width, height);
    check_gl(gl, "a texture of " + std::to_string(width) + "x" + std::to_string(height));
    return texture;
}

Texture create_texture_2d_array(const GladGLContext& gl, GLenum format, int width, int height,
                                int layers, int levels) {
    Texture texture = create_texture(gl, GL_TEXTURE_2D_ARRAY);
    gl.TextureStorage3D(texture.id(), levels_or_all(levels, width, height), format, width, height,
                        layers);
    check_gl(gl, "a texture of " + std::to_string(width) + "x" + std::to_string(height) + " with " +
                     std::to_string(layers) + " layers");
    return texture;
}

Texture create_texture_cube(const GladGLContext& gl, GLenum format, int size, int levels) {
    Texture texture = create_texture(gl, GL_TEXTURE_CUBE_MAP);
    gl.TextureStorage2D(texture.id(), levels_or_all(levels, size, size), format, size, size);
    check_gl(gl, "a cube map of size " + std::to_string(size));
    return texture;
}

Texture create_texture_cube_array(const GladGLContext& gl, GLenum format, int size, int count,
                                  int levels) {
    Texture texture = create_texture(gl, GL_TEXTURE_CUBE_MAP_ARRAY);
    gl.TextureStorage3D(texture.id(), levels_or_all(levels, size, size), format, size, size,
                        6 * count);
    check_gl(gl, std::to_string(count) + " cube maps of size " + std::to_string(size));
    return texture;
}

Texture create_texture_2d_multisample_array(const GladGLContext& gl, GLenum format, int samples,
                                            int width, int height, int layers) {
    Texture texture = create_texture(gl, GL_TEXTURE_2D_MULTISAMPLE_ARRAY);
    gl.TextureStorage3DMultisample(texture.id(), samples, format, width, height, layers, GL_TRUE);
    check_gl(gl, "a texture of " + std::to_string(width) + "x" + std::to_string(height) + " with " +
                     std::to_string(layers) + " layers and " + std::to_string(samples) +
                     " samples");
    return texture;
}

Texture create_view_2d(const GladGLContext& gl, const Texture& array, int levels) {
    GLint format = 0;
    gl.GetTextureLevelParameteriv(array.id(), 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    GLuint id = 0;
    gl.GenTextures(1, &id);  // glTextureView needs a name without a texture
    Texture view(gl, id);
    gl.TextureView(id, GL_TEXTURE_2D, array.id(), static_cast<GLenum>(format), 0,
                   static_cast<GLuint>(levels), 0, 1);
    check_gl(gl, "a view of a texture");
    return view;
}

void read_layer(const GladGLContext& gl, GLuint texture, int layer, int width, int height,
                GLenum format, GLenum type, std::size_t texel, void* to) {
    const std::size_t row = static_cast<std::size_t>(width) * texel;
    const int most = rows_at_once(row);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    auto* next = static_cast<std::byte*>(to);
    for (int y = 0; y < height; y += most) {
        const int rows = std::min(most, height - y);
        const std::size_t bytes = row * static_cast<std::size_t>(rows);
        gl.GetTextureSubImage(texture, 0, 0, y, layer, width, rows, 1, format, type,
                              static_cast<GLsizei>(bytes), next);
        next += bytes;
    }
}

Buffer create_buffer(const GladGLContext& gl, std::size_t bytes, const void* data,
                     GLbitfield flags) {
    GLuint id = 0;
    gl.CreateBuffers(1, &id);
    Buffer buffer(gl, id);
    const bool empty = bytes == 0;
    gl.NamedBufferStorage(id, static_cast<GLsizeiptr>(empty ? 1 : bytes), empty ? nullptr : data,
                          flags);
    check_gl(gl, "a buffer of " + std::to_string(bytes) + " bytes");
    return buffer;
}

Framebuffer create_framebuffer(const GladGLContext& gl) {
    GLuint id = 0;
    gl.CreateFramebuffers(1, &id);
    return Framebuffer(gl, id);
}

VertexArray create_vertex_array(const GladGLContext& gl) {
    GLuint id = 0;
    gl.CreateVertexArrays(1, &id);
    return VertexArray(gl, id);
}

void settle_vertex_array(const GladGLContext& gl, GLuint array, GLuint binding, GLuint buffer,
                         std::size_t stride) {
    constexpr int enough = 8;
    constexpr GLintptr other_offset = 16;
    gl.BindVertexArray(array);
    for (int i = 1; i <= enough; ++i) {
        gl.VertexArrayVertexBuffer(array, binding, buffer, i % 2 * other_offset,
                                   static_cast<GLsizei>(stride));
        gl.DrawArrays(GL_TRIANGLES, 0, 0);
    }
}

void check_framebuffer(const GladGLContext& gl, const Framebuffer& framebuffer,
                       std::string_view what) {
    const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    check_gl(gl, what);
    throw GlError(std::string(what) + ": " + framebuffer_status_name(status) + " (" +
                      hexadecimal(status) + ")",
                  status);
}

}  // namespace cubecam::gl
