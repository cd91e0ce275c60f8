// The extension module cubecam._core.
#include "arguments.hpp"
#include "objects.hpp"
#include "unlocked.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/scene/node.hpp"
#include "cubecam/scene/planar_mirror.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/probe_blend.hpp"
#include "cubecam/scene/probe_grid.hpp"
#include "cubecam/scene/render_texture.hpp"
#include "cubecam/scene/scene.hpp"

#include <pybind11/pybind11.h>

#include <string>

// Each function stands in the file of its name.
void bind_pickling(pybind11::module_& module);
void bind_arrays(pybind11::module_& module);
void bind_errors(pybind11::module_& module);
void bind_device(pybind11::module_& module);
void bind_cubemap(pybind11::module_& module);
void bind_equirect_arrays(pybind11::module_& module);
void bind_lighting(pybind11::module_& module);
void bind_image(pybind11::module_& module);
void bind_radiance(pybind11::module_& module);
void bind_skin(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_blend(pybind11::module_& module);
void bind_stencil(pybind11::module_& module);
void bind_texture(pybind11::module_& module);
void bind_material(pybind11::module_& module);
void bind_image_effect(pybind11::module_& module);
void bind_shadow(pybind11::module_& module);
void bind_light(pybind11::module_& module);
void bind_camera(pybind11::module_& module);
void bind_camera_views(pybind11::module_& module);
void bind_animation(pybind11::module_& module);
void bind_stereo(pybind11::module_& module);
void bind_probe(pybind11::module_& module);
void bind_planar_mirror(pybind11::module_& module);
void bind_probe_blend(pybind11::module_& module);
void bind_probe_grid(pybind11::module_& module);
void bind_render_texture(pybind11::module_& module);
void bind_node(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_scene_queries(pybind11::module_& module);
void bind_renderer(pybind11::module_& module);
void bind_batches(pybind11::module_& module);
#ifdef CUBECAM_PLANTED_FAULTS
void bind_planted_faults(pybind11::module_& module);  // planted/faults.cpp
#endif

/// Makes every class without a `__reduce__` of its own raise TypeError when it is pickled. Without
/// this, pickle's protocols 0 and 1 make an instance in a way that makes pybind11 end the process.
static void refuse_pickling(pybind11::module_& module) {
    namespace py = pybind11;
    const py::object plain = py::module_::import("builtins").attr("object").attr("__reduce__");
    for (const auto& [name, thing] : module.attr("__dict__").cast<py::dict>()) {
        const auto kind = py::type::handle_of(thing).attr("__name__").cast<std::string>();
        if (kind != "pybind11_type" || !py::object(thing.attr("__reduce__")).is(plain)) continue;
        thing.attr("__reduce__") = py::cpp_function(
            [](const py::object& self) -> py::tuple {
                throw py::type_error("cannot pickle a cubecam." +
                                     cubecam::bindings::type_name(self));
            },
            py::name("__reduce__"), py::is_method(thing));
    }
}

/// The names that `from cubecam._core import *` imports and that cubecam exports. A new class is
/// exported without another line in python/cubecam/__init__.py.
static pybind11::list exported_names(const pybind11::module_& module) {
    namespace py = pybind11;
    // Renderer.info and Renderer.stats return objects of these classes; users do not make them.
    const py::tuple inner = py::make_tuple("Limits", "RendererInfo", "Stats");
    py::list names;
    for (const auto& [name, thing] : module.attr("__dict__").cast<py::dict>()) {
        const auto text = name.cast<std::string>();
        if (text.starts_with('_') || inner.contains(name)) continue;
        names.append(name);
    }
    names.append("__version__");
    names.attr("sort")();
    return names;
}

// PYBIND11_MODULE below makes the function `make_module`, and PyInit__core is the one after it:
// pybind11's own would wait for ever in a subinterpreter, before any code of this module runs.
#undef PYBIND11_PLUGIN_IMPL
#define PYBIND11_PLUGIN_IMPL(name) static PyObject* make_module()

PYBIND11_MODULE(_core, module) {
    using namespace cubecam;
    using cubecam::bindings::declare;

    module.doc() = "The compiled part of cubecam. Use `import cubecam`, which exports it.";
    module.attr("__version__") = CUBECAM_VERSION;

    cubecam::bindings::bind_interrupts(module);
    bind_pickling(module);
    bind_arrays(module);
    bind_errors(module);
    bind_device(module);
    // These classes name each other in signatures, so they are declared before any method is
    // defined.
    declare<Node>(module, "Node", nullptr);
    declare<Probe>(module, "Probe", nullptr);
    declare<PlanarMirror>(module, "PlanarMirror", nullptr);
    declare<ProbeBlend>(module, "ProbeBlend", nullptr);
    declare<ProbeGrid>(module, "ProbeGrid", nullptr);
    declare<RenderTexture>(module, "RenderTexture", nullptr);
    declare<Scene>(module, "Scene", nullptr);

    bind_cubemap(module);
    bind_equirect_arrays(module);
    bind_lighting(module);
    bind_image(module);
    bind_radiance(module);
    bind_skin(module);
    bind_mesh(module);
    bind_blend(module);
    bind_stencil(module);
    bind_texture(module);
    bind_material(module);
    bind_image_effect(module);
    bind_shadow(module);
    bind_light(module);
    bind_camera(module);
    bind_camera_views(module);
    bind_animation(module);
    bind_stereo(module);
    bind_probe(module);
    bind_planar_mirror(module);
    bind_probe_blend(module);
    bind_probe_grid(module);
    bind_render_texture(module);
    bind_node(module);
    bind_scene(module);
    bind_scene_queries(module);
    bind_renderer(module);
    bind_batches(module);
    module.def(
        "_newest_revision", &newest_revision,
        "The newest revision of this process. While it stays the same, no object has changed.");
#ifdef CUBECAM_PLANTED_FAULTS
    bind_planted_faults(module);
#endif
    refuse_pickling(module);
    module.attr("__all__") = exported_names(module);
    cubecam::bindings::explain_all_arguments(module);
}

// What pybind11 wants to be called for a new module of an interpreter.
static PyObject* (*create_module)(PyObject*, PyModuleDef*) = nullptr;

static bool is_refused() {
    if (PyInterpreterState_Get() == PyInterpreterState_Main()) return false;
    PyErr_SetString(PyExc_ImportError,
                    "cubecam: expected an import in the main interpreter, got one in a "
                    "subinterpreter, which cubecam does not support; use processes instead "
                    "(multiprocessing's \"spawn\" method), and with mod_wsgi "
                    "`WSGIApplicationGroup %{GLOBAL}`");
    return true;
}

PYBIND11_PLUGIN_DECL(_core)

// Up to Python 3.12 this function runs in the interpreter that imports the module. Since 3.13 it
// always runs in the main interpreter, and only the functions of the definition's slots run in the
// one that imports.
PyObject* PyInit__core() {
    if (is_refused()) return nullptr;
    PyObject* made = make_module();
    if (made == nullptr || create_module != nullptr) return made;
    for (auto* slot = reinterpret_cast<PyModuleDef*>(made)->m_slots; slot->slot != 0; ++slot) {
        if (slot->slot != Py_mod_create) continue;
        create_module = reinterpret_cast<decltype(create_module)>(slot->value);
        PyObject* (*const checked)(PyObject*, PyModuleDef*) = [](PyObject* spec,
                                                                 PyModuleDef* definition) {
            return is_refused() ? nullptr : create_module(spec, definition);
        };
        slot->value = reinterpret_cast<void*>(checked);
    }
    return made;
}
