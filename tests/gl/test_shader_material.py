"""Users' materials: the functions of the source against numpy, its inputs, its errors, its keys."""

import copy
import pathlib
import pickle

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.compare import assert_close, assert_identical
from tests.gl.world import World, inner_smooth, perspective, smooth_environment
from tests.reference.cube_faces import texel_directions
from tests.reference.sampling import sample_faces

UPRIGHT = cc.axis_angle((1, 0, 0), 90)
FRONT = cc.PerspectiveCamera(fov=20, target=(0, 0, -1))


def flat(renderer, material, size=4, **more):
    """Draw a wall that fills the picture, so that every pixel shows the material."""
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(20, 20), material, position=(0, 0, -2), rotation=UPRIGHT)
    return renderer.render(scene, FRONT, (size, size), format="rgba32f", **more).color


def constant(renderer, expression, declarations="", **inputs):
    """Return the colour that an expression gives, which is the same for all pixels."""
    source = f"{declarations}\nvec3 shade(Surface surface) {{ return vec3({expression}); }}"
    color = flat(renderer, cc.ShaderMaterial(source, **inputs))
    assert_identical(color, np.broadcast_to(color[0, 0], color.shape))
    return color[0, 0, :3]


# --- the functions that a source may call


def ball_world():
    world = World(cc.Scene(background=(0, 0, 0, 0)))
    world.sphere(
        0.8, subdivisions=3, position=(0.3, -0.1, 0.2), axis=(1, 2, 3), degrees=40, scale=1.2
    )
    return world


@pytest.mark.parametrize(
    ("field", "want"),
    [
        ("position", lambda hits, eye: hits.position),
        ("normal", lambda hits, eye: hits.normal),
        ("incident", lambda hits, eye: normalised(hits.position - eye)),
        ("position_object", lambda hits, eye: hits.local),
    ],
)
def test_fields_of_a_surface(any_path, field, want):
    world = ball_world()
    view = perspective((1, 2, 3), (0, 0, 0), fov=40, size=(48, 40))
    hits = view.hits(world.shapes)
    material = cc.ShaderMaterial(f"vec3 shade(Surface surface) {{ return surface.{field}; }}")
    world.scene.nodes[0].material = material
    got = any_path.render(world.scene, view.camera, view.size, format="rgba32f").color[..., :3]
    mask = inner_smooth(hits) & hits.hit
    expected = np.where(mask[..., None], want(hits, np.array([1, 2, 3])), 0)
    assert_close(np.where(mask[..., None], got, 0), expected, "position", mask, least=0.1)


def test_position_is_the_world_far_from_the_origin(renderer):
    scene = cc.Scene()
    far = np.array([5000.0, -300.0, 7000.0])
    source = "vec3 shade(Surface s) { return s.position; }"
    scene.add(cc.Mesh.box(1), cc.ShaderMaterial(source), position=far)
    camera = cc.PerspectiveCamera(fov=10, position=np.add(far, (0, 0, 4)), target=far)
    frame = renderer.render(scene, camera, (5, 5), format="rgba32f", outputs=("position",))
    assert_close(frame.color[..., :3], frame.position, "distance")


def test_uv_and_vertex_colors(renderer):
    quad = cc.Mesh(
        [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)],
        [(0, 1, 2), (0, 2, 3)],
        uvs=[(0, 0), (1, 0), (1, 1), (0, 1)],
        colors=[(1, 0, 0, 1), (1, 0, 0, 1), (0, 0, 1, 0.5), (0, 0, 1, 0.5)],
    )
    scene = cc.Scene()
    node = scene.add(quad, cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(s.uv, 0.0); }"))
    camera = cc.OrthographicCamera(height=2, position=(0, 0, 1))
    got = renderer.render(scene, camera, (8, 8), format="rgba32f").color
    centers = (np.arange(8) + 0.5) / 8
    assert_close(got[..., 0], np.broadcast_to(centers, (8, 8)), "shaded")
    assert_close(got[..., 1], np.broadcast_to(centers[::-1, None], (8, 8)), "shaded")
    node.material = cc.ShaderMaterial("vec3 shade(Surface s) { return s.color.rgb * s.color.a; }")
    got = renderer.render(scene, camera, (8, 8), format="rgba32f").color
    t = np.broadcast_to(centers[::-1, None], (8, 8))
    assert_close(got[..., 0], (1 - t) * (1 - t / 2), "shaded")
    node.mesh = cc.Mesh.box((2, 2, 0.1))
    got = renderer.render(scene, camera, (8, 8), format="rgba32f").color
    assert (got == 1).all(), "a mesh without colours is white"


