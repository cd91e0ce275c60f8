#pragma once

#include <cstdint>

/// The part of EGL that this library uses: types, constants and signatures. Private to gl/.
///
/// Values are those of the Khronos EGL registry (https://registry.khronos.org/EGL/, api/egl.xml).
/// They are repeated here so that the build needs no EGL headers, which belong to a GL development
/// package.
namespace cubecam::gl::egl {

using Boolean = unsigned int;
using Enum = unsigned int;
using Int = std::int32_t;
using Attrib = std::intptr_t;
using Display = void*;
using Context = void*;
using Surface = void*;
using Config = void*;
using Device = void*;
using Proc = void (*)();

// EGL 1.0 to 1.5
inline constexpr Int success = 0x3000;
inline constexpr Int not_initialized = 0x3001;
inline constexpr Int bad_access = 0x3002;
inline constexpr Int bad_context = 0x3006;
inline constexpr Int bad_display = 0x3008;
inline constexpr Int context_lost = 0x300E;
inline constexpr Int none = 0x3038;
inline constexpr Int alpha_size = 0x3021;
inline constexpr Int blue_size = 0x3022;
inline constexpr Int green_size = 0x3023;
inline constexpr Int red_size = 0x3024;
inline constexpr Int surface_type = 0x3033;
inline constexpr Int pbuffer_bit = 0x0001;
inline constexpr Int renderable_type = 0x3040;
inline constexpr Int opengl_bit = 0x0008;
inline constexpr Int height = 0x3056;
inline constexpr Int width = 0x3057;
inline constexpr Int vendor = 0x3053;
inline constexpr Int version = 0x3054;
inline constexpr Int extensions = 0x3055;
inline constexpr Int draw = 0x3059;
inline constexpr Int read = 0x305A;
inline constexpr Enum opengl_api = 0x30A2;
inline constexpr Int context_major_version = 0x3098;
inline constexpr Int context_minor_version = 0x30FB;
inline constexpr Int context_opengl_profile_mask = 0x30FD;
inline constexpr Int context_opengl_core_profile_bit = 0x00000001;
inline constexpr Int context_flags = 0x30FC;  // EGL_KHR_create_context
inline constexpr Int context_opengl_debug_bit = 0x00000001;

// EGL 1.5
inline constexpr Int context_robust_access = 0x31B2;
inline constexpr Int context_reset_strategy = 0x31BD;
inline constexpr Int lose_context_on_reset = 0x31BF;

inline constexpr Enum platform_device = 0x313F;       // EGL_EXT_platform_device
inline constexpr Enum platform_surfaceless = 0x31DD;  // EGL_MESA_platform_surfaceless

inline constexpr Int track_references = 0x3352;  // EGL_KHR_display_reference

inline constexpr Int drm_device_file = 0x3233;       // EGL_EXT_device_drm
inline constexpr Int drm_render_node_file = 0x3377;  // EGL_EXT_device_drm_render_node
inline constexpr Int cuda_device = 0x323A;           // EGL_NV_device_cuda
inline constexpr Int device_uuid = 0x335C;           // EGL_EXT_device_persistent_id
inline constexpr Int driver_name = 0x335E;           // EGL_EXT_device_persistent_id
inline constexpr Int renderer_name = 0x335F;         // EGL_EXT_device_query_name

/// Pointers into the EGL library. Core functions are never null, functions of extensions may be
/// null.
struct Table {
    Proc (*get_proc_address)(const char*) = nullptr;
    Int (*get_error)() = nullptr;
    Display (*get_display)(void*) = nullptr;
    Boolean (*initialize)(Display, Int*, Int*) = nullptr;
    const char* (*query_string)(Display, Int) = nullptr;
    Boolean (*bind_api)(Enum) = nullptr;
    Enum (*query_api)() = nullptr;
    Boolean (*choose_config)(Display, const Int*, Config*, Int, Int*) = nullptr;
    Context (*create_context)(Display, Config, Context, const Int*) = nullptr;
    Boolean (*destroy_context)(Display, Context) = nullptr;
    Surface (*create_pbuffer_surface)(Display, Config, const Int*) = nullptr;
    Boolean (*destroy_surface)(Display, Surface) = nullptr;
    Boolean (*make_current)(Display, Surface, Surface, Context) = nullptr;
    Context (*get_current_context)() = nullptr;
    Surface (*get_current_surface)(Int) = nullptr;
    Display (*get_current_display)() = nullptr;

    Display (*get_platform_display)(Enum, void*, const Int*) = nullptr;  // EGL_EXT_platform_base
    Boolean (*query_devices)(Int, Device*, Int*) = nullptr;          // EGL_EXT_device_enumeration
    const char* (*query_device_string)(Device, Int) = nullptr;       // EGL_EXT_device_query
    Boolean (*query_device_attrib)(Device, Int, Attrib*) = nullptr;  // EGL_EXT_device_query
    Boolean (*query_device_binary)(Device, Int, Int, void*,
                                   Int*) = nullptr;  // EGL_EXT_device_persistent_id
};

}  // namespace cubecam::gl::egl
