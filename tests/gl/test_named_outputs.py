"""Outputs that a ShaderMaterial declares of its own, against numpy."""

import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import OUTPUTS, World, perspective
from tests.reference.raycast import cast_cube, interior

SIZE = 48
HEAT = """
out vec4 heat;
out float level, /* two in one */ other;
// out vec4 none;
void helper(out float x) { x = 2.0; }
vec3 shade(Surface surface) {
    heat = vec4(surface.position, 2.0);
    helper(level);
    return surface.normal * 0.5 + 0.5;
}
"""
FLOW = """
out vec2 flow;
out vec3
    way;
vec4 shade(Surface surface) {
    flow = surface.position.xy * 10.0;
    way = surface.incident;
    return vec4(1.0);
}
"""


@pytest.fixture(scope="module")
def world():
    made = World()
    made.box((1.5, 1.2, 1), material=cc.ShaderMaterial(HEAT), position=(0.4, 0.1, -3))
    made.sphere(0.8, material=cc.ShaderMaterial(FLOW), position=(-1.2, 0.3, -3.5))
    made.box((1, 0.5, 0.5), (1, 0, 0), position=(0.3, 0.2, -1.8))
    return made


def expected(hits):
    """The values that the two sources write, and 0 where the visible node does not write an output."""
    heat = np.zeros((*hits.id.shape, 4))
    heat[..., :3] = hits.position
    heat[..., 3] = 2
    flow = hits.position[..., :2] * 10
    return {
        "heat": np.where((hits.id == 1)[..., None], heat, 0),
        "level": np.where(hits.id == 1, 2.0, 0.0),
        "other": np.zeros(hits.id.shape),
        "flow": np.where((hits.id == 2)[..., None], flow, 0),
        "way": np.where((hits.id == 2)[..., None], hits.position / hits.distance[..., None], 0),
    }


@pytest.mark.parametrize("samples", [1, 4])
def test_captures(any_path, world, samples):
    hits = cast_cube(world.shapes, (0, 0, 0), SIZE)
    values = expected(hits)
    cube = any_path.capture(
        world.scene, size=SIZE, samples=samples, outputs=("id", "heat", "level", "flow")
    )
    assert list(cube.outputs) == ["id", "flow", "heat", "level"]
    mask = interior(hits.id)
    assert_close(cube.id, hits.id, "exact", mask=mask)
    assert set(np.unique(hits.id[mask])) == {0, 1, 2, 3}
    for name in ("heat", "level", "flow"):
        got = cube.outputs[name]
        assert got.dtype == np.float32
        assert not got.flags.writeable
        assert_close(got, values[name], "distance", mask=mask, name=name)


@pytest.mark.parametrize("samples", [1, 4])
def test_frames(any_path, world, samples):
    view = perspective((0, 0, 0.5), (0, 0, -3), size=(40, 24))
    hits = view.hits(world.shapes)
    values = expected(hits)
    values["way"] = np.where((hits.id == 2)[..., None], view.directions(), 0)
    frame = any_path.render(
        world.scene, view.camera, view.size, samples=samples, outputs=("way", "heat", "other")
    )
    assert list(frame.outputs) == ["heat", "other", "way"]
    mask = interior(hits.id)
    for name, values_there in frame.outputs.items():
        assert values_there.dtype == np.float32
        assert values_there.flags.writeable
        assert_close(values_there, values[name], "distance", mask=mask, name=name)


def test_they_leave_color_and_the_other_outputs_as_they_are(any_path, world):
    names = OUTPUTS[1:]  # with colour, all of them and two more are too many for the driver
    plain = any_path.capture(world.scene, size=SIZE, outputs=names)
    more = any_path.capture(world.scene, size=SIZE, outputs=(*names, "heat", "flow"))
    assert_identical(plain.faces, more.faces, across="programs")
    for name in names:
        assert_identical(getattr(plain, name), getattr(more, name), name, across="programs")


def test_layered_and_one_pass_are_equal(new_renderer, world):
    names = ("heat", "flow", "level", "way")
    a, b = (
        new_renderer(layered=layered).capture(world.scene, size=SIZE, outputs=names)
        for layered in (True, False)
    )
    for name in names:
        assert_identical(a.outputs[name], b.outputs[name], name, across="programs")


def test_incremental_equals_from_scratch(new_renderer):
    world = World()
    node = world.box(1, material=cc.ShaderMaterial(HEAT), position=(0, 0, -3))
    world.box(0.5, position=(0.2, 0.1, -2))
    kept = new_renderer()
    kept.capture(world.scene, size=SIZE, outputs=("heat",))
    for x in (0.2, -0.3):
        node.position = (x, 0.1, -2.6)
        got = kept.capture(world.scene, size=SIZE, outputs=("heat",))
        fresh = new_renderer().capture(world.scene, size=SIZE, outputs=("heat",))
        assert_identical(got.outputs["heat"], fresh.outputs["heat"])
        assert got.outputs["heat"].any()