def test_environment_is_the_nodes_own(any_path):
    cube = cc.CubeMap(smooth_environment(32))
    other = cc.CubeMap(np.zeros((6, 4, 4, 3), np.float32))
    source = "vec3 shade(Surface s) { return environment(reflect(s.incident, s.normal)); }"
    world = ball_world()
    world.scene.environment = other
    node = world.scene.nodes[0]
    node.material, node.environment = cc.ShaderMaterial(source), cube
    view = perspective((1, 2, 3), (0, 0, 0), fov=40, size=(48, 40))
    hits = view.hits(world.shapes)
    mask = inner_smooth(hits) & hits.hit
    got = any_path.render(world.scene, view.camera, view.size, format="rgba32f").color[..., :3]
    incident = normalised(hits.position[mask] - [1, 2, 3])
    want = np.zeros_like(got)
    want[mask] = sample_faces(cube.faces, shading.reflect(incident, hits.normal[mask]))[..., :3]
    assert_close(np.where(mask[..., None], got, 0), want, "mirror", mask, least=0.1)


LIGHTS = {
    "none": [],
    "point": [shading.Point((3, 4, 3), (1, 0.9, 0.7), 1.5)],
    "decay": [shading.Point((2, 3, 3), (1, 1, 1), 6, 2)],
    "directional": [shading.Directional((-1, -2, -1), (0.5, 0.7, 1))],
    "ambient": [shading.Ambient((0.4, 0.2, 0.1), 2)],
    "six": [shading.Point((i, 4 - i, 3), (0.3, 0.1 * i, 0.2)) for i in range(6)],
}


def product_light(light):
    if isinstance(light, shading.Point):
        return cc.PointLight(
            light.position, color=light.color, intensity=light.intensity, decay=light.decay
        )
    if isinstance(light, shading.Directional):
        return cc.DirectionalLight(light.travels, color=light.color, intensity=light.intensity)
    return cc.AmbientLight(color=light.color, intensity=light.intensity)


@pytest.mark.parametrize("lights", LIGHTS.values(), ids=LIGHTS)
def test_lights_against_numpy(any_path, lights):
    world = ball_world()
    for light in lights:
        world.scene.add(product_light(light))
    source = "vec3 shade(Surface s) { return phong(s, vec3(.9, .4, .2), .3, .6, .8, 7.0); }"
    world.scene.nodes[0].material = cc.ShaderMaterial(source)
    view = perspective((1, 2, 3), (0, 0, 0), fov=40, size=(48, 40))
    hits = view.hits(world.shapes)
    mask = inner_smooth(hits) & hits.hit
    got = any_path.render(world.scene, view.camera, view.size, format="rgba32f").color[..., :3]
    want = np.zeros_like(got)
    want[mask] = shading.phong(
        hits.position[mask],
        hits.normal[mask],
        (1, 2, 3),
        (0.9, 0.4, 0.2),
        lights,
        0.3,
        0.6,
        0.8,
        7.0,
    )
    assert_close(np.where(mask[..., None], got, 0), want, "phong", mask, least=0.1)


def test_a_lambert_of_ones_own_from_sampled_lights(renderer):
    scene = cc.Scene()
    scene.add(cc.PointLight((0, 0, 2), color=(1, 0.5, 0.25)))
    scene.add(cc.DirectionalLight((0, 0, -1), intensity=0.5))
    source = """
    vec3 shade(Surface s) {
        vec3 sum = vec3(0.0);
        for (int i = 0; i < light_count(); ++i) {
            LightSample light = sample_light(i, s);
            sum += max(dot(s.normal, light.direction), 0.0) * light.radiance;
        }
        return sum;
    }"""
    wall = scene.add(cc.Mesh.plane(8, 8), cc.ShaderMaterial(source), rotation=UPRIGHT)
    camera = cc.OrthographicCamera(height=4, position=(0, 0, 3))
    frame = renderer.render(scene, camera, (9, 9), format="rgba32f", outputs=("position",))
    to_light = np.array([0, 0, 2]) - frame.position
    cosine = 2 / np.linalg.norm(to_light, axis=-1, keepdims=True)
    assert wall.id == 1
    assert_close(frame.color[..., :3], cosine * (1, 0.5, 0.25) + 0.5, "phong")


def test_schlick_and_ambient(renderer):
    assert_close(constant(renderer, "schlick(surface, 0.25)"), [0.25] * 3, "shaded")
    assert constant(renderer, "ambient_light()").tolist() == [0, 0, 0]
    assert constant(renderer, "float(light_count())").tolist() == [0, 0, 0]


def test_ambient_light_is_the_sum_of_the_scenes_ambient_lights(renderer):
    def shown(expression):
        scene = cc.Scene()
        scene.add(cc.AmbientLight(color=(0.5, 0.25, 0), intensity=0.5))
        scene.add(cc.AmbientLight(color=(0, 0.5, 1)))
        source = f"vec3 shade(Surface surface) {{ return {expression}; }}"
        scene.add(cc.Mesh.plane(8, 8), cc.ShaderMaterial(source), rotation=UPRIGHT)
        camera = cc.OrthographicCamera(height=4, position=(0, 0, 3))
        return renderer.render(scene, camera, (3, 3), format="rgba32f").color[1, 1, :3]

    assert shown("ambient_light()").tolist() == [0.25, 0.625, 1]
    # The function phong() adds an ambient light of 1 itself.
    phong = shown("phong(surface, vec3(1.0, 0.5, 1.0), 0.5, 0.0, 0.0, 1.0)")
    assert_close(phong, 0.5 * np.array([1, 0.5, 1]) * (1 + np.array([0.25, 0.625, 1])), "phong")


