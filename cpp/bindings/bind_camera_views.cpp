// What cubecam's cameras see: look_at, fit, and the matrices of computer vision.
#include "bounds.hpp"
#include "docs/camera_views.hpp"
#include "look_target.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/geometry/mesh_bounds.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/camera_fit.hpp"
#include "cubecam/scene/intrinsics.hpp"
#include "cubecam/scene/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace cubecam::bindings {

namespace {

/// Width and height of a picture, from 1.
std::pair<int, int> to_picture_size(py::handle value) {
    const auto [width, height] = to_size(value);
    if (width < 1 || height < 1) {
        throw py::value_error("size: expected a width and a height of at least 1, got " +
                              text_of(value));
    }
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    return {static_cast<int>(std::min(width, most)), static_cast<int>(std::min(height, most))};
}

Bounds bounds_of(py::handle what) {
    if (py::isinstance<Scene>(what)) return what.cast<const Scene&>().bounds();
    if (py::isinstance<Node>(what)) return what.cast<const Node&>().world_bounds();
    if (what.is_none() || py::isinstance<py::str>(what)) {
        refuse(what, "what", "a Scene, a Node or bounds (2, 3)");
    }
    const Bounds bounds = to_bounds(what, "what");
    if (is_empty(bounds) && bounds != no_bounds()) {
        throw py::value_error("what: expected the lowest corner, then the highest, got " +
                              text_of(what));
    }
    return bounds;
}

double to_aspect(py::handle size, const std::optional<double>& aspect) {
    if (size.is_none()) return aspect.value_or(1.0);
    if (aspect) throw py::value_error("aspect: expected either size or aspect, got both");
    const auto [width, height] = to_picture_size(size);
    return static_cast<double>(width) / height;
}

template <class Lens>
void bind_views(Class<CameraOf<Lens>, Camera> made) {
    made.def(
        "look_at",
        [](CameraOf<Lens>& self, const LookTarget& target, const OrNone<ArrayLike>& up) {
            std::optional<glm::dvec3> given;
            if (!up.is_none()) given = to_point(up, "up");
            self.look_at(to_look_target(target), given);
        },
        py::arg("target"), py::kw_only(), py::arg("up") = py::none(), docs::camera_look_at);
    made.def(
        "fit",
        [](CameraOf<Lens>& self, const OneOf<Scene, Node, ArrayLike>& what,
           const OrNone<py::typing::Tuple<py::int_, py::int_>>& size,
           Argument<std::optional<double>> aspect, Real margin) {
            const double shape = to_aspect(size, aspect);
            const Bounds bounds = bounds_of(what);
            self.edit_in_world([&](Placed<Lens>& placed) { fit(placed, bounds, shape, margin); });
        },
        py::arg("what"), py::kw_only(), py::arg("size") = py::none(),
        py::arg("aspect") = py::none(), py::arg("margin") = 0.05, docs::fit);
}

py::array_t<double> matrix3_array(const glm::dmat3& matrix) {
    py::array_t<double> array({3, 3});
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            array.mutable_at(row, column) = matrix[column][row];
    }
    return array;
}

glm::dmat3 to_mat3(py::handle value, const char* name) {
    const auto array = double_array(value, name, "(3, 3)");
    glm::dmat3 matrix;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) matrix[column][row] = array.at(row, column);
    }
    return matrix;
}

std::shared_ptr<PerspectiveCamera>
from_intrinsics(const ArrayLike& intrinsics, const SizeLike& size,
                const OrNone<ArrayLike>& world_to_camera_cv, const OrNone<ArrayLike>& position,
                const OrNone<ArrayLike>& target, const OrNone<ArrayLike>& up, Real near, Real far) {
    const auto [width, height] = to_picture_size(size);
    PerspectiveLens lens = lens_of(to_mat3(intrinsics, "K"), width, height);
    lens.near = near;
    lens.far = far;
    Placement placement;
    if (!world_to_camera_cv.is_none()) {
        if (!position.is_none() || !target.is_none() || !up.is_none()) {
            throw py::value_error(
                "world_to_camera_cv: expected either a matrix or position, target and up, got "
                "both");
        }
        placement =
            placement_of(other_camera_axes(to_mat4(world_to_camera_cv, "world_to_camera_cv")));
    }
    if (!position.is_none()) placement.position = to_point(position, "position");
    if (!target.is_none()) placement.target = to_point(target, "target");
    if (!up.is_none()) placement.up = to_point(up, "up");
    return std::make_shared<PerspectiveCamera>(lens, placement);
}

}  // namespace

}  // namespace cubecam::bindings

void bind_camera_views(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto camera = declared<Camera>();
    camera.def_property_readonly(
        "world_to_camera_gl",
        [](const Camera& self) { return matrix_array(self.matrices(1.0).view); },
        "ndarray (4, 4) float64: world to camera in OpenGL's axes (x to the right, y up, z "
        "backwards), read-only; the same as `view`.");
    camera.def_property_readonly(
        "world_to_camera_cv",
        [](const Camera& self) { return matrix_array(other_camera_axes(self.matrices(1.0).view)); },
        "ndarray (4, 4) float64: world to camera in OpenCV's axes (x to the right, y down, z "
        "forwards), read-only: the extrinsics [R t].");
    camera.def(
        "intrinsics",
        [](const Camera& self, const SizeLike& size) {
            const auto [width, height] = to_picture_size(size);
            return matrix3_array(intrinsics(self.value(), width, height));
        },
        py::arg("size"), docs::intrinsics);
    bind_views(declared<PerspectiveCamera, Camera>());
    bind_views(declared<OrthographicCamera, Camera>());
    auto perspective = declared<PerspectiveCamera, Camera>();
    perspective.def_static("from_intrinsics", &from_intrinsics, py::arg("K"), py::arg("size"),
                           py::kw_only(), py::arg("world_to_camera_cv") = py::none(),
                           py::arg("position") = py::none(), py::arg("target") = py::none(),
                           py::arg("up") = py::none(), py::arg("near") = PerspectiveLens{}.near,
                           py::arg("far") = PerspectiveLens{}.far, docs::from_intrinsics);
}
