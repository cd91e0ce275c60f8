"""Points of surfaces: frames, normal maps and other maps as the renderer and the specification have them."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.scene.snapshot import read
from cubecam.truth.shading import normalised, phong, reflect
from cubecam.truth.shading.standard.material import anisotropy_direction, mapped_normal
from cubecam.truth.surfaces.colors import phong_parameters, standard_point, surface_points
from cubecam.truth.surfaces.geometry import Geometry
from tests.compare import assert_close
from tests.gl.world import smooth_environment
from tests.reference.raycast import interior
from tests.truth.rays import random_directions, seen

SIZE = (64, 48)
CAMERA = cc.PerspectiveCamera(position=(0.2, 0.3, 2.5), target=(0, 0.1, 0))


def points_of(scene):
    snapshot, hits, origins, directions = seen(scene, CAMERA, SIZE)
    return snapshot, surface_points(snapshot, hits, directions, origins)


@pytest.mark.parametrize("from_behind", [False, True])
@pytest.mark.parametrize("scale", [1, (-1, 1.2, 1)])
@pytest.mark.parametrize("name", ["normal_map", "clearcoat_normal_map"])
def test_bumps_reflect_as_the_renderer_shows_them(renderer, rng, name, scale, from_behind):
    """A smooth metal or coat that shows a cube: what is seen tells the normal."""
    bumps = rng.uniform(0.3, 0.7, (6, 5, 3)).astype(np.float32)
    bumps[..., 2] = 1
    metal: dict[str, Any] = {
        "normal_map": bumps,
        "normal_scale": -0.8,
        "roughness": 0,
        "color": (1, 1, 1),
    }
    coat: dict[str, Any] = {
        "clearcoat_normal_map": cc.Texture(bumps, rotation=30),
        "clearcoat_normal_scale": 0.7,
        "clearcoat": 1,
        "color": (0, 0, 0),
        "metallic": 0,
        "roughness": 1,
        "specular_weight": 0,
    }
    chosen = metal if name == "normal_map" else coat
    cube = cc.CubeMap(smooth_environment(64))
    scene = cc.Scene(environment=cube, background=(0, 0, 0))
    turn = -120 if from_behind else 60
    scene.add(
        cc.Mesh.plane(2, 2),
        cc.StandardMaterial(double_sided=True, multiple_scattering=False, **chosen),
        rotation=cc.axis_angle((1, 0.1, 0.2), turn),
        scale=scale,
    )
    snapshot, points = points_of(scene)
    assert np.all(points.back == from_behind)
    _parameters, surface, _alpha = standard_point(snapshot, 0, points)
    n = surface.n if name == "normal_map" else surface.clearcoat_n
    assert 0.02 < np.abs(n - points.normal).max() < 1
    seen_light = cube.sample(reflect(-points.v, n)).astype(float)
    if name != "normal_map":
        cosine = np.clip((n * points.v).sum(axis=1, keepdims=True), 1e-4, 1)
        seen_light *= 0.04 + 0.96 * (1 - cosine) ** 5
    want = np.zeros((SIZE[0] * SIZE[1], 3))
    want[points.row] = seen_light
    frame = renderer.render(scene, CAMERA, SIZE, format="rgba32f")
    inside = np.zeros(len(want), bool)
    inside[points.row] = True
    inner = interior(inside.reshape(SIZE[1], SIZE[0]))
    assert_close(frame.color[..., :3], want.reshape(SIZE[1], SIZE[0], 3), "mirror", mask=inner)


MAPS = {
    "metallic_roughness_map": (("roughness", 1), ("metallic", 2)),
    "specular_map": (("specular_weight", 3),),
    "clearcoat_map": (("clearcoat", 0),),
    "clearcoat_roughness_map": (("clearcoat_roughness", 1),),
    "sheen_roughness_map": (("sheen_roughness", 3),),
    "iridescence_map": (("iridescence", 0),),
    "transmission_map": (("transmission", 0),),
    "thickness_map": (("thickness", 1),),
}
NUMBERS: dict[str, Any] = {
    "metallic": 0.8,
    "roughness": 0.9,
    "specular_weight": 0.7,
    "clearcoat": 0.6,
    "clearcoat_roughness": 0.5,
    "sheen_roughness": 0.4,
    "iridescence": 0.3,
    "transmission": 0.2,
    "thickness": 1.5,
}


def test_maps_multiply_what_stands_beside_them(rng):
    """Channels and factors by glTF 2.0 and the texts of its extensions."""
    texel = rng.uniform(0.2, 0.8, 4).astype(np.float32)
    picture = np.broadcast_to(texel, (1, 1, 4)).copy()
    colors: dict[str, Any] = {
        "specular_color": (0.5, 2, 1),
        "sheen_color": (0.2, 0.3, 0.4),
        "emissive": (3, 2, 1),
    }
    others = [f"{name}_map" for name in colors]
    names = [*MAPS, *others, "anisotropy_map", "iridescence_thickness_map"]
    maps: dict[str, Any] = dict.fromkeys(names, cc.Image(picture))
    scene = cc.Scene()
    scene.add(
        cc.Mesh.sphere(0.8),
        cc.StandardMaterial(
            **NUMBERS,
            **colors,
            **maps,
            anisotropy=0.5,
            anisotropy_rotation=40,
            iridescence_thickness_min=200,
            iridescence_thickness_max=500,
            attenuation_distance=3,
            attenuation_color=(0.1, 0.2, 0.3),
            emissive_strength=2,
            ior=1.4,
            dispersion=0.3,
        ),
        scale=(1, 2, 0.5),
    )
    snapshot, points = points_of(scene)
    parameters, surface, alpha = standard_point(snapshot, 0, points)
    for rows in MAPS.values():
        for name, channel in rows:
            want = np.full((len(points), 1), NUMBERS[name] * texel[channel])
            np.testing.assert_allclose(getattr(parameters, name), want, rtol=1e-6, err_msg=name)
    for name, own in colors.items():
        want = np.broadcast_to(np.array(own) * texel[:3], (len(points), 3))
        np.testing.assert_allclose(getattr(parameters, name), want, rtol=1e-6, err_msg=name)
    np.testing.assert_allclose(
        parameters.iridescence_thickness, np.full((len(points), 1), 200 + 300 * texel[1]), rtol=1e-6
    )
    np.testing.assert_allclose(parameters.anisotropy, np.full((len(points), 1), 0.5 * texel[2]))
    np.testing.assert_allclose(
        parameters.anisotropy_direction,
        np.broadcast_to(anisotropy_direction(40, texel), (len(points), 2)),
        atol=1e-6,
    )
    assert (parameters.ior, parameters.dispersion, parameters.emissive_strength) == (
        pytest.approx(1.4),
        pytest.approx(0.3),
        2,
    )
    assert parameters.attenuation_distance == 3
    np.testing.assert_allclose(parameters.attenuation_color, (0.1, 0.2, 0.3), rtol=1e-6)
    assert parameters.occlusion == 1
    assert np.all(surface.scale == (1, 2, 0.5))
    assert np.all(alpha == 1)
    along = points.tangent[:, :3]
    np.testing.assert_allclose(np.linalg.norm(along, axis=1), 1, rtol=1e-9)
    assert np.array_equal(surface.tangent, points.tangent)


def test_bumps_follow_the_specification(rng):
    texel = rng.random(3)
    scene = cc.Scene()
    material = cc.StandardMaterial(normal_map=np.full((1, 1, 3), texel), normal_scale=0.6)
    scene.add(cc.Mesh.torus(0.7, 0.3, 24, 12), material)
    snapshot, points = points_of(scene)
    _parameters, surface, _alpha = standard_point(snapshot, 0, points)
    want = mapped_normal(points.normal, points.tangent, np.float32(texel), 0.6)
    np.testing.assert_allclose(surface.n, want, atol=1e-6)
    assert np.array_equal(surface.clearcoat_n, points.normal)


@pytest.mark.parametrize(
    ("mode", "alpha"), [(None, 0.5), ("blend", 0.5), ("opaque", 1), ("mask", 1)]
)
def test_alpha_counts_as_the_mode_says(mode, alpha):
    scene = cc.Scene()
    picture = np.full((1, 1, 4), 0.5, np.float32)
    scene.add(
        cc.Mesh.box(1),
        cc.StandardMaterial(map=picture, alpha_mode=mode, color=(1, 1, 1, 0.8), alpha_cutoff=0.2),
    )
    snapshot, points = points_of(scene)
    assert len(points) > 100
    assert np.all(standard_point(snapshot, 0, points)[2] == alpha)
    assert snapshot.nodes[0].opacity == (np.float32(0.8) if mode in (None, "blend") else 1)


def test_a_mesh_without_uvs_stretches_no_highlight():
    scene = cc.Scene()
    plain = cc.Mesh.sphere(1)
    scene.add(cc.Mesh(plain.positions, plain.indices), cc.StandardMaterial(anisotropy=0.5))
    snapshot, points = points_of(scene)
    parameters, surface, _alpha = standard_point(snapshot, 0, points)
    assert parameters.anisotropy == 0
    assert np.all(surface.tangent == 0)


@pytest.mark.parametrize("double_sided", [False, True])
def test_phong_surfaces_are_shaded_as_the_renderer_shades_them(renderer, rng, double_sided):
    picture = rng.random((4, 4, 3)).astype(np.float32)
    scene = cc.Scene()
    mesh = cc.Mesh.torus(0.8, 0.3, 48, 24)
    mesh.colors = rng.uniform(0.5, 1, (len(mesh.positions), 3))
    material = cc.PhongMaterial(
        color=(0.9, 0.8, 0.7),
        ka=0.1,
        kd=0.6,
        ks=0.3,
        shininess=8,
        map=picture,
        vertex_colors=True,
        double_sided=double_sided,
    )
    scene.add(mesh, material, rotation=cc.axis_angle((1, 0.3, 0), 50), scale=(1, -1.3, 0.8))
    scene.add(cc.PointLight((2, 3, 4), color=(1, 0.9, 0.8), decay=1, intensity=3))
    scene.add(cc.DirectionalLight((0.3, -1, -0.5), color=(0.2, 0.3, 0.4)))
    snapshot, points = points_of(scene)
    p = phong_parameters(snapshot, 0, points)
    eye = np.asarray(CAMERA.position)
    want = np.zeros((SIZE[0] * SIZE[1], 3))
    want[points.row] = phong(
        points.position, points.normal, eye, p.color, snapshot.lights, p.ka, p.kd, p.ks, p.shininess
    )
    assert np.all(p.alpha == 1)
    frame = renderer.render(scene, CAMERA, SIZE, format="rgba32f", outputs=("distance",))
    covered = np.zeros(len(want), bool)
    steep = (points.normal * points.v).sum(axis=1) > 0.15
    covered[points.row[steep]] = True
    inner = interior(covered.reshape(SIZE[1], SIZE[0])) & covered.reshape(SIZE[1], SIZE[0])
    got = frame.color[..., :3][inner]
    assert len(got) > 300
    assert_close(got, want.reshape(SIZE[1], SIZE[0], 3)[inner], "phong")


def test_normals_of_no_length_stay_finite():
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.PhongMaterial(double_sided=True))
    snapshot, hits, origins, directions = seen(scene, CAMERA, SIZE)
    snapshot.normals[:] = 0  # as joints may leave them
    points = surface_points(snapshot, hits, directions, origins)
    assert len(points) > 100
    assert np.all(points.normal == 0)
    assert np.all(np.isfinite(points.lifted))
    np.testing.assert_allclose(np.linalg.norm(points.face_normal, axis=1), 1)


def test_lifted_points_lie_on_the_outside_of_the_rounded_surface(rng):
    scene = cc.Scene()
    scene.add(cc.Mesh.icosphere(1, subdivisions=2), cc.PhongMaterial(double_sided=True))
    scene.add(cc.Mesh.box(0.5), cc.PhongMaterial(), position=(3, 0, 0))
    snapshot = read(scene)
    geometry = Geometry(snapshot)
    directions = random_directions(rng, 2000)
    for origins in (-3 * directions, 0 * directions):
        hits = geometry.cast(origins, directions)
        points = surface_points(snapshot, hits, directions, origins)
        points = points.take(points.node == 0)
        assert len(points) > 1900
        depth = 1 - np.linalg.norm(points.position, axis=1)
        lift = 1 - np.linalg.norm(points.lifted, axis=1)
        assert depth.max() > 0.01
        if not points.back.any():
            # The planes that touch the corners lie outside of the ball, as far as the triangles lie inside.
            assert np.all(lift < 1e-6)
            assert np.all(lift > -1.01 * depth - 1e-6)
        else:
            assert np.array_equal(lift, depth), "from inside the ball is hollow: nothing is lifted"
        outwards = np.where(points.back, -1, 1)[:, None] * normalised(points.position)
        assert np.all((points.face_normal * outwards).sum(axis=1) > 0.9)
    hits = geometry.cast(np.full((1, 3), (3, 0, 4.0)), np.array([[0.01, 0.02, -1]]))
    box = surface_points(snapshot, hits, np.array([[0.01, 0.02, -1]]))
    np.testing.assert_allclose(box.lifted, box.position, atol=1e-12)
    np.testing.assert_allclose(box.position, [(3 + 0.0375, 0.075, 0.25)], atol=1e-12)
