#include "numbers.hpp"

#include "arrays.hpp"

#include <cmath>
#include <string_view>

namespace cubecam {

namespace {

constexpr Py_ssize_t longest_text = 60;    // letters of a str or bytes
constexpr std::size_t longest_repr = 100;  // letters of any other repr
constexpr Py_ssize_t most_items = 6;
constexpr int deepest_list = 2;

/// Forgets the error that is set, which must be an Exception: a KeyboardInterrupt goes on.
void forget_error() {
    if (PyErr_ExceptionMatches(PyExc_Exception) == 0) throw py::error_already_set();
    PyErr_Clear();
}

/// An attribute, or null if there is none or if reading it raises an Exception.
py::object attribute(py::handle value, const char* name) {
    auto found = py::reinterpret_steal<py::object>(PyObject_GetAttrString(value.ptr(), name));
    if (!found) forget_error();
    return found;
}

std::string typed(py::handle value) {
    // tp_name can have a module in front, as in numpy.ndarray.
    const std::string_view name = Py_TYPE(value.ptr())->tp_name;
    return std::string(name.substr(name.rfind('.') + 1));
}

/// The repr in UTF-8, or an empty text if there is none.
std::string plain_repr(py::handle value) {
    const auto text = py::reinterpret_steal<py::object>(PyObject_Repr(value.ptr()));
    Py_ssize_t size = 0;
    const char* letters = text ? PyUnicode_AsUTF8AndSize(text.ptr(), &size) : nullptr;
    if (letters == nullptr) {
        forget_error();
        return {};
    }
    return {letters, static_cast<std::size_t>(size)};
}

/// A str or bytes, of which only the beginning is shown.
std::string beginning_of(py::handle value, Py_ssize_t length, py::object cut) {
    if (!cut) {
        forget_error();
        return typed(value);
    }
    std::string text = plain_repr(cut);
    if (text.empty()) return typed(value);
    return length > longest_text ? text + "..." : text;
}

std::string int_text(py::handle value) {
    int overflow = 0;
    PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
    if (overflow == 0) return plain_repr(value);
    const auto bits = py::reinterpret_steal<py::object>(PyObject_CallMethod(
        reinterpret_cast<PyObject*>(&PyLong_Type), "bit_length", "O", value.ptr()));
    if (!bits) {
        forget_error();
        return typed(value);
    }
    const long count = PyLong_AsLong(bits.ptr());
    return count <= 128 ? plain_repr(value) : "an int of " + std::to_string(count) + " bits";
}

std::string shown(py::handle value, int depth);

std::string list_text(py::handle value, int depth) {
    const bool list = PyList_Check(value.ptr()) != 0;
    const auto length = [&] {
        return list ? PyList_GET_SIZE(value.ptr()) : PyTuple_GET_SIZE(value.ptr());
    };
    std::string text;
    for (Py_ssize_t i = 0; i < length(); ++i) {
        if (i == most_items || depth == deepest_list) {
            text += text.empty() ? "..." : ", ...";
            break;
        }
        // The repr of an item may run Python code, which may change the list.
        const auto item = py::reinterpret_borrow<py::object>(
            list ? PyList_GET_ITEM(value.ptr(), i) : PyTuple_GET_ITEM(value.ptr(), i));
        text += (i > 0 ? ", " : "") + shown(item, depth + 1);
    }
    if (list) return "[" + text + "]";
    return "(" + text + (length() == 1 ? ",)" : ")");
}

std::string shown(py::handle value, int depth) {
    PyObject* const given = value.ptr();
    if (PyLong_CheckExact(given) != 0) return int_text(value);
    if (PyUnicode_Check(given) != 0) {
        const Py_ssize_t length = PyUnicode_GET_LENGTH(given);
        return beginning_of(value, length,
                            py::reinterpret_steal<py::object>(
                                PyUnicode_Substring(given, 0, std::min(length, longest_text))));
    }
    if (PyBytes_CheckExact(given) != 0) {
        const Py_ssize_t length = PyBytes_GET_SIZE(given);
        return beginning_of(value, length,
                            py::reinterpret_steal<py::object>(
                                PySequence_GetSlice(given, 0, std::min(length, longest_text))));
    }
    if (PyList_CheckExact(given) != 0 || PyTuple_CheckExact(given) != 0) {
        return list_text(value, depth);
    }
    // The repr of a collection is as long as the collection.
    if (PyList_Check(given) != 0 || PyTuple_Check(given) != 0 || PyDict_Check(given) != 0 ||
        PyAnySet_Check(given) != 0 || PyByteArray_Check(given) != 0 ||
        py::isinstance<py::array>(value)) {
        return typed(value);
    }
    const std::string text = plain_repr(value);
    const bool brief =
        !text.empty() && text.size() <= longest_repr && text.find('\n') == std::string::npos;
    return brief ? text : typed(value);
}

/// Whether a value without axes is a number of one of numpy's kinds, as far as the value says what
/// its numbers are: scalars and arrays of numpy do, ints and fractions do not.
bool one_number(py::handle value, std::string_view kinds) {
    const py::object dtype = attribute(value, "dtype");
    if (!dtype) return true;
    const py::object kind = attribute(dtype, "kind");
    if (kind && PyUnicode_Check(kind.ptr()) != 0) {
        const std::string letter = kind.cast<std::string>();
        if (letter.empty() || kinds.find(letter) == std::string_view::npos) return false;
    }
    const py::object axes = attribute(value, "ndim");
    if (axes && PyLong_Check(axes.ptr()) != 0 && PyObject_IsTrue(axes.ptr()) != 0) return false;
    return !hides_values(value);
}

}  // namespace

std::string text_of(py::handle value) { return shown(value, 0); }

std::optional<std::int64_t> whole_number(py::handle value) {
    PyObject* const given = value.ptr();
    if (given == nullptr || PyBool_Check(given) != 0 || PyIndex_Check(given) == 0) {
        return std::nullopt;
    }
    if (PyLong_Check(given) == 0 && !one_number(value, "iu")) return std::nullopt;
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(given));
    if (!index) {
        forget_error();
        return std::nullopt;
    }
    return PyNumber_AsSsize_t(index.ptr(), nullptr);
}

