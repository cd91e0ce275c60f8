"""Skins and morph targets, live: pictures and bounds against meshes that numpy bends as glTF 2.0 specifies."""

import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.bent import Bent, random_matrix
from tests.helpers import DEVICE

#: Only the middle of the sheet is in view, so that no silhouette is.
CAMERA = cc.OrthographicCamera(height=2, position=(0, 0, 5), target=(0, 0, 0))
SIZE = (32, 32)
SHOWN = {
    "position": "surface.position",
    "normal": "surface.normal",
    "uv": "vec3(surface.uv, 0.0)",
    "color": "surface.color.rgb",
}


def raw(text):
    return cc.ShaderMaterial(f"vec3 shade(Surface surface) {{ return {text}; }}", double_sided=True)


def draw(renderer, scene, camera=CAMERA, size=SIZE):
    return renderer.render(scene, camera, size, format="rgba32f").color


def rng_of(seed):
    return np.random.default_rng(seed)


@pytest.mark.parametrize("sets", [1, 2, 3])
@pytest.mark.parametrize("name", SHOWN)
def test_vertices_are_those_of_the_specification(renderer, name, sets):
    material = raw(SHOWN[name])
    bent = Bent(rng_of(sets), sets=sets, material=material)
    got = draw(renderer, bent.scene)
    assert np.ptp(got[..., :2]) > 0.05
    assert_close(got, draw(renderer, bent.baked(material)), "deformed", name=name)


def test_tangents_are_those_of_the_specification(renderer):
    picture = np.random.default_rng(3).random((8, 8, 3)).astype(np.float32)
    material = cc.StandardMaterial(normal_map=picture, normal_scale=0.3, roughness=0.6)
    for mirrored in (False, True):
        bent = Bent(rng_of(4), material=material)
        bent.pose(rng_of(5), mirrored=mirrored)
        baked = bent.baked(material)
        for scene in (bent.scene, baked):
            scene.add(cc.DirectionalLight((0.3, -0.2, -1)))
        got = draw(renderer, bent.scene)
        assert got[..., :3].mean() > 0.05, "light falls on the side in view"
        assert_close(got, draw(renderer, baked), "deformed_light")


@pytest.mark.parametrize("flat", [False, True])
def test_computed_normals_are_those_of_the_new_shape(renderer, flat):
    material = cc.PhongMaterial(flat_shading=flat, kd=1)
    bent = Bent(rng_of(6), normals=False, material=material)
    baked = bent.baked(material)
    for scene in (bent.scene, baked):
        scene.add(cc.DirectionalLight((0.6, -0.2, -1)))
    got, want = draw(renderer, bent.scene), draw(renderer, baked)
    assert np.ptp(got[..., 0]) > 0.02
    # Between flat triangles a pixel may belong to either.
    same = np.abs(got - want).max(axis=-1) < 1e-3
    assert same.mean() > (0.98 if flat else 0.9999)


def test_made_tangents_follow_morphs_and_joints(renderer):
    """MikkTSpace of the shape that targets made, then moved by the joints."""
    picture = np.random.default_rng(3).random((8, 8, 3)).astype(np.float32)
    material = cc.StandardMaterial(normal_map=picture, normal_scale=0.5, roughness=0.7)
    bent = Bent(rng_of(7), normals=True, material=material)
    bent.mesh.tangents = None
    for node in bent.nodes:  # one rigid move, under which MikkTSpace makes the same tangents
        node.parent = bent.root
        node.matrix = np.eye(4)
    turned = cc.axis_angle((0, 0, 1), 30)
    bent.root.rotation = turned
    bent.node.skin = cc.Skin(bent.nodes)
    bent.rest = np.tile(np.eye(4), (len(bent.nodes), 1, 1))
    arrays = {**bent.arrays(), "tangents": None}
    baked = cc.Scene(background=(0, 0, 0))
    baked.add(cc.Mesh(**arrays), material)
    for scene in (bent.scene, baked):
        scene.add(cc.DirectionalLight((0.3, -0.5, -1)))
    assert_close(draw(renderer, bent.scene), draw(renderer, baked), "deformed_light")


