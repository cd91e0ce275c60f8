// The helper process of cubecam::trial: it gets jobs through its standard input, tries them, and
// sends reports back.
//
//     _shader_trial PLATFORM DEVICE STACK_BYTES OWNER     the owner is for people who list
//     processes
//
// It ends when the other end of its standard input is closed. The first thread waits for that; a
// second one, with a stack of the given size, does the work, so that the end comes in time whatever
// the driver is doing.
#include "limits.hpp"

#include "cubecam/gl/context.hpp"
#include "cubecam/trial/perform.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <poll.h>
#include <pthread.h>
#include <string>
#include <unistd.h>

namespace {

using namespace cubecam::trial;

constexpr int idle_milliseconds =
    600'000;  // without a job the helper ends: the next one starts it again
constexpr std::uint64_t most_kept = std::uint64_t{256} << 20;  // bytes that may stay after a job

struct Work {
    std::string platform;
    int device;
};

/// Reads so many bytes; ends the process if the owner is gone.
void read_all(void* to, std::size_t size) {
    auto* bytes = static_cast<char*>(to);
    while (size > 0) {
        const ssize_t got = ::read(helper_channel, bytes, size);
        if (got > 0) {
            bytes += got;
            size -= static_cast<std::size_t>(got);
        } else if (got == 0 || errno != EINTR) {
            _exit(0);
        }
    }
}

std::string read_job() {
    std::uint32_t size = 0;
    read_all(&size, sizeof(size));
    if (size > Limits::job_bytes) _exit(1);
    std::string bytes(size, '\0');
    read_all(bytes.data(), bytes.size());
    return bytes;
}

void try_job(const GladGLContext& gl, const std::string& bytes) {
    try {
        const Job job = decode(bytes);
        helper::start_clock();
        perform(gl, job, helper::begin);
        helper::stop_clock();
        helper::wait_for_cache();
        helper::send(Outcome::survived);
    } catch (const std::bad_alloc&) {
        helper::stop_clock();
        helper::send(Outcome::out_of_memory);
        _exit(0);
    } catch (const std::exception& error) {
        helper::stop_clock();
        helper::send(Outcome::failed, error.what());
    }
}

void* work(void* argument) {
    const auto& place = *static_cast<const Work*>(argument);
    helper::catch_crashes();
    try {
        cubecam::gl::Context context = cubecam::gl::Context::at(place.platform, place.device);
        const cubecam::gl::CurrentScope scope(context);
        const std::uint64_t before = helper::limit_memory();
        helper::send(Outcome::ready,
                     context.vendor() + "\n" + context.renderer() + "\n" + context.version());
        while (true) {
            try_job(context.gl(), read_job());
            if (helper::data_bytes() > before + most_kept) _exit(0);
        }
    } catch (const std::exception& error) {
        helper::send(Outcome::failed, error.what());
    }
    _exit(1);
}

}  // namespace

int main(int count, char** words) {
    if (count < 4) return 2;
    // The owner waits for the first process alone, which ends here: the helper is nobody's child.
    const pid_t child = fork();
    if (child != 0) _exit(child < 0 ? 1 : 0);
    helper::leave_owner();
    Work place{words[1], std::atoi(words[2])};
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes,
                              std::max<std::size_t>(std::strtoul(words[3], nullptr, 10), 65536));
    pthread_t thread{};
    if (pthread_create(&thread, &attributes, &work, &place) != 0) _exit(1);
    while (true) {
        pollfd owner{helper_channel, POLLRDHUP, 0};
        const int found = poll(&owner, 1, idle_milliseconds);
        if (found > 0 || (found == 0 && helper::is_idle())) _exit(0);
    }
}
