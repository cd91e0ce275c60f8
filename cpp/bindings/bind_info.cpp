#include "info.hpp"
#include "objects.hpp"

#include "cubecam/render/renderer.hpp"

#include <pybind11/stl.h>

#include <string>

namespace cubecam {

namespace py = pybind11;

namespace {

std::string list(const std::vector<double>& numbers) {
    return py::repr(py::tuple(py::cast(numbers))).cast<std::string>();
}

}  // namespace

void bind_stats(py::module_& m) {
    bindings::declare<Stats>(
        m, "Stats", "What the last call of a renderer drew and skipped, and how long it took.")
        .def_readonly("views_drawn", &Stats::views_drawn,
                      "int: pictures drawn: frames, faces of captures, faces of probes, textures.")
        .def_readonly("views_skipped", &Stats::views_skipped,
                      "int: pictures that were up to date and not drawn again.")
        .def_readonly("draw_calls", &Stats::draw_calls, "int")
        .def_readonly("triangles", &Stats::triangles,
                      "int: triangles sent to the GPU, counted once for each view.")
        .def_readonly("triangles_skipped", &Stats::triangles_skipped,
                      "int: triangles of drawn meshes that were not sent, since they lie outside "
                      "of the part of the picture that was drawn; counted once for each view.\n\n"
                      "A large mesh (in software one of 2,000 triangles, on a GPU of 100,000) is "
                      "drawn in part where only a part of it shows in what changed, or in the "
                      "picture. The picture has the same bytes.")
        .def_readonly("triangles_simplified", &Stats::triangles_simplified,
                      "int: how many triangles the levels of detail that were drawn have fewer "
                      "than their meshes (``max_lod_error``); counted once for each view.")
        .def_readonly("probes_updated", &Stats::probes_updated,
                      "int: probes of which at least one face was drawn.")
        .def_readonly("textures_updated", &Stats::textures_updated,
                      "int: render textures that were drawn.")
        .def_readonly("shadow_views_drawn", &Stats::shadow_views_drawn,
                      "int: layers of shadow maps drawn: one for each directional and spot light, "
                      "six for a point light.")
        .def_readonly("faces_filtered", &Stats::faces_filtered,
                      "int: faces of cubemaps and probes that were filtered by roughness, since "
                      "they had changed.")
        .def_readonly("pictures_not_kept", &Stats::pictures_not_kept,
                      "int: frames and captures whose buffers take more than the renderer's "
                      "``cache_bytes``, so that the next call must draw them again.")
        .def_property_readonly(
            "bounce_changes",
            [](const Stats& s) -> py::typing::Tuple<py::float_, py::ellipsis> {
                return py::tuple(py::cast(s.bounce_changes));
            },
            "tuple of float: how much each bounce after the first changed what mirrors show.\n\n"
            "Entry i compares the picture of a probe with i + 2 bounces to that with i + 1: the "
            "root of the mean of the squared differences of red, green and blue, as the pictures "
            "hold them, in the directions of the texels of a cube of 32 texels an edge, over all "
            "probes that the call drew and of which it needed both pictures; nan if there is no "
            "such probe. Empty if no probe of more than one bounce was drawn.")
        .def_readonly("milliseconds", &Stats::milliseconds,
                      "float: time of the whole call, including the copy to main memory.")
        .def("__repr__", [](const Stats& s) {
            return "<cubecam.Stats views_drawn=" + std::to_string(s.views_drawn) +
                   " views_skipped=" + std::to_string(s.views_skipped) +
                   " draw_calls=" + std::to_string(s.draw_calls) +
                   " triangles=" + std::to_string(s.triangles) +
                   " triangles_skipped=" + std::to_string(s.triangles_skipped) +
                   " triangles_simplified=" + std::to_string(s.triangles_simplified) +
                   " probes_updated=" + std::to_string(s.probes_updated) +
                   " textures_updated=" + std::to_string(s.textures_updated) +
                   " shadow_views_drawn=" + std::to_string(s.shadow_views_drawn) +
                   " faces_filtered=" + std::to_string(s.faces_filtered) +
                   " pictures_not_kept=" + std::to_string(s.pictures_not_kept) +
                   (s.bounce_changes.empty() ? std::string()
                                             : " bounce_changes=" + list(s.bounce_changes)) +
                   " milliseconds=" + std::to_string(s.milliseconds) + ">";
        });
}

void bind_info(py::module_& m) {
    bindings::declare<gl::Limits>(m, "Limits", "The greatest values that the driver allows.")
        .def_readonly("max_texture_size", &gl::Limits::max_texture_size,
                      "int: pixels along a side of a texture.")
        .def_readonly("max_cube_map_texture_size", &gl::Limits::max_cube_map_texture_size,
                      "int: pixels along an edge of a face of a cubemap that is looked up.")
        .def_property_readonly(
            "max_frame_size",
            [](const gl::Limits& limits) { return gl::largest_side(limits, false).pixels; },
            "int: pixels along a side of a frame that can be drawn.")
        .def_property_readonly(
            "max_face_size",
            [](const gl::Limits& limits) { return gl::largest_side(limits, true).pixels; },
            "int: pixels along an edge of a face that can be captured; a driver may draw smaller "
            "ones than it looks up.")
        .def_readonly("max_array_texture_layers", &gl::Limits::max_array_texture_layers, "int")
        .def_readonly("max_samples", &gl::Limits::max_samples, "int: samples of each pixel (MSAA).")
        .def_readonly("max_color_attachments", &gl::Limits::max_color_attachments, "int");

    bindings::declare<RendererInfo>(m, "RendererInfo",
                                    "The device, driver and limits of a renderer.")
        .def_readonly("vendor", &RendererInfo::vendor, "str: GL_VENDOR.")
        .def_readonly("renderer", &RendererInfo::renderer, "str: GL_RENDERER.")
        .def_readonly("version", &RendererInfo::version, "str: GL_VERSION.")
        .def_readonly("glsl_version", &RendererInfo::glsl_version,
                      "str: GL_SHADING_LANGUAGE_VERSION.")
        .def_readonly("egl_version", &RendererInfo::egl_version, "str: EGL_VERSION.")
        .def_readonly("platform", &RendererInfo::platform,
                      "str: \"device\", \"surfaceless\" or \"default\".")
        .def_readonly("device", &RendererInfo::device, "Device: the device of the renderer.")
        .def_readonly("limits", &RendererInfo::limits, "Limits")
        .def_readonly("software", &RendererInfo::software,
                      "bool: whether the device renders on the CPU.")
        .def_readonly("layered", &RendererInfo::layered,
                      "bool: whether one draw call draws a mesh on all faces of a cube.")
        .def("__repr__", [](const RendererInfo& i) {
            return "<cubecam.RendererInfo " + i.renderer + ", OpenGL " + i.version + ", " +
                   i.platform + (i.software ? ", software>" : ">");
        });
}

}  // namespace cubecam
