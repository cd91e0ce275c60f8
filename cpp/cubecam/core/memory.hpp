#pragma once

#include <cstddef>
#include <filesystem>
#include <new>
#include <string>
#include <utility>

namespace cubecam {

/// How much memory this process may still take, and what limits it.
struct MemoryLeft {
    double bytes;
    std::string limit;  ///< "the free memory of this machine", "RLIMIT_AS", ...
};

/// The least of what the machine has free (MemAvailable and free swap of /proc/meminfo), of what
/// the control groups of the process leave (versions 1 and 2, every group up to the root), and of
/// what RLIMIT_AS and RLIMIT_DATA leave. Pages of files that a group could give back count as free.
///
/// @param root the folder in which proc/ and sys/ lie; tests name another one.
MemoryLeft memory_left(const std::filesystem::path& root = "/");

/// Refuses a size, since `left` bytes are less than `what` takes; `of` says of what they are left.
[[noreturn]] void refuse_size(double left, const std::string& of, double bytes,
                              const std::string& what);

/// Refuses an allocation that the memory cannot hold: the kernel would grant it and would end the
/// process as soon as the process writes to it. Less than `small_allocation` bytes always pass.
/// @throws std::invalid_argument that names `what`, which takes `bytes`.
void check_memory(double bytes, const std::string& what);

/// Too little memory: MemoryError in Python.
class OutOfMemory : public std::bad_alloc {
public:
    explicit OutOfMemory(std::string text) : text_(std::move(text)) {}
    const char* what() const noexcept override { return text_.c_str(); }

private:
    std::string text_;
};

/// Takes a function that frees what is kept only to save time, and returns how many bytes that was.
/// Both checks call it before they refuse anything. At most eight functions.
void add_reserve(std::size_t (*free_reserve)());

/// Memory of at least this size has large pages where the system has them: new memory then takes a
/// fault of the processor for each 2 MiB, not for each 4 KiB.
constexpr std::size_t large_allocation = std::size_t{4} << 20;

/// Asks the system for large pages within new memory.
void advise_large_pages(void* memory, std::size_t bytes) noexcept;

constexpr std::size_t small_allocation = std::size_t{32} << 20;

/// The same for a piece of work of which no argument says its size. @throws OutOfMemory
void check_room(std::size_t bytes);

}  // namespace cubecam
