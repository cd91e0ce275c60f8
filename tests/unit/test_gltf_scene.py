"""load_scene of glTF by value: nodes, lights, cameras, variants, animations, skins, morph targets, environment."""

import math

import numpy as np
import pytest

import cubecam as cc
from tests.gltf_files import CORNERS, SQUARE, GltfFile
from tests.scene_files import SceneFile, f32, noise, picture


@pytest.fixture
def load(tmp_path):
    def load(file):
        (tmp_path / "a.glb").write_bytes(file.glb())
        return cc.load_scene(tmp_path / "a.glb")

    return load


# Nodes


def test_nodes_with_names_places_and_parents(load):
    file = GltfFile()
    inner = file.node(root=False, name="inner", scale=[2, 3, -4])
    turn = [0, math.sin(0.3), 0, math.cos(0.3)]
    outer = file.node(name="outer", translation=[1, 2, 3], rotation=turn, children=[inner])
    moved = np.array([[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]], float)
    file.node(name="matrix", matrix=moved.T.reshape(-1).tolist(), mesh=file.mesh())
    scene = load(file)
    first, second, third = scene.nodes
    # Ids follow the order of the file, in which a child may stand before its parent.
    assert [node.name for node in scene.nodes] == ["inner", "outer", "matrix"]
    assert (inner, outer) == (0, 1)
    assert first.parent is second
    assert second.parent is None
    np.testing.assert_array_equal(first.scale, (2, 3, -4))
    np.testing.assert_array_equal(second.position, (1, 2, 3))
    np.testing.assert_allclose(second.rotation, (turn[3], *turn[:3]))
    np.testing.assert_allclose(third.matrix, moved)


def test_the_default_scene_alone_is_read(load):
    file = GltfFile(scene=1, scenes=[{"nodes": [0]}, {"nodes": [1]}])
    file.tree["nodes"] = [{"name": "a"}, {"name": "b"}]
    assert [node.name for node in load(file).nodes] == ["b"]


def test_several_primitives_are_nodes_below(load):
    file = GltfFile()
    mesh = file.mesh(file.primitive(), file.primitive(CORNERS + 1), name="pair")
    file.node(mesh=mesh, name="first")
    file.node(mesh=mesh, name="second")
    scene = load(file)
    first, second = scene.nodes[:2]
    assert first.mesh is None
    assert [child.name for child in first.children] == ["pair.0", "pair.1"]
    assert [a.mesh is b.mesh for a, b in zip(first.children, second.children, strict=True)] == [
        True,
        True,
    ]
    assert first.children[0].mesh is not first.children[1].mesh
    assert first.children[0].material is second.children[1].material