@pytest.mark.parametrize("place", [(0, 0, 0), (1e6, -2e6, 3e6)])
def test_bounds_are_exact(renderer, place):
    bent = Bent(rng_of(8), place=place)
    want = bent.arrays()["positions"]
    corners = np.stack([want.min(axis=0), want.max(axis=0)])
    assert np.abs(bent.node.world_bounds - corners).max() < 3e-6
    assert np.abs(bent.scene.bounds - corners).max() < 3e-6
    bent.pose(rng_of(9))
    bent.node.weights = [2, -1]
    want = bent.arrays()["positions"]
    corners = np.stack([want.min(axis=0), want.max(axis=0)])
    assert np.abs(bent.node.world_bounds - corners).max() < 6e-6


def test_far_from_the_origin_a_skin_is_as_exact_as_near_it(renderer):
    near = Bent(rng_of(10), material=raw("surface.normal"))
    far = Bent(rng_of(10), material=raw("surface.normal"), place=(2**20, -(2**21), 2**20))
    camera = cc.OrthographicCamera(
        height=2, position=(2**20, -(2**21), 2**20 + 5), target=(2**20, -(2**21), 2**20)
    )
    got = draw(renderer, far.scene, camera)
    assert_close(got, draw(renderer, near.scene), "deformed")


def test_the_place_of_the_node_itself_has_no_effect(fresh_renderer):
    bent = Bent(rng_of(11))
    before = draw(fresh_renderer, bent.scene)
    bounds = bent.node.world_bounds
    bent.node.matrix = random_matrix(rng_of(12))
    assert_identical(draw(fresh_renderer, bent.scene), before)
    assert fresh_renderer.stats.views_drawn == 0
    assert_identical(bent.node.world_bounds, bounds)
    below = bent.scene.add(cc.Mesh.box(0.1), parent=bent.node)
    assert_identical(below.world_matrix, bent.node.matrix)


def scratch(scene, size=SIZE, camera=CAMERA):
    """The picture of a copy of the scene by a renderer that has drawn nothing before."""
    with cc.Renderer(device=DEVICE) as renderer:
        return draw(renderer, pickle.loads(pickle.dumps(scene)), camera, size)


def test_only_what_changes_is_drawn(fresh_renderer):
    bent = Bent(rng_of(13), material=raw("surface.normal"))
    steps = [
        (lambda: None, 1),
        (lambda: None, 0),
        (lambda: bent.pose(rng_of(13)), 1),
        (lambda: setattr(bent.nodes[0], "matrix", bent.nodes[0].matrix), 0),
        (lambda: setattr(bent.node, "weights", [0.3, 0.3]), 1),
        (lambda: setattr(bent.node, "weights", np.array([0.3, 0.3], np.float32)), 0),
        (lambda: setattr(bent.node, "weights", [0, 0]), 1),
        (lambda: setattr(bent.root, "position", (0.1, 0, 0)), 1),
        (lambda: setattr(bent.node, "name", "sheet"), 0),
        (lambda: setattr(bent.mesh, "positions", bent.mesh.positions * 1.1), 1),
        (lambda: setattr(bent.node, "skin", cc.Skin(bent.nodes, bent.rest)), 0),
        (lambda: setattr(bent.node, "skin", None), 1),
    ]
    for index, (change, drawn) in enumerate(steps):
        change()
        got = draw(fresh_renderer, bent.scene)
        assert fresh_renderer.stats.views_drawn == drawn, f"step {index}"
        assert_identical(got, scratch(bent.scene), f"step {index}")


