#pragma once

#include <pybind11/pybind11.h>

namespace cubecam {

/// The classes that a renderer reports in: Stats, and RendererInfo with its Limits.
void bind_stats(pybind11::module_& m);
void bind_info(pybind11::module_& m);

}  // namespace cubecam
