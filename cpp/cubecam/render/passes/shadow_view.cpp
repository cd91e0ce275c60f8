#include "cubecam/render/passes/shadow_view.hpp"

#include "cubecam/geometry/mesh_bounds.hpp"
#include "cubecam/math/cube_face.hpp"
#include "cubecam/math/transform.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cubecam {
namespace {

/// The border of a directional light's map: lookups beyond the map read its outermost texels, so
/// nothing is drawn there.
constexpr int empty_border = 1;

/// A margin round the casters, as a share of their size: surfaces on the border of the view must
/// not be clipped.
constexpr double room = 1e-3;

glm::dvec3 up_for(const glm::dvec3& forward) {
    return std::abs(forward.y) < 0.999 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
}

/// Converts GL's camera, which looks along -z, to axes whose z points away from the light.
glm::dmat4 z_forward(glm::dmat4 view) {
    for (int column = 0; column < 4; ++column) view[column].z = -view[column].z;
    return view;
}

/// Camera to clip; `half` is the tangent of half the angle. Without a far plane this is the limit
/// for an infinite one: the reversed depth is near / z, with the full precision of a float at every
/// distance.
glm::dmat4 lens(double half, double near, const std::optional<double>& far) {
    glm::dmat4 m(0.0);
    m[0][0] = m[1][1] = 1.0 / half;
    m[2][2] = far ? -(*far + near) / (*far - near) : -1.0;
    m[2][3] = -1.0;
    m[3][2] = far ? -2.0 * *far * near / (*far - near) : -2.0 * near;
    return m;
}

/// The lens of spot and point lights, `half` the tangent of half the angle that they light.
glm::dmat4 bordered_lens(ShadowView& made, double half, const Shadow& shadow) {
    const double border = border_of(shadow);
    half *= shadow.size / (shadow.size - 2.0 * border);
    made.texels = 0.5 * shadow.size / half;
    made.near = shadow.near;
    made.offset = shadow.far ? -shadow.near / (*shadow.far - shadow.near) : 0.0;
    made.scale = shadow.far ? *shadow.far * shadow.near / (*shadow.far - shadow.near) : shadow.near;
    return lens(half, shadow.near, shadow.far);
}

ShadowView view_of(const PointParameters& light, const Shadow& shadow, const SceneSnapshot&) {
    ShadowView made;
    made.kind = ShadowView::Kind::cube;
    const glm::dmat4 projection = bordered_lens(made, 1.0, shadow);
    for (const Face face : all_faces) {
        View view = camera_view(
            {look_along(light.position, glm::dvec3(face_forward(face)), glm::dvec3(face_up(face))),
             projection});
        view.position = light.position;  // exactly, not from an inverse matrix
        made.views.push_back(view);
    }
    made.to_light = glm::dmat4(1.0);
    made.to_light[3] = glm::dvec4(-light.position, 1.0);
    return made;
}

ShadowView view_of(const SpotParameters& light, const Shadow& shadow, const SceneSnapshot&) {
    ShadowView made;
    made.kind = ShadowView::Kind::single;
    const glm::dmat4 projection = bordered_lens(made, std::tan(radians(light.angle)), shadow);
    View view = camera_view(
        {look_along(light.position, light.direction, up_for(light.direction)), projection});
    view.position = light.position;
    made.to_light = z_forward(view.view);
    made.views.push_back(view);
    return made;
}

/// The box round all casters, in the axes to which `turn` converts the world's.
Bounds casters_bounds(const SceneSnapshot& scene, const glm::dmat4& turn) {
    Bounds all = no_bounds();
    for (const NodeSnapshot& node : scene.nodes) {
        if (!casts_shadow(node)) continue;
        // This box is tighter than one round the node's box in the world.
        all = united(all, transformed(node.mesh->bounds(), turn * node.world));
    }
    return is_empty(all) ? Bounds{glm::dvec3(-0.5), glm::dvec3(0.5)} : all;
}

ShadowView view_of(const DirectionalParameters& light, const Shadow& shadow,
                   const SceneSnapshot& scene) {
    const glm::dmat4 turn =
        z_forward(look_along(glm::dvec3(0.0), light.direction, up_for(light.direction)));
    const Bounds bounds = casters_bounds(scene, turn);
    const glm::dvec3 extent = bounds.extent();
    // A single flat caster, seen from its edge, has an extent of 0.
    const double least = std::max({extent.x, extent.y, extent.z, 1e-30}) * room;
    double width = shadow.extent.value_or(std::max(extent.x, extent.y) + 2.0 * least);
    width *= shadow.size / (shadow.size - 2.0 * empty_border);
    const double depth = extent.z + 2.0 * least;

    // The view's position is in the middle of the near plane.
    const glm::dvec3 center = bounds.center();
    const glm::dvec3 place(center.x, center.y, bounds.low.z - least);
    const glm::dvec3 position(glm::transpose(turn) * glm::dvec4(place, 0.0));

    ShadowView made;
    made.kind = ShadowView::Kind::parallel;
    View view = camera_view({look_along(position, light.direction, up_for(light.direction)),
                             orthographic(width, 1.0, 0.0, depth)});
    view.position = position;
    made.to_light = z_forward(view.view);
    made.views.push_back(view);
    made.offset = 1.0;
    made.scale = -1.0 / depth;
    made.texels = shadow.size / width;
    made.near = least;
    return made;
}

ShadowView view_of(const AmbientParameters&, const Shadow&, const SceneSnapshot&) { return {}; }

}  // namespace

ShadowView shadow_view(const LightValue& light, const SceneSnapshot& scene) {
    return std::visit(
        [&](const auto& parameters) { return view_of(parameters, *light.shadow, scene); },
        light.parameters);
}

}  // namespace cubecam
