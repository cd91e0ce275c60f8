#include "cubecam/core/memory.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace cubecam {
namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number in a file; none if there is no file or no number, such as "max".
std::optional<double> number_in(const fs::path& file) {
    std::ifstream stream(file);
    double number = 0.0;
    if (stream >> number) return number;
    return std::nullopt;
}

/// The number after a key at the begin of a line, as in /proc/meminfo and memory.stat.
std::optional<double> number_after(const fs::path& file, std::string_view key) {
    std::ifstream stream(file);
    std::string line;
    while (std::getline(stream, line)) {
        std::istringstream words(line);
        std::string word;
        double number = 0.0;
        if (words >> word && word == key && words >> number) return number;
    }
    return std::nullopt;
}

std::string megabytes(double bytes) {
    return std::to_string(static_cast<long long>(bytes / (1 << 20))) + " MiB";
}

void lower(MemoryLeft& left, double bytes, const std::string& limit) {
    if (bytes < left.bytes) left = {std::max(bytes, 0.0), limit};
}

/// Names of the files of one version of control groups.
struct GroupFiles {
    const char* limit;
    const char* usage;
    const char* pages[2];  ///< keys of memory.stat: pages of files, which the kernel can drop
};

constexpr GroupFiles version_1{
    "memory.limit_in_bytes", "memory.usage_in_bytes", {"total_inactive_file", "total_active_file"}};
constexpr GroupFiles version_2{"memory.max", "memory.current", {"inactive_file", "active_file"}};

double swap_left(const fs::path& group, double free_swap) {
    const auto limit = number_in(group / "memory.swap.max");
    const auto used = number_in(group / "memory.swap.current");
    if (!limit) return free_swap;  // "max", or no such file
    return std::clamp(*limit - used.value_or(0.0), 0.0, free_swap);
}

/// Lowers `left` to what a group and those above it leave.
void lower_to_groups(MemoryLeft& left, const fs::path& mount, fs::path path,
                     const GroupFiles& files, double free_swap) {
    // In a container the path may be that of the host, of which the container sees the end alone.
    if (!fs::exists(mount / path / files.usage)) path.clear();
    while (true) {
        const fs::path group = mount / path;
        const auto limit = number_in(group / files.limit);
        const auto usage = number_in(group / files.usage);
        if (limit && usage) {
            double pages = 0.0;
            for (const char* key : files.pages) {
                pages += number_after(group / "memory.stat", key).value_or(0.0);
            }
            const bool swaps = &files == &version_2;
            lower(left,
                  *limit - std::max(*usage - pages, 0.0) +
                      (swaps ? swap_left(group, free_swap) : 0.0),
                  "the control group's limit of " + megabytes(*limit));
        }
        if (path.empty()) return;
        path = path.parent_path();
    }
}

void lower_to_all_groups(MemoryLeft& left, const fs::path& root, double free_swap) {
    const fs::path mounts = root / "sys/fs/cgroup";
    std::ifstream stream(root / "proc/self/cgroup");
    std::string line;
    while (std::getline(stream, line)) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const fs::path path = fs::path(line.substr(second + 1)).relative_path();
        if (controllers == ",,") {
            lower_to_groups(left, mounts, path, version_2, free_swap);
        } else if (controllers.find(",memory,") != std::string::npos) {
            lower_to_groups(left, mounts / "memory", path, version_1, free_swap);
        }
    }
}

/// Lowers `left` to the limits of the process; statm has its sizes in pages (proc_pid_statm(5)).
void lower_to_process(MemoryLeft& left, const fs::path& root) {
    std::ifstream stream(root / "proc/self/statm");
    double sizes[6] = {};
    for (double& size : sizes) stream >> size;
    const double page = static_cast<double>(sysconf(_SC_PAGESIZE));
    const auto lower_to = [&](int kind, double pages, const char* name) {
        rlimit limit{};
        if (getrlimit(static_cast<decltype(RLIMIT_AS)>(kind), &limit) != 0) return;
        if (limit.rlim_cur == RLIM_INFINITY) return;
        lower(left, static_cast<double>(limit.rlim_cur) - pages * page, name);
    };
    lower_to(RLIMIT_AS, sizes[0], "RLIMIT_AS");
    lower_to(RLIMIT_DATA, sizes[5], "RLIMIT_DATA");
}

std::atomic<std::size_t (*)()> reserves[8];

/// What is left once the reserves are free; they are freed only if less than `bytes` are left.
MemoryLeft memory_left_for(double bytes) {
    MemoryLeft left = memory_left();
    if (bytes <= left.bytes) return left;
    std::size_t freed = 0;
    for (const auto& each : reserves) {
        if (const auto free_reserve = each.load()) freed += free_reserve();
    }
    if (freed == 0) return left;
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    return memory_left();
}

}  // namespace

void add_reserve(std::size_t (*free_reserve)()) {
    for (auto& each : reserves) {
        std::size_t (*none)() = nullptr;
        if (each.compare_exchange_strong(none, free_reserve)) return;
    }
    throw std::logic_error("memory: expected at most eight reserves, got one more");
}

void advise_large_pages([[maybe_unused]] void* memory,
                        [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (first + page - 1) / page * page;
    const std::uintptr_t end = (first + bytes) / page * page;
    // Where it fails, pages are small.
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

MemoryLeft memory_left(const fs::path& root) {
    MemoryLeft left{unlimited, "no limit"};
    const fs::path info = root / "proc/meminfo";
    const double free_swap = 1024.0 * number_after(info, "SwapFree:").value_or(0.0);
    if (const auto available = number_after(info, "MemAvailable:")) {
        lower(left, 1024.0 * *available + free_swap, "the free memory of this machine");
    } else {
        lower(left,
              static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                  static_cast<double>(sysconf(_SC_PAGESIZE)),
              "the memory of this machine");
    }
    lower_to_all_groups(left, root, free_swap);
    lower_to_process(left, root);
    return left;
}

void refuse_size(double left, const std::string& of, double bytes, const std::string& what) {
    throw std::invalid_argument("size: expected what fits into " + megabytes(left) + " of " + of +
                                ", got " + what + ", which take " + megabytes(bytes));
}

void check_memory(double bytes, const std::string& what) {
    if (bytes < static_cast<double>(small_allocation)) return;
    const MemoryLeft left = memory_left_for(bytes);
    if (bytes <= left.bytes) return;
    refuse_size(left.bytes, "memory (" + left.limit + ")", bytes, what);
}

void check_room(std::size_t bytes) {
    if (bytes < small_allocation) return;
    const MemoryLeft left = memory_left_for(static_cast<double>(bytes));
    if (static_cast<double>(bytes) <= left.bytes) return;
    throw OutOfMemory("expected work that fits into " + megabytes(left.bytes) + " of memory (" +
                      left.limit + "), got a piece that takes " +
                      megabytes(static_cast<double>(bytes)));
}

}  // namespace cubecam
