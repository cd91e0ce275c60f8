#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/scene/camera.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

namespace cubecam {

/// How the pictures of two eyes become one.
enum class StereoLayout : std::uint8_t {
    anaglyph,      ///< red from the left eye, green and blue from the right, alpha the greater
    side_by_side,  ///< the left eye in the left half
    top_bottom     ///< the left eye in the upper half
};

inline constexpr NameTable<StereoLayout, 3> stereo_layout_names{
    {{"anaglyph", StereoLayout::anaglyph},
     {"side_by_side", StereoLayout::side_by_side},
     {"top_bottom", StereoLayout::top_bottom}}};

/// @throws std::invalid_argument for any other name.
StereoLayout parse_stereo_layout(std::string_view name);
std::string_view to_string(StereoLayout layout);

struct Eyes {
    CameraValue left;
    CameraValue right;
};

/// Returns eyes at both sides of a camera, each half of `separation` away along the camera's right
/// axis, with parallel axes. With `convergence` their frusta are sheared: a point at that distance
/// from the camera, along its axis, has the same place in both pictures (P. Bourke, "Calculating
/// Stereo Pairs", 1999). Lengths are in world units. The eyes have the camera's parent.
/// @throws std::invalid_argument for numbers out of their range, or for a convergence of parallel
/// rays, which have no frustum.
Eyes off_axis_eyes(const CameraValue& camera, double separation, std::optional<double> convergence);

/// Returns eyes on a circle round the camera's target, each turned by half of `degrees` about the
/// axis that is up in the camera's picture.
/// @throws std::invalid_argument for a camera without a target, or an angle outside [0, 180).
Eyes toe_in_eyes(const CameraValue& camera, double degrees);

struct StereoValue {
    Eyes eyes;
    StereoLayout layout;
};

/// Two cameras whose pictures are drawn in one call and combined.
class StereoCamera {
public:
    StereoCamera(std::shared_ptr<Camera> left, std::shared_ptr<Camera> right, StereoLayout layout);
    StereoCamera(const StereoCamera&) = delete;
    StereoCamera& operator=(const StereoCamera&) = delete;

    std::shared_ptr<Camera> left() const;
    std::shared_ptr<Camera> right() const;
    StereoLayout layout() const;
    /// @throws std::invalid_argument for null.
    void set_left(std::shared_ptr<Camera> camera);
    void set_right(std::shared_ptr<Camera> camera);
    void set_layout(StereoLayout layout);

    /// The eyes in the world.
    StereoValue value() const;

private:
    mutable std::mutex mutex_;
    std::shared_ptr<Camera> left_;
    std::shared_ptr<Camera> right_;
    StereoLayout layout_;
};

}  // namespace cubecam