@pytest.mark.parametrize(("level", "row", "column"), [(0, 2, 5), (1, 1, 2), (3, 0, 0)])
def test_a_level_of_the_environment_is_looked_up_in_its_direction(
    any_path, rng, level, row, column
):
    """A lookup in the middle of a level's texel gives that texel alone: the mean of its block in level 0."""
    faces = rng.random((6, 8, 8, 3)).astype(np.float32)
    size = 8 >> level
    want = faces.reshape(6, size, 8 // size, size, 8 // size, 3).mean((2, 4))[:, row, column]
    scene = cc.Scene(environment=cc.CubeMap(faces, mipmaps=True))
    source = """
    uniform vec3 direction; uniform float level;
    vec3 shade(Surface s) { return environment_lod(direction, level); }"""
    material = cc.ShaderMaterial(source, uniforms={"level": float(level)})
    scene.add(cc.Mesh.box(1), material, position=(0, 0, -3))
    for face, direction in enumerate(texel_directions(size)[:, row, column]):
        material.uniforms["direction"] = direction
        color = any_path.render(scene, FRONT, (1, 1), format="rgba32f").color[0, 0, :3]
        np.testing.assert_allclose(color, want[face], atol=2e-3)


@pytest.mark.parametrize("eye", [None, (2, -3, 5)])
def test_the_vertex_stage_knows_the_eye_of_a_capture(any_path, eye):
    source = "in vec3 seen_from; vec3 shade(Surface s) { return seen_from; }"
    vertex = "out vec3 seen_from; void vertex(inout Vertex v) { seen_from = eye_position(); }"
    scene = cc.Scene()
    scene.add(cc.Mesh.box(4), cc.ShaderMaterial(source, vertex=vertex, double_sided=True))
    position = (0.5, 0.25, -0.75)
    cube = any_path.capture(scene, position, 4, eye=eye)
    want = np.broadcast_to(np.array(position if eye is None else eye, np.float32), (6, 4, 4, 3))
    np.testing.assert_allclose(cube.faces[..., :3], want, atol=1e-5)


def test_matrices_and_eye(renderer):
    scene = cc.Scene()
    matrix = np.array([[2, 0.5, 0, 1], [0, 1, 0.25, 2], [0.5, 0, 1, 3], [0, 0, 0, 1.0]])
    source = """
    uniform int what;
    vec3 shade(Surface s) {
        if (what == 0) return (model_matrix() * vec4(s.position_object, 1.0)).xyz - s.position;
        if (what == 1) return eye_position();
        return normalize(normal_matrix() * s.normal_object) - s.normal;
    }"""
    material = cc.ShaderMaterial(source, uniforms={"what": 0})
    scene.add(cc.Mesh.icosphere(1), material, matrix=matrix)
    camera = cc.PerspectiveCamera(fov=20, position=(1, 2, 13), target=(1, 2, 3))
    for what, want in ((0, (0, 0, 0)), (1, (1, 2, 13)), (2, (0, 0, 0))):
        material.uniforms["what"] = what
        got = renderer.render(scene, camera, (9, 9), format="rgba32f").color
        assert got[4, 4, 3] == 1
        assert_close(got[3:6, 3:6, :3], np.broadcast_to(want, (3, 3, 3)), "normal")


# --- uniforms and textures

VALUES = [
    ("float", 0.625, "vec3(x)", [0.625] * 3),
    ("float", [0.5], "vec3(x)", [0.5] * 3),
    ("vec2", (1, 2), "vec3(x, 0)", [1, 2, 0]),
    ("vec3", (1, 2, 3), "x", [1, 2, 3]),
    ("vec4", (1, 2, 3, 4), "x.gba", [2, 3, 4]),
    ("int", -7, "vec3(x)", [-7] * 3),
    ("ivec3", (1, -2, 3), "vec3(x)", [1, -2, 3]),
    ("uint", 3_000_000_000, "vec3(x / 1000u, x % 1000u, 1)", [3e6, 0, 1]),
    ("uvec2", (4, 5), "vec3(x, 0)", [4, 5, 0]),
    ("bool", True, "vec3(x ? 2.0 : 1.0)", [2, 2, 2]),
    ("bvec3", (True, False, True), "vec3(x)", [1, 0, 1]),
    ("float x[3]; //", (1, 2, 3), "vec3(x[2], x[1], x[0])", [3, 2, 1]),
    ("vec3 x[2]; //", ((1, 2, 3), (4, 5, 6)), "x[1] - x[0] * 10.0", [-6, -15, -24]),
    ("mat2", ((1, 2), (3, 4)), "vec3(x * vec2(1, 10), 0)", [21, 43, 0]),
    ("mat3", np.arange(9).reshape(3, 3), "x * vec3(1, 10, 100)", [210, 543, 876]),
    ("mat4", np.arange(16).reshape(4, 4), "(x * vec4(1, 0, 0, 10)).xyz", [30, 74, 118]),
    ("mat2 x[2]; //", np.arange(8).reshape(2, 2, 2), "vec3(x[1] * vec2(1, 10), 0)", [54, 76, 0]),
]


@pytest.mark.parametrize(
    ("kind", "value", "expression", "want"), VALUES, ids=[v[0] for v in VALUES]
)
def test_every_type_of_uniform(renderer, kind, value, expression, want):
    got = constant(renderer, expression, f"uniform {kind} x;", uniforms={"x": value})
    assert_close(got, np.array(want, float), "float32_maths")


def test_members_and_elements_have_names_of_their_own(renderer):
    declarations = "struct Lamp { vec3 color; float power; }; uniform Lamp lamps[2];"
    uniforms = {"lamps[0].color": (1, 2, 3), "lamps[1].power": 2, "lamps[1].color": (1, 1, 1)}
    got = constant(
        renderer,
        "lamps[0].color * lamps[1].power + lamps[1].color",
        declarations,
        uniforms=uniforms,
    )
    assert got.tolist() == [3, 5, 7]


def test_a_uniform_without_a_value_has_what_the_source_says(renderer):
    declarations = "uniform float a = 0.25; uniform mat2 m = mat2(1, 2, 3, 4); uniform float b;"
    material = cc.ShaderMaterial(
        declarations + "vec3 shade(Surface s) { return vec3(a, b, (m * vec2(1, 0)).y); }"
    )
    assert flat(renderer, material)[0, 0].tolist() == [0.25, 0, 2, 1]
    material.uniforms.update(a=3, b=5, m=[[0, 0], [7, 0]])
    assert flat(renderer, material)[0, 0].tolist() == [3, 5, 7, 1]
    del material.uniforms["a"], material.uniforms["m"]
    assert flat(renderer, material)[0, 0].tolist() == [0.25, 5, 2, 1]


def test_two_materials_of_one_source_keep_their_values(any_path):
    source = "uniform vec3 color; vec3 shade(Surface s) { return color; }"
    scene = cc.Scene()
    for x, color in ((-0.6, (1, 0, 0)), (0.6, (0, 1, 0))):
        material = cc.ShaderMaterial(source, uniforms={"color": color})
        scene.add(cc.Mesh.box(0.4), material, position=(x, 0, -3))
    got = any_path.render(scene, FRONT, (32, 8)).color
    assert got[4, 12, :3].tolist() == [255, 0, 0]
    assert got[4, 20, :3].tolist() == [0, 255, 0]


def test_textures_are_looked_up(renderer):
    picture = np.zeros((2, 2, 3), np.float32)
    picture[0, 0], picture[1, 1] = (1, 2, 3), (4, 5, 6)
    faces = np.arange(6, dtype=np.float32)[:, None, None, None] * np.ones((6, 2, 2, 1), np.float32)
    got = constant(
        renderer,
        "texture(image, vec2(.25, .75)).x, texture(image, vec2(.75, .25)).y, texture(sky, vec3(0, 0, -1)).x",
        "uniform sampler2D image; uniform samplerCube sky;",
        textures={"image": picture, "sky": cc.CubeMap(faces)},
    )
    assert got.tolist() == [1, 5, 5]


def test_a_probe_as_texture_leaves_its_node_out_and_follows_the_scene(any_path):
    scene = cc.Scene(background=(0, 0, 0, 1))
    around = cc.BasicMaterial(color=(1, 0, 0))
    scene.add(cc.Mesh.box(1), around, position=(0, 0, 3))
    source = (
        "uniform samplerCube room; vec3 shade(Surface s) { return texture(room, s.normal).rgb; }"
    )
    material = cc.ShaderMaterial(source, textures={"room": cc.Probe(size=16)})
    scene.add(cc.Mesh.box(0.5), material)
    camera = cc.PerspectiveCamera(fov=10, position=(0, 0, 2), target=(0, 0, 0))
    assert any_path.render(scene, camera, (3, 3)).color[1, 1].tolist() == [255, 0, 0, 255]
    around.color = (0, 0, 1)
    assert any_path.render(scene, camera, (3, 3)).color[1, 1].tolist() == [0, 0, 255, 255]
    assert any_path.stats.probes_updated == 1


# --- vertices


def test_vertices_move_and_hand_on_what_they_like(any_path):
    vertex = """
    uniform float height;
    out vec3 v_from;
    void vertex(inout Vertex vertex) {
        v_from = vertex.position;
        vertex.position.y += height * vertex.position.x;
        vertex.normal = vec3(-height, 1.0, 0.0);
    }"""
    fragment = "in vec3 v_from; vec3 shade(Surface s) { return v_from; }"
    material = cc.ShaderMaterial(fragment, vertex=vertex, uniforms={"height": 0.5})
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(2, 2), material, rotation=UPRIGHT)
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 3), target=(0, 0, 0))
    frame = any_path.render(
        scene, camera, (24, 24), format="rgba32f", outputs=("position", "normal", "id")
    )
    hit = frame.id == 1
    assert hit.sum() > 100
    # The mesh stands upright: its (x, y, z) is (x, -z, y) in the world.
    x, y = frame.position[hit][:, 0], frame.position[hit][:, 1]
    assert_close(frame.position[hit][:, 2], 0.5 * x, "position")
    assert_close(frame.color[hit][:, :3], np.stack([x, 0 * x, -y], axis=-1), "position")
    slope = np.array([-0.5, 0, 1]) / np.sqrt(1.25)
    assert_close(frame.normal[hit], np.broadcast_to(slope, (hit.sum(), 3)), "normal")


