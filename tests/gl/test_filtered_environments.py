"""Lookups of an environment by roughness, and environments that a scene turns and scales, against numpy."""

import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.flat import flat_camera, quad
from tests.reference.cube_faces import face_uv_to_direction
from tests.reference.sampling import mip_levels, sample_faces
from tests.reference.transforms import rotation

WIDTH, HEIGHT = 24, 20
ROUGHNESSES = (0, 0.1, 0.2, 0.33, 0.5, 0.77, 1)


def random_cube(seed=0, size=32, channels=3, dtype=np.float32, **options):
    """Light between .05 and 20, or random counts."""
    rng = np.random.default_rng(seed)
    shape = (6, size, size, channels)
    if dtype == np.uint8:
        return cc.CubeMap(rng.integers(0, 256, shape, dtype=np.uint8), **options)
    return cc.CubeMap(np.exp(rng.uniform(-3, 3, shape)).astype(dtype), **options)


def directions():
    """Directions of any length for each pixel, (H, W, 3): random ones, and some at edges and corners of the cube."""
    rng = np.random.default_rng(5)
    found = rng.normal(size=(HEIGHT, WIDTH, 3)).astype(np.float32)
    edges = rng.choice([-1, 1], (6, WIDTH, 3)) * rng.uniform(0.97, 1, (6, WIDTH, 3))
    edges[:3, :, 1] *= rng.uniform(0, 1, (3, WIDTH))
    found[:6] = edges
    return found


DIRECTIONS = directions()


def looked_up(renderer, scene, expression, environment=None):
    """The value of a GLSL expression of the direction `d`, for each of DIRECTIONS."""
    source = f"""uniform sampler2D way;
    vec3 shade(Surface s) {{
        vec3 d = texelFetch(way, ivec2(gl_FragCoord.xy), 0).xyz;
        return {expression};
    }}"""
    node = scene.add(
        quad(WIDTH, HEIGHT),
        cc.ShaderMaterial(source, textures={"way": cc.Image(DIRECTIONS)}),
        environment=environment,
        position=(0, 0, 4.5),  # in front of everything else
    )
    frame = renderer.render(scene, flat_camera(WIDTH, HEIGHT), (WIDTH, HEIGHT), format="rgba32f")
    scene.remove(node)
    return frame.color[..., :3]


def filtered(levels, roughness, way=DIRECTIONS):
    """The lookup between the levels of evenly spaced roughnesses."""
    level = roughness * (len(levels) - 1)
    lower = min(int(level), len(levels) - 2)
    low, high = (sample_faces(levels[k], way) for k in (lower, lower + 1))
    return (low + (high - low) * (level - lower))[..., :3]


@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_a_lookup_by_roughness_lies_between_two_levels(any_path, roughness):
    cube = random_cube()
    got = looked_up(any_path, cc.Scene(environment=cube), f"environment_filtered(d, {roughness:f})")
    assert_close(got, filtered(cube.prefilter().levels, roughness), "filtered_lookup")


def test_roughness_0_is_the_cube_itself(any_path):
    scene = cc.Scene(environment=random_cube(mipmaps=True))
    got = looked_up(any_path, scene, "environment_filtered(d, 0.0)")
    assert_identical(got, looked_up(any_path, scene, "environment(d)"), across="programs")


def test_irradiance(any_path):
    cube = random_cube(1)
    got = looked_up(any_path, cc.Scene(environment=cube), "environment_irradiance(d)")
    assert_close(got, sample_faces(cube.irradiance().faces, DIRECTIONS), "filtered_lookup")


@pytest.mark.parametrize(
    ("channels", "dtype"), [(1, np.float32), (4, np.float32), (3, np.float16), (3, np.uint8)]
)
def test_cubes_of_every_type(renderer, channels, dtype):
    cube = random_cube(2, 16, channels, dtype)
    got = looked_up(renderer, cc.Scene(environment=cube), "environment_filtered(d, 0.6)")
    wide = cc.CubeMap(cube.faces / np.float32(255 if dtype == np.uint8 else 1))
    want = filtered(wide.prefilter().levels, 0.6)
    assert_close(got, np.broadcast_to(want, got.shape), "filtered_lookup")


