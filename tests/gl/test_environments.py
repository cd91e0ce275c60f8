"""What a user's shader source can read about its environment: its levels, and where a probe captured it."""

import numpy as np
import pytest

import cubecam as cc

CAMERA = cc.PerspectiveCamera(fov=40, position=(0, 0, 4), target=(0, 0, 0))
SAY = """vec3 shade(Surface s) {
    return environment_is_local() ? environment_position() : vec3(-1.0, environment_levels(), 0.0);
}"""


def drawn(renderer, scene, size=(16, 16)):
    return renderer.render(scene, CAMERA, size, format="rgba32f").color[8, 8, :3]


def cube(mipmaps, size=8):
    faces = np.zeros((6, size, size, 3), np.float32)
    return cc.CubeMap(faces, mipmaps=mipmaps)


@pytest.mark.parametrize(
    ("environment", "levels"), [(None, 0), (cube(False), 1), (cube(True), 4), (cube(True, 5), 3)]
)
def test_levels_of_a_photograph(any_path, environment, levels):
    scene = cc.Scene(environment=environment, background=(0, 0, 0))
    scene.add(cc.Mesh.sphere(1), cc.ShaderMaterial(SAY))
    assert drawn(any_path, scene).tolist() == [-1, levels, 0]


@pytest.mark.parametrize(("mipmaps", "levels"), [(False, 1), (True, 5)])
def test_levels_of_a_probe(renderer, mipmaps, levels):
    scene = cc.Scene(background=(0, 0, 0))
    material = cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(environment_levels()); }")
    scene.add(cc.Mesh.sphere(1), material, environment=cc.Probe(size=16, mipmaps=mipmaps))
    assert drawn(renderer, scene).tolist() == [levels] * 3


def test_a_probe_says_where_it_is_and_follows(any_path):
    scene = cc.Scene(background=(0, 0, 0))
    carrier = scene.add(position=(1, 2, 3))
    probe = cc.Probe(position=(0.5, 0, 0), parent=carrier, size=8)
    scene.add(cc.Mesh.sphere(1), cc.ShaderMaterial(SAY), environment=probe)
    assert drawn(any_path, scene).tolist() == [1.5, 2, 3]
    carrier.position = (1e6, 0.25, -2)  # nothing that the probe sees changes
    np.testing.assert_array_equal(
        drawn(any_path, scene), np.array([1e6 + 0.5, 0.25, -2], np.float32)
    )


def test_a_probe_that_is_not_drawn_again_stays_where_it_was(fresh_renderer):
    """The reported position stays the place where the probe's contents were captured."""
    scene = cc.Scene(background=(0, 0, 0))
    probe = cc.Probe(position=(1, 0, 0), size=8, update="once")
    scene.add(cc.Mesh.sphere(1), cc.ShaderMaterial(SAY), environment=probe)
    assert drawn(fresh_renderer, scene).tolist() == [1, 0, 0]
    probe.position = (2, 0, 0)
    assert drawn(fresh_renderer, scene).tolist() == [1, 0, 0]
    fresh_renderer.update_probes(scene, probes=probe)
    assert drawn(fresh_renderer, scene).tolist() == [2, 0, 0]


def test_a_box_corrects_parallax(renderer):
    """A mirror looks up the point where the reflected ray meets a wall: the picture shows the walls' positions."""
    room = cc.Scene()
    walls = cc.ShaderMaterial("vec3 shade(Surface s) { return s.position; }", double_sided=True)
    room.add(cc.Mesh.box(8), walls)
    mirror = cc.ShaderMaterial("""vec3 shade(Surface s) {
        vec3 way = reflect(s.incident, s.normal);
        vec3 reach = (sign(way) * 4.0 - s.position) / way;
        vec3 met = s.position + way * min(reach.x, min(reach.y, reach.z));
        return environment(met - environment_position());
    }""")
    probe = cc.Probe(position=(1, -1.5, 2), size=256, format="rgba32f", near=0.01)
    room.add(cc.Mesh.icosphere(0.5, subdivisions=3), mirror, environment=probe)
    camera = cc.PerspectiveCamera(fov=20, position=(0.5, 0.5, 3), target=(0, 0, 0))
    frame = renderer.render(
        room, camera, (64, 64), format="rgba32f", outputs=("position", "normal", "id")
    )
    ball = frame.id == 2
    assert ball.sum() > 500
    point, normal = frame.position[ball], frame.normal[ball]
    incident = point - np.array([0.5, 0.5, 3])
    incident /= np.linalg.norm(incident, axis=1, keepdims=True)
    way = incident - 2 * (incident * normal).sum(1, keepdims=True) * normal
    expected = point + way * ((np.sign(way) * 4 - point) / way).min(1, keepdims=True)
    off = np.abs(frame.color[ball][:, :3] - expected).max(1)
    assert np.quantile(off, 0.9) < 0.02  # texels are 3 cm wide
    assert off.max() < 0.3  # where texels are seen at a slant
