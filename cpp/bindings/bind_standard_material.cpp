// cubecam.StandardMaterial
#include "material_kind.hpp"

#include "cubecam/materials/standard.hpp"

namespace cubecam::bindings {

template <>
struct Conversion<SpecularMode> : ChoiceConversion<SpecularMode, specular_mode_names> {};

namespace {

constexpr const char* standard_doc =
    R"doc(The metallic-roughness material of glTF 2.0, with the KHR_materials extensions.

The model is that of glTF 2.0, section 3.9 and appendix B: a metal and a dielectric of GGX microfacets (D of
Trowbridge and Reitz, separable V of Smith, F of Schlick, alpha = roughness**2), mixed by `metallic`; the
dielectric has a Lambertian base. Above it lie, in this order, a thin film, sheen, emission and a clear coat.
The parameters, their ranges and most defaults are glTF's. Only `color`, `metallic` and `roughness` matter for
most materials; every other part costs nothing until it is used.

Light comes from the environment, which is that of the node, a CubeMap or a Probe, or else that of the scene,
filtered by roughness; and from lights. The unit of a `DirectionalLight` is lux and that of a `PointLight` or
`SpotLight` with ``decay=2`` is candela, as in KHR_lights_punctual: a white surface that faces one lux has the
radiance 1/pi. An `AmbientLight` acts as an environment of constant radiance.

A map is an Image, an array (H, W, C), a RenderTexture, or one of these with a place (`Texture`). Maps multiply
the parameter beside them, except those of normals and occlusion. Colours in maps of 8 bits (`map`,
`emissive_map`, `specular_color_map`, `sheen_color_map`) are sRGB and are decoded; all other maps and all
floats are linear. Maps are not shown on meshes without uvs.

Parameters
----------
color : array_like (3,) or (4,), or str
    Base colour, linear RGB or RGBA from 0 to 1: what a metal reflects head-on and a dielectric scatters; a CSS
    name or "#rrggbb" is sRGB and is decoded (3.9.2).
metallic : float
    From 0, a dielectric, to 1, a metal (3.9.2).
roughness : float
    From 0, a mirror, to 1 (3.9.2, B.2.3).
map : map, optional
    Times `color`, alpha included.
metallic_roughness_map : map, optional
    Green times `roughness`, blue times `metallic`.
normal_map : map, optional
    Normals in the tangent frame, x along growing u and y along growing v; 0 to 1 stands for -1 to 1 (3.9.3).
normal_scale : float
    Factor of the normals' x and y, finite.
occlusion_map : map, optional
    Red is the share of the light from all around, of the environment and of ambient lights, that reaches the
    surface; other lights and what shows through are not changed (3.9.3).
occlusion_strength : float
    From 0, no occlusion, to 1.
emissive : array_like (3,) or str
    Linear RGB of the radiance that the surface emits, not negative (3.9.3).
emissive_map : map, optional
    Times `emissive`.
emissive_strength : float
    Times `emissive`, not negative (KHR_materials_emissive_strength).
vertex_colors : bool
    Whether the mesh's colours multiply `color`, alpha included (3.9.2).
alpha_mode : {"opaque", "mask", "blend"} or None
    "opaque" ignores the alpha of colour, map and vertices; "mask" makes holes where it is below `alpha_cutoff`;
    "blend" blends the surface (3.9.4). None blends it if any alpha is below 1, as other materials do. `opacity`
    counts in all modes, and ``blend=`` decides how the surface is blended, if it is given. A blended surface
    multiplies all of its light by alpha, reflections included.
alpha_cutoff : float
    The smallest alpha that "mask" shows, not negative.
ior : float
    Index of refraction of the dielectric, at least 1; 0 stands for infinity (KHR_materials_ior).
specular_weight : float
    Strength of the dielectric's reflection, from 0 to 1 (KHR_materials_specular).
specular_map : map, optional
    Alpha times `specular_weight`.
specular_color : array_like (3,) or str
    Factor of the dielectric's reflectance seen head-on, not negative; the product ends at 1.
specular_color_map : map, optional
    Times `specular_color`.
clearcoat : float
    Share of a clear coat with an index of refraction of 1.5, from 0 to 1 (KHR_materials_clearcoat).
clearcoat_map : map, optional
    Red times `clearcoat`.
clearcoat_roughness : float
    Roughness of the coat, from 0 to 1.
clearcoat_roughness_map : map, optional
    Green times `clearcoat_roughness`.
clearcoat_normal_map : map, optional
    Normals of the coat. Without it the coat has the normals of the mesh.
clearcoat_normal_scale : float
    Factor of the coat's normals' x and y, finite.
sheen_color : array_like (3,) or str
    Linear RGB from 0 to 1 of fibres on the surface, as of velvet (KHR_materials_sheen).
sheen_color_map : map, optional
    Times `sheen_color`.
sheen_roughness : float
    How much the fibres spread, from 0 to 1.
sheen_roughness_map : map, optional
    Alpha times `sheen_roughness`.
iridescence : float
    Share of a thin film in which light interferes, from 0 to 1 (KHR_materials_iridescence).
iridescence_map : map, optional
    Red times `iridescence`.
iridescence_ior : float
    Index of refraction of the film, at least 1.
iridescence_thickness_min, iridescence_thickness_max : float
    Thickness of the film in nanometres where the map is 0 and 1, not negative; without a map it is the latter.
iridescence_thickness_map : map, optional
    Green goes from one thickness to the other.
anisotropy : float
    How much highlights are stretched, from 0 to 1 (KHR_materials_anisotropy).
anisotropy_rotation : float
    Direction of the stretch, degrees from the tangent towards the bitangent.
anisotropy_map : map, optional
    Red and green are a direction to be turned by `anisotropy_rotation`, 0 to 1 for -1 to 1; blue times
    `anisotropy`.
transmission : float
    Share of the light entering the dielectric that passes through it, times `color`, from 0 to 1
    (KHR_materials_transmission). The surface shows what lies behind.
transmission_map : map, optional
    Red times `transmission`.
thickness : float
    Thickness of the volume behind the surface, in the mesh's units, not negative; 0 is a thin wall, which bends
    no light (KHR_materials_volume).
thickness_map : map, optional
    Green times `thickness`.
attenuation_distance : float
    World units, above 0, after which white light in the volume has the colour `attenuation_color`.
attenuation_color : array_like (3,) or str
    Linear RGB from 0 to 1.
dispersion : float
    20 divided by the Abbe number, not negative: how far colours part in the volume (KHR_materials_dispersion).
unlit : bool
    Whether `color` times its map is all that shows (KHR_materials_unlit).
specular : {"levels", "sampled"}
    How the reflection of the environment is found. "levels": one lookup in the environment filtered by
    roughness, in the main direction of Lagarde and de Rousiers (2014), times the split sum of Karis (2013).
    "sampled": `specular_samples` directions by the visible normals of GGX (Dupuy and Benyoub 2023), looked up in
    box mipmaps (Krivanek and Colbert 2008): slower and closer to the exact integral. Clear coats always use the
    levels.
specular_samples : int
    From 1 to 1024: 16 leave an error of about 12 %, 64 of 5 %.
multiple_scattering : bool
    Whether the light that rough surfaces scatter more than once is added (Fdez-Aguera 2019); it is lost
    otherwise. Lights with a place or direction are not changed.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
    The options of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite, or a name that is not in the list.
TypeError
    For a map of another type.

Notes
-----
Where glTF leaves a choice: lights see a roughness of at least 1/32, since a lamp of no size would be infinitely
bright in a smooth mirror. The light of lights that passes through a transmissive surface is left out.

Examples
--------
>>> import cubecam as cc
>>> gold = cc.StandardMaterial(color=(1, .77, .34), roughness=.3)
>>> gold.metallic, gold.roughness, gold.alpha_mode
(1.0, 0.3, None)
>>> cc.StandardMaterial(color="red", metallic=0, roughness=.5, clearcoat=1)
StandardMaterial(color=(1, 0, 0, 1), metallic=0.0, roughness=0.5, clearcoat=1.0)
)doc";

const MaterialBinding standard(Standard::name, [](py::module_& module) {
    bind_material_kind<Standard>(module, standard_doc);
});

}  // namespace

}  // namespace cubecam::bindings
