"""Scenes as plain data: what is read, what is refused, and blending and backgrounds as the renderer shows them."""

import pickle
import re

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.scene.records import BlendRecord
from cubecam.truth.scene.snapshot import read
from cubecam.truth.shading import Directional, Point, Spot, normalised
from tests.gl.bent import Bent
from tests.gl.world import smooth_environment
from tests.reference import transforms as ref
from tests.truth.rays import FRONT as CAMERA
from tests.truth.rays import materials_of, one


def test_records_say_what_nodes_are():
    scene = cc.Scene()
    group = scene.add(cast_shadow=False, in_captures=False)
    under = scene.add(cc.Mesh.box(1), cc.MirrorMaterial(double_sided=True), parent=group, label=7)
    scene.add(cc.Mesh.box(1), cc.PhongMaterial(), visible=False)
    hidden = scene.add(visible=False)
    scene.add(cc.Mesh.box(1), cc.PhongMaterial(), parent=hidden)
    pane = scene.add(
        cc.Mesh.box(1),
        cc.PhongMaterial(color=(1, 1, 1, 0.5), opacity=0.5),
        scale=(1, -2, 3),
        receive_shadow=False,
    )
    found = read(scene, exclude=[group])
    assert [node.id for node in found.nodes] == [under.id, pane.id]
    first, last = found.nodes
    assert (first.kind, first.label, first.double_sided) == ("mirror", 7, True)
    assert (first.casts_shadow, first.in_captures, first.visible) == (False, False, False)
    assert (last.kind, last.label, last.double_sided) == ("phong", 0, False)
    assert (last.casts_shadow, last.in_captures, last.visible) == (False, True, True)
    assert (first.receive_shadow, last.receive_shadow) == (True, False)
    assert first.blend is None
    assert last.blend == BlendRecord("alpha")
    assert last.opacity == 0.25
    assert last.scale.tolist() == [1, 2, 3]
    assert len(found.corners) == len(found.node) == 24
    assert read(cc.Scene()).corners.shape == (0, 3, 3)


def test_a_snapshot_is_plain_data(rng):
    scene, node = one(
        cc.StandardMaterial(map=rng.random((4, 4, 3)), normal_map=rng.random((2, 2, 3)))
    )
    scene.environment = cc.CubeMap(smooth_environment(4))
    node.environment = cc.CubeMap(smooth_environment(2))
    scene.add(cc.PointLight((1, 2, 3), shadow=True))
    before = read(scene)
    after = pickle.loads(pickle.dumps(before))
    for name in ("corners", "normals", "uvs", "tangents", "colors", "places", "node"):
        assert np.array_equal(getattr(before, name), getattr(after, name)), name
    place = np.array([[0.3, 0.4]])
    for name, lookup in materials_of(before)[0].maps.items():
        assert np.array_equal(lookup.at(place), materials_of(after)[0].maps[name].at(place))
    directions = np.array([[1, 2, 3.0]])
    for one_, other in zip(before.surroundings, after.surroundings, strict=True):
        assert np.array_equal(one_.at(directions), other.at(directions))
    scene.remove(node)
    assert len(read(scene).nodes) == 0
    assert len(before.nodes) == 1


def test_triangles_are_those_of_the_world(rng):
    for scale in ((1, 2, 0.5), (-1, 2, 0.5)):
        matrix = ref.trs((1, 2, 3), ref.axis_angle((1, 1, 0), 50), scale)
        mesh = cc.Mesh.box(1)
        scene = cc.Scene()
        scene.add(mesh, cc.StandardMaterial(anisotropy=0.5), matrix=matrix)
        found = read(scene)
        across = np.cross(
            found.corners[:, 1] - found.corners[:, 0], found.corners[:, 2] - found.corners[:, 0]
        )
        assert np.all((across * (found.corners.mean(axis=1) - (1, 2, 3))).sum(axis=1) > 0)
        assert np.all((found.normals * across[:, None]).sum(axis=2) > 0)
        want = ref.apply(matrix, found.places)
        np.testing.assert_allclose(found.corners, want, atol=1e-12)
        # The third direction of the frame runs along growing v, mirrored or not.
        edges = found.corners[:, 1:] - found.corners[:, :1]
        steps = found.uvs[:, 1:] - found.uvs[:, :1]
        along_v = np.linalg.solve(steps.astype(float), edges)[:, 1]
        third = np.cross(found.normals[:, 0], found.tangents[:, 0, :3]) * found.tangents[:, 0, 3:]
        assert np.all((third * along_v).sum(axis=1) > 0)


