/// The cubemap that a surface looks up, from Python and back: a CubeMap, a Probe or None.
#pragma once

#include "objects.hpp"

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/materials/texture_source.hpp"
#include "cubecam/scene/planar_mirror.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/probe_blend.hpp"

namespace cubecam::bindings {

using CubeLike = OneOf<CubeMap, Probe, py::none>;

inline CubeSource to_cube_source(py::handle value, const char* name) {
    if (value.is_none()) return {};
    if (py::isinstance<Probe>(value)) return py::cast<std::shared_ptr<Probe>>(value);
    return to_shared<CubeMap>(value, name,
                              "a CubeMap (see cubecam.load_environment), a Probe or None");
}

/// What the environment of a node may be: also a PlanarMirror or a ProbeBlend.
using EnvironmentLike = OneOf<CubeMap, Probe, ProbeBlend, PlanarMirror, py::none>;

inline CubeSource to_environment_source(py::handle value, const char* name) {
    if (py::isinstance<PlanarMirror>(value)) return py::cast<std::shared_ptr<PlanarMirror>>(value);
    if (py::isinstance<ProbeBlend>(value)) return py::cast<std::shared_ptr<ProbeBlend>>(value);
    if (value.is_none()) return {};
    if (py::isinstance<Probe>(value)) return py::cast<std::shared_ptr<Probe>>(value);
    return to_shared<CubeMap>(value, name,
                              "a CubeMap (see cubecam.load_environment), a Probe, a ProbeBlend, a "
                              "PlanarMirror or None");
}

inline py::object from_cube_source(const CubeSource& source) {
    if (const auto* cube = std::get_if<std::shared_ptr<CubeMap>>(&source)) return py::cast(*cube);
    if (const auto* probe = std::get_if<std::shared_ptr<Probe>>(&source)) return py::cast(*probe);
    if (const auto* mirror = std::get_if<std::shared_ptr<PlanarMirror>>(&source)) {
        return py::cast(*mirror);
    }
    if (const auto* blend = std::get_if<std::shared_ptr<ProbeBlend>>(&source)) {
        return py::cast(*blend);
    }
    return py::none();
}

}  // namespace cubecam::bindings