def test_instances_are_nodes_below(load):
    file = GltfFile()
    places = np.array([[1, 0, 0], [0, 2, 0]], np.float32)
    attributes = {"TRANSLATION": file.accessor(places), "SCALE": file.accessor(places * 0 + 3)}
    node = {"extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}}
    file.node(mesh=file.mesh(name="leaf"), translation=[0, 0, 1], **node)
    tree, *leaves = load(file).nodes
    assert tree.mesh is None
    assert [leaf.name for leaf in leaves] == ["leaf.0", "leaf.1"]
    got = [leaf.world_matrix[:3, 3] for leaf in leaves]
    np.testing.assert_allclose(got, places + f32([0, 0, 1]))
    np.testing.assert_allclose([leaf.scale for leaf in leaves], 3)
    assert leaves[0].mesh is leaves[1].mesh


def test_hidden_nodes_are_there_and_not_visible(load):
    file = GltfFile()
    file.node(mesh=file.mesh(), extensions={"KHR_node_visibility": {"visible": False}})
    file.node(mesh=0)
    assert [node.visible for node in load(file).nodes] == [False, True]


@pytest.mark.parametrize(
    ("node", "column"),
    [
        ({"scale": [0, 2, 3]}, (1e-6, 2, 3)),
        ({"matrix": np.diag([2.0, 0, 3, 1]).reshape(-1).tolist()}, (2, 1e-6, 3)),
    ],
)
def test_a_scale_of_0_becomes_small(load, node, column):
    file = GltfFile()
    file.node(mesh=file.mesh(), **node)
    matrix = load(file).nodes[0].matrix
    np.testing.assert_allclose(np.abs(np.diag(matrix)[:3]), column, rtol=1e-6)


def test_meshes_by_value(load):
    file = SceneFile()
    uvs = np.array([[0, 0.25], [1, 0], [1, 1], [0, 1]], np.float32)
    colors = np.array([[1, 0, 0, 0.5]] * 4, np.float32)
    tangents = np.array([[1, 0, 0, -1]] * 4, np.float32)
    given = {"TEXCOORD_0": uvs, "TEXCOORD_1": uvs / 2, "COLOR_0": colors, "TANGENT": tangents}
    file.node(mesh=file.mesh(file.square(**given)))
    mesh = load(file).nodes[0].mesh
    np.testing.assert_array_equal(mesh.positions, SQUARE)
    np.testing.assert_array_equal(mesh.indices, [[0, 1, 2], [0, 2, 3]])
    np.testing.assert_array_equal(mesh.normals, [[0, 0, 1]] * 4)
    np.testing.assert_array_equal(mesh.uvs, np.stack([uvs[:, 0], 1 - uvs[:, 1]], axis=1))
    np.testing.assert_array_equal(mesh.uvs1, np.stack([uvs[:, 0] / 2, 1 - uvs[:, 1] / 2], axis=1))
    np.testing.assert_array_equal(mesh.colors, colors)
    np.testing.assert_array_equal(mesh.tangents, tangents)


def test_points_and_lines_give_one_warning(load):
    file = GltfFile()
    lines = [file.primitive(mode=1) for _ in range(5)]
    file.node(mesh=file.mesh(*lines, file.primitive()))
    with pytest.warns(cc.SceneWarning, match=r"lines are left out.*and 2 more") as seen:
        scene = load(file)
    assert len(seen) == 1
    assert len(scene) == 1


def test_a_scene_without_triangles_is_a_scene(load):
    assert len(load(GltfFile())) == 0


# Lights and cameras


def lit(light):
    file = GltfFile()
    file.tree["extensionsUsed"] = ["KHR_lights_punctual"]
    file.tree["extensions"] = {"KHR_lights_punctual": {"lights": [light]}}
    node = {"extensions": {"KHR_lights_punctual": {"light": 0}}}
    turned = [0, math.sin(math.pi / 4), 0, math.cos(math.pi / 4)]  # -z becomes -x
    file.node(translation=[1, 2, 3], rotation=turned, **node)
    return file


def test_a_point_light(load):
    # The scene must live: lights do not keep the node that is their parent alive.
    scene = load(lit({"type": "point", "color": [1, 0.5, 0.25], "intensity": 7, "range": 9}))
    (light,) = scene.lights
    assert isinstance(light, cc.PointLight)
    np.testing.assert_allclose(light.color, (1, 0.5, 0.25))
    assert (light.intensity, light.decay, light.range) == (7, 2, 9)
    np.testing.assert_allclose(light.world_position, (1, 2, 3))


def test_a_spot_light(load):
    cone = {"innerConeAngle": 0.2, "outerConeAngle": 0.5}
    scene = load(lit({"type": "spot", "spot": cone}))
    (light,) = scene.lights
    assert isinstance(light, cc.SpotLight)
    assert light.angle == pytest.approx(math.degrees(0.5))
    assert light.angle * (1 - light.penumbra) == pytest.approx(math.degrees(0.2))
    assert light.range == math.inf
    np.testing.assert_allclose(light.world_direction, (-1, 0, 0), atol=1e-12)
    assert light.parent is scene.nodes[0]


def test_a_spot_light_without_numbers_has_those_of_the_extension(load):
    (light,) = load(lit({"type": "spot"})).lights
    assert light.angle == pytest.approx(45)
    assert light.penumbra == 1
    assert light.intensity == 1


def test_a_directional_light(load):
    scene = load(lit({"type": "directional", "intensity": 3}))
    (light,) = scene.lights
    assert isinstance(light, cc.DirectionalLight)
    np.testing.assert_allclose(light.world_direction, (-1, 0, 0), atol=1e-12)
    assert light.intensity == 3


def test_an_unknown_light_is_refused(load):
    with pytest.raises(cc.MeshError, match=r"lights\[0\].type: expected directional"):
        load(lit({"type": "area"}))


def seen(camera):
    file = GltfFile()
    file.add("cameras", camera)
    file.node(camera=0, translation=[1, 2, 3])
    return file


def test_a_perspective_camera(load):
    lens = {"yfov": 0.8, "znear": 0.5, "zfar": 50, "aspectRatio": 2}
    scene = load(seen({"type": "perspective", "perspective": lens}))
    (camera,) = scene.cameras
    assert camera.fov == pytest.approx(math.degrees(0.8))
    assert (camera.near, camera.far) == (0.5, 50)
    assert camera.parent is scene.nodes[0]
    np.testing.assert_allclose(camera.world_position, (1, 2, 3))


def test_a_perspective_camera_without_an_end(load):
    (camera,) = load(
        seen({"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.5}})
    ).cameras
    assert camera.far == 1e9


def test_an_orthographic_camera(load):
    lens = {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 10}
    (camera,) = load(seen({"type": "orthographic", "orthographic": lens})).cameras
    assert isinstance(camera, cc.OrthographicCamera)
    assert (camera.height, camera.near, camera.far) == (4, 0, 10)


def test_a_camera_without_a_lens_is_refused(load):
    with pytest.raises(cc.MeshError, match=r"cameras\[0\].perspective.yfov: expected a number"):
        load(seen({"type": "perspective", "perspective": {"znear": 1}}))


# Variants


def test_variants(load):
    file = SceneFile()
    numbers = [file.add("materials", {"name": name}) for name in ("plain", "red", "blue")]
    names = [{"name": "morning"}, {"name": "noon"}, {"name": "night"}]
    file.use("KHR_materials_variants", {"variants": names})
    mapping = [{"material": 1, "variants": [0, 2]}, {"material": 2, "variants": [1]}]
    primitive = file.square(numbers[0])
    primitive["extensions"] = {"KHR_materials_variants": {"mappings": mapping}}
    file.node(mesh=file.mesh(primitive))
    scene = load(file)
    node = scene.nodes[0]
    assert scene.variants == ("morning", "noon", "night")
    assert scene.variant is None
    shown = []
    for name in (None, *scene.variants):
        scene.variant = name
        shown.append(node.material.name)
    assert shown == ["plain", "red", "blue", "red"]
    assert node.variants["morning"] is node.variants["night"]


# Animations


def moving(path, times, values, interpolation=None, **node):
    file = GltfFile()
    number = file.node(**node)
    sampler = {"input": file.accessor(f32(times)), "output": values(file)}
    if interpolation:
        sampler["interpolation"] = interpolation
    channel = {"sampler": 0, "target": {"node": number, "path": path}}
    file.add("animations", {"name": "move", "channels": [channel], "samplers": [sampler]})
    return file


def test_a_translation(load):
    keys = np.array([[0, 0, 0], [2, 4, 6]], np.float32)
    scene = load(moving("translation", [1, 3], lambda file: file.accessor(keys)))
    (animation,) = scene.animations
    assert (animation.name, animation.duration) == ("move", 3)
    for time, share in ((0, 0), (1.5, 0.25), (9, 1)):
        assert scene.set_time(time, "move") is scene
        np.testing.assert_allclose(scene.nodes[0].position, keys[1] * share)


def test_a_rotation_of_normalized_integers(load):
    half = round(math.sin(math.pi / 4) * 32767)
    keys = np.array([[0, 0, 0, 32767], [0, half, 0, half]], np.int16)
    file = moving("rotation", [0, 1], lambda f: f.accessor(keys, normalized=True), "STEP")
    scene = load(file)
    np.testing.assert_allclose(scene.set_time(0.9).nodes[0].rotation, (1, 0, 0, 0))
    want = (math.cos(math.pi / 4), 0, math.sin(math.pi / 4), 0)
    np.testing.assert_allclose(scene.set_time(1).nodes[0].rotation, want, atol=1e-4)


def test_a_cubic_scale(load):
    # In-tangent, value, out-tangent of two keys.
    rows = np.array([[0] * 3, [1] * 3, [2] * 3, [4] * 3, [3] * 3, [0] * 3], np.float32)
    file = moving("scale", [0, 2], lambda f: f.accessor(rows), "CUBICSPLINE")
    got = load(file).set_time(0.5).nodes[0].scale
    t, span = 0.25, 2.0
    want = (  # appendix C.5
        (2 * t**3 - 3 * t**2 + 1) * 1
        + span * (t**3 - 2 * t**2 + t) * 2
        + (-2 * t**3 + 3 * t**2) * 3
        + span * (t**3 - t**2) * 4
    )
    np.testing.assert_allclose(got, want, rtol=1e-6)


def morphed(*, names=None, weights=None, **primitive):
    file = GltfFile()
    entry = file.primitive(**primitive)
    up = CORNERS * 0 + (0, 0, 1)
    entry["targets"] = [
        {"POSITION": file.accessor(up)},
        {"POSITION": file.accessor(up * 2), "TEXCOORD_0": file.accessor(CORNERS[:, :2])},
    ]
    mesh = {} if names is None else {"extras": {"targetNames": names}}
    if weights is not None:
        mesh["weights"] = weights
    file.node(mesh=file.mesh(entry, **mesh))
    return file


def test_morph_targets(load):
    uvs = np.zeros((3, 2), np.float32)
    file = morphed(names=["rise", "soar"], weights=[0.5, 0.25], TEXCOORD_0=uvs)
    node = load(file).nodes[0]
    first, second = node.mesh.morph_targets
    assert (first.name, second.name) == ("rise", "soar")
    np.testing.assert_array_equal(node.weights, (0.5, 0.25))
    np.testing.assert_array_equal(second.positions, [[0, 0, 2]] * 3)
    np.testing.assert_array_equal(second.uvs, CORNERS[:, :2] * (1, -1))


def test_weights_of_a_node_come_first(load):
    file = morphed(weights=[0.5, 0.25])
    file.tree["nodes"][0]["weights"] = [1, 0]
    np.testing.assert_array_equal(load(file).nodes[0].weights, (1, 0))


def test_weights_move(load):
    file = morphed()
    values = file.accessor(f32([0, 1, 1, 0]))
    sampler = {"input": file.accessor(f32([0, 1])), "output": values}
    channel = {"sampler": 0, "target": {"node": 0, "path": "weights"}}
    file.add("animations", {"channels": [channel], "samplers": [sampler]})
    node = load(file).set_time(0.25).nodes[0]
    np.testing.assert_allclose(node.weights, (0.25, 0.75))


def test_channels_that_cubecam_does_not_know(load):
    file = moving("pointer", [0], lambda f: f.accessor(f32([1])))
    with pytest.warns(cc.SceneWarning, match="KHR_animation_pointer"):
        assert load(file).animations == ()


@pytest.mark.parametrize("cubic", [False, True])
def test_of_keys_of_equal_times_the_last_counts(load, cubic):
    times = [0, 1, 1, 2]
    keys = np.zeros((4, 3), np.float32)
    keys[:, 0] = 0, 5, 7, 9
    values = np.stack([keys * 0, keys, keys * 0], 1).reshape(-1, 3) if cubic else keys
    file = moving("translation", times, lambda file: file.accessor(values))
    if cubic:
        file.tree["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"
    with pytest.warns(cc.SceneWarning, match=r"equal times .*samplers\[0\]"):
        scene = load(file)
    assert scene.animations[0].channels[0].times.tolist() == [0, 1, 2]
    assert scene.set_time(1).nodes[0].position[0] == 7


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"interpolation": "BOUNCE"}, r"samplers\[0\].interpolation: expected one of STEP"),
        ({"input": 99}, r"samplers\[0\].input: expected an index"),
        ({"output": 0}, r"samplers\[0\].output: expected an accessor of VEC3"),
    ],
)
def test_broken_animations_are_refused(load, change, text):
    keys = np.zeros((2, 3), np.float32)
    file = moving("translation", [1, 3], lambda file: file.accessor(keys))
    file.tree["animations"][0]["samplers"][0] |= change
    with pytest.raises(cc.MeshError, match=text):
        load(file)


