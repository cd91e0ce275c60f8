#pragma once

#include "cubecam/core/error.hpp"
#include "cubecam/gl/objects.hpp"

#include <cstddef>

namespace cubecam {

/// The GPU's buffer through which pictures are read. A GPU copies into it while it goes on; reading
/// into the memory of the process would wait for the GPU once for each face and output.
///
/// A software driver needs no buffer: its pictures are in the memory of the process, and a buffer
/// would only be one more copy.
class ReadBuffer {
public:
    /// The largest copy at once; larger pictures are read in several steps.
    static constexpr std::size_t most_bytes = std::size_t{256} << 20;
    /// A larger buffer is freed after use.
    static constexpr std::size_t most_kept = std::size_t{64} << 20;

    /// Makes the buffer at least this large, and the current target of glReadPixels.
    /// @throws GlError if there is not enough memory.
    void bind(const GladGLContext& gl, std::size_t bytes) {
        if (bytes > size_) {
            buffer_.reset();
            size_ = 0;
            buffer_ =
                gl::create_buffer(gl, bytes, nullptr, GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
            size_ = bytes;
        }
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
    }

    /// Ends the copies, and calls `use` with the first `bytes` of the buffer.
    template <class Use>
    void read(const GladGLContext& gl, std::size_t bytes, Use&& use) {
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        const auto* held = static_cast<const std::byte*>(gl.MapNamedBufferRange(
            buffer_.id(), 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT));
        gl::check_gl(gl, "reading a picture");
        if (held == nullptr) throw GlError("reading a picture: the driver maps no buffer");
        use(held);
        gl.UnmapNamedBuffer(buffer_.id());
        if (size_ <= most_kept) return;
        buffer_.reset();
        size_ = 0;
    }

private:
    gl::Buffer buffer_;
    std::size_t size_ = 0;
};

}  // namespace cubecam