def test_a_constant_environment_stays_constant_and_none_is_black(any_path):
    light = np.full((6, 8, 8, 3), [0.25, 1, 70], np.float32)
    for expression in ("environment_filtered(d, 0.7)", "environment_irradiance(d)"):
        got = looked_up(any_path, cc.Scene(environment=cc.CubeMap(light)), expression)
        assert_close(got, np.broadcast_to(light[0, 0, 0], got.shape), "filtered_lookup")
        assert not looked_up(any_path, cc.Scene(), expression).any()


@pytest.mark.parametrize("level", [0, 1, 2.4, 5, 9])
def test_a_level_by_its_number(renderer, level):
    cube = random_cube(3)
    both = f"environment_lod(d, {level:f}) + 0.0 * environment_irradiance(d)"
    got = looked_up(renderer, cc.Scene(environment=cube), both)
    want = filtered(cube.prefilter().levels, min(level / 5, 1))
    assert_close(got, want, "filtered_lookup")


def test_how_many_levels(renderer):
    scene = cc.Scene(environment=random_cube(3))
    count = "vec3(environment_levels())"
    assert looked_up(renderer, scene, count).max() == 1
    assert looked_up(renderer, scene, f"{count} + 0.0 * environment_irradiance(d)").max() == 6


def test_levels_that_a_cubemap_has_of_its_own(any_path):
    """They are used as they are, also by the words that otherwise see mipmaps."""
    cube = random_cube(4).prefilter(levels=4)
    scene = cc.Scene(environment=cube)
    for expression in ("environment_lod(d, 1.5)", "environment_filtered(d, 0.5)"):
        got = looked_up(any_path, scene, expression)
        assert any_path.stats.faces_filtered == 0
        assert_close(got, filtered(cube.levels, 0.5), "filtered_lookup")
    got = looked_up(any_path, scene, "environment_irradiance(d)")
    assert_close(got, sample_faces(cube.irradiance().faces, DIRECTIONS), "filtered_lookup")
    assert looked_up(any_path, scene, "vec3(environment_levels())").max() == 4


@pytest.mark.parametrize("mipmaps", [False, True])
@pytest.mark.parametrize("lod", [0, 1, 2, 4.5, 9])
def test_box_mipmaps_are_there_whether_the_cube_has_them_or_not(any_path, mipmaps, lod):
    cube = random_cube(5, mipmaps=mipmaps)
    expression = f"environment_mip(d, {lod:f}) + 0.0 * environment_size()"
    got = looked_up(any_path, cc.Scene(environment=cube), expression)
    levels = mip_levels(cube.faces)
    lower = min(int(lod), len(levels) - 1)
    low, high = (
        sample_faces(levels[min(k, len(levels) - 1)], DIRECTIONS) for k in (lower, lower + 1)
    )
    assert_close(got, low + (high - low) * min(lod - lower, 1), "filtered_lookup")
    assert looked_up(any_path, cc.Scene(environment=cube), "vec3(environment_size())").min() == 32


def test_the_table_of_reflection(renderer):
    got = looked_up(renderer, cc.Scene(), "vec3(brdf(clamp(abs(d.x), 0.0, 1.0), 0.3), 0.0)")
    n_dot_v = np.clip(np.abs(DIRECTIONS[..., 0]), 0, 1)
    assert_close(got[..., :2], cc.brdf(n_dot_v, np.full_like(n_dot_v, 0.3)), "lookup")


def test_too_many_textures_on_a_surface_are_an_error(fresh_renderer):
    picture = np.ones((2, 2, 4), np.float32)
    names = [name for name in dir(cc.StandardMaterial) if name == "map" or name.endswith("_map")]
    assert len(names) > 14
    material = cc.StandardMaterial()
    for name in names:
        setattr(material, name, picture)
    scene = cc.Scene(environment=random_cube(13, 8))
    scene.add(quad(), material)
    frame = fresh_renderer.render(scene, CAMERA, (8, 8))  # without shadows there is room
    assert frame.color.any()
    for k in range(16):
        scene.add(cc.DirectionalLight((k, -1, 0), shadow=cc.Shadow(size=12)))
    got = (
        rf"got {len(names) + 19}: {len(names)} of the material, 3 of the environment, 16 of shadows"
    )
    with pytest.raises(
        ValueError, match=f"StandardMaterial: expected at most .* textures .* {got}"
    ):
        fresh_renderer.render(scene, CAMERA, (8, 8))