MOVER = "uniform vec3 by; void vertex(inout Vertex vertex) { vertex.position += by; }"
PLAIN = "vec3 shade(Surface s) { return vec3(1.0); }"


@pytest.mark.parametrize("displacement", [None, 10])
def test_what_moves_into_the_picture_is_seen(any_path, displacement):
    scene = cc.Scene()
    material = cc.ShaderMaterial(
        PLAIN, vertex=MOVER, uniforms={"by": (0, 0, 0)}, displacement=displacement
    )
    scene.add(cc.Mesh.box(0.3), material, position=(-9, 0, -3))
    assert any_path.render(scene, FRONT, (9, 9)).color.max() == 0
    material.uniforms["by"] = (9, 0, 0)
    assert any_path.render(scene, FRONT, (9, 9)).color[4, 4].tolist() == [255] * 4
    cube = any_path.capture(scene, size=9, format="rgba8")
    assert cube.faces[5, 4, 4].tolist() == [255] * 4


def test_a_bound_culls(fresh_renderer):
    scene = cc.Scene()
    material = cc.ShaderMaterial(PLAIN, vertex=MOVER, uniforms={"by": (0, 0, 0)}, displacement=0.1)
    scene.add(cc.Mesh.box(0.3), material, position=(-9, 0, -3))
    fresh_renderer.render(scene, FRONT, (9, 9))
    assert fresh_renderer.stats.draw_calls == 0
    material.displacement = None
    fresh_renderer.render(scene, FRONT, (9, 9))
    assert fresh_renderer.stats.draw_calls == 1