def test_flat_shading_has_the_normals_of_the_planes():
    scene = cc.Scene()
    scene.add(
        cc.Mesh.icosphere(1, subdivisions=1), cc.PhongMaterial(flat_shading=True), scale=(1, 2, 3)
    )
    found = read(scene)
    across = np.cross(
        found.corners[:, 1] - found.corners[:, 0], found.corners[:, 2] - found.corners[:, 0]
    )
    unit = normalised(found.normals)
    np.testing.assert_allclose(unit, np.repeat(normalised(across)[:, None], 3, 1), atol=1e-6)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("normals", [False, True])
def test_skins_and_weights_bend_meshes(rng, normals, mirrored):
    material = cc.StandardMaterial(anisotropy=0.3, double_sided=True)
    bent = Bent(rng, sets=2, normals=normals, material=material, place=(3, 1, 0))
    bent.pose(rng, mirrored=mirrored)
    found, want = read(bent.scene), read(bent.baked(material))
    np.testing.assert_allclose(found.corners, want.corners, atol=1e-5)
    np.testing.assert_allclose(normalised(found.normals), normalised(want.normals), atol=2e-4)
    np.testing.assert_allclose(found.uvs, want.uvs, atol=1e-6)
    np.testing.assert_allclose(found.colors, want.colors, atol=1e-6)
    if normals:  # else the renderer makes tangents before the joints move them
        np.testing.assert_allclose(found.tangents, want.tangents, atol=1e-3)
    origin = bent.nodes[0].world_matrix[:3, 3]
    np.testing.assert_allclose(found.places + origin, found.corners, atol=1e-5)
    assert np.allclose(found.nodes[0].scale, 1)


def test_a_skin_without_all_its_joints_does_not_count(rng):
    bent = Bent(rng, targets=0)
    bent.scene.remove(bent.nodes[-1])
    found = read(bent.scene)
    want = ref.apply(np.asarray(bent.node.world_matrix), bent.positions[bent.triangles])
    np.testing.assert_allclose(found.corners, want, atol=1e-6)


def test_variants_show_as_they_are_set():
    scene, node = one(cc.PhongMaterial(color=(1, 0, 0)))
    scene.variants = ["night"]
    node.variants = {"night": cc.BasicMaterial(color=(0, 0, 1))}
    assert read(scene).nodes[0].kind == "phong"
    scene.variant = "night"
    found = read(scene)
    assert found.nodes[0].kind == "basic"
    assert materials_of(found)[0].color.tolist() == [0, 0, 1, 1]


def test_lights_are_in_the_world():
    scene = cc.Scene()
    arm = scene.add(position=(1, 0, 0), rotation=cc.axis_angle((0, 0, 1), 90))
    scene.add(
        cc.PointLight((1, 0, 0), color=(1, 0.5, 0.25), intensity=3, decay=2, range=7, parent=arm)
    )
    scene.add(cc.DirectionalLight((1, 0, 0), shadow=True, parent=arm))
    scene.add(cc.SpotLight((0, 2, 0), (0, 0, -1), angle=20, penumbra=0.5, shadow=True))
    scene.add(cc.AmbientLight(color=(0.1, 0.2, 0.4), intensity=2))
    scene.add(cc.AmbientLight(color=(1, 0, 0), intensity=0.5))
    found = read(scene)
    point, sun, spot = found.lights
    assert isinstance(point, Point)
    np.testing.assert_allclose(point.position, (1, 1, 0), atol=1e-12)
    assert (point.color, point.intensity, point.decay, point.range) == ([1, 0.5, 0.25], 3, 2, 7)
    assert isinstance(sun, Directional)
    np.testing.assert_allclose(sun.travels, (0, 1, 0), atol=1e-12)
    assert isinstance(spot, Spot)
    assert (spot.position, spot.travels) == ([0, 2, 0], [0, 0, -1])
    assert (spot.angle, spot.penumbra, spot.decay, spot.range) == (20, 0.5, 0, np.inf)
    assert found.shadows == [False, True, True]
    np.testing.assert_allclose(found.ambient, (0.7, 0.4, 0.8), atol=1e-6)


