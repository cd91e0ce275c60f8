"""Nodes: transforms against the oracle, parents and children, ids, flags."""

import gc

import numpy as np
import pytest

import cubecam as cc
from tests.reference import transforms as ref

POSITION, AXIS, DEGREES, SCALE = (1, -2, 3), (1, 2, -1), 50, (2, 0.5, 1.5)


@pytest.fixture
def scene():
    return cc.Scene()


@pytest.fixture
def box():
    return cc.Mesh.box(1)


def test_at_rest_a_node_has_the_identity(scene, box):
    node = scene.add(box)
    np.testing.assert_array_equal(node.world_matrix, np.eye(4))
    np.testing.assert_array_equal(node.position, [0, 0, 0])
    np.testing.assert_array_equal(node.rotation, [1, 0, 0, 0])
    np.testing.assert_array_equal(node.scale, [1, 1, 1])


@pytest.mark.parametrize("guess", [(0, 90, 0), np.array([0, 90, 0]), np.eye(3)])
def test_angles_and_matrices_are_no_rotation(scene, guess):
    with pytest.raises(ValueError, match=r"quaternion \(w, x, y, z\), as cc.axis_angle gives"):
        scene.add(rotation=guess)
    with pytest.raises(ValueError, match="rotation: expected"):
        scene.add(rotation=np.float64(4))


def test_matrix_is_translation_rotation_scale(scene, box):
    node = scene.add(box, position=POSITION, rotation=cc.axis_angle(AXIS, DEGREES), scale=SCALE)
    want = ref.trs(POSITION, ref.axis_angle(AXIS, DEGREES), SCALE)
    np.testing.assert_allclose(node.world_matrix, want, atol=1e-12)
    np.testing.assert_allclose(node.matrix, want, atol=1e-12)
    np.testing.assert_allclose(node.matrix @ [1, 1, 1, 1], want @ [1, 1, 1, 1], atol=1e-12)


def test_axis_angle_is_a_quaternion_w_first():
    np.testing.assert_allclose(
        cc.axis_angle((0, 3, 0), 90), [np.sqrt(0.5), 0, np.sqrt(0.5), 0], atol=1e-12
    )
    np.testing.assert_allclose(
        cc.axis_angle(AXIS, DEGREES), ref.axis_angle(AXIS, DEGREES), atol=1e-12
    )


def test_positive_angles_turn_anticlockwise_seen_from_the_tip(scene):
    node = scene.add(rotation=cc.axis_angle((0, 1, 0), 90))
    np.testing.assert_allclose(node.world_matrix[:3, :3] @ [0, 0, 1], [1, 0, 0], atol=1e-12)


def test_quaternions_are_normalised(scene):
    node = scene.add(rotation=(0, 0, 4, 0))
    np.testing.assert_allclose(node.world_matrix, ref.rotation((0, 0, 1, 0)), atol=1e-12)


def test_a_number_scales_all_axes(scene):
    np.testing.assert_array_equal(scene.add(scale=3).scale, [3, 3, 3])


def test_a_matrix_is_taken_whole(scene):
    matrix = ref.trs(POSITION, ref.axis_angle(AXIS, DEGREES), SCALE)
    node = scene.add(matrix=matrix)
    np.testing.assert_allclose(node.world_matrix, matrix, atol=1e-12)
    np.testing.assert_allclose(node.position, POSITION)
    np.testing.assert_allclose(node.scale, SCALE)


def test_a_sheared_matrix_is_taken_and_its_parts_are_refused(scene):
    matrix = np.eye(4)
    matrix[0, 1] = 0.5
    node = scene.add(matrix=matrix)
    np.testing.assert_array_equal(node.matrix, matrix)
    with pytest.raises(ValueError, match="shear"):
        _ = node.rotation


def test_a_matrix_and_parts_exclude_each_other(scene):
    with pytest.raises(ValueError, match="matrix"):
        scene.add(matrix=np.eye(4), position=(1, 0, 0))


