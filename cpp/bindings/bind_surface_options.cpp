// The options that every material has, as properties of cubecam.Material.
#include "surface_options.hpp"
#include "vectors.hpp"

namespace cubecam::bindings {

namespace {

template <class Get, class Set>
void surface_property(Class<Material>& material, const char* name, Get get, Set set,
                      const char* doc) {
    material.def_property(
        name, [get](const Material& self) { return get(self.value().surface); }, set, doc);
}

template <class Change>
void edit_surface(Material& material, Change change) {
    material.edit([&](MaterialValue& next) { change(next.surface); });
}

}  // namespace

void bind_surface_options(Class<Material>& material) {
    material.def_property(
        "name", &Material::name, [](Material& self, const Text& value) { self.set_name(value); },
        "str: a name for people, empty by default; no picture depends on it, and "
        "it need not be unique.");
    surface_property(
        material, "opacity", [](const SurfaceOptions& s) { return shortest(s.opacity); },
        [](Material& self, Strict<float> value) {
            edit_surface(self, [&](SurfaceOptions& s) { s.opacity = value; });
        },
        "float: from 0 to 1; multiplies the alpha of the colours.");
    surface_property(
        material, "double_sided", [](const SurfaceOptions& s) { return s.double_sided; },
        [](Material& self, Flag value) {
            edit_surface(self, [&](SurfaceOptions& s) { s.double_sided = value; });
        },
        "bool: True shows both sides, with the normal turned to the viewer; False culls back "
        "faces.");
    surface_property(
        material, "blend", [](const SurfaceOptions& s) { return from_blend(s); },
        [](Material& self, const BlendLike& value) {
            edit_surface(self, [&](SurfaceOptions& s) { set_blend(s, value); });
        },
        "str, Blend or None: how the material is combined with the picture: \"opaque\", \"alpha\", "
        "\"alpha_keep\", \"additive\", \"multiply\", \"premultiplied\" or a `Blend`; see "
        "`Material`. "
        "None: \"alpha\" if any part of the material is translucent, else \"opaque\".");
    surface_property(
        material, "depth_write",
        [](const SurfaceOptions& s) -> DepthWriteLike {
            return s.depth_write ? py::object(py::bool_(*s.depth_write)) : py::none();
        },
        [](Material& self, const DepthWriteLike& value) {
            const auto write = to_depth_write(value);
            edit_surface(self, [&](SurfaceOptions& s) { s.depth_write = write; });
        },
        "bool or None: whether the surface hides farther surfaces that are drawn after it. None: "
        "True "
        "if the blend is \"opaque\".");
    surface_property(
        material, "depth_test", [](const SurfaceOptions& s) { return s.depth_test; },
        [](Material& self, Flag value) {
            edit_surface(self, [&](SurfaceOptions& s) { s.depth_test = value; });
        },
        "bool: False: the surface is drawn over nearer ones, too.");
    surface_property(
        material, "color_write",
        [](const SurfaceOptions& s) -> py::typing::Tuple<bool, bool, bool, bool> {
            return from_color_write(s.color_write);
        },
        [](Material& self, const ColorWriteLike& value) {
            const glm::bvec4 write = to_color_write(value);
            edit_surface(self, [&](SurfaceOptions& s) { s.color_write = write; });
        },
        "tuple of bool: which of red, green, blue, alpha are written; one bool sets all four. "
        "Depth and the other outputs do not depend on this option.");
    surface_property(
        material, "stencil", [](const SurfaceOptions& s) { return from_stencil(s.stencil); },
        [](Material& self, const OrNone<Stencil>& value) {
            const auto stencil = to_stencil(value);
            edit_surface(self, [&](SurfaceOptions& s) { s.stencil = stencil; });
        },
        "Stencil or None: how the surface tests and changes the stencil buffer, if "
        "``depth_format`` "
        "has one. None: it does neither.");
    surface_property(
        material, "flat_shading", [](const SurfaceOptions& s) { return s.flat_shading; },
        [](Material& self, Flag value) {
            edit_surface(self, [&](SurfaceOptions& s) { s.flat_shading = value; });
        },
        "bool: True shows each triangle with the normal of its plane, as `Mesh.flat_shaded` has "
        "them.");
}

}  // namespace cubecam::bindings
