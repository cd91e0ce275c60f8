#pragma once

#include "cubecam/render/graph/picture.hpp"

namespace cubecam {

/// In the order in which messages look for one to blame. A kind that comes (a filtered cube, a
/// planar mirror) takes the next number; FrameContext::make makes its pictures.
enum class PictureKind : std::uint8_t { probe, texture, shadow, frame };

inline PictureId probe_id(std::size_t scene, std::size_t probe, std::size_t bounce = 0) {
    return {PictureKind::probe, scene, probe, bounce, nullptr};
}

/// Render textures are numbered in the scene of the call; `texture` is a place there.
inline PictureId texture_id(std::size_t texture) {
    return {PictureKind::texture, 0, texture, 0, nullptr};
}

inline PictureId shadow_id(std::size_t scene, std::size_t light) {
    return {PictureKind::shadow, scene, light, 0, nullptr};
}

/// The frame or capture of the call.
inline PictureId frame_id() { return {PictureKind::frame, 0, 0, 0, nullptr}; }

}  // namespace cubecam
