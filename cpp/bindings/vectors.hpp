/// Numbers, vectors, colours and rotations, from Python and back.
#pragma once

#include "arrays.hpp"
#include "colors.hpp"
#include "objects.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/parse_name.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <charconv>
#include <string>

namespace cubecam::bindings {

/// Three finite numbers. Tuples and lists of plain numbers, which most callers pass, are converted
/// without numpy, which is faster.
inline glm::dvec3 to_point(py::handle value, const char* name) {
    const bool tuple = PyTuple_CheckExact(value.ptr()) != 0;
    if (tuple ? PyTuple_GET_SIZE(value.ptr()) == 3
              : PyList_CheckExact(value.ptr()) && PyList_GET_SIZE(value.ptr()) == 3) {
        glm::dvec3 point;
        bool plain = true;
        for (int i = 0; i < 3 && plain; ++i) {
            PyObject* item =
                tuple ? PyTuple_GET_ITEM(value.ptr(), i) : PyList_GET_ITEM(value.ptr(), i);
            plain = PyFloat_CheckExact(item) || PyLong_CheckExact(item);
            if (plain) point[i] = PyFloat_AsDouble(item);
        }
        if (PyErr_Occurred()) {
            PyErr_Clear();
        } else if (plain && std::isfinite(point.x + point.y + point.z)) {
            return point;
        }
    }
    return to_vec3(value, name);  // raises the error, if the value has one
}

/// Three numbers, or one number that stands for all three.
inline glm::dvec3 to_scale(py::handle value, const char* name) {
    const py::array given = to_array(value, name);
    if (given.ndim() > 0) return to_point(given, name);
    return glm::dvec3(*double_array(given, name, "()").data());
}

/// The quaternion (w, x, y, z), of any length except 0. `instead` names what else could be given.
inline glm::dquat to_rotation(py::handle value, const char* name, const char* instead = "") {
    // Three angles and a matrix of three rows are the usual guesses.
    const Py_ssize_t length = py::isinstance<py::str>(value) ? -1 : PySequence_Size(value.ptr());
    if (length < 0) PyErr_Clear();
    if (length == 3) {
        throw py::value_error(std::string(name) +
                              ": expected a quaternion (w, x, y, z), as cc.axis_angle gives" +
                              instead + "; got a sequence of 3");
    }
    const glm::dvec4 v = to_vec4(value, name);
    return {v.x, v.y, v.z, v.w};
}

/// A colour of 3 or 4 linear numbers, with an alpha of 1 by default, or of a text that
/// `parse_color` reads.
inline glm::vec4 to_rgba(py::handle value, const char* name) {
    if (py::isinstance<py::str>(value)) {
        return glm::vec4(parse_color(value.cast<std::string>(), name));
    }
    return glm::vec4(to_color(value, name));
}

/// A colour without alpha.
inline glm::vec3 to_rgb(py::handle value, const char* name) {
    if (!py::isinstance<py::str>(value)) return glm::vec3(to_point(value, name));
    const auto text = value.cast<std::string>();
    const glm::dvec4 color = parse_color(text, name);
    if (color.a != 1.0) {
        throw py::value_error(std::string(name) + ": expected a colour without alpha, got '" +
                              shortened(text) + "'");
    }
    return glm::vec3(color);
}

/// The shortest decimal number of a float32, as the user typed it: 0.2 and not 0.200000003.
inline double shortest(float value) {
    const std::string text = describe(value);
    double number = static_cast<double>(value);
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

inline py::array_t<double> quaternion_array(const glm::dquat& q) {
    return readonly_array(glm::dvec4(q.w, q.x, q.y, q.z));
}

/// A read-only array of a colour, in float32 as the colour is stored.
template <class Color>
py::array_t<float> color_array(const Color& color) {
    py::array_t<float> array(py::ssize_t{Color::length()});
    for (int i = 0; i < Color::length(); ++i) array.mutable_data()[i] = color[i];
    array.attr("flags").attr("writeable") = false;
    return array;
}

inline py::array_t<double> point_array(const glm::dvec3& value) { return readonly_array(value); }
inline py::array_t<double> matrix_array(const glm::dmat4& value) { return readonly_array(value); }

/// "(3, 4.5, 0)", for __repr__.
template <class Vector>
std::string tuple_text(const Vector& value) {
    std::string text = "(";
    for (int i = 0; i < Vector::length(); ++i) text += (i ? ", " : "") + describe(value[i]);
    return text + ")";
}

}  // namespace cubecam::bindings