# Skins


def test_a_skin_of_two_sets(load):
    file = GltfFile()
    joints = np.array([[0, 1, 0, 0]] * 3, np.uint8)
    weights = np.array([[0.5, 0.25, 0, 0]] * 3, np.float32)
    more = np.array([[1, 0, 0, 0]] * 3, np.uint16)
    rest = np.array([[0.25, 0, 0, 0]] * 3, np.float32)
    primitive = file.primitive(JOINTS_0=joints, WEIGHTS_0=weights, JOINTS_1=more, WEIGHTS_1=rest)
    file.node(mesh=file.mesh(primitive), skin=0, translation=[50, 0, 0])
    bones = [file.node(name="root"), file.node(name="tip", translation=[2, 0, 0])]
    bind = np.tile(np.eye(4), (2, 1, 1))
    bind[1, :3, 3] = (0, 0, -4)
    entry = {"joints": bones, "skeleton": bones[0]}
    columns = bind.transpose(0, 2, 1).reshape(2, 16)
    file.add("skins", {**entry, "inverseBindMatrices": file.accessor(columns)})
    scene = load(file)
    node = scene.nodes[0]
    assert node.mesh.joints.shape == (3, 8)
    np.testing.assert_allclose(node.mesh.joint_weights.sum(axis=1), 1)
    assert node.skin.joints == (scene["root"], scene["tip"])
    assert node.skin.skeleton is scene["root"]
    np.testing.assert_allclose(node.skin.inverse_bind_matrices, bind)


