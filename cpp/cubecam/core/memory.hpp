#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace cubecam {

/// Refuses what cannot fit into this machine's memory. The kernel grants more than there is, and
/// ends the process that then uses it.
/// @throws std::invalid_argument naming `what`, which is of `bytes`.
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