std::optional<double> real_number(py::handle value) {
    PyObject* const given = value.ptr();
    if (given == nullptr || PyBool_Check(given) != 0) return std::nullopt;
    if (PyFloat_Check(given) != 0) return PyFloat_AS_DOUBLE(given);
    const PyNumberMethods* const methods = Py_TYPE(given)->tp_as_number;
    if (methods == nullptr || (methods->nb_float == nullptr && methods->nb_index == nullptr) ||
        PyUnicode_Check(given) != 0 || PyBytes_Check(given) != 0) {
        return std::nullopt;
    }
    if (PyLong_Check(given) == 0 && !one_number(value, "fiu")) return std::nullopt;
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Float(given));
    if (!number) {
        forget_error();
        return std::nullopt;
    }
    return PyFloat_AsDouble(number.ptr());
}

std::optional<bool> truth_value(py::handle value) {
    if (value.ptr() == Py_True) return true;
    if (value.ptr() == Py_False) return false;
    if (!value) return std::nullopt;
    const std::string_view type = Py_TYPE(value.ptr())->tp_name;
    if (type != "numpy.bool" && type != "numpy.bool_") return std::nullopt;
    return PyObject_IsTrue(value.ptr()) == 1;
}

std::int64_t to_int(py::handle value, const char* name) {
    if (const auto number = whole_number(value)) return *number;
    throw TypeError(std::string(name) + ": expected an int, got " + text_of(value));
}

std::int64_t to_int(py::handle value, const char* name, std::int64_t low, std::int64_t high) {
    const std::int64_t number = to_int(value, name);
    if (number >= low && number <= high) return number;
    throw py::value_error(std::string(name) + ": expected an int from " + std::to_string(low) +
                          " to " + std::to_string(high) + ", got " + text_of(value));
}

std::pair<std::int64_t, std::int64_t> to_size(py::handle value) {
    const auto refuse = [&]() -> std::pair<std::int64_t, std::int64_t> {
        throw TypeError("size: expected (width, height) in pixels, got " + text_of(value));
    };
    if (!py::isinstance<py::sequence>(value) || PyUnicode_Check(value.ptr()) != 0 ||
        PyBytes_Check(value.ptr()) != 0 || PyByteArray_Check(value.ptr()) != 0 ||
        PyMemoryView_Check(value.ptr()) != 0) {
        return refuse();
    }
    const Py_ssize_t length = PySequence_Size(value.ptr());
    if (length < 0) forget_error();
    if (length != 2 || hides_values(value)) return refuse();
    std::int64_t numbers[2] = {};
    for (Py_ssize_t i = 0; i < 2; ++i) {
        const auto item = py::reinterpret_steal<py::object>(PySequence_GetItem(value.ptr(), i));
        if (!item) {
            forget_error();
            return refuse();
        }
        numbers[i] = to_int(item, i == 0 ? "width" : "height");
    }
    return {numbers[0], numbers[1]};
}

}  // namespace cubecam