@pytest.mark.parametrize("turned", [False, True], ids=["plain", "turned"])
def test_users_may_name_functions_as_the_library_names_its_own(renderer, turned):
    scene = cc.Scene(environment=random_cube(14, 8), environment_intensity=2 if turned else 1)
    want = looked_up(renderer, scene, "environment_filtered(d, 0.5) * (d.x > 0.0 ? 1.0 : 0.5)")
    names = ("in_cube", "with_intensity", "on_face", "place_in", "level_of")
    for name in names:
        source = f"""uniform sampler2D way;
        bool {name}(vec3 d) {{ return d.x > 0.0; }}
        vec3 shade(Surface s) {{
            vec3 d = texelFetch(way, ivec2(gl_FragCoord.xy), 0).xyz;
            return environment_filtered(d, 0.5) * ({name}(d) ? 1.0 : 0.5);
        }}"""
        material = cc.ShaderMaterial(source, textures={"way": cc.Image(DIRECTIONS)})
        node = scene.add(quad(WIDTH, HEIGHT), material, position=(0, 0, 4.5))
        frame = renderer.render(
            scene, flat_camera(WIDTH, HEIGHT), (WIDTH, HEIGHT), format="rgba32f"
        )
        scene.remove(node)
        assert_identical(frame.color[..., :3], want, across="programs")


# Only what changed is filtered.


def rough_scene(environment, **options):
    scene = cc.Scene(environment=environment, **options)
    for x, roughness in ((-1.1, 0.4), (0, 0.8), (1.1, 0)):
        glass = cc.GlassMaterial(roughness=roughness)
        scene.add(cc.Mesh.icosphere(0.5, subdivisions=3), glass, position=(x, 0, 0))
    return scene


CAMERA = cc.PerspectiveCamera(fov=40, position=(0, 0, 5), target=(0, 0, 0))


def drawn(renderer, scene):
    return renderer.render(scene, CAMERA, (48, 24), format="rgba32f").color


def test_only_changed_faces_are_filtered_again(new_renderer):
    cube = random_cube(6)
    scene, live = rough_scene(cube), new_renderer()
    drawn(live, scene)
    assert live.stats.faces_filtered == 6
    drawn(live, scene)
    assert live.stats.faces_filtered == 0
    for face, value in ((2, 50), (5, 0), (2, 1)):
        before = drawn(live, scene)
        cube.set_face(face, np.full((32, 32, 3), value, np.float32))
        got = drawn(live, scene)
        assert live.stats.faces_filtered == 1
        assert not np.array_equal(got, before)
        assert_identical(got, drawn(new_renderer(), scene))


def test_what_no_drawn_surface_needs_is_not_filtered(fresh_renderer):
    scene = rough_scene(random_cube(6))
    for node in scene.nodes[:2]:
        node.visible = False
    drawn(fresh_renderer, scene)
    assert fresh_renderer.stats.faces_filtered == 0
    scene.nodes[0].visible = True
    drawn(fresh_renderer, scene)
    assert fresh_renderer.stats.faces_filtered == 6


def test_infinite_light_gives_finite_levels(renderer):
    faces = np.ones((6, 8, 8, 3), np.float32)
    faces[0, 3, 3] = np.inf
    got = looked_up(renderer, cc.Scene(environment=cc.CubeMap(faces)), "environment_irradiance(d)")
    assert np.isfinite(got).all()


# The scene's environment, turned and scaled.

TURN = cc.axis_angle((1, -2, 0.5), 77)
MATRIX = rotation(TURN)[:3, :3]


def turned(way):
    """The directions in the cube that appear in the directions `way` of the world."""
    return way @ MATRIX