def test_moved_vertices_redraw_what_they_leave(new_renderer):
    scene = cc.Scene(background=(0.2, 0.2, 0.2))
    scene.add(cc.Mesh.box(0.2), cc.BasicMaterial(color=(0, 1, 0)), position=(0.4, 0.2, -3.5))
    material = cc.ShaderMaterial(PLAIN, vertex=MOVER, uniforms={"by": (0, 0, 0)}, displacement=0.6)
    scene.add(cc.Mesh.box(0.2), material, position=(-0.3, 0, -3))
    kept = new_renderer()
    for step in range(5):
        material.uniforms["by"] = (0.12 * step, 0.05 * step, 0)
        got = kept.render(scene, FRONT, (40, 30)).color
        assert_identical(got, new_renderer().render(scene, FRONT, (40, 30)).color)


# --- alpha, layers, samples


def test_alpha_of_a_vec4_counts_where_it_is_blended(renderer):
    source = "vec4 shade(Surface s) { return vec4(1.0, 0.5, 0.0, 0.5); }"
    assert flat(renderer, cc.ShaderMaterial(source))[0, 0].tolist() == [1, 0.5, 0, 1]
    assert flat(renderer, cc.ShaderMaterial(source, blend="alpha"))[0, 0].tolist() == [
        0.5,
        0.25,
        0,
        0.5,
    ]
    half = cc.ShaderMaterial(source, opacity=0.5)
    assert flat(renderer, half)[0, 0].tolist() == [0.25, 0.125, 0, 0.25]


def test_discard_leaves_what_is_behind(any_path):
    source = "vec3 shade(Surface s) { if (s.uv.x < 0.5) discard; return vec3(1.0); }"
    scene = cc.Scene(background=(0, 0, 0.5, 1))
    scene.add(
        cc.Mesh.plane(20, 20), cc.ShaderMaterial(source), position=(0, 0, -2), rotation=UPRIGHT
    )
    frame = any_path.render(scene, FRONT, (8, 8), format="rgba32f", outputs=("id",))
    assert (frame.color[:, :4] == (0, 0, 0.5, 1)).all()
    assert (frame.color[:, 4:] == 1).all()
    assert (frame.id[:, :4] == 0).all()


def test_layered_equals_one_pass(shared_renderers):
    scene = cc.Scene(environment=cc.CubeMap(smooth_environment(16)))
    scene.add(cc.PointLight((1, 2, 3)))
    source = "vec3 shade(Surface s) { return environment(s.normal) + phong(s, s.position, 0., 1., 1., 5.); }"
    for place in ((0, 0, -2), (1, 1.5, 0.2), (-2, 0.3, 0.9)):
        scene.add(cc.Mesh.icosphere(0.7), cc.ShaderMaterial(source), position=place)
    cubes = [
        shared_renderers(layered).capture(scene, size=24, outputs=("normal", "id"))
        for layered in (None, False)
    ]
    assert_identical(cubes[0].faces, cubes[1].faces, across="programs")
    assert_identical(cubes[0].normal, cubes[1].normal, across="programs")


