#include "cubecam/trial/helper_process.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/core/interrupts.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

extern char** environ;

namespace cubecam::trial {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int slice = 50;  // milliseconds between two looks for an interrupt
constexpr int start_milliseconds = 20'000;
constexpr std::chrono::seconds start_pause{60};  // after a start that failed
constexpr int answer_milliseconds = (Limits::most_seconds + 10) * 1000;
constexpr std::size_t most_text = 4096;

/// The descriptors of connections. A forked child closes its copies: as long as one is open, the
/// helper does not see that its owner ended.
std::array<std::atomic<int>, 64> connections;

void close_in_child() noexcept {
    for (std::atomic<int>& place : connections) {
        const int descriptor = place.exchange(0);
        if (descriptor > 0) ::close(descriptor);
    }
}

void note_connection(int descriptor) {
    static const int registered = pthread_atfork(nullptr, nullptr, close_in_child);
    (void)registered;
    for (std::atomic<int>& place : connections) {
        int none = 0;
        if (place.compare_exchange_strong(none, descriptor)) return;
    }
}

void forget_connection(int descriptor) {
    for (std::atomic<int>& place : connections) {
        int mine = descriptor;
        if (place.compare_exchange_strong(mine, 0)) return;
    }
}

std::string reason(const char* what, int error) {
    return std::string(what) + ": " + std::strerror(error);
}

/// Moves a descriptor above those of standard input and output, which the helper gets.
int above_standard(int descriptor) {
    if (descriptor < 0 || descriptor > 2) return descriptor;
    const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, 3);
    ::close(descriptor);
    return moved;
}

/// Waits a moment for a connection. @throws what poll_interrupts() throws; the helper then ends.
void wait_for(int descriptor, short event) {
    pollfd wait{descriptor, event, 0};
    ::poll(&wait, 1, slice);
    poll_interrupts();
}

struct Pair {
    int ours = -1;
    int theirs = -1;
    ~Pair() {
        if (ours >= 0) ::close(ours);
        if (theirs >= 0) ::close(theirs);
    }
};

/// The environment of the helper: llvmpipe needs no threads for one pixel.
std::vector<char*> helper_environment() {
    static char no_threads[] = "LP_NUM_THREADS=0";
    static char one_arena[] = "MALLOC_ARENA_MAX=1";
    std::vector<char*> variables;
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
        const std::string_view text(*variable);
        if (text.starts_with("LP_NUM_THREADS=") || text.starts_with("MALLOC_ARENA_MAX=")) continue;
        variables.push_back(*variable);
    }
    variables.push_back(no_threads);
    variables.push_back(one_arena);
    variables.push_back(nullptr);
    return variables;
}

/// Starts the program with its channel as standard input. The program leaves the process that is
/// spawned at once and goes on in a child of it, so that nobody who waits for all children of this
/// process waits for the helper.
void spawn(const std::string& path, const HelperPlace& place, int channel, int print) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, channel, helper_channel);
    posix_spawn_file_actions_adddup2(&actions, print, 1);
    posix_spawn_file_actions_adddup2(&actions, print, 2);
    // A session of its own: Ctrl-C in the terminal reaches the user's program alone.
    posix_spawnattr_setflags(
        &attributes,
        static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSID));
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);

    const std::array<std::string, 5> words = {path, place.platform, std::to_string(place.device),
                                              std::to_string(place.stack_bytes),
                                              std::to_string(getpid())};
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::vector<char*> variables = helper_environment();
    pid_t child = 0;
    const int error = posix_spawn(&child, path.c_str(), &actions, &attributes, arguments.data(),
                                  variables.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw Error(reason(path.c_str(), error));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
}

}  // namespace

std::string helper_path() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&helper_path), &info) == 0 ||
        info.dli_fname == nullptr) {
        return "_shader_trial";
    }
    const std::string file = info.dli_fname;
    const std::size_t slash = file.rfind('/');
    return (slash == std::string::npos ? std::string("./") : file.substr(0, slash + 1)) +
           "_shader_trial";
}

Connection::Connection(const HelperPlace& place) {
    try {
        start(place);
    } catch (...) {
        close();
        throw;
    }
}

void Connection::close() noexcept {
    if (channel_ >= 0) {
        forget_connection(channel_);
        ::close(std::exchange(channel_, -1));
    }
    if (printed_ >= 0) ::close(std::exchange(printed_, -1));
}