def test_joints_outside_of_the_scene_are_read(load):
    file = GltfFile()
    joints, weights = np.zeros((3, 4), np.uint8), f32([[1, 0, 0, 0]] * 3)
    file.node(mesh=file.mesh(file.primitive(JOINTS_0=joints, WEIGHTS_0=weights)), skin=0)
    bone = file.node(root=False, name="bone")
    file.node(root=False, name="above", children=[bone])
    file.add("skins", {"joints": [bone]})
    scene = load(file)
    assert scene.nodes[0].skin.joints == (scene["bone"],)
    assert scene["bone"].parent is scene["above"]


# The environment


def surrounded(faces, kind="PNG", **light):
    file = SceneFile()
    images = [file.image(face, kind) for face in faces]
    entry = {
        "irradianceCoefficients": [[0, 0, 0]] * 9,
        "specularImageSize": faces[0].shape[0],
        "specularImages": [images],
        **light,
    }
    file.use("EXT_lights_image_based", {"lights": [entry]})
    file.tree["scenes"][0]["extensions"] = {"EXT_lights_image_based": {"light": 0}}
    return file


def flat_faces(channels):
    return [np.full((4, 4, channels), 40 * (face + 1), np.uint8) for face in range(6)]


def test_an_environment_of_rgbd(load):
    faces = flat_faces(4)
    for face in faces:
        face[..., 3] = 51
    turned = [0, math.sin(0.2), 0, math.cos(0.2)]
    scene = load(surrounded(faces, intensity=2, rotation=turned))
    assert scene.environment_intensity == 2
    np.testing.assert_allclose(scene.environment_rotation, (turned[3], *turned[:3]))
    got = [scene.environment.sample(d)[0] for d in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, 0, -1))]
    # A lookup in the file's faces has -x, so that +x is their second face.
    want = [(40 * (face + 1) / 255) ** 2.2 / (51 / 255) for face in (1, 0, 2, 5)]
    np.testing.assert_allclose(got, want, rtol=1e-3)


