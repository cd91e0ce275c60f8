#include "cubecam/scene/parallax.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/math/transform.hpp"
#include "cubecam/scene/box.hpp"

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <string>

namespace cubecam {

glm::dmat4 ParallaxValue::to_proxy() const {
    const glm::dvec3 half = (box->high - box->low) * 0.5;
    const glm::dmat4 of_box = glm::scale(glm::translate(glm::dmat4(1.0), box->center()), half);
    return glm::inverse(proxy_matrix.value_or(glm::dmat4(1.0)) * of_box);
}

void check(const ParallaxValue& value) {
    if (value.by_proxy()) {
        expect(value.box.has_value(),
               "box=(low, high), the corners of the proxy, with parallax='" +
                   std::string(to_string(value.method)) + "'",
               "None");
    }
    if (value.box) expect_box(*value.box, "box");
    if (value.proxy_matrix) {
        const glm::dmat4& matrix = *value.proxy_matrix;
        expect(is_finite(matrix), "a proxy_matrix of finite numbers", "one with others");
        const glm::dvec4 last = glm::row(matrix, 3);
        expect(last == glm::dvec4(0.0, 0.0, 0.0, 1.0),
               "a proxy_matrix whose last row is (0, 0, 0, 1)",
               "(" + describe(last.x) + ", " + describe(last.y) + ", " + describe(last.z) + ", " +
                   describe(last.w) + ")");
        expect(!is_singular(glm::dmat3(matrix)), "a proxy_matrix that can be inverted",
               "a singular one");
    }
    const bool known = std::find(parallax_fetches.begin(), parallax_fetches.end(), value.fetches) !=
                       parallax_fetches.end();
    expect(known, "fetches of 6, 14 or 35", std::to_string(value.fetches));
}

}  // namespace cubecam
