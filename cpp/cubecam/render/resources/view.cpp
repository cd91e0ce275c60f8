#include "cubecam/render/resources/view.hpp"

#include "cubecam/math/cube_face.hpp"
#include "cubecam/math/transform.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace cubecam {
namespace {

View make_view(const Matrices& matrices) {
    const glm::dmat4 world = glm::inverse(matrices.view);
    View view;
    view.view = matrices.view;
    view.projection = matrices.projection;
    view.view_projection = matrices.projection * matrices.view;
    view.position = glm::dvec3(world[3]);
    view.eye = view.position;
    view.forward = -glm::normalize(glm::dvec3(world[2]));
    view.parallel = is_parallel(matrices.projection);
    if (view.parallel) {
        // On the near plane clip z is -w: p22 z + p32 = -p33; the camera looks along -z.
        const glm::dmat4& p = matrices.projection;
        view.near = (p[3][3] + p[3][2]) / p[2][2];
    }
    return view;
}

}  // namespace

View camera_view(const Matrices& matrices) { return make_view(matrices); }

bool sees_front(const View& view, const Plane& plane) {
    return view.parallel ? glm::dot(view.forward, plane.normal) < 0.0
                         : plane.height(view.eye) > 0.0;
}

View mirrored(const View& view, const Plane& mirror) {
    const glm::dmat4 mirror_matrix = reflection(mirror);
    View made = view;
    if (!view.parallel && view.eye != view.position) {
        made.view = glm::translate(view.view, view.position - view.eye);
    }
    made.view = made.view * mirror_matrix;
    made.view_projection = view.projection * made.view;
    const glm::dvec3 from = view.parallel ? view.position : view.eye;
    made.position = from - 2.0 * mirror.height(from) * mirror.normal;
    made.eye = made.position;
    made.forward = glm::dmat3(mirror_matrix) * view.forward;
    made.clip = mirror;
    if (!sees_front(view, mirror)) made.clip->normal = -mirror.normal;
    return made;
}

std::vector<View> cube_views(glm::dvec3 position, double near, double far,
                             std::optional<glm::dvec3> eye, const glm::dquat& rotation) {
    // The identity multiplies by ones and zeros alone, so that its views are the same bit for bit.
    const auto turn = glm::mat3_cast(rotation);
    std::vector<View> views;
    views.reserve(face_count);
    for (const Face face : all_faces) {
        View view = make_view({look_along(position, turn * glm::dvec3(face_forward(face)),
                                          turn * glm::dvec3(face_up(face))),
                               perspective(90.0, 1.0, near, far)});
        view.position = position;  // exactly, not from an inverse matrix
        view.eye = eye.value_or(position);
        views.push_back(view);
    }
    return views;
}

}  // namespace cubecam
