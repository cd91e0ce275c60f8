#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace cubecam {

/// Refuses an allocation that cannot fit into this machine's memory: the kernel would grant it and
/// would end the process as soon as the process writes to it.
/// @throws std::invalid_argument that names `what`, which takes `bytes`.
inline void check_memory(double bytes, const std::string& what) {
    const double memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (bytes <= memory) return;
    constexpr double mebi = 1 << 20;
    throw std::invalid_argument("size: expected pictures that fit into " +
                                std::to_string(static_cast<long long>(memory / mebi)) +
                                " MiB of memory, got " + what + ", which take " +
                                std::to_string(static_cast<long long>(bytes / mebi)) + " MiB");
}

}  // namespace cubecam
