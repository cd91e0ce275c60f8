#include "cubecam/scene/influence.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/box.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace cubecam {

void check(const InfluenceValue& value) {
    if (value.box) expect_box(*value.box, "influence");
    expect_positive(value.blend_distance, "blend_distance");
}

Influence make_influence(const InfluenceValue& value, const std::optional<glm::dmat4>& matrix) {
    Influence made;
    made.blend_distance = value.blend_distance;
    made.everywhere = !value.box.has_value();
    if (made.everywhere) return made;
    made.sphere = value.shape == InfluenceShape::sphere;
    const glm::dmat4 to_world = matrix.value_or(glm::dmat4(1.0));
    const glm::dvec3 half = (value.box->high - value.box->low) * 0.5;
    made.from_box =
        to_world * glm::scale(glm::translate(glm::dmat4(1.0), value.box->center()), half);
    made.to_box = glm::inverse(made.from_box);
    made.reach = transformed(*value.box, to_world);
    made.reach.low -= value.blend_distance;
    made.reach.high += value.blend_distance;
    return made;
}

bool Influence::reaches(const Bounds& bounds) const {
    return everywhere || (glm::all(glm::lessThan(bounds.low, reach.high)) &&
                          glm::all(glm::greaterThan(bounds.high, reach.low)));
}

bool Influence::contains(const Bounds& bounds) const {
    if (everywhere) return true;
    // The shape is convex, so the corners decide.
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                               (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                               (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
        const glm::dvec3 at(to_box * glm::dvec4(place, 1.0));
        const bool inside = sphere ? glm::dot(at, at) <= 1.0
                                   : glm::all(glm::lessThanEqual(glm::abs(at), glm::dvec3(1.0)));
        if (!inside) return false;  // also for bounds that are infinite
    }
    return true;
}

bool Influence::operator==(const Influence& other) const {
    return everywhere == other.everywhere && sphere == other.sphere && to_box == other.to_box &&
           blend_distance == other.blend_distance;
}

}  // namespace cubecam