void Connection::start(const HelperPlace& place) {
    const std::string path = helper_path();
    if (access(path.c_str(), X_OK) != 0) throw Error(reason(path.c_str(), errno));
    Pair channel;
    Pair print;
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw Error(reason("socketpair", errno));
    }
    channel.ours = above_standard(ends[0]);
    channel.theirs = above_standard(ends[1]);
    if (pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) throw Error(reason("pipe2", errno));
    print.ours = above_standard(ends[0]);
    print.theirs = above_standard(ends[1]);
    if (std::min({channel.ours, channel.theirs, print.ours, print.theirs}) < 0) {
        throw Error(reason("fcntl", errno));
    }
    spawn(path, place, channel.theirs, print.theirs);
    ::close(std::exchange(channel.theirs, -1));
    ::close(std::exchange(print.theirs, -1));
    channel_ = std::exchange(channel.ours, -1);
    printed_ = std::exchange(print.ours, -1);
    note_connection(channel_);
    const auto answer = receive_report(start_milliseconds);
    if (!answer) {
        const std::string text = printed();
        throw Error(path + " ended at once" + (text.empty() ? "" : ": " + text));
    }
    if (answer->report.outcome != Outcome::ready) {
        throw Error(answer->text.empty() ? path + ": the driver ended it at once" : answer->text);
    }
    driver_ = answer->text;
}

std::string Connection::printed() const {
    std::string text(most_text, '\0');
    const ssize_t got = ::read(printed_, text.data(), text.size());
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

bool Connection::send(std::string_view bytes, int milliseconds) {
    const auto end = Clock::now() + std::chrono::milliseconds(milliseconds);
    while (!bytes.empty()) {
        const ssize_t done =
            ::send(channel_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (done > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(done));
            continue;
        }
        if (errno != EAGAIN && errno != EINTR) return false;
        if (Clock::now() > end) return false;
        wait_for(channel_, POLLOUT);
    }
    return true;
}

bool Connection::receive(void* to, std::size_t size, int milliseconds) {
    auto* bytes = static_cast<char*>(to);
    const auto end = Clock::now() + std::chrono::milliseconds(milliseconds);
    while (size > 0) {
        const ssize_t got = ::recv(channel_, bytes, size, MSG_DONTWAIT);
        if (got > 0) {
            bytes += got;
            size -= static_cast<std::size_t>(got);
            continue;
        }
        if (got == 0 || (errno != EAGAIN && errno != EINTR)) return false;
        if (Clock::now() > end) return false;
        wait_for(channel_, POLLIN);
    }
    return true;
}

std::optional<Connection::Answer> Connection::receive_report(int milliseconds) {
    Answer answer;
    if (!receive(&answer.report, sizeof(Report), milliseconds)) return std::nullopt;
    const Report& report = answer.report;
    if (report.magic != Report::right_magic || report.text_size > most_text) return std::nullopt;
    answer.text.resize(report.text_size);
    if (!receive(answer.text.data(), answer.text.size(), milliseconds)) return std::nullopt;
    return answer;
}

std::optional<Connection::Answer> Connection::ask(std::string_view job) {
    const auto size = static_cast<std::uint32_t>(job.size());
    const std::string_view head(reinterpret_cast<const char*>(&size), sizeof(size));
    if (!send(head, answer_milliseconds) || !send(job, answer_milliseconds)) return std::nullopt;
    const auto start = Clock::now();
    auto answer = receive_report(answer_milliseconds);
    if (!answer && Clock::now() - start >= std::chrono::milliseconds(answer_milliseconds)) {
        answer.emplace();
        answer->report.outcome = Outcome::out_of_time;
    }
    return answer;
}

Helper& Helper::of(const HelperPlace& place) {
    // Neither the mutex nor the helpers are ever freed: renderers may be closed while the process
    // ends. The kernel then closes the connections, and the helpers end.
    static auto* guard = new std::mutex();
    static auto* helpers = new std::map<HelperPlace, std::unique_ptr<Helper>>();
    const std::lock_guard lock(*guard);
    std::unique_ptr<Helper>& helper = (*helpers)[place];
    if (helper == nullptr) helper = std::make_unique<Helper>(place);
    return *helper;
}

std::unique_ptr<Connection> Helper::connect() {
    if (Clock::now() < next_start_) throw Error(problem_);
    try {
        return std::make_unique<Connection>(place_);
    } catch (const Error& error) {
        problem_ = error.what();
        next_start_ = Clock::now() + start_pause;
        throw;
    }
}

Verdict Helper::ask(std::string_view job, const std::string& driver) {
    std::unique_lock lock(mutex_, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(slice))) poll_interrupts();
    for (int left = 2; left > 0;) {
        // From here to the answer the connection is in use: an exception ends it and the helper.
        std::unique_ptr<Connection> connection = std::exchange(connection_, nullptr);
        const bool fresh = connection == nullptr;
        if (fresh) connection = connect();
        if (connection->driver() != driver) {
            throw Error("its driver is another one: expected " + driver + ", got " +
                        connection->driver());
        }
        const auto answer = connection->ask(job);
        if (!answer) {
            if (fresh) --left;  // another one may have ended since its last job
            continue;
        }
        const Report& report = answer->report;
        const Verdict verdict{report.outcome, report.step, report.signal};
        if (verdict.passed()) connection_ = std::move(connection);
        return verdict;
    }
    return {Outcome::killed};
}

}  // namespace cubecam::trial
