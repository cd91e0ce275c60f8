// cubecam.StereoCamera
#include "choice.hpp"
#include "docs/stereo.hpp"
#include "objects.hpp"
#include "values.hpp"

#include "cubecam/scene/stereo_camera.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace cubecam::bindings {

namespace {

using StereoName = Choice<stereo_layout_names>;

std::shared_ptr<Camera> to_eye(py::handle value, const char* name) {
    return to_shared<Camera>(value, name, "a Camera");
}

std::shared_ptr<Camera> camera_of(const CameraValue& value) {
    if (const auto* given = std::get_if<Matrices>(&value)) return std::make_shared<Camera>(*given);
    if (const auto* placed = std::get_if<Placed<PerspectiveLens>>(&value)) {
        return std::make_shared<PerspectiveCamera>(placed->lens, placed->placement);
    }
    const auto& placed = std::get<Placed<OrthographicLens>>(value);
    return std::make_shared<OrthographicCamera>(placed.lens, placed.placement);
}

std::shared_ptr<StereoCamera> stereo_of(const Eyes& eyes, const StereoName& layout) {
    return std::make_shared<StereoCamera>(camera_of(eyes.left), camera_of(eyes.right),
                                          parse_stereo_layout(layout));
}

}  // namespace

}  // namespace cubecam::bindings

void bind_stereo(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;
    using Eye = OneOf<Camera>;

    auto stereo = declare<StereoCamera>(module, "StereoCamera", docs::stereo);
    stereo
        .def(py::init([](const Eye& left, const Eye& right, const StereoName& layout) {
                 return std::make_shared<StereoCamera>(to_eye(left, "left"), to_eye(right, "right"),
                                                       parse_stereo_layout(layout));
             }),
             py::arg("left"), py::arg("right"), py::kw_only(), py::arg("layout") = "anaglyph")
        .def_static(
            "off_axis",
            [](const Eye& camera, Real separation, Argument<std::optional<double>> convergence,
               const StereoName& layout) {
                return stereo_of(
                    off_axis_eyes(to_eye(camera, "camera")->value(), separation, convergence),
                    layout);
            },
            py::arg("camera"), py::kw_only(), py::arg("separation") = 0.065,
            py::arg("convergence") = py::none(), py::arg("layout") = "anaglyph", docs::off_axis)
        .def_static(
            "toe_in",
            [](const Eye& camera, Real degrees, const StereoName& layout) {
                return stereo_of(toe_in_eyes(to_eye(camera, "camera")->value(), degrees), layout);
            },
            py::arg("camera"), py::kw_only(), py::arg("degrees") = 4.0,
            py::arg("layout") = "anaglyph", docs::toe_in)
        .def_property(
            "left", &StereoCamera::left,
            [](StereoCamera& self, const Eye& value) { self.set_left(to_eye(value, "left")); },
            "Camera: the camera of the left eye.")
        .def_property(
            "right", &StereoCamera::right,
            [](StereoCamera& self, const Eye& value) { self.set_right(to_eye(value, "right")); },
            "Camera: the camera of the right eye.")
        .def_property(
            "layout",
            [](const StereoCamera& self) -> StereoName { return to_string(self.layout()); },
            [](StereoCamera& self, const StereoName& value) {
                self.set_layout(parse_stereo_layout(value));
            },
            "str: \"anaglyph\", \"side_by_side\" or \"top_bottom\".")
        .def("__repr__",
             [](const StereoCamera& self) {
                 return "StereoCamera(" + py::repr(py::cast(self.left())).cast<std::string>() +
                        ", " + py::repr(py::cast(self.right())).cast<std::string>() + ", layout='" +
                        std::string(to_string(self.layout())) + "')";
             })
        .def("__reduce__", [](const py::object& self) {
            return reduced(self, attributes_of(self, "left", "right", "layout"));
        });
}