def test_an_environment_of_8_bits_is_mirrored_in_x(load):
    faces = flat_faces(3)
    faces[4][:, 0] = 255  # the left column of +z
    scene = load(surrounded(faces))
    # Seen by OpenGL's table, the left column of +z is at -x; a lookup with -x finds it at +x.
    assert scene.environment.sample((0.75, 0.25, 1))[0] == pytest.approx(1)
    assert scene.environment.sample((-0.75, 0.25, 1))[0] < 0.7


def test_a_broken_environment_is_left_out(load):
    file = surrounded(flat_faces(3))
    file.tree["images"][3] = {"uri": "missing.png"}
    with pytest.warns(cc.SceneWarning, match="the environment is left out"):
        assert load(file).environment is None


# Limits


def test_animations_that_share_an_accessor_are_counted(load):
    count = 65_536
    file = moving("translation", [0], lambda f: f.accessor(np.zeros((1, 3), np.float32)))
    big = file.add("accessors", {"componentType": 5126, "count": count, "type": "SCALAR"})
    wide = file.add("accessors", {"componentType": 5126, "count": count, "type": "VEC3"})
    animation = file.tree["animations"][0]
    animation["samplers"][0] = {"input": big, "output": wide}
    animation["channels"] *= 100
    with pytest.raises(cc.MeshError, match=r"expected (at most|increasing|.*increas)"):
        load(file)