def test_samples_smooth_its_edges_only(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.icosphere(0.4), cc.ShaderMaterial(PLAIN), position=(0, 0, -3))
    one = renderer.render(scene, FRONT, (33, 33), format="rgba32f", outputs=("id",))
    four = renderer.render(scene, FRONT, (33, 33), format="rgba32f", samples=4, outputs=("id",))
    assert_identical(one.id, four.id)
    values = np.unique(four.color[..., 0])
    assert len(values) > 2
    assert {0.0, 1.0} < set(values.tolist())


# --- keys


def test_every_change_redraws_and_equal_ones_do_not(fresh_renderer):
    scene = cc.Scene(environment=cc.CubeMap(smooth_environment(8)))
    source = "uniform float a; uniform sampler2D t; vec3 shade(Surface s) { return texture(t, s.uv).rgb * a; }"
    material = cc.ShaderMaterial(
        source, uniforms={"a": 1}, textures={"t": np.ones((2, 2, 3), np.float32)}
    )
    scene.add(cc.Mesh.plane(20, 20), material, position=(0, 0, -2), rotation=UPRIGHT)

    def drawn():
        fresh_renderer.render(scene, FRONT, (4, 4))
        return fresh_renderer.stats.views_drawn

    assert drawn() == 1
    assert drawn() == 0
    changes = [
        lambda: material.uniforms.update(a=2),
        lambda: material.textures.update(t=np.zeros((2, 2, 3), np.float32)),
        lambda: setattr(material, "fragment", source + "\n"),
        lambda: setattr(material, "vertex", "void vertex(inout Vertex v) {}"),
        lambda: setattr(material, "displacement", 1),
    ]
    for index, change in enumerate(changes):
        change()
        assert drawn() == 1, index
    material.uniforms["a"] = 2.0
    material.fragment = source + "\n"
    assert drawn() == 0
    scene.background = scene.environment
    assert drawn() == 0
    scene.environment = cc.CubeMap(smooth_environment(16))
    assert drawn() == 0, "a source that does not look the environment up does not depend on it"
    material.fragment = source.replace("rgb * a", "rgb * environment(s.normal)")
    assert drawn() == 1
    scene.environment = cc.CubeMap(smooth_environment(8))
    assert drawn() == 1


def test_programs_of_edited_sources_are_given_up(fresh_renderer):
    material = cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(0.0); }")
    for step in range(70):
        material.fragment = f"vec3 shade(Surface s) {{ return vec3({step}.0); }}"
        assert flat(fresh_renderer, material, 1)[0, 0, 0] == step


# --- errors


def test_compile_errors_name_the_users_own_lines(renderer):
    source = "uniform float a;\n\nvec3 shade(Surface surface) {\n    float b = a * nothing;\n    return vec3(b);\n}\n"
    with pytest.raises(cc.ShaderError) as error:
        flat(renderer, cc.ShaderMaterial(source))
    text = str(error.value)
    assert text.startswith("fragment does not compile:")
    assert "fragment:4(" in text
    assert "nothing" in text
    assert ">    4 |     float b = a * nothing;" in text


def test_errors_of_the_vertex_source_name_it(renderer):
    with pytest.raises(cc.ShaderError) as error:
        flat(
            renderer,
            cc.ShaderMaterial(
                PLAIN, vertex="\nvoid vertex(inout Vertex v) { v.positions = vec3(0); }"
            ),
        )
    assert "vertex:2(" in str(error.value)


def test_varyings_that_do_not_meet_are_told(renderer):
    fragment = "in vec3 v_x; vec3 shade(Surface s) { return v_x; }"
    with pytest.raises(cc.ShaderError, match="v_x"):
        flat(renderer, cc.ShaderMaterial(fragment))


BAD_INPUTS = [
    (
        {"uniforms": {"y": 1}},
        r"uniform y: expected one of x, got a name that the source does not know",
    ),
    ({"uniforms": {"x": 1}}, r"uniform x: expected shape \(3,\) for a vec3, got a number"),
    ({"uniforms": {"x": (1, 2)}}, r"uniform x: expected shape \(3,\) for a vec3, got shape \(2,\)"),
    (
        {"uniforms": {"x": np.eye(3)}},
        r"uniform x: expected shape \(3,\) for a vec3, got shape \(3, 3\)",
    ),
    ({"textures": {"t": np.ones((1, 1, 3), np.float32)}}, r"uniform t: expected one of x"),
]


@pytest.mark.parametrize(("inputs", "message"), BAD_INPUTS)
def test_inputs_that_the_source_does_not_know_are_told(renderer, inputs, message):
    source = "uniform vec3 x; vec3 shade(Surface s) { return x; }"
    material = cc.ShaderMaterial(source, **inputs)
    for _ in range(2):
        with pytest.raises(ValueError, match=message):
            flat(renderer, material)
    material.uniforms, material.textures = {"x": (1, 2, 3)}, {}
    assert flat(renderer, material)[0, 0].tolist() == [1, 2, 3, 1]


