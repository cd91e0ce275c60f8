#include "cubecam/scene/intrinsics.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/math/transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace cubecam {

glm::dmat3 intrinsics(const CameraValue& camera, int width, int height) {
    const double w = width;
    const double h = height;
    const glm::dmat4 p = matrices(camera, w / h).projection;
    const glm::dvec4 last(p[0][3], p[1][3], p[2][3], p[3][3]);
    if (is_parallel(p)) expect(false, "a camera with a vanishing point", "one of parallel rays");
    if (last != glm::dvec4(0.0, 0.0, -1.0, 0.0) || p[3][0] != 0.0 || p[3][1] != 0.0) {
        expect(false, "a projection with (0, 0, -1, 0) as its last row and no translation in x, y",
               "the last row " + describe(glm::vec4(last)));
    }
    // u = w/2 (1 + x_clip / w_clip), v = h/2 (1 - y_clip / w_clip), with y and z of OpenCV's axes.
    glm::dmat3 k(1.0);
    k[0] = {0.5 * w * p[0][0], -0.5 * h * p[0][1], 0.0};
    k[1] = {-0.5 * w * p[1][0], 0.5 * h * p[1][1], 0.0};
    k[2] = {0.5 * w * (1.0 - p[2][0]), 0.5 * h * (1.0 + p[2][1]), 1.0};
    // The other entries of most projections are 0, and -0 would be a surprise.
    for (int i = 0; i < 3; ++i) k[i] += 0.0;
    return k;
}

PerspectiveLens lens_of(const glm::dmat3& K, int width, int height) {
    const glm::dvec3 last(K[0][2], K[1][2], K[2][2]);
    if (last != glm::dvec3(0.0, 0.0, 1.0)) {
        expect(false, "K with (0, 0, 1) as its last row", describe(last));
    }
    const double fx = K[0][0];
    const double fy = K[1][1];
    if (K[1][0] != 0.0 || K[0][1] != 0.0) {
        expect(false, "K without skew (for one with skew use Camera(view, projection))",
               "K[0, 1] = " + describe(K[1][0]) + ", K[1, 0] = " + describe(K[0][1]));
    }
    if (!(fx > 0.0 && fy > 0.0)) {
        expect(false, "focal lengths K[0, 0] and K[1, 1] above 0",
               describe(fx) + " and " + describe(fy));
    }
    const double h = height;
    PerspectiveLens lens;
    lens.pixel_aspect = fy / fx;
    lens.fov = 2.0 * std::atan(0.5 * h / fy) * 180.0 / std::numbers::pi;
    lens.shift = {(0.5 * width - K[2][0]) / h * lens.pixel_aspect, (K[2][1] - 0.5 * h) / h};
    return lens;
}

glm::dmat4 other_camera_axes(const glm::dmat4& view) {
    glm::dmat4 turned = view;
    for (int column = 0; column < 4; ++column) {
        // 0 - x and not -x, so that no 0 becomes -0.
        turned[column][1] = 0.0 - view[column][1];
        turned[column][2] = 0.0 - view[column][2];
    }
    return turned;
}

Placement placement_of(const glm::dmat4& view) {
    const glm::dmat3 turn(view);
    const glm::dmat3 product = turn * glm::transpose(turn);
    double error = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            error = std::max(error, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
    }
    const glm::dvec4 last(view[0][3], view[1][3], view[2][3], view[3][3]);
    // The tolerance also suits matrices that were computed in float32.
    if (!(error < 1e-4) || !(glm::determinant(turn) > 0.0) ||
        last != glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
        expect(false, "a world-to-camera matrix that is a rotation and a translation",
               "one with a scale, a shear, a mirror, or another last row than (0, 0, 0, 1)");
    }
    const glm::dmat3 axes = glm::transpose(turn);  // right, up and back in the world
    Placement placement;
    placement.position = -(glm::inverse(turn) * glm::dvec3(view[3]));
    placement.target = placement.position - axes[2];
    placement.up = axes[1];
    return placement;
}

}  // namespace cubecam
