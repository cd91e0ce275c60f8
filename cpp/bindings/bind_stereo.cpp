// cubecam.StereoCamera
#include "objects.hpp"

#include "cubecam/scene/stereo_camera.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace cubecam::bindings {

namespace {

constexpr const char* stereo_doc =
    R"doc(Two eyes, whose pictures are drawn in one call and combined.

``renderer.render(scene, stereo_camera, size)`` gives one Frame of that size. Each eye's picture is, bit
for bit, the one that its camera gives alone, with the aspect of its part; tone mapping and encoding come
before they are combined. Only the eyes whose picture changed are drawn again.

Parameters
----------
left, right : Camera
    Any two; changed at any time, they show it in the next picture.
layout : {"anaglyph", "side_by_side", "top_bottom"}
    "anaglyph", for red-cyan glasses: red from the left eye, green and blue from the right, alpha the
    greater; there are no outputs. "side_by_side": the left eye in the left half, of an even width;
    "top_bottom": the left eye in the upper half, of an even height; outputs are combined alike.

Raises
------
TypeError
    For what is no Camera.
ValueError
    For another layout.

Examples
--------
>>> import cubecam as cc
>>> camera = cc.PerspectiveCamera(fov=60, position=(0, 1, 5), target=(0, 0, 0))
>>> eyes = cc.StereoCamera.off_axis(camera, separation=.1, convergence=5, layout="side_by_side")
>>> eyes.left.position.round(9).tolist(), eyes.right.position.round(9).tolist()
([-0.05, 1.0, 5.0], [0.05, 1.0, 5.0])
>>> with cc.Renderer() as renderer:
...     frame = renderer.render(cc.Scene(background=(1, 1, 1)), eyes, size=(8, 4))
>>> frame.size
(8, 4)
)doc";

constexpr const char* off_axis_doc = R"doc(Eyes beside a camera, with parallel axes.

They stand half of `separation` to the left and right of it, along its own right axis, and look the same
way. Without `convergence` what is infinitely far has no parallax, and all else stands before the screen.

Parameters
----------
camera : Camera
    The middle of the two; it is copied.
separation : float
    Distance of the eyes, world units, not negative. 0.065 is a person's, in metres.
convergence : float, optional
    Distance along the camera's axis, world units, at which points have the same place in both pictures:
    farther ones lie behind the screen, nearer ones before it. The frusta are sheared for that, and not
    turned, so that no vertical parallax arises. Not for cameras of parallel rays.
layout : {"anaglyph", "side_by_side", "top_bottom"}
    See the class.

Returns
-------
StereoCamera

Raises
------
ValueError
    For a number out of its range or not finite, or a convergence of parallel rays.

Notes
-----
P. Bourke, "Calculating Stereo Pairs", 1999. At depth z a point's places differ by
``separation * (1 / convergence - 1 / z) * f / 2`` widths of the picture to the right for the right eye, f
being ``camera.projection(aspect)[0, 0]``.
)doc";

constexpr const char* toe_in_doc =
    R"doc(Eyes on a circle round a camera's target, both looking at it.

The view is turned by half of `degrees` to the left and to the right, about the axis through the target
that is up in the camera's picture. Simple, and with vertical parallax towards the corners; `off_axis` has
none.

Parameters
----------
camera : PerspectiveCamera or OrthographicCamera
    The middle of the two, with a target; it is copied.
degrees : float
    Angle between the two eyes as seen from the target: from 0 to below 180.
layout : {"anaglyph", "side_by_side", "top_bottom"}
    See the class.

Returns
-------
StereoCamera

Raises
------
ValueError
    For a camera without a target, or an angle out of its range.

Examples
--------
>>> import cubecam as cc
>>> camera = cc.PerspectiveCamera(position=(0, 0, 2), target=(0, 0, 0))
>>> cc.StereoCamera.toe_in(camera, degrees=90).right.position.round(3).tolist()
[1.414, 0.0, 1.414]
)doc";

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

std::shared_ptr<StereoCamera> stereo_of(const Eyes& eyes, const std::string& layout) {
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

    auto stereo = declare<StereoCamera>(module, "StereoCamera", stereo_doc);
    stereo
        .def(py::init([](const Eye& left, const Eye& right, const std::string& layout) {
                 return std::make_shared<StereoCamera>(to_eye(left, "left"), to_eye(right, "right"),
                                                       parse_stereo_layout(layout));
             }),
             py::arg("left"), py::arg("right"), py::kw_only(), py::arg("layout") = "anaglyph")
        .def_static(
            "off_axis",
            [](const Eye& camera, double separation, std::optional<double> convergence,
               const std::string& layout) {
                return stereo_of(
                    off_axis_eyes(to_eye(camera, "camera")->value(), separation, convergence),
                    layout);
            },
            py::arg("camera"), py::kw_only(), py::arg("separation") = 0.065,
            py::arg("convergence") = py::none(), py::arg("layout") = "anaglyph", off_axis_doc)
        .def_static(
            "toe_in",
            [](const Eye& camera, double degrees, const std::string& layout) {
                return stereo_of(toe_in_eyes(to_eye(camera, "camera")->value(), degrees), layout);
            },
            py::arg("camera"), py::kw_only(), py::arg("degrees") = 4.0,
            py::arg("layout") = "anaglyph", toe_in_doc)
        .def_property(
            "left", &StereoCamera::left,
            [](StereoCamera& self, const Eye& value) { self.set_left(to_eye(value, "left")); },
            "Camera: of the left eye.")
        .def_property(
            "right", &StereoCamera::right,
            [](StereoCamera& self, const Eye& value) { self.set_right(to_eye(value, "right")); },
            "Camera: of the right eye.")
        .def_property(
            "layout",
            [](const StereoCamera& self) { return std::string(to_string(self.layout())); },
            [](StereoCamera& self, const std::string& value) {
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