@pytest.mark.parametrize("mipmaps", [False, True])
def test_a_scene_turns_and_scales_its_environment(any_path, mipmaps):
    cube = random_cube(7, mipmaps=mipmaps)
    scene = cc.Scene(environment=cube, environment_intensity=2.5, environment_rotation=3 * TURN)
    want = 2.5 * sample_faces(cube.faces, turned(DIRECTIONS))
    got = looked_up(any_path, scene, "environment_lod(d, 0.0)")
    assert_close(got, want, "turned_lookup")
    got = looked_up(any_path, scene, "environment_mip(d, 0.0)")
    assert_close(got, want, "turned_lookup")
    levels = cube.prefilter().levels
    got = looked_up(any_path, scene, "environment_filtered(d, 0.5)")
    assert_close(got, 2.5 * filtered(levels, 0.5, turned(DIRECTIONS)), "turned_lookup")
    got = looked_up(any_path, scene, "environment_irradiance(d)")
    irradiance = cube.irradiance().faces
    assert_close(got, 2.5 * sample_faces(irradiance, turned(DIRECTIONS)), "turned_lookup")


def test_a_node_s_own_environment_and_a_background_stay_as_they_are(any_path):
    cube = random_cube(8)
    scene = cc.Scene(environment=cube, background=cube, environment_intensity=3)
    scene.environment_rotation = TURN
    own = looked_up(any_path, scene, "environment(d)", environment=cube)
    assert_close(own, sample_faces(cube.faces, DIRECTIONS), "lookup")
    background = any_path.capture(scene, size=16).faces[..., :3]
    plain = cc.Scene(background=cube)
    assert_identical(background, any_path.capture(plain, size=16).faces[..., :3])


def test_the_background_shows_what_mirrors_show(any_path):
    cube = random_cube(9)
    scene = cc.Scene(environment=cube, environment_intensity=0.5, environment_rotation=TURN)
    n = 16
    centers = (np.arange(n) + 0.5) / n
    way = np.stack([face_uv_to_direction(f, *np.meshgrid(centers, centers)) for f in range(6)])
    want = 0.5 * sample_faces(cube.faces, turned(way))
    captured = any_path.capture(scene, size=n)
    assert_close(captured.faces[..., :3], want, "turned_lookup")
    assert (captured.faces[..., 3] == 1).all()
    # A probe shows it, too, and is itself neither turned nor scaled again.
    probe = cc.Probe(size=n, format="rgba32f")
    got = looked_up(any_path, scene, "environment(d)", environment=probe)
    assert_close(got, sample_faces(captured.faces[..., :3], DIRECTIONS), "lookup")


def test_mirrors_and_glass_see_the_turned_environment(any_path):
    """A turned environment round a scene is that scene, turned, in the environment as it is."""
    cube = random_cube(10)
    here = rough_scene(cube, environment_rotation=TURN, environment_intensity=2)
    here.add(cc.Mesh.icosphere(0.4, subdivisions=3), cc.MirrorMaterial(), position=(0, 0.9, 0))
    back = TURN * [1, -1, -1, -1]
    there = cc.Scene(environment=cube)
    group = there.add(rotation=back)
    for node in here.nodes:
        there.add(node.mesh, node.material, position=node.position, parent=group)
    camera = cc.PerspectiveCamera(
        fov=40, position=MATRIX.T @ [0, 0, 5], target=(0, 0, 0), up=MATRIX.T @ [0, 1, 0]
    )
    got = drawn(any_path, here)[..., :3]
    want = any_path.render(there, camera, (48, 24), format="rgba32f").color[..., :3]
    assert np.quantile(np.abs(got / 2 - want) / want, 0.97) < 1e-3  # the rest is on silhouettes


@pytest.mark.parametrize("background", [None, (0, 0, 0, 1)])
def test_turning_draws_again_and_equal_values_do_not(fresh_renderer, renderer, background):
    scene = rough_scene(random_cube(11), background=background)
    scene.environment_rotation = TURN
    for name, value, views in (
        ("environment_intensity", 2, 1),
        ("environment_intensity", 2, 0),
        ("environment_rotation", TURN, 0),
        ("environment_rotation", (2, 0, 0, 0), 1),
        ("environment_rotation", (1, 0, 0, 0), 0),
        ("environment_intensity", 0, 1),
    ):
        setattr(scene, name, value)
        picture = drawn(fresh_renderer, scene)
        assert fresh_renderer.stats.views_drawn == views, name
        assert_identical(picture, renderer.render(scene, CAMERA, (48, 24), format="rgba32f").color)
    assert not picture[..., :3].any()
    assert fresh_renderer.stats.faces_filtered == 0


