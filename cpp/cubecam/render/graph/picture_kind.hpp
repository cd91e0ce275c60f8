#pragma once

#include "cubecam/render/graph/picture.hpp"

namespace cubecam {

/// The kinds of pictures, in the order in which messages search for the picture to name. A new kind
/// (a filtered cube) gets the next number; FrameContext::make makes its pictures.
enum class PictureKind : std::uint8_t {
    probe,
    texture,
    shadow,
    frame,
    behind,
    planar_mirror,
    screen
};

inline PictureId probe_id(std::size_t scene, std::size_t probe, std::size_t bounce = 0) {
    return {PictureKind::probe, scene, probe, bounce, nullptr};
}

/// The scene of the call numbers the render textures of all its scenes; `texture` is such a number.
inline PictureId texture_id(std::size_t texture) {
    return {PictureKind::texture, 0, texture, 0, nullptr};
}

inline PictureId shadow_id(std::size_t scene, std::size_t light) {
    return {PictureKind::shadow, scene, light, 0, nullptr};
}

/// The frame or capture of the call.
inline PictureId frame_id() { return {PictureKind::frame, 0, 0, 0, nullptr}; }

/// What lies behind the transmissive surfaces of another picture.
inline PictureId behind_id(const PictureId& viewer) {
    return {PictureKind::behind, viewer.scene, 0, 0, std::make_shared<const PictureId>(viewer)};
}

/// What reflections in another picture find on the screen.
inline PictureId screen_id(const PictureId& viewer) {
    return {PictureKind::screen, viewer.scene, 0, 0, std::make_shared<const PictureId>(viewer)};
}

/// What another picture sees in a planar mirror; `mirror` is its place in FrameContext::mirrors.
inline PictureId planar_mirror_id(const PictureId& viewer, std::size_t mirror) {
    return {PictureKind::planar_mirror, viewer.scene, mirror, 0,
            std::make_shared<const PictureId>(viewer)};
}

}  // namespace cubecam
