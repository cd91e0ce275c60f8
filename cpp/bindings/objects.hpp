/// What the bindings of scene objects share: how classes are declared, and checked objects from
/// Python.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <typeinfo>
#include <utility>

namespace cubecam::bindings {

namespace py = pybind11;

/// Scene objects are shared between Python, scenes and renderers.
template <class T, class... Bases>
using Class = py::class_<T, Bases..., std::shared_ptr<T>>;

/// Makes a class that prints and pickles as `cubecam.NAME`. Its module is set before any method is
/// defined, so that signatures name it so, too.
///
/// An instance whose __init__ has not run (a subclass that touches itself before
/// super().__init__()) has no C++ object. pybind11 then hands out memory that nothing was built in;
/// here it raises.
template <class T, class... Bases>
Class<T, Bases...> declare(py::module_& module, const char* name, const char* doc) {
    Class<T, Bases...> made(module, name, doc);
    made.attr("__module__") = "cubecam";
    py::detail::get_type_info(typeid(T))->operator_new = [](std::size_t) -> void* {
        throw py::type_error("expected an object whose __init__() was called");
    };
    return made;
}

/// A class that `declare` made earlier: two classes may name each other in their signatures only if
/// both are declared before either's methods are defined.
template <class T, class... Bases>
Class<T, Bases...> declared() {
    return py::reinterpret_borrow<Class<T, Bases...>>(py::type::of<T>());
}

inline bool any_object(PyObject*) { return true; }

/// Any Python object; it shows in signatures as one of the types named, and we do the checking.
template <class... Types>
class OneOf : public py::object {
    PYBIND11_OBJECT_DEFAULT(OneOf, object, any_object)
    using object::object;
};

/// The same for all that numpy makes an array of.
class ArrayLike : public py::object {
    PYBIND11_OBJECT_DEFAULT(ArrayLike, object, any_object)
    using object::object;
};

template <class T>
using OrNone = OneOf<T, py::none>;

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

/// A whole number of Python or numpy, bool left out, from `low` to `high`.
inline std::int64_t to_whole(py::handle value, const char* name, std::int64_t low,
                             std::int64_t high) {
    if (py::isinstance<py::bool_>(value) || PyIndex_Check(value.ptr()) == 0) {
        refuse(value, name, "an int");
    }
    const std::int64_t number = PyNumber_AsSsize_t(value.ptr(), nullptr);  // clamped to 64 bits
    if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    if (number >= low && number <= high) return number;
    throw py::value_error(std::string(name) + ": expected an int from " + std::to_string(low) +
                          " to " + std::to_string(high) + ", got " +
                          py::str(value).cast<std::string>());
}

/// For `__reduce__`: pickle keeps the object made of `args` in its memo before it pickles `state`,
/// so that the state may lead back to the object.
inline py::tuple reduced(py::handle self, py::tuple args) {
    return py::make_tuple(py::type::handle_of(self), std::move(args));
}

inline py::tuple reduced(py::handle self, py::tuple args, py::object state) {
    return py::make_tuple(py::type::handle_of(self), std::move(args), std::move(state));
}

/// Defines `__setstate__` as a method of an object that exists: of a function made by that name
/// pybind11 expects that it constructs one.
template <class Bound, class Function>
void def_setstate(Bound& bound, const char* state_type, Function&& function) {
    const auto class_name = bound.attr("__name__").template cast<std::string>();
    const std::string doc = "__setstate__(self: cubecam." + class_name + ", state: " + state_type +
                            ") -> None\n\nFor unpickling.";
    py::options options;
    options.disable_function_signatures();
    bound.attr("__setstate__") =
        py::cpp_function(std::forward<Function>(function), py::name("_set_state"),
                         py::is_method(bound), py::arg("state"), doc.c_str());
}

}  // namespace cubecam::bindings

namespace pybind11::detail {

template <class... Types>
struct handle_type_name<cubecam::bindings::OneOf<Types...>> {
    static constexpr auto name = union_concat(make_caster<Types>::name...);
};

template <>
struct handle_type_name<cubecam::bindings::ArrayLike> {
    static constexpr auto name = const_name("numpy.typing.ArrayLike");
};

}  // namespace pybind11::detail
