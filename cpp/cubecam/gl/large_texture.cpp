#include "cubecam/gl/large_texture.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/context_impl.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace cubecam::gl {
namespace {

/// Of 16 bytes each, 32 MiB: a slow machine takes a fifth of a second for them. To make the thread
/// and its context takes 2 to 6 ms.
constexpr double many_texels = 1 << 21;
constexpr std::chrono::milliseconds one_look{20};

constinit std::atomic<int> at_work{0};

/// What the caller and the thread share. The thread may be the last to hold it.
class Making {
public:
    Making(egl::RawContext context, const GladGLContext& gl,
           std::function<Texture(const GladGLContext&)> make)
        : context_(std::move(context)), gl_(gl), make_(std::move(make)) {}

    /// On the thread. The context must be gone when the caller goes on.
    void run() noexcept {
        make();
        context_.reset();
        make_ = nullptr;
        const std::lock_guard lock(mutex_);
        done_ = true;
        changed_.notify_all();
    }

    /// On the caller's thread. @throws what a look throws; the texture is then deleted.
    void wait() {
        std::unique_lock lock(mutex_);
        while (!changed_.wait_for(lock, one_look, [this] { return done_; })) {
            lock.unlock();
            poll_interrupts();
            lock.lock();
        }
    }

    /// The texture, for the caller that waited; empty if the context of the thread has failed.
    /// @throws what making it threw.
    Texture take(const GladGLContext& gl) {
        if (error_) std::rethrow_exception(error_);
        return made_ == 0 ? Texture() : Texture(gl, std::exchange(made_, 0U));
    }

    /// On the caller's thread, in the caller's context: nobody wants the texture any more.
    void give_up(const GladGLContext& gl) noexcept {
        const std::lock_guard lock(mutex_);
        unwanted_ = true;
        if (made_ != 0) gl.DeleteTextures(1, &made_);
        made_ = 0;
    }

private:
    void make() noexcept {
        try {
            const egl::Current current(*context_);
            Texture texture = make_(gl_);
            gl_.Finish();  // then other contexts see it (OpenGL 4.6, section 5.3)
            const std::lock_guard lock(mutex_);
            if (!unwanted_) made_ = texture.release();
        } catch (const ContextError&) {
            // The caller makes the texture itself, and reports what is wrong with its context.
        } catch (...) {
            error_ = std::current_exception();
        }
    }

    std::optional<egl::RawContext> context_;
    const GladGLContext gl_;  // a copy: the caller's context may be gone before the thread is
    std::function<Texture(const GladGLContext&)> make_;
    std::exception_ptr error_;
    GLuint made_ = 0;

    std::mutex mutex_;
    std::condition_variable changed_;
    bool done_ = false;
    bool unwanted_ = false;
};

/// Starts a thread that handles no signals: those are for the threads of the program.
void start_making(std::shared_ptr<Making> making) {
    const struct Blocked {
        sigset_t before{};
        Blocked() {
            sigset_t all;
            sigfillset(&all);
            pthread_sigmask(SIG_BLOCK, &all, &before);
        }
        ~Blocked() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }
    } blocked;
    ++at_work;
    try {
        std::thread([making = std::move(making)]() mutable {
            making->run();
            making.reset();
            --at_work;
        }).detach();
    } catch (...) {
        --at_work;
        throw;
    }
}

}  // namespace

int threads_making_textures() noexcept { return at_work.load(); }

Texture make_large_texture(const Context& context, double texels,
                           std::function<Texture(const GladGLContext&)> make) {
    poll_interrupts();
    if (texels < many_texels || !may_be_interrupted() ||
        !context.renderer().starts_with("llvmpipe")) {
        return make(context.gl());
    }
    std::shared_ptr<Making> making;
    try {
        making = std::make_shared<Making>(context.impl().raw.sharing(), context.gl(), make);
        start_making(making);
    } catch (const ContextError&) {
        return make(context.gl());
    } catch (const std::system_error&) {  // no more threads
        return make(context.gl());
    }
    try {
        making->wait();
    } catch (...) {
        making->give_up(context.gl());
        throw;
    }
    Texture texture = making->take(context.gl());
    return texture ? std::move(texture) : make(context.gl());
}

}  // namespace cubecam::gl
