// cubecam.Camera and the cameras below it.
#include "arguments.hpp"
#include "docs/camera.hpp"
#include "objects.hpp"
#include "parent.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/node.hpp"

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <type_traits>

namespace cubecam::bindings {

namespace {

Placement placement(const ArrayLike& position, const OrNone<ArrayLike>& target, const ArrayLike& up,
                    const OrNone<Node>& parent) {
    Placement made;
    made.parent = to_parent(parent);
    made.position = to_point(position, "position");
    if (!target.is_none()) made.target = to_point(target, "target");
    made.up = to_point(up, "up");
    return made;
}

template <class Lens>
void number(Class<CameraOf<Lens>, Camera>& made, const char* name, double Lens::* field,
            const char* doc) {
    made.def_property(
        name, [field](const CameraOf<Lens>& self) { return self.placed().lens.*field; },
        [field](CameraOf<Lens>& self, Real value) {
            self.edit_placed([&](Placed<Lens>& placed) { placed.lens.*field = value; });
        },
        doc);
}

template <class Lens>
void point(Class<CameraOf<Lens>, Camera>& made, const char* name, glm::dvec3 Placement::* field,
           const char* doc) {
    made.def_property(
        name,
        [field](const CameraOf<Lens>& self) { return point_array(self.placed().placement.*field); },
        [field, name](CameraOf<Lens>& self, const ArrayLike& value) {
            const glm::dvec3 given = to_point(value, name);
            self.edit_placed([&](Placed<Lens>& placed) { placed.placement.*field = given; });
        },
        doc);
}

glm::dvec2 to_shift(const ArrayLike& value) {
    const auto array = double_array(value, "shift", "(2,)");
    return {array.data()[0], array.data()[1]};
}

void bind_shift(Class<PerspectiveCamera, Camera>& made) {
    made.def_property(
        "shift",
        [](const PerspectiveCamera& self) {
            const glm::dvec2 shift = self.placed().lens.shift;
            py::array_t<double> array(2);
            for (int i = 0; i < 2; ++i) array.mutable_data()[i] = shift[i];
            array.attr("flags").attr("writeable") = false;
            return array;
        },
        [](PerspectiveCamera& self, const ArrayLike& value) {
            const glm::dvec2 shift = to_shift(value);
            self.edit_placed([&](Placed<PerspectiveLens>& placed) { placed.lens.shift = shift; });
        },
        "ndarray (2,) float64: how far the middle of the picture lies right of and above the axis, "
        "in "
        "heights of the picture, read-only.");
}

template <class Lens>
void bind_parent(Class<CameraOf<Lens>, Camera>& made) {
    using C = CameraOf<Lens>;
    made.def_property(
        "parent", [](const C& self) { return or_none(self.placed().placement.parent.lock()); },
        [](C& self, const OrNone<Node>& value) {
            const auto parent = to_parent(value);
            self.edit_placed([&](Placed<Lens>& placed) { placed.placement.parent = parent; });
        },
        "Node or None: the node that the camera moves with. Position, target and up stay, and are "
        "in the node's coordinates.");
    made.def_property_readonly(
        "world_position",
        [](const C& self) {
            return point_array(std::get<Placed<Lens>>(self.world_value()).placement.position);
        },
        "ndarray (3,) float64: the position in world space, read-only.");
    made.def(
        "_world_placement",
        [](const C& self) -> py::typing::Tuple<py::array_t<double>, OrNone<py::array_t<double>>,
                                               py::array_t<double>, py::array_t<double>> {
            const Placement p = std::get<Placed<Lens>>(self.world_value()).placement;
            return py::make_tuple(point_array(p.position),
                                  p.target ? py::object(point_array(*p.target)) : py::none(),
                                  point_array(p.up), point_array(forward_of(p)));
        },
        "Position, target, up and the way to the target, in world space.");
    made.def(
        "_place_in_world",
        [](C& self, const ArrayLike& position, const OrNone<ArrayLike>& target) {
            const glm::dvec3 at = to_point(position, "position");
            std::optional<glm::dvec3> to;
            if (!target.is_none()) to = to_point(target, "target");
            self.edit_in_world([&](Placed<Lens>& placed) {
                placed.placement.position = at;
                placed.placement.target = to;
            });
        },
        py::arg("position"), py::arg("target"), "Set position and target, in world space.");
}

/// Defines the class of a camera with a position; `opening` names the first parameter of its lens.
template <class Lens>
void bind_placed(py::module_& module, const char* class_name, const char* class_doc,
                 const char* opening, double Lens::* field, const char* opening_doc) {
    using C = CameraOf<Lens>;
    auto made = declare<C, Camera>(module, class_name, class_doc);
    if constexpr (std::is_same_v<Lens, PerspectiveLens>) {
        made.def(py::init([](Real size, const ArrayLike& position, const OrNone<ArrayLike>& target,
                             const ArrayLike& up, Real near, Real far, const ArrayLike& shift,
                             Real pixel_aspect, const OrNone<Node>& parent) {
                     return std::make_shared<C>(
                         Lens{size, near, far, to_shift(shift), pixel_aspect},
                         placement(position, target, up, parent));
                 }),
                 py::kw_only(), py::arg(opening) = Lens{}.*field,
                 py::arg("position") = py::make_tuple(0, 0, 0), py::arg("target") = py::none(),
                 py::arg("up") = py::make_tuple(0, 1, 0), py::arg("near") = Lens{}.near,
                 py::arg("far") = Lens{}.far, py::arg("shift") = py::make_tuple(0, 0),
                 py::arg("pixel_aspect") = Lens{}.pixel_aspect, py::arg("parent") = py::none());
        bind_shift(made);
        number<Lens>(made, "pixel_aspect", &Lens::pixel_aspect,
                     "float: the width of a pixel over its height; 1 for pixels of every screen.");
    } else {
        made.def(py::init([](Real size, const ArrayLike& position, const OrNone<ArrayLike>& target,
                             const ArrayLike& up, Real near, Real far, const OrNone<Node>& parent) {
                     return std::make_shared<C>(Lens{size, near, far},
                                                placement(position, target, up, parent));
                 }),
                 py::kw_only(), py::arg(opening) = Lens{}.*field,
                 py::arg("position") = py::make_tuple(0, 0, 0), py::arg("target") = py::none(),
                 py::arg("up") = py::make_tuple(0, 1, 0), py::arg("near") = Lens{}.near,
                 py::arg("far") = Lens{}.far, py::arg("parent") = py::none());
    }
    number<Lens>(made, opening, field, opening_doc);
    number<Lens>(made, "near", &Lens::near, "float: the nearest depth that is drawn, world units.");
    number<Lens>(made, "far", &Lens::far, "float: the farthest depth that is drawn, world units.");
    point<Lens>(
        made, "position", &Placement::position,
        "ndarray (3,) float64: world space, or the parent's coordinates; read-only. Setting the "
        "position keeps the target.");
    point<Lens>(made, "up", &Placement::up,
                "ndarray (3,) float64: the direction that is up in the picture, in world space or "
                "the parent's coordinates; read-only.");
    made.def_property(
        "target",
        [](const C& self) -> OrNone<py::array_t<double>> {
            const auto target = self.placed().placement.target;
            return target ? py::object(point_array(*target)) : py::none();
        },
        [](C& self, const OrNone<ArrayLike>& value) {
            std::optional<glm::dvec3> target;
            if (!value.is_none()) target = to_point(value, "target");
            self.edit_placed([&](Placed<Lens>& placed) { placed.placement.target = target; });
        },
        "ndarray (3,) float64 or None: the point that the camera looks at, in world space or the "
        "parent's coordinates; read-only. None: the camera looks along -Z, with a parent along the "
        "parent's.");
    bind_parent(made);
    made.def_property_readonly(
        "view", [](const C& self) { return matrix_array(self.matrices(1.0).view); },
        "ndarray (4, 4) float64: world to camera, read-only.");
    made.def("__repr__", [class_name, opening, field](const C& self) {
        const Placed<Lens> placed = self.placed();
        const Placement& p = placed.placement;
        return std::string(class_name) + "(" + opening + "=" + describe(placed.lens.*field) +
               ", position=" + tuple_text(p.position) +
               ", target=" + (p.target ? tuple_text(*p.target) : "None") + parent_text(p.parent) +
               ")";
    });
    made.def("__reduce__", [opening](const py::object& self) {
        py::dict arguments =
            attributes_of(self, opening, "position", "target", "up", "near", "far");
        for (const char* name : {"shift", "pixel_aspect"}) {
            if (py::hasattr(self, name)) arguments[name] = self.attr(name);
        }
        return reduced_with_parent(self, arguments);
    });
    def_setstate(made, "tuple", &set_parent_state);
}

/// Camera.__init__ called on an object of a class below it makes pybind11 (3.1) end the process.
void guard_init(Class<Camera>& camera) {
    const py::object init = camera.attr("__init__");
    explain_arguments(init, "Camera");
    const auto doc = init.attr("__doc__").cast<std::string>();
    py::options options;
    options.disable_function_signatures();
    const auto guarded = [init](const py::object& self, const py::args& args,
                                const py::kwargs& kwargs) {
        if (py::isinstance<PerspectiveCamera>(self) || py::isinstance<OrthographicCamera>(self)) {
            throw py::type_error("Camera.__init__: expected a Camera of matrices, got " +
                                 type_name(self));
        }
        init(self, *args, **kwargs);
    };
    camera.attr("__init__") =
        py::cpp_function(guarded, py::name("_guarded_init"), py::is_method(camera), doc.c_str());
}

}  // namespace

}  // namespace cubecam::bindings

