/// Functions in versions for several processors. Only the .cpp files of cubemap/ include this
/// header.
///
/// One object file holds all versions; the loader takes the one that the processor can run. This
/// needs GCC, x86 and glibc; elsewhere there is only the plain version, with the same results bit
/// for bit, since files of such functions are compiled without fused multiply and add, and for
/// loops with comparisons without traps of the processor (cpp/CMakeLists.txt). (Sanitizers are not
/// ready yet when the loader chooses.)
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__) &&       \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CUBECAM_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CUBECAM_CLONES
#endif