def test_nodes_of_one_look_with_and_without_the_turn_are_drawn_apart(any_path):
    """One has the environment of the scene, which is turned, one the same cube of its own."""
    cube = random_cube(12)
    scene = cc.Scene(environment=cube, environment_rotation=TURN, background=(0, 0, 0))
    ball, mirror = cc.Mesh.icosphere(0.5, subdivisions=3), cc.MirrorMaterial()
    scene.add(ball, mirror, position=(-0.7, 0, 0))
    other = scene.add(ball, mirror, position=(0.7, 0, 0), environment=cube)
    both = drawn(any_path, scene)
    other.visible = False
    assert_identical(drawn(any_path, scene)[:, :24], both[:, :24])
    scene.nodes[0].visible, other.visible = False, True
    assert_identical(drawn(any_path, scene)[:, 24:], both[:, 24:])
    scene.environment_rotation = (1, 0, 0, 0)
    assert_identical(drawn(any_path, scene)[:, 24:], both[:, 24:])


def test_properties_of_a_scene():
    scene = cc.Scene()
    assert scene.environment_intensity == 1
    assert scene.environment_rotation.tolist() == [1, 0, 0, 0]
    assert not scene.environment_rotation.flags.writeable
    scene.environment_intensity, scene.environment_rotation = 0.2, 2 * TURN
    again = pickle.loads(pickle.dumps(scene))
    assert again.environment_intensity == 0.2
    np.testing.assert_array_equal(again.environment_rotation, scene.environment_rotation)
    np.testing.assert_allclose(again.environment_rotation, TURN, atol=1e-15)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("environment_intensity", -0.1, "environment_intensity finite and not negative, got -0.1"),
        ("environment_intensity", np.nan, "environment_intensity finite"),
        ("environment_intensity", np.inf, "environment_intensity finite"),
        ("environment_rotation", (0, 0, 0, 0), "a rotation .* not all 0"),
        (
            "environment_rotation",
            (0, 90, 0),
            r"environment_rotation: expected a quaternion \(w, x, y, z\), as cc.axis_angle gives; got",
        ),
    ],
)
def test_bad_placings_are_errors(name, value, message):
    scene = cc.Scene()
    with pytest.raises(ValueError, match=message):
        setattr(scene, name, value)
    with pytest.raises(ValueError, match=message):
        cc.Scene(**{name: value})
    assert scene.environment_intensity == 1
    assert scene.environment_rotation.tolist() == [1, 0, 0, 0]


# Probes.


def room(rng, environment=None, **probe):
    """A room of bright boxes, with a probe that a rough ball in the middle looks up."""
    scene = cc.Scene(environment=environment)
    for _ in range(12):
        way = rng.normal(size=3)
        color = np.exp(rng.uniform(-2, 4, 3))
        scene.add(
            cc.Mesh.box(0.8), cc.BasicMaterial(color=color), position=3 * way / np.linalg.norm(way)
        )
    held = cc.Probe(**{"size": 16, "format": "rgba32f", **probe})
    scene.add(
        cc.Mesh.icosphere(0.5, subdivisions=3), cc.GlassMaterial(roughness=0.6), environment=held
    )
    return scene, held


@pytest.mark.parametrize("texels", ["rgba32f", "rgba16f", "rgba8"])
def test_a_probe_is_filtered_as_it_was_drawn(any_path, texels):
    scene, probe = room(np.random.default_rng(20), format=texels)
    drawn(any_path, scene)
    held = any_path.read_probe(probe)
    faces = held.faces / np.float32(255) if held.faces.dtype == np.uint8 else held.faces
    assert faces[..., :3].max() > (0.9 if texels == "rgba8" else 30)
    levels = cc.CubeMap(faces.astype(np.float32)).prefilter().levels
    for node in scene.nodes:
        node.in_captures = node.environment is None
    got = looked_up(any_path, scene, "environment_filtered(d, 0.5)", environment=probe)
    assert_close(got, filtered(levels, 0.5), "filtered_lookup")