def test_nodes_that_share_a_shape_may_part(fresh_renderer):
    """Two nodes have one mesh, skin and weights; then their weights differ, in either order."""
    for first in (0, 1):
        bent = Bent(rng_of(14), material=raw("surface.normal"))
        bent.mesh.update(positions=bent.mesh.positions * 0.1)
        bent.pose(rng_of(15))
        nodes = [bent.node]
        free = [
            bent.scene.add(
                bent.mesh, raw("surface.position"), position=(x, 0, 1), weights=bent.node.weights
            )
            for x in (-0.5, 0.5)
        ]
        nodes += free
        for weights in ((1, 0), (0, 1), (0, 0), (0, 1)):
            free[first].weights = weights
            assert_identical(draw(fresh_renderer, bent.scene), scratch(bent.scene))
            free[1 - first].weights = weights
            assert_identical(draw(fresh_renderer, bent.scene), scratch(bent.scene))


def test_probes_shadows_and_ids_follow(fresh_renderer):
    """A scene that looks at a skinned mesh in every way, against the same scene with a baked mesh."""
    painted = cc.PhongMaterial(color=(1, 0.3, 0.1), double_sided=True)
    bent = Bent(rng_of(16), material=painted)
    bent.mesh.update(positions=bent.mesh.positions * (0.2, 0.2, 1))
    bent.positions = bent.mesh.positions
    camera = cc.PerspectiveCamera(position=(2, 3, 5), target=(0, 0, 0))

    def complete(scene):
        scene.add(cc.DirectionalLight((0.2, -0.3, -1), shadow=cc.Shadow(size=64)))
        scene.add(cc.AmbientLight(intensity=0.3))
        scene.add(cc.Mesh.box((8, 8, 0.1)), cc.PhongMaterial(), position=(0, 0, -1.5))
        probe = cc.Probe(position=(0, 2, 2), size=32)
        scene.add(cc.Mesh.sphere(0.7), cc.MirrorMaterial(), position=(0, 2, 2), environment=probe)

    complete(bent.scene)
    for seed in (17, 18):
        bent.pose(rng_of(seed))
        baked = bent.baked(painted)
        complete(baked)
        got = fresh_renderer.render(bent.scene, camera, (96, 72), outputs=("id",))
        assert fresh_renderer.stats.views_drawn > 2
        with cc.Renderer(device=DEVICE) as other:
            want = other.render(baked, camera, (96, 72), outputs=("id",))
        off = np.abs(got.color.astype(int) - want.color).max(axis=-1) > 4
        assert off.mean() < 0.01
        sheet = got.id == bent.node.id
        assert sheet.mean() > 0.02
        assert (sheet != (want.id == 1)).mean() < 0.005
        assert_identical(got.color, scratch_bytes(bent.scene, camera))


def scratch_bytes(scene, camera):
    with cc.Renderer(device=DEVICE) as renderer:
        copy = pickle.loads(pickle.dumps(scene))
        return renderer.render(copy, camera, (96, 72), outputs=("id",)).color


def test_mirrored_joints_show_their_outside(renderer):
    """The triangles of mirrored vertices are turned round, so that the side of the normals stays outside."""
    bent = Bent(rng_of(19), material=cc.BasicMaterial(color=(1, 0, 0)))
    behind = cc.OrthographicCamera(height=2, position=(0, 0, -5), target=(0, 0, 0))
    for node in bent.nodes:
        node.parent = bent.root
    for mirrored in (True, False, True):
        bent.pose(rng_of(20), mirrored=mirrored)
        assert (draw(renderer, bent.scene)[..., 0] == 1).all()
        assert (draw(renderer, bent.scene, behind)[..., 0] == 0).all()