REFUSED = {
    "material": cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(1.0); }"),
    "material.stencil": cc.PhongMaterial(stencil=cc.Stencil()),
    "material.depth_test": cc.PhongMaterial(depth_test=False),
    "material.color_write": cc.PhongMaterial(color_write=(True, True, False, True)),
    "material.depth_write": cc.PhongMaterial(depth_write=False),
    "material.cubemap": cc.BasicMaterial(cubemap=cc.Probe()),
    "material.blend.src": cc.PhongMaterial(blend=cc.Blend("dst_color", "zero")),
    "material.blend.dst": cc.PhongMaterial(blend=cc.Blend("one", "src_alpha_saturate")),
    "material.blend.src_alpha": cc.PhongMaterial(
        blend=cc.Blend("one", "one", src_alpha="dst_alpha")
    ),
    "material.blend.dst_alpha": cc.PhongMaterial(
        blend=cc.Blend("one", "one", dst_alpha="one_minus_dst_alpha")
    ),
    "material.blend.equation": cc.PhongMaterial(blend=cc.Blend("one", "one", equation="max")),
    "material.map": cc.PhongMaterial(map=cc.RenderTexture(cc.Scene(), CAMERA, name="screen")),
}


@pytest.mark.parametrize("place", REFUSED)
def test_what_rays_cannot_follow_is_refused_by_name(place):
    scene, node = one(REFUSED[place])
    with pytest.raises(ValueError, match=rf"^node 1 'wall', {re.escape(place)}: expected .*, got "):
        read(scene)
    node.visible = False
    assert read(scene).nodes == []


def test_a_translucent_surface_may_leave_depth_alone():
    scene, _ = one(cc.PhongMaterial(opacity=0.5, depth_write=False))
    assert read(scene).nodes[0].blend is not None


def test_render_textures_come_from_the_caller(rng):
    screen = cc.RenderTexture(cc.Scene(), CAMERA, wrap="mirror")
    scene, _ = one(cc.StandardMaterial(map=screen, roughness=0.5, emissive_map=screen))
    asked = []

    def picture(texture):
        asked.append(texture)
        return np.array([[[2.0, 0.5, 0.25, 1.0]]])

    found = read(scene, textures=picture)
    assert asked == [screen], "each texture is rendered once"
    record = materials_of(found)[0]
    assert record.maps["map"].wrap == ("mirror", "mirror")
    here = np.array([[0.5, 0.5]])
    assert record.maps["map"].at(here).tolist() == [[1, 0.5, 0.25, 1]], "rgba8 clips"
    half = read(scene, textures=lambda _: np.full((1, 1, 4), 128, np.uint8))
    decoded = ((128 / 255 + 0.055) / 1.055) ** 2.4
    np.testing.assert_allclose(
        materials_of(half)[0].maps["map"].at(here), [[decoded] * 3 + [128 / 255]]
    )
    screen.format = "rgba32f"
    assert materials_of(read(scene, textures=picture))[0].maps["map"].at(here)[0, 0] == 2
    screen.effects = [cc.ImageEffect("vec4 effect(vec2 uv) { return vec4(1.0); }")]
    with pytest.raises(
        ValueError, match=r"material\.map: expected a RenderTexture without effects"
    ):
        read(scene, textures=picture)


def test_maps_are_shown_where_meshes_have_the_uvs(rng):
    material = cc.StandardMaterial(
        map=rng.random((2, 2, 3)),
        metallic_roughness_map=cc.Texture(rng.random((2, 2, 3)), uv_set=1),
        normal_map=rng.random((2, 2, 3)),
        anisotropy=0.5,
    )
    plain = cc.Mesh.plane(1, 1)
    scene = cc.Scene()
    scene.add(cc.Mesh(plain.positions, plain.indices), material)
    scene.add(plain, material)
    scene.add(plain, material)
    scene.add(cc.Mesh(plain.positions, plain.indices, uvs=plain.uvs, uvs1=plain.uvs), material)
    found = read(scene)
    shown = [set(materials_of(found)[node.material].maps) for node in found.nodes]
    assert shown[0] == set()
    assert shown[1] == shown[2] == {"map", "normal_map"}
    assert shown[3] == {"map", "normal_map", "metallic_roughness_map"}
    assert len(found.materials) == 3
    assert [record.tangents for record in materials_of(found)] == [False, True, True]
