#include "cubecam/trial/trial.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/core/notices.hpp"
#include "cubecam/trial/helper_process.hpp"
#include "cubecam/trial/verdict_store.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <optional>
#include <pthread.h>

namespace cubecam::trial {
namespace {

constexpr std::size_t least_stack = std::size_t{128} << 10;
constexpr std::size_t most_stack = std::size_t{3} << 20;

/// The stack of the driver in the helper: at most half of what this thread has left, so that a
/// source whose expressions just fit there fits here. It is rounded, since verdicts are kept for
/// each size.
std::size_t helper_stack() {
    thread_local const char* lowest = [] {
        pthread_attr_t attributes;
        void* address = nullptr;
        std::size_t size = 0;
        if (pthread_getattr_np(pthread_self(), &attributes) == 0) {
            pthread_attr_getstack(&attributes, &address, &size);
            pthread_attr_destroy(&attributes);
        }
        return static_cast<const char*>(address);
    }();
    const char here = 0;
    const auto left = static_cast<std::size_t>(std::max<std::ptrdiff_t>(&here - lowest, 0));
    constexpr std::size_t step = std::size_t{1} << 20;
    const std::size_t half = left / 2;
    const std::size_t rounded = half < step ? std::bit_floor(half) : half / step * step;
    return std::clamp(rounded, least_stack, most_stack);
}

std::atomic<bool> unavailable_noted{false};

void note_unavailable(const std::string& why) {
    if (unavailable_noted.exchange(true)) return;
    add_notice("new GLSL is compiled in this process without a trial, since the process for trials "
               "cannot be started: " +
               why +
               ". A source with which the driver crashes ends this process; "
               "Renderer(trust_shaders=True) says that this is fine");
}

void add_line(Sha256& hash, std::string_view text) {
    hash.add(text);
    hash.add("\n");
}

}  // namespace

Trial::Trial(const gl::Context& context)
    : platform_(context.platform()), device_(context.device().index),
      driver_(context.vendor() + "\n" + context.renderer() + "\n" + context.version()) {}

void Trial::require(const Job& job, std::string_view source) {
    const std::string bytes = encode(job);
    if (bytes.size() > Limits::job_bytes) {
        throw ShaderError(std::string(source) + ": expected GLSL of at most " +
                          std::to_string(Limits::job_bytes >> 20) + " MiB, got " +
                          std::to_string(bytes.size() >> 20) + " MiB with what it includes");
    }
    const std::size_t stack = helper_stack();
    Sha256 hash;
    add_line(hash, CUBECAM_CORE_VERSION);
    add_line(hash, std::to_string(Report::right_magic));
    add_line(hash, platform_);
    add_line(hash, std::to_string(device_));
    add_line(hash, driver_);
    add_line(hash, std::to_string(stack));
    hash.add(bytes);
    const Sha256::Digest digest = hash.finish();

    VerdictStore& store = VerdictStore::of_process();
    std::optional<Verdict> verdict = store.find(digest);
    if (!verdict) {
        try {
            verdict = Helper::of({platform_, device_, stack}).ask(bytes, driver_);
        } catch (const Error& error) {
            note_unavailable(error.what());
            return;
        }
        if (verdict->known()) store.add(digest, *verdict);
    }
    if (verdict->passed()) return;
    throw ShaderError(std::string(source) + ": " + in_words(*verdict) +
                      ". cubecam tries a source first in a process of its own, so that this one "
                      "goes on; Renderer(trust_shaders=True) would run it here");
}

}  // namespace cubecam::trial
