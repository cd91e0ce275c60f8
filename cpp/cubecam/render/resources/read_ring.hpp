#pragma once

#include "cubecam/core/error.hpp"
#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/objects.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace cubecam {

/// The GPU's buffers through which pictures are read. A GPU copies into one of them while it goes
/// on; reading into the memory of the process would wait for the GPU once for each face and output.
/// While the pixels of one picture travel, the next one can be drawn and requested: it has another
/// buffer. Buffers stay mapped (GL 4.5 section 6.2, GL_MAP_PERSISTENT_BIT), and a fence says when
/// the copies have ended.
///
/// A software driver needs no buffer: its pictures are in the memory of the process, and a buffer
/// would only be one more copy.
class ReadRing {
public:
    /// The largest copy at once; larger pictures are read in several steps.
    static constexpr std::size_t most_bytes = std::size_t{256} << 20;
    /// If all buffers together are larger, one is freed after use.
    static constexpr std::size_t most_kept = std::size_t{128} << 20;

    /// For tests: software drivers read through buffers, too.
    static inline constinit std::atomic<bool> for_all_drivers{false};

    /// A buffer that holds the pixels of one picture. Its owner may end after the ring.
    class Slot {
    public:
        /// Ends the requests: `wait` waits for those before.
        void requested(const GladGLContext& gl) {
            gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
            drop_fence(gl);
            fence_ = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
            gl.Flush();
        }

        /// Waits until everything requested has arrived, and returns it. Polls.
        const std::byte* wait(const GladGLContext& gl) {
            constexpr GLuint64 one_wait = 20 * 1'000'000;  // nanoseconds
            for (;;) {
                const GLenum status = gl.ClientWaitSync(fence_, 0, one_wait);
                if (status == GL_WAIT_FAILED) {
                    gl::check_gl(gl, "reading a picture");
                    throw GlError("reading a picture: the driver does not wait for it");
                }
                if (status != GL_TIMEOUT_EXPIRED) break;
                poll_interrupts();
            }
            drop_fence(gl);
            return held_;
        }

        /// Nobody needs the contents any more.
        void release() noexcept { taken_.store(false, std::memory_order_release); }

    private:
        friend class ReadRing;

        /// @throws GlError if there is not enough memory.
        void make(const GladGLContext& gl, std::size_t bytes) {
            free(gl);
            constexpr GLbitfield access =
                GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
            gl::Buffer made = gl::create_buffer(gl, bytes, nullptr, access | GL_CLIENT_STORAGE_BIT);
            held_ = static_cast<const std::byte*>(
                gl.MapNamedBufferRange(made.id(), 0, static_cast<GLsizeiptr>(bytes), access));
            gl::check_gl(gl, "reading a picture");
            if (held_ == nullptr) throw GlError("reading a picture: the driver maps no buffer");
            buffer_ = std::move(made);
            size_ = bytes;
        }

        void free(const GladGLContext& gl) noexcept {
            drop_fence(gl);
            buffer_.reset();  // a deleted buffer is unmapped
            held_ = nullptr;
            size_ = 0;
        }

        void drop_fence(const GladGLContext& gl) noexcept {
            if (fence_ != nullptr) gl.DeleteSync(std::exchange(fence_, nullptr));
        }

        gl::Buffer buffer_;
        std::size_t size_ = 0;
        const std::byte* held_ = nullptr;
        GLsync fence_ = nullptr;
        std::atomic<bool> taken_{false};
    };

    explicit ReadRing(const GladGLContext& gl) : gl_(&gl) {}
    ~ReadRing() {
        for (const auto& slot : slots_) slot->free(*gl_);
    }
    ReadRing(const ReadRing&) = delete;
    ReadRing& operator=(const ReadRing&) = delete;

    /// Returns a free buffer of at least this size, which is the current target of glReadPixels.
    /// @throws GlError if there is not enough memory.
    std::shared_ptr<Slot> take(std::size_t bytes) {
        std::shared_ptr<Slot> found;
        for (const auto& slot : slots_) {
            if (slot->taken_.load(std::memory_order_acquire)) continue;
            if (found == nullptr || found->size_ < bytes) found = slot;
        }
        if (found == nullptr) {
            found = slots_.emplace_back(std::make_shared<Slot>());
        }
        if (found->size_ < bytes) found->make(*gl_, bytes);
        found->taken_ = true;
        gl_->BindBuffer(GL_PIXEL_PACK_BUFFER, found->buffer_.id());
        return found;
    }

    /// Takes a buffer back after its contents were read.
    void give_back(Slot& slot) noexcept {
        std::size_t bytes = 0;
        for (const auto& held : slots_) bytes += held->size_;
        if (bytes > most_kept) slot.free(*gl_);
        slot.release();
    }

private:
    const GladGLContext* gl_;
    std::vector<std::shared_ptr<Slot>> slots_;
};

}  // namespace cubecam
