/// Errors of one line for calls that fit no signature, instead of pybind11's list of all
/// signatures.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace cubecam::bindings {

/// Makes a function of pybind11 raise a TypeError with the text of python/cubecam/_arguments.py
/// when a call fits no signature. `name` is the function's name in messages, such as "Scene.add".
/// Calls that succeed are as fast as before.
void explain_arguments(pybind11::handle function, const std::string& name);

/// Calls `explain_arguments` for every function, method and setter of the module.
void explain_all_arguments(const pybind11::module_& module);

}  // namespace cubecam::bindings
