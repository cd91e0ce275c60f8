#include "cubecam/scene/skin.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/node.hpp"

#include <cstddef>
#include <string>
#include <utility>

namespace cubecam {

Skin::Skin(WeakNodes joints, std::vector<glm::dmat4> inverse_bind,
           const std::shared_ptr<Node>& skeleton)
    : joints_(std::move(joints)), inverse_bind_(std::move(inverse_bind)), skeleton_(skeleton) {
    expect(!joints_.empty(), "at least one joint", "none");
    if (inverse_bind_.empty()) inverse_bind_.assign(joints_.size(), glm::dmat4(1.0));
    expect(inverse_bind_.size() == joints_.size(),
           "as many inverse_bind_matrices as joints, " + std::to_string(joints_.size()),
           std::to_string(inverse_bind_.size()));
    for (std::size_t i = 0; i < inverse_bind_.size(); ++i) {
        const glm::dmat4& matrix = inverse_bind_[i];
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                expect_finite(matrix[column][row], "inverse_bind_matrices");
            }
        }
        const glm::dvec4 last(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
        if (last == glm::dvec4(0.0, 0.0, 0.0, 1.0)) continue;
        expect(false, "inverse_bind_matrices with (0, 0, 0, 1) as their last rows",
               describe(glm::vec4(last)) + " for joint " + std::to_string(i));
    }
}

}  // namespace cubecam
