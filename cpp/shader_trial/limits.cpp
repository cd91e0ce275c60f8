#include "limits.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <string>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
#include <vector>

namespace helper {
namespace {

using cubecam::trial::Limits;
using cubecam::trial::Outcome;
using cubecam::trial::Report;
using cubecam::trial::Step;

std::atomic<Step> current{Step::start};
std::atomic<bool> busy{true};  // until the context is there, too
std::atomic<bool> memory_limited{false};
std::atomic<bool> memory_short{false};  // the machine cannot grant as much as Limits says
std::array<char, 65536> signal_stack;

/// Sends a report and ends the process. It may run in a signal handler and inside malloc.
[[noreturn]] void report_end(Outcome outcome, int signal) {
    Report report;
    report.magic = Report::right_magic;
    report.outcome = outcome;
    report.step = current;
    report.signal = static_cast<std::uint8_t>(signal);
    (void)!::write(cubecam::trial::helper_channel, &report, sizeof(report));
    _exit(0);
}

void on_crash(int signal) { report_end(Outcome::crashed, signal); }
void on_time(int signal) { report_end(Outcome::out_of_time, signal); }

std::int64_t cpu_milliseconds() {
    timespec used{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return used.tv_sec * std::int64_t{1000} + used.tv_nsec / 1'000'000;
}

std::atomic<std::int64_t> cpu_before{0};  // of the last look

/// On a busy machine a driver that works gets little time: what counts is whether it works.
void on_look(int signal) {
    const std::int64_t now = cpu_milliseconds();
    if (now - cpu_before.exchange(now) < Limits::least_milliseconds) on_time(signal);
}
void on_exit() { report_end(Outcome::ended, 0); }

void handle(int signal, void (*handler)(int)) {
    struct sigaction action{};
    action.sa_handler = handler;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

void set_clock(int seconds, int wall_seconds) {
    itimerval cpu{};
    cpu.it_value.tv_sec = seconds;
    setitimer(ITIMER_PROF, &cpu, nullptr);
    itimerval wall{};
    wall.it_value.tv_sec = wall_seconds;
    wall.it_interval = wall.it_value;
    cpu_before = cpu_milliseconds();
    setitimer(ITIMER_REAL, &wall, nullptr);
}

/// Returns a number of a file in /proc: the one that follows `name`.
std::uint64_t number_in(const char* path, const char* name) {
    const int file = ::open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return 0;
    std::array<char, 8192> text{};
    const ssize_t got = ::read(file, text.data(), text.size() - 1);
    ::close(file);
    if (got <= 0) return 0;
    const char* found = std::strstr(text.data(), name);
    return found == nullptr ? 0 : std::strtoull(found + std::strlen(name), nullptr, 10);
}

void write_file(const char* path, std::string_view text) {
    const int file = ::open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0) return;
    (void)!::write(file, text.data(), text.size());
    ::close(file);
}

/// Opens the states of Mesa's threads that write its disk cache: their names end in "disk$0".
std::vector<int> open_cache_threads() {
    std::vector<int> states;
    DIR* tasks = opendir("/proc/self/task");
    if (tasks == nullptr) return states;
    while (const dirent* task = readdir(tasks)) {
        const std::string folder = std::string("/proc/self/task/") + task->d_name;
        const int file = ::open((folder + "/comm").c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) continue;
        std::array<char, 64> name{};
        const ssize_t got = ::read(file, name.data(), name.size() - 1);
        ::close(file);
        if (got <= 0 || std::strstr(name.data(), "disk$") == nullptr) continue;
        const int state = ::open((folder + "/stat").c_str(), O_RDONLY | O_CLOEXEC);
        if (state >= 0) states.push_back(state);
    }
    closedir(tasks);
    return states;
}

/// Whether a thread waits for work, from its line in /proc: "1234 (name) S ...".
bool sleeps(int state) {
    std::array<char, 256> text{};
    if (pread(state, text.data(), text.size() - 1, 0) <= 0) return true;
    const char* end = std::strrchr(text.data(), ')');
    return end == nullptr || end[1] != ' ' || end[2] == 'S';
}

}  // namespace

void refuse_memory() {
    if (memory_limited) report_end(Outcome::out_of_memory, memory_short ? 1 : 0);
}

void leave_owner() {
#ifdef SYS_close_range
    if (syscall(SYS_close_range, 3U, ~0U, 0U) != 0)
#endif
    {
        for (int descriptor = 3; descriptor < 4096; ++descriptor) ::close(descriptor);
    }
    write_file("/proc/self/oom_score_adj", "1000");
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
}

void catch_crashes() {
    stack_t stack{};
    stack.ss_sp = signal_stack.data();
    stack.ss_size = signal_stack.size();
    sigaltstack(&stack, nullptr);
    for (const int signal : {SIGSEGV, SIGFPE, SIGABRT, SIGBUS, SIGILL, SIGTRAP, SIGSYS}) {
        handle(signal, on_crash);
    }
    handle(SIGPROF, on_time);
    handle(SIGALRM, on_look);
    std::atexit(on_exit);
}

std::uint64_t data_bytes() { return number_in("/proc/self/status", "VmData:") << 10; }

std::uint64_t limit_memory() {
    const std::uint64_t before = data_bytes();
    std::uint64_t granted = Limits::bytes;
    const std::uint64_t available = number_in("/proc/meminfo", "MemAvailable:") << 10;
    if (available > 0) granted = std::min(granted, available / 2);
    rlimit limit{};
    if (getrlimit(RLIMIT_DATA, &limit) == 0) {
        limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, before + granted);
        memory_short = limit.rlim_cur < before + Limits::bytes;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        setrlimit(RLIMIT_DATA, &limit);  // a sanitizer ends the process when memory is refused
#endif
    }
    memory_limited = true;
    busy = false;
    return before;
}

void start_clock() {
    busy = true;
    set_clock(Limits::seconds, Limits::wall_seconds);
}

void stop_clock() {
    set_clock(0, 0);
    current = Step::start;
    busy = false;
}

bool is_idle() { return !busy; }

void wait_for_cache() {
    // Mesa starts more of these threads when it has more to write, so they are looked for each
    // time. They have the lowest priority: on a busy machine the wait takes longer.
    constexpr int most_microseconds = 2'000'000;
    int waited = 0;
    int pause = 100;
    for (const int thread : open_cache_threads()) {
        while (waited < most_microseconds && !sleeps(thread)) {
            usleep(static_cast<useconds_t>(pause));
            waited += pause;
            pause = std::min(pause + pause / 4, 2'000);
        }
        ::close(thread);
    }
}

void begin(Step step) { current = step; }

void send(Outcome outcome, std::string_view text) {
    text = text.substr(0, 2048);
    std::array<char, sizeof(Report) + 2048> bytes{};
    Report report;
    report.magic = Report::right_magic;
    report.outcome = outcome;
    report.step = current;
    report.text_size = static_cast<std::uint32_t>(text.size());
    std::memcpy(bytes.data(), &report, sizeof(report));
    std::memcpy(bytes.data() + sizeof(report), text.data(), text.size());
    const std::size_t size = sizeof(report) + text.size();
    if (::write(cubecam::trial::helper_channel, bytes.data(), size) != static_cast<ssize_t>(size)) {
        _exit(0);
    }
}

}  // namespace helper
