/// One line for calls that fit no signature, instead of pybind11's list of all signatures.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace cubecam::bindings {

/// Lets a function of pybind11 raise what python/cubecam/_arguments.py makes of its TypeError;
/// `name` is how messages call it, such as "Scene.add". Calls that succeed are as fast as before.
void explain_arguments(pybind11::handle function, const std::string& name);

/// The same for every function, method and setter of the module.
void explain_all_arguments(const pybind11::module_& module);

}  // namespace cubecam::bindings