def test_only_drawn_faces_of_a_probe_are_filtered(new_renderer):
    scene, _ = room(np.random.default_rng(21))
    live = new_renderer()
    drawn(live, scene)
    assert live.stats.faces_filtered == 6
    box = scene.add(cc.Mesh.box(0.2), cc.BasicMaterial(color=(9, 5, 1)), position=(0.2, 0.1, 2.5))
    drawn(live, scene)
    assert live.stats.faces_filtered == 1
    for step in range(5):
        box.position = (0.7 * step - 0.5, 0.1, 2.5)
        got = drawn(live, scene)
        faces = live.stats.views_drawn - 1
        assert live.stats.faces_filtered == faces
        assert 0 < faces < 3
        assert_identical(got, drawn(new_renderer(), scene))


@pytest.mark.parametrize("count", [1, 2, 5])
def test_faces_per_frame(new_renderer, count):
    scene, probe = room(np.random.default_rng(22))
    live = new_renderer()
    drawn(live, scene)
    probe.faces_per_frame = count
    scene.background = (0.3, 0.2, 0.1)
    seen: list[int] = []
    while len(seen) < 8:
        picture = drawn(live, scene)
        seen.append(live.stats.faces_filtered)
    assert sum(seen) == 6
    assert max(seen) == count
    # One face and six are captured by different programs.
    assert_identical(picture, drawn(new_renderer(), scene), across="programs")


def test_policies_keep_what_they_filtered(fresh_renderer):
    scene, probe = room(np.random.default_rng(23), update="manual")
    fresh_renderer.update_probes(scene)
    assert fresh_renderer.stats.faces_filtered == 0
    first = drawn(fresh_renderer, scene)
    assert fresh_renderer.stats.faces_filtered == 6
    scene.background = (0, 0, 1)
    second = drawn(fresh_renderer, scene)
    assert fresh_renderer.stats.faces_filtered == 0
    ball = np.abs(second - first).max(-1) == 0
    assert ball.sum() > 20
    probe.prefilter = True
    drawn(fresh_renderer, scene)
    assert fresh_renderer.stats.faces_filtered == 0
    fresh_renderer.update_probes(scene)
    assert fresh_renderer.stats.faces_filtered == 6


def test_a_probe_that_is_always_filtered(renderer):
    scene, probe = room(np.random.default_rng(24), prefilter=True)
    scene.remove(scene.nodes[-1])
    got = looked_up(renderer, scene, "environment_lod(d, 2.0)", environment=probe)
    assert renderer.stats.faces_filtered == 6
    levels = renderer.read_probe(probe).prefilter().levels
    assert_close(got, filtered(levels, 0.4), "filtered_lookup")
    probe.prefilter = None
    without = looked_up(renderer, scene, "environment_lod(d, 2.0)", environment=probe)
    assert_close(without, sample_faces(levels[0], DIRECTIONS)[..., :3], "filtered_lookup")


@pytest.mark.parametrize("mipmaps", [False, True])
def test_a_probe_that_is_never_filtered_shows_its_mipmaps(any_path, mipmaps):
    scene, probe = room(np.random.default_rng(25), prefilter=False, mipmaps=mipmaps)
    scene.remove(scene.nodes[-1])
    got = looked_up(any_path, scene, "environment_filtered(d, 0.5)", environment=probe)
    assert any_path.stats.faces_filtered == 0
    levels = mip_levels(any_path.read_probe(probe).faces[..., :3])
    if not mipmaps:
        levels = levels[:1]
    want = filtered(levels, 0.5) if mipmaps else sample_faces(levels[0], DIRECTIONS)
    assert_close(got, want, "filtered_lookup")
    got = looked_up(any_path, scene, "environment_irradiance(d)", environment=probe)
    assert_close(got, sample_faces(levels[-1], DIRECTIONS), "filtered_lookup")


def test_box_mipmaps_of_a_probe_follow_it(renderer):
    scene, probe = room(np.random.default_rng(26))
    scene.remove(scene.nodes[-1])
    for background in ((0, 0, 0), (1, 2, 3)):
        scene.background = (*background, 1)
        got = looked_up(renderer, scene, "environment_mip(d, 2.0)", environment=probe)
        levels = mip_levels(renderer.read_probe(probe).faces[..., :3])
        assert_close(got, sample_faces(levels[2], DIRECTIONS), "filtered_lookup")