def test_translucent_nodes_do_not_write_them(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.ShaderMaterial(HEAT, opacity=0.5), position=(0, 0, -3))
    cube = renderer.capture(scene, size=8, outputs=("heat",))
    assert cube.faces[5].any()
    assert not cube.outputs["heat"].any()


def test_a_node_in_front_hides_them(renderer, world):
    """The box of a plain material overwrites with 0 what was drawn before it."""
    hits = cast_cube(world.shapes, (0, 0, 0), SIZE)
    cube = renderer.capture(world.scene, size=SIZE, outputs=("heat",))
    plain = (hits.id == 3) & interior(hits.id)
    assert plain.sum() > 10
    assert not cube.outputs["heat"][plain].any()


def test_pictures_carry_them_along(renderer, world):
    cube = renderer.capture(world.scene, size=8, outputs=("heat", "level", "z"))
    again = pickle.loads(pickle.dumps(cube))
    assert again == cube
    assert list(again.outputs) == list(cube.outputs)
    assert_identical(again.outputs["heat"], cube.outputs["heat"])
    assert cube.copy() == cube
    frame = renderer.render(world.scene, cc.PerspectiveCamera(), (6, 4), outputs=("flow", "id"))
    again = pickle.loads(pickle.dumps(frame))
    assert_identical(again.outputs["flow"], frame.outputs["flow"])
    assert_identical(again.id, frame.id)


def test_pairs_of_a_stereo_camera_hold_them(renderer, world):
    eyes = [cc.PerspectiveCamera(position=(x, 0, 0.5), target=(0, 0, -3)) for x in (-0.1, 0.1)]
    camera = cc.StereoCamera(*eyes, layout="side_by_side")
    frame = renderer.render(world.scene, camera, (32, 16), outputs=("heat",))
    assert frame.outputs["heat"].shape == (16, 32, 4)
    left = renderer.render(world.scene, camera.left, (16, 16), outputs=("heat",))
    assert left.outputs["heat"].any()
    assert_identical(frame.outputs["heat"][:, :16], left.outputs["heat"])


def test_unknown_names_are_refused_with_the_known_ones(renderer, world):
    with pytest.raises(ValueError, match=r'expected "color", "distance".*"heat".*, got "cold"'):
        renderer.capture(world.scene, size=4, outputs=("cold",))
    with pytest.raises(ValueError, match=r'"stencil", or what the GLSL .* got "heat"'):
        renderer.capture(cc.Scene(), size=4, outputs=("heat",))


@pytest.mark.parametrize(
    ("declaration", "message"),
    [
        ("out int heat;", "expected outputs declared as `out vec4 name;`.*out int heat"),
        ("layout(location = 3) out vec4 heat;", "expected outputs declared as"),
        ("out vec4 heat[2];", "expected outputs declared as"),
        ("out Block { vec4 heat; };", "expected outputs declared as"),
        ("out vec4 distance;", 'a name that is not one of .* got "distance"'),
        ("out vec4 color;", 'a name that is not one of .* got "color"'),
    ],
)
def test_declarations_of_another_form_are_refused(renderer, declaration, message):
    scene = cc.Scene()
    source = declaration + "\nvec3 shade(Surface surface) { return vec3(1.0); }"
    scene.add(cc.Mesh.box(1), cc.ShaderMaterial(source), position=(0, 0, -2))
    with pytest.raises(ValueError, match=message):
        renderer.capture(scene, size=4)


def test_two_types_of_one_name_are_refused(renderer):
    scene = cc.Scene()
    for kind in ("vec4", "float"):
        source = f"out {kind} heat; vec3 shade(Surface surface) {{ return vec3(1.0); }}"
        scene.add(cc.Mesh.box(1), cc.ShaderMaterial(source), position=(0, 0, -2))
    with pytest.raises(ValueError, match='to declare "heat" with one type, got vec4 and float'):
        renderer.capture(scene, size=4, outputs=("heat",))


def test_more_than_the_driver_has_buffers_for_are_refused(renderer):
    names = [f"extra{i}" for i in range(20)]
    source = "".join(f"out float {name};\n" for name in names)
    scene = cc.Scene()
    scene.add(
        cc.Mesh.box(1), cc.ShaderMaterial(source + "vec3 shade(Surface s) { return vec3(1.0); }")
    )
    with pytest.raises(ValueError, match=r"outputs: expected at most \d+ .*DRAW_BUFFERS.*got 20"):
        renderer.capture(scene, size=4, outputs=names)
    # Outputs that are not requested are plain variables.
    renderer.capture(scene, size=4, outputs=names[:3])


def test_errors_name_the_users_own_lines(renderer):
    source = "out vec4\n  heat;\nvec3 shade(Surface surface) {\n  return nonsense;\n}\n"
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.ShaderMaterial(source), position=(0, 0, -2))
    with pytest.raises(cc.ShaderError, match=r"fragment:4|fragment.*line 4|4 \| "):
        renderer.capture(scene, size=4, outputs=("heat",))
