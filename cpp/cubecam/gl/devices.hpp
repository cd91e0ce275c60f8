#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cubecam::gl {

/// A device that can render: an EGL device. A string that the driver does not report is empty,
/// except `name` and `vendor`, which are then "unknown".
struct DeviceInfo {
    int index = -1;         ///< position in list_devices(); -1: not an EGL device
    std::string name;       ///< e.g. "NVIDIA GeForce RTX 4090", "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string vendor;     ///< e.g. "NVIDIA Corporation", "Mesa/X.org"
    std::string driver;     ///< e.g. "nvidia", "Mesa 22.3.6"
    bool software = false;  ///< renders on the CPU
    std::string uuid;       ///< 8-4-4-4-12 hexadecimal digits (EGL_EXT_device_persistent_id)
    std::optional<int> cuda_index;  ///< its number in CUDA (EGL_NV_device_cuda)
    std::string drm_node;           ///< e.g. "/dev/dri/renderD128"
    std::string platform;           ///< "device", "surfaceless" or "default"
    std::string problem;            ///< why it cannot be used; empty when it can
};

/// Every EGL device, in EGL's order. A device whose driver does not start is listed with its
/// `problem`. The first call may start a driver and a context to learn a name; the result is then
/// kept. Throws ContextError when there is no EGL library, or in a process forked after EGL was
/// opened.
std::vector<DeviceInfo> list_devices();

/// Describes a device in one line, for messages: `0: llvmpipe (LLVM 15.0.6, 256 bits) [software]`.
std::string describe(const DeviceInfo& device);

}  // namespace cubecam::gl