def test_probes_in_a_circle_show_the_turned_environment(new_renderer):
    """Of two balls that see each other, each shows the scene's environment in the other's probe, filtered."""
    cube = random_cube(27)
    scene = cc.Scene(environment=cube, environment_rotation=TURN, environment_intensity=2)
    glass, ball = cc.GlassMaterial(roughness=0.5), cc.Mesh.icosphere(0.5, subdivisions=3)
    probes = []
    for x in (-0.8, 0.8):
        node = scene.add(ball, glass, position=(x, 0, 0))
        probes.append(cc.Probe(parent=node, size=16, format="rgba32f"))
        node.environment = probes[-1]
    renderer = new_renderer()
    picture = drawn(renderer, scene)
    held = [renderer.read_probe(probe).faces for probe in probes]
    assert_identical(picture, drawn(new_renderer(), scene))
    # The same from each probe's place, with the scene's environment on the other ball.
    for other, faces in ((1, held[0]), (0, held[1])):
        probe, scene.nodes[other].environment = scene.nodes[other].environment, None
        place = (-0.8 if other else 0.8, 0, 0)
        want = renderer.capture(scene, place, 16, exclude=[scene.nodes[1 - other]])
        assert_identical(faces, want.faces)
        scene.nodes[other].environment = probe


def test_two_renderers_layered_or_not_filter_the_same(shared_renderers):
    scene, _ = room(np.random.default_rng(28), environment=random_cube(28), format="rgba16f")
    scene.environment_rotation = TURN
    scene.add(
        cc.Mesh.box(0.4), cc.GlassMaterial(roughness=0.3, tint=(1, 1, 1, 0.5)), position=(1, 1, 0)
    )
    first = shared_renderers(None).capture(scene, (0, 0, 2), 16).faces
    assert_identical(
        first, shared_renderers(False).capture(scene, (0, 0, 2), 16).faces, across="programs"
    )


def test_a_probe_s_prefilter_is_a_property():
    probe = cc.Probe(prefilter=True)
    assert probe.prefilter is True
    assert pickle.loads(pickle.dumps(probe)).prefilter is True
    probe.prefilter = None
    assert cc.Probe().prefilter is None
    with pytest.raises(TypeError):
        probe.prefilter = "yes"  # type: ignore[assignment]


# Rough glass.


def test_rough_glass_is_its_formula(any_path):
    cube = random_cube(30)
    ior, roughness = 1.2, 0.5
    scene = cc.Scene(environment=cube)
    glass = cc.GlassMaterial(ior=ior, roughness=roughness, tint=(0.5, 0.7, 0.9))
    scene.add(cc.Mesh.icosphere(1, subdivisions=4), glass)
    outputs = ("position", "normal", "id")
    frame = any_path.render(scene, CAMERA, (64, 64), format="rgba32f", outputs=outputs)
    ball = frame.id == 1
    n = frame.normal[ball].astype(float)
    i = frame.position[ball] - [0, 0, 5]
    i /= np.linalg.norm(i, axis=-1, keepdims=True)
    front = -(i * n).sum(-1) > 0.2
    n, i = n[front], i[front]
    cos_i = -(i * n).sum(-1, keepdims=True)
    cos_t = np.sqrt(1 - (1 - cos_i**2) / ior**2)
    refracted = i / ior + (cos_i / ior - cos_t) * n
    r_s = (cos_i / ior - cos_t) / (cos_i / ior + cos_t)
    r_p = (cos_i - cos_t / ior) / (cos_i + cos_t / ior)
    f = (r_s**2 + r_p**2) / 2
    a = roughness**2
    reflected = n + (i + 2 * cos_i * n - n) * (1 - a) * (np.sqrt(1 - a) + a)
    levels = cube.prefilter().levels
    passed = filtered(levels, roughness * (2 * ior - 2), refracted)
    want = f * filtered(levels, roughness, reflected) + (1 - f) * [0.5, 0.7, 0.9] * passed
    assert len(want) > 300
    assert_close(frame.color[ball][front][:, :3], want, "turned_lookup")


@pytest.mark.parametrize("roughness", [-0.1, 1.01, np.nan])
def test_a_bad_roughness_is_an_error(roughness):
    with pytest.raises(ValueError, match="roughness from 0 to 1"):
        cc.GlassMaterial(roughness=roughness)