def test_instances_are_counted(load):
    file = GltfFile()
    count = 65_536 + 1000
    places = file.add("accessors", {"componentType": 5126, "count": count, "type": "VEC3"})
    mesh = file.mesh(file.primitive(), file.primitive(CORNERS + 1))
    entry = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}
    file.node(mesh=mesh, extensions=entry)
    with pytest.raises(cc.MeshError, match=r"expected at most .* nodes"):
        load(file)


def test_pictures_are_counted(load, monkeypatch):
    from cubecam.io import model_pictures

    monkeypatch.setattr(model_pictures, "_FREE_BYTES", 1000)
    monkeypatch.setattr(model_pictures, "_RATIO", 1)
    file = SceneFile()
    infos = [{"index": file.texture(np.zeros((30, 30, 3), np.uint8) + n)} for n in range(2)]
    file.node(mesh=file.mesh(file.square({"emissiveTexture": infos[0], "normalTexture": infos[1]})))
    with pytest.raises(cc.MeshError, match="expected pictures of at most"):
        load(file)


def test_pictures_are_decoded_once(load, monkeypatch):
    from cubecam.io import model_pictures
    from cubecam.io.picture_files import decode_picture

    decoded = []

    def counted(data):
        decoded.append(len(data))
        return decode_picture(data)

    monkeypatch.setattr(model_pictures, "decode_picture", counted)
    file = SceneFile()
    data = picture(noise(4, 4))
    source = file.image(data)
    view = file.tree["images"][source]["bufferView"]
    again = file.add("images", {"bufferView": view})
    infos = [{"index": file.texture(number)} for number in (source, source, again)]
    names = ("emissiveTexture", "normalTexture", "occlusionTexture")
    file.node(mesh=file.mesh(file.square(dict(zip(names, infos, strict=True)))))
    load(file)
    assert decoded == [len(data)]


# Other files


def test_an_error_names_the_file(tmp_path):
    path = tmp_path / "broken.glb"
    path.write_bytes(b"glTF")
    with pytest.raises(cc.MeshError, match=r"broken.glb: expected a GLB header"):
        cc.load_scene(path)


def test_a_missing_file(tmp_path):
    with pytest.raises(FileNotFoundError):
        cc.load_scene(tmp_path / "missing.glb")


def test_an_unknown_kind(tmp_path):
    (tmp_path / "a.xyz").write_bytes(b"x")
    with pytest.raises(cc.MeshError, match=r"ends in .glb, .gltf, .obj.*got .xyz"):
        cc.load_scene(tmp_path / "a.xyz")


def test_a_ply_is_one_node(tmp_path):
    text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    text += "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    text += "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n"
    (tmp_path / "leaf.ply").write_text(text)
    (node,) = cc.load_scene(tmp_path / "leaf.ply").nodes
    assert node.name == "leaf"
    assert isinstance(node.material, cc.StandardMaterial)
    assert node.mesh is not None
    np.testing.assert_array_equal(node.mesh.colors, [[1, 0, 0, 1]] * 3)
