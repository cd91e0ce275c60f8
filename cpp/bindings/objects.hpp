/// Functions that the binding files share: they declare classes, check objects from Python, and
/// pickle.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <typeinfo>
#include <utility>

namespace cubecam::bindings {

namespace py = pybind11;

/// The Python class of objects that Python, scenes and renderers share.
template <class T, class... Bases>
using Class = py::class_<T, Bases..., std::shared_ptr<T>>;

/// Makes a class that prints and pickles as `cubecam.NAME`. The module of the class is set before
/// any method is defined, so that signatures show this name, too.
///
/// An instance whose __init__ has not run (a subclass that uses itself before super().__init__())
/// has no C++ object. pybind11 would pass uninitialised memory to the method; with this class the
/// use raises TypeError.
template <class T, class... Bases>
Class<T, Bases...> declare(py::module_& module, const char* name, const char* doc) {
    Class<T, Bases...> made(module, name, doc);
    made.attr("__module__") = "cubecam";
    py::detail::get_type_info(typeid(T))->operator_new = [](std::size_t) -> void* {
        throw py::type_error("expected an object whose __init__() was called");
    };
    return made;
}

/// A class that `declare` made earlier. Two classes may name each other in their signatures only if
/// both are declared before the methods of either are defined.
template <class T, class... Bases>
Class<T, Bases...> declared() {
    return py::reinterpret_borrow<Class<T, Bases...>>(py::type::of<T>());
}

inline bool any_object(PyObject*) { return true; }

/// Any Python object. Signatures show it as one of the named types; the binding checks the type.
template <class... Types>
class OneOf : public py::object {
    PYBIND11_OBJECT_DEFAULT(OneOf, object, any_object)
    using object::object;
};

/// The text of a type, as a parameter of a template.
template <std::size_t size>
struct TypeText {
    constexpr TypeText(const char (&given)[size]) { std::copy_n(given, size, text); }
    char text[size];
};

/// Any Python object. Signatures show it as this text; the binding checks the type.
template <TypeText text>
class Shown : public py::object {
    PYBIND11_OBJECT_DEFAULT(Shown, object, any_object)
    using object::object;
};

using ArrayLike = Shown<"numpy.typing.ArrayLike">;
using DTypeLike = Shown<"numpy.typing.DTypeLike">;
using PathLike = Shown<"os.PathLike[str]">;
using WholeNumber = Shown<"typing.SupportsIndex">;  ///< an int of Python or numpy
using Pixels = Shown<"numpy.typing.NDArray[numpy.uint8 | numpy.float16 | numpy.float32]">;
using PixelDType = Shown<"numpy.dtype[numpy.uint8 | numpy.float16 | numpy.float32]">;
using OutputArray = Shown<"numpy.typing.NDArray[numpy.float32 | numpy.int32 | numpy.uint8]">;

/// Pixels, or the numbers of an output.
using PixelsOrOutput =
    Shown<"numpy.typing.NDArray[numpy.uint8 | numpy.float16 | numpy.float32 | numpy.int32]">;

template <class T>
using OrNone = OneOf<T, py::none>;

/// (width, height).
using Size = py::typing::Tuple<int, int>;
using SizeLike = OneOf<py::typing::Tuple<py::int_, py::int_>>;
using ColorLike = OneOf<py::str, ArrayLike>;

inline std::string type_name(py::handle value) {
    return value.is_none() ? "None" : py::str(py::type::handle_of(value).attr("__name__"));
}

/// Raises TypeError "NAME: expected EXPECTED, got TYPE".
[[noreturn]] inline void refuse(py::handle value, const char* name, const char* expected) {
    throw py::type_error(std::string(name) + ": expected " + expected + ", got " +
                         type_name(value));
}

template <class T>
std::shared_ptr<T> to_shared(py::handle value, const char* name, const char* expected) {
    if (!py::isinstance<T>(value)) refuse(value, name, expected);
    return py::cast<std::shared_ptr<T>>(value);
}

template <class T>
std::shared_ptr<T> to_shared_or_none(py::handle value, const char* name, const char* expected) {
    return value.is_none() ? nullptr : to_shared<T>(value, name, expected);
}

/// The object, or None for null.
template <class T>
OrNone<T> or_none(const std::shared_ptr<T>& object) {
    return py::cast(object);
}

/// The format number in every pickle, which unpickling checks. The number increases when the
/// contents of pickles change; pickles of version 0.1 have none.
constexpr int pickle_format = 2;

/// Raises TypeError unless the format of a pickle is `pickle_format`.
void check_pickle(py::handle format);

/// A state with the format number, as pickles hold it, and the state without the number.
inline py::tuple closed_state(py::object state) {
    return py::make_tuple(pickle_format, std::move(state));
}
py::object opened_state(py::handle state);

/// The result of `__reduce__` for an object that is made again from arguments by position (a tuple)
/// or by name (a dict). Pickle keeps the object in its memo before it pickles `state`, so that the
/// state may refer to the object.
inline py::tuple reduced(py::handle self, py::object args) {
    const py::object remake = py::module_::import("cubecam._pickling").attr("remake");
    return py::make_tuple(
        remake, py::make_tuple(pickle_format, py::type::handle_of(self), std::move(args)));
}

inline py::tuple reduced(py::handle self, py::object args, py::object state) {
    return py::tuple(reduced(self, std::move(args)) +
                     py::make_tuple(closed_state(std::move(state))));
}

/// A dict of attributes, for the arguments of `reduced`.
template <class... Names>
py::dict attributes_of(py::handle self, const Names&... names) {
    py::dict values;
    ((values[names] = self.attr(names)), ...);
    return values;
}

/// Defines `__setstate__` as a method of an object that exists already. It is made under another
/// name, since pybind11 expects a function of the name `__setstate__` to construct the object.
template <class Bound, class Function>
void def_setstate(Bound& bound, const char* state_type, Function&& function) {
    const auto class_name = bound.attr("__name__").template cast<std::string>();
    const std::string doc = "__setstate__(self: cubecam." + class_name + ", state: " + state_type +
                            ") -> None\n\nFor unpickling.";
    py::options options;
    options.disable_function_signatures();
    const py::object set =
        py::cpp_function(std::forward<Function>(function), py::name("_set_state"), py::arg("self"),
                         py::arg("state"));
    bound.attr("__setstate__") = py::cpp_function(
        [set](const py::object& self, const py::object& state) { set(self, opened_state(state)); },
        py::name("_set_state"), py::is_method(bound), py::arg("state"), doc.c_str());
}

}  // namespace cubecam::bindings

namespace pybind11::detail {

template <class... Types>
struct handle_type_name<cubecam::bindings::OneOf<Types...>> {
    static constexpr auto name = union_concat(make_caster<Types>::name...);
};

template <cubecam::bindings::TypeText text>
struct handle_type_name<cubecam::bindings::Shown<text>> {
    static constexpr auto name = const_name(text.text);
};

}  // namespace pybind11::detail