def test_whole_numbers_stay_whole(renderer):
    with pytest.raises(ValueError, match=r"uniform n: expected whole numbers for an int, got 2\.5"):
        constant(renderer, "n", "uniform int n;", uniforms={"n": 2.5})
    with pytest.raises(ValueError, match="uniform n: expected whole numbers for an uint, got -1"):
        constant(renderer, "n", "uniform uint n;", uniforms={"n": -1})


def test_textures_of_the_wrong_kind_are_told(renderer):
    flat_one, cube = np.ones((1, 1, 3), np.float32), cc.CubeMap(np.ones((6, 1, 1, 3), np.float32))
    read = "vec3 shade(Surface s) { return texture(t, s.position%s).rgb; }"
    with pytest.raises(
        ValueError, match="texture t: expected an Image for the sampler2D, got a cubemap"
    ):
        flat(
            renderer, cc.ShaderMaterial("uniform sampler2D t;" + read % ".xy", textures={"t": cube})
        )
    with pytest.raises(
        ValueError, match="texture t: expected a CubeMap or Probe for the samplerCube, got an Image"
    ):
        flat(
            renderer,
            cc.ShaderMaterial("uniform samplerCube t;" + read % "", textures={"t": flat_one}),
        )
    with pytest.raises(ValueError, match="texture t: expected one for the sampler2D, got none"):
        flat(renderer, cc.ShaderMaterial("uniform sampler2D t;" + read % ".xy"))
    with pytest.raises(ValueError, match="uniform t: expected a float"):
        flat(renderer, cc.ShaderMaterial("uniform sampler3D t;" + read % ""))


def test_an_input_that_is_named_but_not_used_is_no_mistake(renderer):
    source = "uniform float a; // uniform float b;\nvec3 shade(Surface s) { return vec3(1.0); }"
    assert flat(renderer, cc.ShaderMaterial(source, uniforms={"a": 1, "b": 2}))[0, 0, 0] == 1


BAD_ARGUMENTS = [
    ({"fragment": ""}, ValueError, "fragment with a function vec3 shade"),
    ({"fragment": "void main() {}"}, ValueError, "fragment with a function vec3 shade"),
    (
        {"fragment": 7},
        TypeError,
        "fragment: expected GLSL as a str, or a pathlib.Path of a file, got int",
    ),
    (
        {"fragment": PLAIN, "vertex": "void main() {}"},
        ValueError,
        "a vertex with a function void vertex",
    ),
    ({"fragment": PLAIN, "uniforms": [1]}, TypeError, "uniforms: expected a mapping"),
    ({"fragment": PLAIN, "uniforms": {1: 1}}, TypeError, "uniforms: expected names"),
    (
        {"fragment": PLAIN, "uniforms": {"a b": 1}},
        ValueError,
        "uniforms named as GLSL names them, got 'a b'",
    ),
    ({"fragment": PLAIN, "uniforms": {"gl_x": 1}}, ValueError, "uniforms named as GLSL names them"),
    ({"fragment": PLAIN, "uniforms": {"a": "1"}}, TypeError, "uniform a: expected real numbers"),
    (
        {"fragment": PLAIN, "uniforms": {"a": np.nan}},
        ValueError,
        "uniform a: expected finite numbers",
    ),
    (
        {"fragment": PLAIN, "uniforms": {"a": 1e300}},
        ValueError,
        "uniform a: expected numbers within float32",
    ),
    (
        {"fragment": PLAIN, "uniforms": {"a": []}},
        ValueError,
        "uniform a: expected 1 to 65536 numbers",
    ),
    ({"fragment": PLAIN, "textures": {"t": "x.png"}}, TypeError, "texture t: expected an Image"),
    ({"fragment": PLAIN, "textures": {"t": None}}, TypeError, "texture t: expected an Image"),
    ({"fragment": PLAIN, "displacement": -1}, ValueError, "displacement finite and not negative"),
]


@pytest.mark.parametrize(("arguments", "kind", "message"), BAD_ARGUMENTS)
def test_bad_arguments_are_told(arguments, kind, message):
    with pytest.raises(kind, match=message):
        cc.ShaderMaterial(**arguments)


def test_one_name_is_one_input():
    with pytest.raises(ValueError, match="both a uniform and a texture 'x'"):
        cc.ShaderMaterial(PLAIN, uniforms={"x": 1}, textures={"x": np.ones((1, 1, 3), np.float32)})


def test_a_version_line_is_refused(renderer):
    with pytest.raises(cc.ShaderError, match="fragment:1: a #version line"):
        flat(renderer, cc.ShaderMaterial("#version 330\n" + PLAIN))


# --- hot reload


def test_a_new_source_shows_in_the_next_picture(renderer):
    material = cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(1.0, 0.0, 0.0); }")
    assert flat(renderer, material)[0, 0].tolist() == [1, 0, 0, 1]
    material.fragment = "vec3 shade(Surface s) { return vec3(0.0, 1.0, 0.0) }"
    with pytest.raises(cc.ShaderError):
        flat(renderer, material)
    material.fragment = "vec3 shade(Surface s) { return vec3(0.0, 1.0, 0.0); }"
    assert flat(renderer, material)[0, 0].tolist() == [0, 1, 0, 1]


