#pragma once

#include <glad/gl.h>

#include <type_traits>
#include <utility>

namespace cubecam::gl {

/// True in a process forked after EGL was opened (also in context.hpp).
bool in_forked_child() noexcept;

/// Owner of one OpenGL object. Move-only; a moved-from or default-made handle is empty (id 0).
///
/// A handle must be destroyed while its context is current; the owner of the context ensures that.
/// In a forked child the destructor does nothing; after Context::abandon() the table's delete
/// functions do nothing.
template <class Traits>
class Handle {
public:
    Handle() noexcept = default;

    /// Takes ownership of `id`, an object of the context that `gl` belongs to.
    Handle(const GladGLContext& gl, GLuint id) noexcept : gl_(&gl), id_(id) {}

    Handle(Handle&& other) noexcept
        : gl_(std::exchange(other.gl_, nullptr)), id_(std::exchange(other.id_, 0u)) {}

    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            gl_ = std::exchange(other.gl_, nullptr);
            id_ = std::exchange(other.id_, 0u);
        }
        return *this;
    }

    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    ~Handle() { reset(); }

    GLuint id() const noexcept { return id_; }
    explicit operator bool() const noexcept { return id_ != 0; }

    /// The table of the context this object belongs to; only for a handle that is not empty.
    const GladGLContext& gl() const noexcept { return *gl_; }

    /// Gives up ownership: the caller deletes the object.
    [[nodiscard]] GLuint release() noexcept {
        gl_ = nullptr;
        return std::exchange(id_, 0u);
    }

    /// Forgets the object without deleting it: OpenGL deletes it with its context.
    void abandon() noexcept { (void)release(); }

    /// Deletes the object, if there is one.
    void reset() noexcept {
        if (id_ == 0) return;
        const GladGLContext* gl = std::exchange(gl_, nullptr);
        const GLuint id = std::exchange(id_, 0u);
        if (!in_forked_child()) Traits::destroy(*gl, id);
    }

private:
    const GladGLContext* gl_ = nullptr;
    GLuint id_ = 0;
};

struct TextureTraits {
    static void destroy(const GladGLContext& gl, GLuint id) noexcept { gl.DeleteTextures(1, &id); }
};
struct BufferTraits {
    static void destroy(const GladGLContext& gl, GLuint id) noexcept { gl.DeleteBuffers(1, &id); }
};
struct FramebufferTraits {
    static void destroy(const GladGLContext& gl, GLuint id) noexcept {
        gl.DeleteFramebuffers(1, &id);
    }
};
struct VertexArrayTraits {
    static void destroy(const GladGLContext& gl, GLuint id) noexcept {
        gl.DeleteVertexArrays(1, &id);
    }
};
struct ShaderTraits {
    static void destroy(const GladGLContext& gl, GLuint id) noexcept { gl.DeleteShader(id); }
};
struct ProgramTraits {
    static void destroy(const GladGLContext& gl, GLuint id) noexcept { gl.DeleteProgram(id); }
};

using Texture = Handle<TextureTraits>;
using Buffer = Handle<BufferTraits>;
using Framebuffer = Handle<FramebufferTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using ShaderHandle = Handle<ShaderTraits>;
using ProgramHandle = Handle<ProgramTraits>;

static_assert(!std::is_copy_constructible_v<Texture> &&
              std::is_nothrow_move_constructible_v<Texture>);

}  // namespace cubecam::gl