def test_without_its_joints_a_node_is_drawn_as_it_stands(fresh_renderer):
    bent = Bent(rng_of(21), targets=0, material=raw("surface.normal"))
    plain = cc.Scene(background=(0, 0, 0))
    plain.add(bent.mesh, bent.node.material, matrix=bent.node.matrix)
    bounds = plain.bounds
    assert np.abs(bent.scene.bounds - bounds).max() > 0.1
    draw(fresh_renderer, bent.scene)
    last = next(node for node in reversed(bent.nodes) if not node.children)
    bent.scene.remove(last)
    assert_identical(draw(fresh_renderer, bent.scene), scratch(plain))
    assert_identical(bent.scene.bounds, bounds)
    bent.nodes.remove(last)
    del last
    skin = bent.node.skin
    assert skin is not None
    assert skin.joints.count(None) == 1
    assert_identical(draw(fresh_renderer, bent.scene), scratch(plain))
    again = pickle.loads(pickle.dumps(bent.scene))
    assert_identical(draw(fresh_renderer, again), scratch(plain))


def test_a_removed_group_keeps_its_skin():
    bent = Bent(rng_of(22))
    bent.node.parent = bent.root
    want = bent.node.world_bounds
    bent.scene.remove(bent.root)
    assert_identical(bent.node.world_bounds, want)


def test_a_mesh_that_loses_its_joints_is_drawn_as_it_stands(fresh_renderer):
    bent = Bent(rng_of(23), material=raw("surface.normal"), targets=0)
    draw(fresh_renderer, bent.scene)
    bent.mesh.update(
        joints=np.full((81, 4), 5), joint_weights=np.ones((81, 4))
    )  # there is no joint 5
    plain = cc.Scene(background=(0, 0, 0))
    plain.add(bent.mesh, bent.node.material, matrix=bent.node.matrix)
    assert_identical(draw(fresh_renderer, bent.scene), scratch(plain))


def test_targets_that_make_colors_translucent(fresh_renderer):
    """Opaque nodes become blended ones, and back, in the pictures after a change of weights alone."""
    quad = cc.Mesh.plane(4, 4)
    veil = cc.MorphTarget(colors=np.tile((0, 0, 0, -1), (4, 1)))
    quad.update(colors=np.tile((1, 0, 0, 1), (4, 1)), morph_targets=[veil])
    scene = cc.Scene(background=(0, 0, 1))
    turned = cc.axis_angle((1, 0, 0), 90)
    node = scene.add(quad, cc.BasicMaterial(vertex_colors=True), rotation=turned)
    for weight in (0, 0.5, 0, 0.25):
        node.weights = [weight]
        got = draw(fresh_renderer, scene)[16, 16, :3]
        assert np.abs(got - (1 - weight, 0, weight)).max() < 0.01


def test_weights_of_0_are_the_mesh_itself(fresh_renderer):
    bent = Bent(rng_of(24), material=raw("surface.normal"))
    bent.node.skin = None
    bent.node.matrix = np.eye(4)
    bent.node.weights = [0, 0]
    plain = cc.Scene(background=(0, 0, 0))
    plain.add(bent.mesh, bent.node.material)
    assert_identical(draw(fresh_renderer, bent.scene), scratch(plain))


def test_vertices_without_weights_go_with_the_first_joint():
    mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    mesh.update(joints=np.ones((3, 4), int), joint_weights=np.zeros((3, 4)))
    assert np.array(mesh.joints).max() == 0
    scene = cc.Scene()
    joints = [scene.add(position=(x, 0, 0)) for x in (5, 9)]
    node = scene.add(mesh, skin=cc.Skin(joints))
    assert node.world_bounds.tolist() == [[5, 0, 0], [6, 1, 0]]


def test_joints_that_flatten_give_finite_pictures(renderer):
    """Normals that the matrices make 0 are replaced by smooth ones."""
    bent = Bent(rng_of(25), targets=0, material=raw("surface.normal"))
    flat = np.diag((1.0, 1.0, 0.0, 1.0))
    bent.node.skin = cc.Skin([bent.root] * len(bent.nodes), [flat] * len(bent.nodes))
    got = draw(renderer, bent.scene)
    assert np.isfinite(got).all()
    assert_close(got[..., :3], np.broadcast_to((0.0, 0.0, 1.0), (*SIZE, 3)), "deformed")
