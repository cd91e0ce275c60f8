#include "cubecam/gl/texture_memory.hpp"

#include "cubecam/core/memory.hpp"

#include <glad/gl.h>

namespace cubecam {
namespace {

// From the extensions' specifications; both count in KiB.
constexpr GLenum current_available_nvx = 0x9049;  // GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX
constexpr GLenum texture_free_ati = 0x87FC;       // TEXTURE_FREE_MEMORY_ATI: the pool's sum first

}  // namespace

std::optional<double> free_video_memory(const gl::Context& context) {
    GLint kibibytes[4] = {};
    if (context.has_extension("GL_NVX_gpu_memory_info")) {
        context.gl().GetIntegerv(current_available_nvx, kibibytes);
    } else if (context.has_extension("GL_ATI_meminfo")) {
        context.gl().GetIntegerv(texture_free_ati, kibibytes);
    } else {
        return std::nullopt;
    }
    if (kibibytes[0] <= 0) return std::nullopt;  // a driver that offers the name alone
    return 1024.0 * kibibytes[0];
}

void check_texture_memory(const gl::Context& context, double texture_bytes, double main_bytes,
                          const std::string& what) {
    if (texture_bytes + main_bytes < static_cast<double>(small_allocation)) return;
    auto left = context.software() ? std::nullopt : free_video_memory(context);
    if (!left) return check_memory(texture_bytes + main_bytes, what);
    if (texture_bytes > *left) {
        // Textures that were deleted a moment ago are freed when the GPU has finished its work.
        context.gl().Finish();
        left = free_video_memory(context);
    }
    if (left && texture_bytes > *left) {
        refuse_size(*left, "free video memory", texture_bytes, what);
    }
    check_memory(main_bytes, what);
}

}  // namespace cubecam