def test_reload_reads_the_files_again(renderer, tmp_path):
    fragment, vertex = tmp_path / "paint.frag", tmp_path / "move.vert"
    fragment.write_text("vec3 shade(Surface s) { return vec3(1.0, 0.0, 0.0); }")
    vertex.write_text("void vertex(inout Vertex v) {}")
    material = cc.ShaderMaterial(fragment, vertex=vertex)
    assert flat(renderer, material)[0, 0].tolist() == [1, 0, 0, 1]
    assert material.reload() is False
    fragment.write_text("vec3 shade(Surface s) {\n  return vec3(0.0, 1.0, wrong);\n}")
    assert flat(renderer, material)[0, 0].tolist() == [1, 0, 0, 1]
    assert material.reload() is True
    with pytest.raises(cc.ShaderError, match=r"paint\.frag:2"):
        flat(renderer, material)
    fragment.write_text("vec3 shade(Surface s) { return vec3(0.0, 0.0, 1.0); }")
    assert material.reload() is True
    assert flat(renderer, material)[0, 0].tolist() == [0, 0, 1, 1]
    fragment.unlink()
    with pytest.raises(FileNotFoundError):
        material.reload()
    assert flat(renderer, material)[0, 0].tolist() == [0, 0, 1, 1]


def test_reload_of_text_is_told():
    with pytest.raises(ValueError, match="expected a source that was read from a file"):
        cc.ShaderMaterial(PLAIN).reload()
    with pytest.raises(FileNotFoundError):
        cc.ShaderMaterial(pathlib.Path("nowhere.frag"))


# --- the objects


@pytest.mark.parametrize(
    "copied", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy], ids=["pickle", "deepcopy"]
)
def test_copies(copied, renderer, tmp_path):
    path = tmp_path / "a.frag"
    path.write_text(
        "uniform vec3 x; uniform sampler2D t; vec3 shade(Surface s) { return x * texture(t, s.uv).g; }"
    )
    material = cc.ShaderMaterial(
        path,
        vertex="void vertex(inout Vertex v) {}",
        uniforms={"x": (1, 2, 3)},
        textures={"t": np.full((1, 1, 3), 0.5, np.float32)},
        displacement=0.5,
        blend="alpha",
        opacity=0.5,
    )
    other = copied(material)
    assert_identical(flat(renderer, material), flat(renderer, other))
    assert (other.displacement, other.blend, other.opacity) == (0.5, "alpha", 0.5)
    assert other.vertex == material.vertex
    assert repr(other) == repr(material)
    assert other.reload() is False
    other.uniforms["x"] = 0
    assert np.asarray(material.uniforms["x"]).tolist() == [1, 2, 3]


def test_a_material_whose_probe_leads_back_to_it_pickles():
    scene = cc.Scene()
    material = cc.ShaderMaterial(
        "uniform samplerCube r; vec3 shade(Surface s) { return texture(r, s.normal).rgb; }"
    )
    node = scene.add(cc.Mesh.box(), material)
    material.textures["r"] = cc.Probe(parent=node, exclude=[node])
    copied_scene, copied = pickle.loads(pickle.dumps((scene, material)))
    assert copied_scene.nodes[0].material is copied
    assert copied.textures["r"].parent is copied_scene.nodes[0]


def test_inputs_are_mappings():
    material = cc.ShaderMaterial(PLAIN + "// b a", uniforms={"b": 2, "a": (1, 2)})
    assert sorted(material.uniforms) == ["a", "b"]
    assert len(material.uniforms) == 2
    assert material.uniforms["b"] == 2.0
    assert np.asarray(dict(material.uniforms)["a"]).tolist() == [1, 2]
    array = material.uniforms["a"]
    assert isinstance(array, np.ndarray)
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 5
    with pytest.raises(KeyError):
        material.uniforms["c"]
    with pytest.raises(KeyError):
        del material.uniforms["c"]
    assert material.uniforms.pop("b") == 2.0
    assert "b" not in material.uniforms
    with pytest.raises(ValueError, match="finite"):
        material.uniforms["a"] = np.inf
    assert np.asarray(material.uniforms["a"]).tolist() == [1, 2]
    assert "a" in repr(material.uniforms)


def test_sides(renderer):
    """On double-sided surfaces the normal points to the viewer, as with other materials."""
    source = "vec3 shade(Surface s) { return s.normal; }"
    scene = cc.Scene()
    down = cc.axis_angle((1, 0, 0), -90)
    material = cc.ShaderMaterial(source)
    scene.add(cc.Mesh.plane(20, 20), material, position=(0, 0, -2), rotation=down)
    assert renderer.render(scene, FRONT, (2, 2)).color.max() == 0
    material.double_sided = True
    got = renderer.render(scene, FRONT, (2, 2), format="rgba32f").color
    assert_close(got[..., :3], np.broadcast_to([0, 0, 1], (2, 2, 3)), "normal")