def test_setters(scene):
    node = scene.add()
    node.position, node.rotation, node.scale = POSITION, cc.axis_angle(AXIS, DEGREES), SCALE
    want = ref.trs(POSITION, ref.axis_angle(AXIS, DEGREES), SCALE)
    np.testing.assert_allclose(node.world_matrix, want, atol=1e-12)
    node.matrix = np.eye(4)
    np.testing.assert_array_equal(node.position, [0, 0, 0])


def test_arrays_handed_out_are_read_only(scene):
    node = scene.add()
    for name in ("position", "rotation", "scale", "matrix", "world_matrix"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(node, name)[0] = 3


def test_world_matrices_multiply_down_the_tree(scene, box):
    a = scene.add(position=(1, 0, 0), rotation=cc.axis_angle((0, 0, 1), 90))
    b = scene.add(position=(0, 2, 0), scale=(1, 2, 3), parent=a)
    c = scene.add(box, position=(0, 0, 3), parent=b)
    want = (
        ref.trs((1, 0, 0), ref.axis_angle((0, 0, 1), 90))
        @ ref.trs((0, 2, 0), scale=(1, 2, 3))
        @ ref.translation((0, 0, 3))
    )
    np.testing.assert_allclose(c.world_matrix, want, atol=1e-12)
    a.position = (5, 0, 0)
    np.testing.assert_allclose(c.world_matrix, ref.translation((4, 0, 0)) @ want, atol=1e-12)


def test_parents_and_children(scene):
    a, b = scene.add(name="a"), scene.add(name="b")
    c = scene.add(parent=a)
    assert c.parent is a
    assert list(a.children) == [c]
    c.parent = b
    assert (list(a.children), list(b.children)) == ([], [c])
    c.parent = None
    assert c.parent is None
    assert not b.children


@pytest.mark.parametrize("length", [1, 2, 5])
def test_parent_cycles_are_refused_and_leave_the_tree(scene, length):
    chain = [scene.add()]
    for _ in range(length - 1):
        chain.append(scene.add(parent=chain[-1]))
    with pytest.raises(ValueError, match="cycle"):
        chain[0].parent = chain[-1]
    assert chain[0].parent is None


def test_a_parent_of_another_scene_is_refused(scene):
    stranger = cc.Scene().add()
    with pytest.raises(ValueError, match="scene"):
        scene.add(parent=stranger)
    with pytest.raises(ValueError, match="scene"):
        scene.add().parent = stranger


def test_ids_count_from_1_and_are_never_reused(scene, box):
    nodes = [scene.add(box) for _ in range(3)]
    assert [node.id for node in nodes] == [1, 2, 3]
    scene.remove(nodes[2])
    assert scene.add(box).id == 4
    scene.clear()
    assert scene.add(box).id == 5


def test_ids_are_not_to_be_set(scene):
    with pytest.raises(AttributeError):
        scene.add().id = 7


def test_removing_takes_the_subtree(scene, box):
    a = scene.add(box)
    b = scene.add(box, parent=a)
    c = scene.add(box)
    scene.remove(a)
    assert list(scene.nodes) == [c]
    assert b.parent is a
    with pytest.raises(ValueError, match="scene"):
        scene.remove(a)


def test_a_light_is_returned_and_removed(scene):
    light = scene.add(cc.PointLight(position=(1, 2, 3)))
    assert isinstance(light, cc.PointLight)
    assert list(scene.lights) == [light]
    scene.remove(light)
    assert not scene.lights
    with pytest.raises(ValueError, match="light"):
        scene.remove(light)


def test_nodes_are_kept_by_their_scene(scene, box):
    scene.add(box, name="kept")
    gc.collect()
    assert [node.name for node in scene.nodes] == ["kept"]
    assert scene.nodes[0] is scene.nodes[0]


def test_a_node_without_material_is_phong(scene, box):
    assert isinstance(scene.add(box).material, cc.PhongMaterial)


def test_a_group_has_no_mesh(scene):
    assert scene.add().mesh is None


def test_mesh_and_material_are_shared_objects(scene, box):
    material = cc.BasicMaterial()
    a, b = scene.add(box, material), scene.add(box, material)
    assert a.mesh is box
    assert a.material is b.material is material


def test_flags_default_and_change(scene, box):
    node = scene.add(box)
    assert node.visible is True
    assert node.in_captures is True
    node.visible, node.in_captures = False, False
    assert node.visible is False
    assert node.in_captures is False


def test_environment_takes_none_a_cubemap_or_a_probe(scene, box):
    node = scene.add(box)
    assert node.environment is None
    for value in (cc.CubeMap(np.zeros((6, 2, 2, 3))), cc.Probe(position=(0, 0, 0)), None):
        node.environment = value
        assert node.environment is value
    with pytest.raises(TypeError):
        node.environment = "sky"


def test_scene_environment_and_background(scene):
    assert scene.environment is None
    assert scene.background is None
    cube = cc.CubeMap(np.zeros((6, 2, 2, 3)))
    scene.environment = cube
    assert scene.environment is cube
    scene.background = (0.1, 0.2, 0.3)
    np.testing.assert_allclose(scene.background, [0.1, 0.2, 0.3, 1], rtol=1e-6)
    scene.background = cube
    assert scene.background is cube
    other = cc.Scene(environment=cube, background=(1, 0, 0))
    assert other.environment is cube


BAD_PLACES = {
    "position nan": ({"position": (np.nan, 0, 0)}, ValueError, "position"),
    "position of 2": ({"position": (0, 0)}, ValueError, "position"),
    "position text": ({"position": "origin"}, TypeError, "position"),
    "position bool": ({"position": (True, False, True)}, TypeError, "position"),
    "rotation of 3": ({"rotation": (1, 0, 0)}, ValueError, "rotation"),
    "rotation zero": ({"rotation": (0, 0, 0, 0)}, ValueError, "rotation"),
    "rotation inf": ({"rotation": (np.inf, 0, 0, 0)}, ValueError, "rotation"),
    "scale zero": ({"scale": (1, 0, 1)}, ValueError, "scale"),
    "scale number zero": ({"scale": 0}, ValueError, "scale"),
    "matrix of 3": ({"matrix": np.eye(3)}, ValueError, "matrix"),
    "matrix singular": ({"matrix": np.diag([1, 1, 0, 1.0])}, ValueError, "singular"),
    "matrix nan": ({"matrix": np.full((4, 4), np.nan)}, ValueError, "matrix"),
    "matrix complex": ({"matrix": np.eye(4) * 1j}, TypeError, "matrix"),
}


@pytest.mark.parametrize(("where", "error", "text"), BAD_PLACES.values(), ids=BAD_PLACES)
def test_bad_places_are_refused_and_add_nothing(scene, where, error, text):
    with pytest.raises(error, match=text):
        scene.add(**where)
    assert not scene.nodes
    node = scene.add(position=(1, 2, 3))
    name, value = next(iter(where.items()))
    with pytest.raises(error, match=text):
        setattr(node, name, value)
    np.testing.assert_array_equal(node.world_matrix, ref.translation((1, 2, 3)))


@pytest.mark.parametrize("bad", ["mesh", 3, cc.BasicMaterial])
def test_only_meshes_and_lights_are_added(scene, bad):
    with pytest.raises(TypeError):
        scene.add(bad)


def test_a_material_without_a_mesh_is_no_mesh(scene):
    with pytest.raises(TypeError):
        scene.add(cc.BasicMaterial())


def test_bad_backgrounds_are_refused(scene):
    with pytest.raises(ValueError, match="background"):
        scene.background = (np.nan, 0, 0)
    with pytest.raises((TypeError, ValueError)):
        scene.background = "sky.png"
    with pytest.raises(TypeError):
        scene.environment = (1, 0, 0)
