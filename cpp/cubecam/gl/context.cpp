#include "cubecam/gl/context.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/core/notices.hpp"
#include "cubecam/gl/context_impl.hpp"
#include "cubecam/gl/device_probe.hpp"

#include <algorithm>
#include <chrono>
#include <new>
#include <thread>
#include <utility>

namespace cubecam::gl {

namespace {

std::string candidate_in_words(const Candidate& candidate) {
    if (candidate.platform != egl::Platform::device)
        return std::string(candidate.info.platform) + " platform";
    const std::string kind = candidate.info.software ? "software" : "GPU";
    return "device " + std::to_string(candidate.info.index) + " (" +
           (candidate.info.name.empty() ? kind : candidate.info.name) + ")";
}

[[noreturn]] void throw_attempts(const CandidateList& list) {
    std::string text = "no OpenGL 4.5 context for " + list.choice + ":";
    for (std::size_t i = 0; i < list.attempts.size(); ++i) {
        text += "\n  " + std::to_string(i + 1) + ". " + list.attempts[i];
    }
    const bool any_too_old =
        std::any_of(list.attempts.begin(), list.attempts.end(), [](const std::string& attempt) {
            return attempt.find(older_version) != std::string::npos;
        });
    if (any_too_old) throw ContextError(text + "\n" + egl::version_hint());
    // A driver that cannot be opened for lack of descriptors is there: nothing is to be installed.
    const std::string files = egl::descriptors_hint();
    if (!files.empty()) throw ContextError(text + "\n" + files);
    const std::string chosen = egl::driver_variables();
    if (!chosen.empty()) {
        text += "\n" + chosen + " is set: without it another driver may start.";
    } else if (list.kind != DeviceKind::gpu) {
        text += "\n" + egl::software_hint();
    }
    throw ContextError(text + "\n" + egl::gpu_hint() + "\n" + egl::doctor_hint());
}

/// Adds a notice if the context renders in software although EGL lists a GPU.
void note_fallback(const CandidateList& list, const Context::Impl& impl) {
    if (list.kind != DeviceKind::any || !impl.software) return;
    const Candidate* gpu = nullptr;
    for (const Candidate& candidate : list.candidates) {
        const bool hardware =
            candidate.platform == egl::Platform::device && !candidate.info.software;
        if (hardware && gpu == nullptr) gpu = &candidate;
    }
    if (gpu == nullptr) return;
    std::string text = "this renderer draws in software, with " + impl.renderer +
                       ", although EGL lists a GPU, " + candidate_in_words(*gpu) + ".";
    for (const std::string& attempt : list.attempts) text += "\n  " + attempt;
    add_notice(text + "\nOn a device that no GPU is expected of, device=\"software\" or "
                      "CUBECAM_DEVICE=software gives no warning.");
}

std::unique_ptr<Context::Impl> start_first(CandidateList list, bool debug) {
    // The driver of a GPU may render on the CPU without saying so: such a context is kept in
    // reserve while a GPU may still follow.
    std::unique_ptr<Context::Impl> second_best;
    for (const Candidate& candidate : list.candidates) {
        // No later candidate is better than the software context in reserve.
        if (second_best != nullptr && candidate.info.software) break;
        try {
            std::unique_ptr<Context::Impl> impl = start_context(candidate, debug);
            const bool by_kind = list.kind != DeviceKind::any;
            if (by_kind && impl->software != (list.kind == DeviceKind::software)) {
                list.attempts.push_back(candidate_in_words(candidate) + ": started, but renders " +
                                        (impl->software ? "in software: " : "on a GPU: ") +
                                        impl->renderer);
                continue;
            }
            const bool disguised = impl->software && !candidate.info.software &&
                                   candidate.platform == egl::Platform::device;
            if (!by_kind && disguised) {
                list.attempts.push_back(candidate_in_words(candidate) +
                                        ": started, but renders in software: " + impl->renderer);
                if (second_best == nullptr) second_best = std::move(impl);
                continue;
            }
            if (second_best != nullptr && impl->software) break;
            note_fallback(list, *impl);
            return impl;
        } catch (const ContextError& error) {
            list.attempts.push_back(candidate_in_words(candidate) + ": " + error.what());
        }
    }
    if (second_best == nullptr) throw_attempts(list);
    note_fallback(list, *second_best);
    return second_best;
}

}  // namespace

LargestSide largest_side(const Limits& limits, bool face) noexcept {
    LargestSide least =
        face ? LargestSide{limits.max_cube_map_texture_size, "GL_MAX_CUBE_MAP_TEXTURE_SIZE"}
             : LargestSide{limits.max_texture_size, "GL_MAX_TEXTURE_SIZE"};
    for (const LargestSide& other :
         {LargestSide{limits.max_framebuffer_width, "GL_MAX_FRAMEBUFFER_WIDTH"},
          LargestSide{limits.max_framebuffer_height, "GL_MAX_FRAMEBUFFER_HEIGHT"},
          LargestSide{limits.max_viewport_width, "GL_MAX_VIEWPORT_DIMS"},
          LargestSide{limits.max_viewport_height, "GL_MAX_VIEWPORT_DIMS"}}) {
        if (other.pixels < least.pixels) least = other;
    }
    return least;
}

Context::Context(const ContextOptions& options) {
    egl::library();  // first, so that a missing library or a forked child gets a clear message
    impl_ = start_first(list_candidates(options.device), options.debug);
}

Context::Context(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}

Context Context::at(const std::string& platform, int device) {
    egl::library();
    if (platform == egl::platform_name(egl::Platform::device)) {
        return Context({.device = device});
    }
    Candidate candidate;
    candidate.platform = platform == egl::platform_name(egl::Platform::surfaceless)
                             ? egl::Platform::surfaceless
                             : egl::Platform::fallback;
    candidate.info.platform = platform;
    return Context(start_context(candidate, false));
}

Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

const GladGLContext& Context::gl() const noexcept { return impl_->gl; }
Pace& Context::pace() const noexcept { return impl_->pace; }
const std::string& Context::vendor() const noexcept { return impl_->vendor; }
const std::string& Context::renderer() const noexcept { return impl_->renderer; }
const std::string& Context::version() const noexcept { return impl_->version; }
const std::string& Context::glsl_version() const noexcept { return impl_->glsl_version; }
const std::string& Context::egl_version() const noexcept { return impl_->egl_version; }
const std::string& Context::platform() const noexcept { return impl_->device.platform; }
bool Context::software() const noexcept { return impl_->software; }
bool Context::debug() const noexcept { return impl_->debug; }
const DeviceInfo& Context::device() const noexcept { return impl_->device; }
const Limits& Context::limits() const noexcept { return impl_->limits; }
const std::vector<std::string>& Context::extensions() const noexcept { return impl_->extensions; }

bool Context::has_extension(std::string_view name) const noexcept {
    return std::binary_search(impl_->extensions.begin(), impl_->extensions.end(), name);
}

std::vector<std::string> Context::take_debug_messages() {
    const std::lock_guard lock(impl_->messages_mutex);
    return std::exchange(impl_->messages, {});
}

void Context::check_reset() {
    const GLenum status = impl_->reset_status();
    if (status == GL_NO_ERROR) return;
    impl_->reset = true;
    // While the reset lasts, the driver goes on reporting it and makes no new context.
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    while (impl_->reset_status() != GL_NO_ERROR && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    throw ContextLost(status == GL_GUILTY_CONTEXT_RESET
                          ? "the GPU was reset because of what this renderer drew"
                      : status == GL_INNOCENT_CONTEXT_RESET
                          ? "the GPU was reset because of what another context drew"
                          : "the GPU was reset",
                      true);
}

void Context::abandon() noexcept {
    // After a reset of the GPU the handle stays valid until the context is destroyed. In all other
    // cases the handle may already belong to another context.
    if (!impl_->reset) impl_->raw.abandon();
    GladGLContext& gl = impl_->gl;
    const auto no_delete_many = +[](GLsizei, const GLuint*) {};
    const auto no_delete = +[](GLuint) {};
    gl.DeleteTextures = no_delete_many;
    gl.DeleteBuffers = no_delete_many;
    gl.DeleteFramebuffers = no_delete_many;
    gl.DeleteVertexArrays = no_delete_many;
    gl.DeleteSamplers = no_delete_many;
    gl.DeleteQueries = no_delete_many;
    gl.DeleteShader = no_delete;
    gl.DeleteProgram = no_delete;
    gl.DeleteSync = +[](GLsync) {};
}

CurrentScope::CurrentScope(const Context& context) {
    static_assert(sizeof(egl::Current) <= sizeof(saved_) &&
                  alignof(egl::Current) <= alignof(void*));
    egl::refuse_forked_child();
    Context::Impl& impl = *context.impl_;
    if (impl.reset) throw ContextLost("the GPU was reset", true);
    try {
        new (saved_) egl::Current(impl.raw);
    } catch (const ContextLost& lost) {
        impl.reset = lost.reset();
        throw;
    }
    if (impl.has_mark()) return;
    // After a reset a context may answer no question.
    impl.reset = impl.reset_status() != GL_NO_ERROR;
    std::launder(reinterpret_cast<egl::Current*>(saved_))->~Current();
    if (impl.reset) throw ContextLost("the GPU was reset", true);
    throw ContextLost("another library in this process has terminated the EGL display, and its "
                      "context now has the handle of ours");
}

CurrentScope::~CurrentScope() { std::launder(reinterpret_cast<egl::Current*>(saved_))->~Current(); }

}  // namespace cubecam::gl
