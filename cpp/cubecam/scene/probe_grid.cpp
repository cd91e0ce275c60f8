#include "cubecam/scene/probe_grid.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/box.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace cubecam {
namespace {

constexpr std::size_t light_numbers = 27;

template <class Number>
bool same_numbers(const SharedNumbers<Number>& a, const SharedNumbers<Number>& b) {
    return a == b || *a == *b;
}

template <class Number>
void check_length(const SharedNumbers<Number>& numbers, std::size_t count, const char* name) {
    expect(numbers->size() == count,
           std::string(name) + " of " + std::to_string(count) + " numbers",
           std::to_string(numbers->size()));
}

void check_finite(const SharedNumbers<float>& numbers, const char* name) {
    const bool finite = std::all_of(numbers->begin(), numbers->end(),
                                    [](float number) { return std::isfinite(number); });
    expect(finite, std::string(name) + " of finite numbers", "others among them");
}

std::string counts_text(const glm::ivec3& counts) {
    return "(" + std::to_string(counts.x) + ", " + std::to_string(counts.y) + ", " +
           std::to_string(counts.z) + ")";
}

void check_shape(const ProbeGridValue& value) {
    expect_box(value.box, "box");
    expect(glm::all(glm::greaterThanEqual(value.counts, glm::ivec3(2))),
           "counts=(nx, ny, nz) of at least 2", counts_text(value.counts));
    expect(value.resolution >= 4 && value.resolution <= 32, "resolution from 4 to 32",
           std::to_string(value.resolution));
    const auto edge = static_cast<std::int64_t>(value.resolution) + 2;
    const std::int64_t width = value.counts.x * edge;
    const std::int64_t height = std::int64_t{value.counts.y} * value.counts.z * edge;
    expect(width <= most_grid_texels && height <= most_grid_texels &&
               std::int64_t{value.counts.x} * 9 <= most_grid_texels,
           "counts with nx and ny * nz of at most " + std::to_string(most_grid_texels / edge) +
               " at this resolution",
           counts_text(value.counts));
}

}  // namespace

std::size_t ProbeGridValue::node_count() const {
    return static_cast<std::size_t>(counts.x) * static_cast<std::size_t>(counts.y) *
           static_cast<std::size_t>(counts.z);
}

glm::dvec3 ProbeGridValue::step() const { return (box.high - box.low) / glm::dvec3(counts - 1); }

double ProbeGridValue::least_step() const {
    const glm::dvec3 each = step();
    return std::min({each.x, each.y, each.z});
}

bool ProbeGridValue::operator==(const ProbeGridValue& other) const {
    return box == other.box && counts == other.counts && resolution == other.resolution &&
           size == other.size && visibility == other.visibility &&
           normal_bias == other.normal_bias && view_bias == other.view_bias &&
           same_numbers(coefficients, other.coefficients) &&
           same_numbers(distances, other.distances) && same_numbers(active, other.active);
}

void check(const ProbeGridValue& value) {
    check_shape(value);
    expect(value.size >= 1 && value.size <= 128, "size from 1 to 128", std::to_string(value.size));
    const std::size_t nodes = value.node_count();
    const auto texels = static_cast<std::size_t>(value.resolution * value.resolution);
    check_length(value.coefficients, nodes * light_numbers, "coefficients");
    check_length(value.distances, nodes * texels * 2, "distances");
    check_length(value.active, nodes, "active");
    check_finite(value.coefficients, "coefficients");
    check_finite(value.distances, "distances");
    expect_not_negative(value.normal_bias, "normal_bias");
    expect_not_negative(value.view_bias, "view_bias");
}

ProbeGridValue empty_grid(const Bounds& box, const glm::ivec3& counts, int resolution) {
    ProbeGridValue value;
    value.box = box;
    value.counts = counts;
    value.resolution = resolution;
    check_shape(value);
    const std::size_t nodes = value.node_count();
    // As if there were nothing for a million units around.
    std::vector<float> far(nodes * static_cast<std::size_t>(resolution * resolution) * 2, 1e6F);
    for (std::size_t i = 1; i < far.size(); i += 2) far[i] = 1e12F;
    value.coefficients = std::make_shared<const std::vector<float>>(nodes * light_numbers, 0.0F);
    value.distances = std::make_shared<const std::vector<float>>(std::move(far));
    value.active = std::make_shared<const std::vector<std::uint8_t>>(nodes, std::uint8_t{1});
    return value;
}

ProbeGrid::ProbeGrid(ProbeGridValue value) : value_((cubecam::check(value), std::move(value))) {}

}  // namespace cubecam
