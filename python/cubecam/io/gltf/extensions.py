"""The extensions of glTF that are known. A file that requires another one is refused (section 3.12)."""

from __future__ import annotations

from ..._core import MeshError
from .entries import Entry, shown

#: Those that change geometry, and are followed.
DRACO = "KHR_draco_mesh_compression"
MESHOPT = ("KHR_meshopt_compression", "EXT_meshopt_compression")
INSTANCING = "EXT_mesh_gpu_instancing"
VISIBILITY = "KHR_node_visibility"
GEOMETRY = frozenset({DRACO, *MESHOPT, INSTANCING, VISIBILITY, "KHR_mesh_quantization"})

#: Those that `load_scene` follows, besides those of geometry.
SCENE = frozenset(
    {
        "EXT_lights_image_based",
        "EXT_texture_webp",
        "KHR_lights_punctual",
        "KHR_materials_anisotropy",
        "KHR_materials_clearcoat",
        "KHR_materials_dispersion",
        "KHR_materials_emissive_strength",
        "KHR_materials_ior",
        "KHR_materials_iridescence",
        "KHR_materials_pbrSpecularGlossiness",
        "KHR_materials_sheen",
        "KHR_materials_specular",
        "KHR_materials_transmission",
        "KHR_materials_unlit",
        "KHR_materials_variants",
        "KHR_materials_volume",
        "KHR_texture_basisu",
        "KHR_texture_transform",
        "MSFT_texture_dds",
    }
)

#: Those that change no picture of a scene: metadata, sounds, what a user may click, coarser models.
SILENT = frozenset(
    {
        "AGI_stk_metadata",
        "EXT_feature_metadata",
        "EXT_instance_features",
        "EXT_mesh_features",
        "EXT_structural_metadata",
        "FB_geometry_metadata",
        "KHR_audio_emitter",
        "KHR_node_hoverability",
        "KHR_node_selectability",
        "KHR_xmp",
        "KHR_xmp_json_ld",
        "MSFT_lod",  # the nodes of the tree are the finest level
        "MSFT_packing_normalRoughnessMetallic",
        "MSFT_packing_occlusionRoughnessMetallic",
    }
)

#: Those that leave triangles where they are: looks, lights, metadata, behaviour.
HARMLESS = (
    SCENE
    | SILENT
    | {
        "ADOBE_materials_clearcoat_specular",
        "ADOBE_materials_clearcoat_tint",
        "ADOBE_materials_thin_transparency",
        "CESIUM_primitive_outline",
        "EXT_lights_ies",
        "EXT_texture_avif",
        "KHR_animation_pointer",
        "KHR_materials_diffuse_transmission",
        "KHR_materials_volume_scatter",
        "KHR_techniques_webgl",
        "NV_materials_mdl",
        "VRMC_materials_mtoon",
    }
)


def unread(tree: Entry) -> list[str]:
    """Return the names of the extensions that a file uses and `load_scene` does not follow.

    One that the file requires is a `MeshError`.
    """
    known = GEOMETRY | SCENE | SILENT
    for place, name in enumerate(tree.entries("extensionsRequired")):
        if name not in known:
            raise MeshError(
                f"extensionsRequired[{place}]: expected an extension that load_scene follows, got {name!a}"
            )
    names = [name for name in tree.entries("extensionsUsed") if isinstance(name, str)]
    return [name for name in dict.fromkeys(names) if name not in known]


def required(tree: Entry) -> frozenset[str]:
    """Return the names of the extensions that the file requires; one that is not known is a `MeshError`."""
    names = tree.entries("extensionsRequired")
    for place, name in enumerate(names):
        if not isinstance(name, str):
            raise MeshError(
                f"extensionsRequired[{place}]: expected the name of an extension, got {shown(name)}"
            )
        if name not in GEOMETRY and name not in HARMLESS:
            raise MeshError(
                f"extensionsRequired[{place}]: expected an extension that cubecam knows, got {name!a}"
            )
    return frozenset(names)
