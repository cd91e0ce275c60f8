// The exception classes of cubecam, and which C++ exception becomes which.
#include "cubecam/core/error.hpp"

#include <pybind11/gil_safe_call_once.h>
#include <pybind11/pybind11.h>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

struct ErrorClasses {
    py::object error;
    py::object context_error;
    py::object shader_error;
    py::object gl_error;
};

// Made once for each interpreter and never destroyed: at exit an exception may still be in flight.
PYBIND11_CONSTINIT py::gil_safe_call_once_and_store<ErrorClasses> error_storage;

/// A new class `cubecam.<name>`. Its module is the package and not the extension, so that it prints
/// and pickles under the public name.
py::object make_class(py::module_& module, const char* name, const char* doc,
                      const py::object& base) {
    const std::string full_name = std::string("cubecam.") + name;
    auto made = py::reinterpret_steal<py::object>(
        PyErr_NewExceptionWithDoc(full_name.c_str(), doc, base.ptr(), nullptr));
    if (!made) throw py::error_already_set();
    module.add_object(name, made);
    return made;
}

ErrorClasses make_classes(py::module_& module) {
    const auto runtime_error = py::reinterpret_borrow<py::object>(PyExc_RuntimeError);
    ErrorClasses classes;
    classes.error = make_class(
        module, "Error",
        "Base of cubecam's own exceptions, which report problems of the machine or of files.",
        runtime_error);
    classes.context_error =
        make_class(module, "ContextError",
                   "No OpenGL context can be made, or the context can no longer be used.\n\n"
                   "The message names each attempt, why it failed, and what to install.",
                   classes.error);
    classes.shader_error = make_class(
        module, "ShaderError",
        "A shader did not compile or link; the message has the log and the source lines.",
        classes.error);
    classes.gl_error =
        make_class(module, "GlError", "OpenGL reported an error, for example too little memory.",
                   classes.error);
    const py::object file_error = make_class(
        module, "FileError", "The contents of a file cannot be read or written.", classes.error);
    make_class(module, "ImageError", "The contents of an image file cannot be used.", file_error);
    make_class(module, "MeshError", "The contents of a mesh file cannot be used.", file_error);
    return classes;
}

void translate(std::exception_ptr pointer) {
    if (!pointer) return;
    const ErrorClasses& classes = error_storage.get_stored();
    try {
        std::rethrow_exception(pointer);
    } catch (const ContextError& error) {
        py::set_error(classes.context_error, error.what());
    } catch (const ShaderError& error) {
        py::set_error(classes.shader_error, error.what());
    } catch (const GlError& error) {
        py::set_error(classes.gl_error, error.what());
    } catch (const Error& error) {
        py::set_error(classes.error, error.what());
    } catch (const TypeError& error) {
        py::set_error(PyExc_TypeError, error.what());
    } catch (const py::cast_error&) {
        // pybind11 itself would raise a RuntimeError that names C++ types.
        py::set_error(PyExc_TypeError,
                      "expected text that is valid Unicode, numbers in range and objects whose "
                      "__init__ was called, got an argument that is not");
    }
}

}  // namespace

}  // namespace cubecam::bindings

void bind_errors(py::module_& module) {
    using namespace cubecam::bindings;
    error_storage.call_once_and_store_result([&] { return make_classes(module); });
    // The translator is local to this module, so that it does not see exceptions of other
    // extensions.
    py::register_local_exception_translator(translate);
}
