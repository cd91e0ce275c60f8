// The extension module cubecam._core.
#include "objects.hpp"

#include "cubecam/scene/node.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/scene.hpp"

#include <pybind11/pybind11.h>

// One a topic, each in the file of its name.
void bind_errors(pybind11::module_& module);
void bind_device(pybind11::module_& module);
void bind_cubemap(pybind11::module_& module);
void bind_image(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_material(pybind11::module_& module);
void bind_light(pybind11::module_& module);
void bind_camera(pybind11::module_& module);
void bind_probe(pybind11::module_& module);
void bind_node(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_renderer(pybind11::module_& module);

PYBIND11_MODULE(_core, module) {
    using namespace cubecam;
    using cubecam::bindings::declare;

    module.doc() = "The compiled part of cubecam. Use `import cubecam`, which has all of it.";
    module.attr("__version__") = CUBECAM_VERSION;

    bind_errors(module);
    bind_device(module);
    // Signatures name the classes that are declared by then, and these lead to each other.
    declare<Node>(module, "Node", nullptr);
    declare<Probe>(module, "Probe", nullptr);
    declare<Scene>(module, "Scene", nullptr);

    bind_cubemap(module);
    bind_image(module);
    bind_mesh(module);
    bind_material(module);
    bind_light(module);
    bind_camera(module);
    bind_probe(module);
    bind_node(module);
    bind_scene(module);
    bind_renderer(module);
}