void bind_camera(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto camera = declare<Camera>(module, "Camera", docs::camera);
    camera
        .def(py::init([](const ArrayLike& view, const ArrayLike& projection) {
                 return std::make_shared<Camera>(
                     Matrices{to_mat4(view, "view"), to_mat4(projection, "projection")});
             }),
             py::kw_only(), py::arg("view"), py::arg("projection"))
        .def_property(
            "view", [](const Camera& self) { return matrix_array(self.matrices(1.0).view); },
            [](Camera& self, const ArrayLike& value) {
                const glm::dmat4 view = to_mat4(value, "view");
                self.edit([&](CameraValue& next) { std::get<Matrices>(next).view = view; });
            },
            "ndarray (4, 4) float64: world to camera, read-only.")
        .def(
            "projection",
            [](const Camera& self, Real aspect) {
                return matrix_array(self.matrices(aspect).projection);
            },
            py::arg("aspect") = 1.0, docs::projection)
        .def("__repr__", [](const Camera&) { return "Camera(view, projection)"; })
        .def("__reduce__", [](const py::object& self) {
            py::dict arguments = attributes_of(self, "view");
            arguments["projection"] = self.attr("projection")();
            return reduced(self, arguments);
        });
    guard_init(camera);
    bind_placed<PerspectiveLens>(module, "PerspectiveCamera", docs::perspective, "fov",
                                 &PerspectiveLens::fov,
                                 "float: vertical, above 0 and below 180 degrees.");
    bind_placed<OrthographicLens>(module, "OrthographicCamera", docs::orthographic, "height",
                                  &OrthographicLens::height,
                                  "float: world units from the bottom to the top of the picture.");
}
