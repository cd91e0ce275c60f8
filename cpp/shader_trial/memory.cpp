// The allocator of C with one change: memory that is not granted ends the process with a report.
// Without it a driver that does not check what it got would crash later, and nobody could say why.
//
// The names go before those of the C library in every library of this process (ELF symbol
// interposition). Another C library, and AddressSanitizer, keep their own.
#include <cstddef>
#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace helper {
void refuse_memory();
}

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);

#define EXPORTED __attribute__((visibility("default")))

EXPORTED void* malloc(std::size_t size) {
    void* block = __libc_malloc(size);
    if (block == nullptr) helper::refuse_memory();
    return block;
}

EXPORTED void* calloc(std::size_t count, std::size_t size) {
    void* block = __libc_calloc(count, size);
    if (block == nullptr) helper::refuse_memory();
    return block;
}

EXPORTED void* realloc(void* block, std::size_t size) {
    void* moved = __libc_realloc(block, size);
    if (moved == nullptr && size != 0) helper::refuse_memory();
    return moved;
}
}

#endif
