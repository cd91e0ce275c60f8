#include "arguments.hpp"

#include "numbers.hpp"

#include <exception>
#include <string>
#include <string_view>
#include <unordered_map>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

/// The type of pybind11's dispatcher: METH_FASTCALL | METH_KEYWORDS.
using Dispatcher = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);

Dispatcher pybind_dispatcher = nullptr;

/// Names of functions by the object that Python passes to the dispatcher as `self`. The map is
/// never freed, since functions may be called until the interpreter ends.
std::unordered_map<PyObject*, std::string>& function_names() {
    static auto& names = *new std::unordered_map<PyObject*, std::string>();
    return names;
}

/// Replaces the TypeError that is set by one of a shorter text, if the error is pybind11's.
void shorten_error(PyObject* function, PyObject* const* args, Py_ssize_t count, PyObject* names) {
    const py::error_already_set error;  // takes the error away from Python
    const std::string message = py::str(error.value());
    for (const std::string_view kind : {"function", "constructor"}) {
        if (message.find("incompatible " + std::string(kind) + " arguments") == std::string::npos) {
            continue;
        }
        const Py_ssize_t positional = PyVectorcall_NARGS(static_cast<std::size_t>(count));
        py::tuple given(positional);
        for (Py_ssize_t i = 0; i < positional; ++i) {
            given[static_cast<std::size_t>(i)] = py::reinterpret_borrow<py::object>(args[i]);
        }
        py::dict named;
        const Py_ssize_t keywords = names == nullptr ? 0 : PyTuple_GET_SIZE(names);
        for (Py_ssize_t i = 0; i < keywords; ++i) {
            named[py::handle(PyTuple_GET_ITEM(names, i))] = py::handle(args[positional + i]);
        }
        const py::object explain = py::module_::import("cubecam._arguments").attr("explain");
        const py::object better = explain(function_names()[function], message, given, named);
        PyErr_SetObject(py::type::handle_of(better).ptr(), better.ptr());
        return;
    }
    py::error_already_set(error).restore();
}

/// Whether a function makes an object from a pickle: what it gets may be anything.
bool reads_state(const std::string& name) {
    return name.ends_with(".__setstate__") || name == "_restore_frame";
}

/// A state that lacks a part, or has another in its place, is a wrong value: pickle's caller must
/// not have to know by which lookup that was found.
void explain_state(const std::string& name) {
    const bool wrong = PyErr_ExceptionMatches(PyExc_LookupError) != 0 ||
                       PyErr_ExceptionMatches(PyExc_AttributeError) != 0 ||
                       PyErr_ExceptionMatches(PyExc_SystemError) != 0 ||
                       PyErr_ExceptionMatches(PyExc_RecursionError) != 0 ||
                       PyErr_ExceptionMatches(PyExc_UnicodeError) != 0 ||
                       PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
    if (!wrong) return;
    py::error_already_set error;
    const std::string kind = name == "_restore_frame" ? "Frame" : name.substr(0, name.find('.'));
    const std::string text = kind + ": expected the state of a pickled " + kind +
                             ", got a broken one (" + text_of(error.value()) + ")";
    py::raise_from(error, PyExc_ValueError, text.c_str());
}

/// pybind11's dispatcher, whose own texts of errors may fail, for example for a keyword that is no
/// valid Unicode. A C++ exception that left it would end the process.
PyObject* call_pybind(PyObject* function, PyObject* const* args, Py_ssize_t count,
                      PyObject* names) {
    try {
        return pybind_dispatcher(function, args, count, names);
    } catch (py::error_already_set& error) {
        py::raise_from(error, PyExc_TypeError,
                       (function_names()[function] +
                        ": expected arguments as documented, got names or values that cannot be "
                        "shown")
                           .c_str());
    } catch (const std::exception& error) {
        PyErr_SetString(PyExc_TypeError, error.what());
    }
    return nullptr;
}

PyObject* dispatch(PyObject* function, PyObject* const* args, Py_ssize_t count, PyObject* names) {
    PyObject* const result = call_pybind(function, args, count, names);
    if (result == nullptr && reads_state(function_names()[function])) {
        try {
            explain_state(function_names()[function]);
        } catch (py::error_already_set& error) {
            error.restore();
        } catch (const std::exception& error) {
            PyErr_SetString(PyExc_ValueError, error.what());
        }
    }
    if (result == nullptr && PyErr_ExceptionMatches(PyExc_TypeError) != 0) {
        try {
            shorten_error(function, args, count, names);
        } catch (py::error_already_set& error) {
            error.restore();
        } catch (const std::exception& error) {  // no C++ exception may pass through Python
            PyErr_SetString(PyExc_TypeError, error.what());
        }
    }
    return result;
}

void explain_members(py::handle type, const std::string& class_name) {
    for (const auto& [key, member] : type.attr("__dict__").attr("copy")().cast<py::dict>()) {
        const std::string name = class_name + "." + py::str(key).cast<std::string>();
        if (Py_TYPE(member.ptr()) == &PyProperty_Type || py::hasattr(member, "fset")) {
            for (const char* accessor : {"fget", "fset"}) {
                explain_arguments(member.attr(accessor), name);
            }
        } else if (Py_TYPE(member.ptr()) == &PyStaticMethod_Type) {
            explain_arguments(member.attr("__func__"), name);
        } else {
            explain_arguments(member, py::str(key).equal(py::str("__init__")) ? class_name : name);
        }
    }
}

}  // namespace

void explain_arguments(py::handle function, const std::string& name) {
    PyObject* plain = function.ptr();
    if (PyInstanceMethod_Check(plain) != 0) plain = PyInstanceMethod_GET_FUNCTION(plain);
    if (PyCFunction_Check(plain) == 0) return;
    auto* const builtin = reinterpret_cast<PyCFunctionObject*>(plain);
    PyMethodDef& method = *builtin->m_ml;
    // Functions of pybind11 have a record as self; all other functions are left as they are.
    if (method.ml_flags != (METH_FASTCALL | METH_KEYWORDS) || builtin->m_self == nullptr ||
        py::detail::function_record_ptr_from_PyObject(builtin->m_self) == nullptr) {
        return;
    }
    const auto current = reinterpret_cast<Dispatcher>(reinterpret_cast<void (*)()>(method.ml_meth));
    function_names()[builtin->m_self] = name;
    if (current == &dispatch) return;
    pybind_dispatcher = current;  // pybind11 has one dispatcher for all functions
    method.ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&dispatch));
}

void explain_all_arguments(const py::module_& module) {
    for (const auto& [key, thing] : module.attr("__dict__").attr("copy")().cast<py::dict>()) {
        const std::string name = py::str(key);
        if (PyType_Check(thing.ptr()) != 0) {
            explain_members(thing, name);
        } else {
            explain_arguments(thing, name);
        }
    }
}

}  // namespace cubecam::bindings
