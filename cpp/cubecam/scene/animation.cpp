#include "cubecam/scene/animation.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/node.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

namespace cubecam {

namespace {

std::size_t rows_of_key(const Keys& keys) {
    return keys.interpolation == Interpolation::cubic ? 3 : 1;
}

/// The place of row `part` of a key: of a cubic one 0 is the in-tangent, 1 the value, 2 the
/// out-tangent.
std::size_t start_of(const Keys& keys, std::size_t key, std::size_t part) {
    return (rows_of_key(keys) * key + part) * keys.width;
}

/// The value of a key.
std::span<const double> value_of(const Keys& keys, std::size_t key) {
    const std::size_t part = keys.interpolation == Interpolation::cubic ? 1 : 0;
    return std::span(keys.values).subspan(start_of(keys, key, part), keys.width);
}

double length_of(std::span<const double> row) {
    double sum = 0.0;
    for (const double number : row) sum += number * number;
    return std::sqrt(sum);
}

/// Returns whether the row had a length.
bool normalise(std::span<double> row) {
    const double length = length_of(row);
    if (!(length > 0.0)) return false;
    for (double& number : row) number /= length;
    return true;
}

void copy_key(const Keys& keys, std::size_t key, std::span<double> to) {
    std::ranges::copy(value_of(keys, key), to.begin());
    if (keys.path == AnimationPath::rotation) normalise(to);
}

/// Spherical interpolation along the shorter way.
void slerp(const Keys& keys, std::size_t key, double share, std::span<double> to) {
    std::array<double, 4> next;
    copy_key(keys, key, to);
    copy_key(keys, key + 1, next);
    double cosine = 0.0;
    for (std::size_t i = 0; i < 4; ++i) cosine += to[i] * next[i];
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    const double angle = std::acos(std::min(std::abs(cosine), 1.0));
    const double sine = std::sin(angle);
    // For small angles both shares tend to those of a straight line.
    const bool straight = sine < 1e-9;
    const double first = straight ? 1.0 - share : std::sin(angle * (1.0 - share)) / sine;
    const double second = sign * (straight ? share : std::sin(angle * share) / sine);
    for (std::size_t i = 0; i < 4; ++i) to[i] = first * to[i] + second * next[i];
    normalise(to);
}

void between_linear(const Keys& keys, std::size_t key, double share, std::span<double> to) {
    if (keys.path == AnimationPath::rotation) return slerp(keys, key, share, to);
    const auto from = value_of(keys, key);
    const auto next = value_of(keys, key + 1);
    for (std::size_t i = 0; i < keys.width; ++i) to[i] = (1.0 - share) * from[i] + share * next[i];
}

void between_cubic(const Keys& keys, std::size_t key, double share, std::span<double> to) {
    const double distance = keys.times[key + 1] - keys.times[key];
    const double square = share * share;
    const double cube = square * share;
    const auto from = value_of(keys, key);
    const auto next = value_of(keys, key + 1);
    const double* leaving = keys.values.data() + start_of(keys, key, 2);
    const double* arriving = keys.values.data() + start_of(keys, key + 1, 0);
    for (std::size_t i = 0; i < keys.width; ++i) {
        to[i] = (2.0 * cube - 3.0 * square + 1.0) * from[i] +
                distance * (cube - 2.0 * square + share) * leaving[i] +
                (3.0 * square - 2.0 * cube) * next[i] + distance * (cube - square) * arriving[i];
    }
    // A spline may pass through 0, where there is no rotation.
    if (keys.path == AnimationPath::rotation && !normalise(to)) copy_key(keys, key, to);
}

void check_times(const std::vector<double>& times) {
    expect(!times.empty(), "times of at least 1 key", "none");
    for (std::size_t i = 0; i < times.size(); ++i) {
        expect_finite(times[i], "times");
        if (i > 0 && !(times[i - 1] < times[i])) {
            expect(false, "times that increase strictly",
                   describe(times[i - 1]) + ", then " + describe(times[i]));
        }
    }
}

}  // namespace

void check(const Keys& keys) {
    check_times(keys.times);
    const bool weights = keys.path == AnimationPath::weights;
    const std::size_t wanted = keys.path == AnimationPath::rotation ? 4 : 3;
    const std::string path(animation_path_names[static_cast<std::size_t>(keys.path)].first);
    if (weights ? keys.width < 1 : keys.width != wanted) {
        expect(false,
               "values of " +
                   (weights ? "at least 1 number" : std::to_string(wanted) + " numbers") +
                   " a row for \"" + path + "\"",
               std::to_string(keys.width));
    }
    const std::size_t rows = rows_of_key(keys) * keys.times.size();
    if (keys.values.size() != rows * keys.width) {
        expect(
            false,
            "values of " + std::to_string(rows) + " rows for " + std::to_string(keys.times.size()) +
                " times" +
                (rows_of_key(keys) == 3 ? " (in-tangent, value and out-tangent of each key)" : ""),
            std::to_string(keys.values.size() / keys.width));
    }
    for (const double number : keys.values) expect_finite(number, "values");
    if (keys.path != AnimationPath::rotation) return;
    for (std::size_t key = 0; key < keys.times.size(); ++key) {
        if (!(length_of(value_of(keys, key)) > 0.0)) {
            expect(false, "rotations (w, x, y, z) of some length",
                   "length 0 at key " + std::to_string(key));
        }
    }
}

void sample(const Keys& keys, double seconds, std::span<double> to) {
    const auto& times = keys.times;
    const auto after = std::ranges::upper_bound(times, seconds);
    if (after == times.begin()) return copy_key(keys, 0, to);
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end() || keys.interpolation == Interpolation::step) {
        return copy_key(keys, key, to);
    }
    const double share = (seconds - times[key]) / (times[key + 1] - times[key]);
    if (keys.interpolation == Interpolation::linear) return between_linear(keys, key, share, to);
    between_cubic(keys, key, share, to);
}

AnimationChannel::AnimationChannel(const std::shared_ptr<Node>& node, Keys keys)
    : node_(node), keys_((check(keys), std::move(keys))) {}

Animation::Animation(AnimationChannels channels, std::string name)
    : channels_(std::move(channels)), name_(std::move(name)) {
    std::set<std::pair<const Node*, AnimationPath>> known;
    for (const auto& channel : channels_) {
        if (!channel) throw std::invalid_argument("expected a channel, got none");
        const Keys& keys = channel->keys();
        duration_ = std::max(duration_, keys.times.back());
        const auto node = channel->node();
        if (!node || known.emplace(node.get(), keys.path).second) continue;
        const auto path = animation_path_names[static_cast<std::size_t>(keys.path)].first;
        expect(false, "one channel for each node and path",
               "two of \"" + std::string(path) + "\" for node " + std::to_string(node->id()));
    }
}

}  // namespace cubecam
