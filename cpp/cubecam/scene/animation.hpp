#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/scene/weak_nodes.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cubecam {

/// The property of a node that a channel changes.
enum class AnimationPath : std::uint8_t { translation, rotation, scale, weights };

inline constexpr NameTable<AnimationPath, 4> animation_path_names{
    {{"translation", AnimationPath::translation},
     {"rotation", AnimationPath::rotation},
     {"scale", AnimationPath::scale},
     {"weights", AnimationPath::weights}}};

/// How a channel goes from key to key (glTF 2.0, appendix C).
enum class Interpolation : std::uint8_t {
    step,
    linear,  ///< rotations: spherical, along the shorter way
    cubic,   ///< a cubic Hermite spline; each key has an in-tangent, a value and an out-tangent
};

inline constexpr NameTable<Interpolation, 3> interpolation_names{{{"step", Interpolation::step},
                                                                  {"linear", Interpolation::linear},
                                                                  {"cubic", Interpolation::cubic}}};

/// The keys of a channel.
struct Keys {
    AnimationPath path = AnimationPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;   ///< seconds, increasing
    std::vector<double> values;  ///< rows of `width` numbers: one a key, or three if it is cubic
    std::size_t width = 3;  ///< 3; 4 for rotations (w, x, y, z); the targets' number for weights

    bool operator==(const Keys&) const = default;
};

/// Throws std::invalid_argument for times that are not finite or do not increase, rows of another
/// number or width, numbers that are not finite, or a rotation of length 0.
void check(const Keys& keys);

/// The value at a time, in `to`, which has `width` numbers. Before the first and after the last key
/// it is the value of that key. Rotations have unit length.
void sample(const Keys& keys, double seconds, std::span<double> to);

/// A property of a node as a function of time. A channel does not keep its node alive.
class AnimationChannel {
public:
    AnimationChannel(const std::shared_ptr<Node>& node, Keys keys);
    AnimationChannel(const AnimationChannel&) = delete;
    AnimationChannel& operator=(const AnimationChannel&) = delete;

    std::shared_ptr<Node> node() const { return node_.lock(); }
    const Keys& keys() const { return keys_; }
    /// For unpickling: a channel is made before its node.
    void restore_node(const std::shared_ptr<Node>& node) { node_ = node; }

private:
    std::weak_ptr<Node> node_;
    const Keys keys_;
};

using AnimationChannels = std::vector<std::shared_ptr<AnimationChannel>>;

/// Channels that share their time. An animation does not change once it is made.
class Animation {
public:
    /// @throws std::invalid_argument for null, or two channels of one path of one node.
    explicit Animation(AnimationChannels channels, std::string name = {});
    Animation(const Animation&) = delete;
    Animation& operator=(const Animation&) = delete;

    const AnimationChannels& channels() const { return channels_; }
    const std::string& name() const { return name_; }
    double duration() const { return duration_; }  ///< the time of the last key, at least 0

private:
    const AnimationChannels channels_;
    const std::string name_;
    double duration_ = 0.0;
};

}  // namespace cubecam
