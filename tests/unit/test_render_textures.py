"""RenderTexture as a value: defaults, what it refuses, pickling, which objects keep which alive."""

import copy
import gc
import pickle
import threading

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import copies, need_own_memory, run_python


def camera():
    return cc.OrthographicCamera(height=2, position=(0, 0, 5))


def texture(**options):
    return cc.RenderTexture(cc.Scene(), camera(), **options)


def test_defaults():
    scene, seen_from = cc.Scene(), camera()
    made = cc.RenderTexture(scene, seen_from)
    assert made.scene is scene
    assert made.camera is seen_from
    assert made.size == (512, 512)
    assert (made.format, made.samples, made.mipmaps, made.wrap) == ("rgba8", 1, False, "clamp")
    assert (made.exclude, made.name) == ((), "")


def test_everything_can_be_given_in_order_and_set():
    scene = cc.Scene()
    node = scene.add()
    made = cc.RenderTexture(
        scene,
        camera(),
        size=(16, 8),
        format="rgba16f",
        samples=4,
        mipmaps=True,
        wrap="repeat",
        exclude=[node],
        name="screen",
    )
    assert made.size == (16, 8)
    assert (made.format, made.samples, made.mipmaps, made.wrap) == ("rgba16f", 4, True, "repeat")
    assert (made.exclude, made.name) == ((node,), "screen")
    other, lens = cc.Scene(), cc.PerspectiveCamera()
    values = {
        "scene": other,
        "camera": lens,
        "size": [3, np.int64(5)],
        "format": "rgba32f",
        "samples": 2,
        "mipmaps": False,
        "wrap": "clamp",
        "exclude": iter([other.add()]),
        "name": "Bildschirm ä",
    }
    for name, value in values.items():
        setattr(made, name, value)
    assert (made.scene, made.camera, made.size) == (other, lens, (3, 5))
    assert made.exclude == other.nodes
    assert made.name == "Bildschirm ä"


def test_repr_names_it():
    assert repr(texture(size=(16, 8), name="screen")) == "RenderTexture('screen', 16 x 8, rgba8)"
    assert repr(texture()) == "RenderTexture(512 x 512, rgba8)"
    shown = cc.BasicMaterial(map=texture(name="a"))
    assert repr(shown) == "BasicMaterial(map=RenderTexture('a', 512 x 512, rgba8))"


BAD = {
    "size 0": ("size", (0, 5), ValueError, "size of at least 1 x 1, got 0 x 5"),
    "size negative": ("size", (5, -1), ValueError, "5 x -1"),
    "size one number": ("size", 5, TypeError, "size"),
    "size three": ("size", (5, 5, 5), TypeError, "size"),
    "size float": ("size", (5.0, 5), TypeError, "width: expected an int"),
    "size text": ("size", "55", TypeError, "size"),
    "size bool": ("size", (True, 5), TypeError, "width"),
    "samples 0": ("samples", 0, ValueError, "samples of at least 1, got 0"),
    "samples float": ("samples", 1.5, TypeError, "samples"),
    "format": ("format", "rgb8", ValueError, "format"),
    "wrap": ("wrap", "edge", ValueError, "wrap"),
    "exclude a node": ("exclude", cc.Scene().add(), TypeError, "exclude"),
    "exclude numbers": ("exclude", [3], TypeError, "exclude"),
    "exclude None": ("exclude", None, TypeError, "exclude"),
    "scene None": ("scene", None, TypeError, "scene: expected a Scene, got NoneType|scene"),
    "scene text": ("scene", "room", TypeError, "scene: expected a Scene, got str"),
    "camera None": ("camera", None, TypeError, "camera: expected a Camera"),
    "camera a probe": ("camera", cc.Probe(), TypeError, "camera: expected a Camera, got Probe"),
    "name": ("name", 3, TypeError, "name: expected str, got 3"),
}


@pytest.mark.parametrize(("name", "value", "error", "text"), BAD.values(), ids=BAD)
def test_bad_values(name, value, error, text):
    with pytest.raises(error, match=text):
        cc.RenderTexture(**{"scene": cc.Scene(), "camera": camera(), name: value})
    made = texture(name="kept")
    before = getattr(made, name)
    with pytest.raises(error):
        setattr(made, name, value)
    assert getattr(made, name) == before


def test_scene_and_camera_are_needed():
    with pytest.raises(TypeError):
        cc.RenderTexture()  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        cc.RenderTexture(cc.Scene())  # type: ignore[call-arg]


@pytest.mark.parametrize("kind", [cc.BasicMaterial, cc.PhongMaterial])
def test_materials_take_it_as_a_map(kind):
    made = texture()
    material = kind(map=made)
    assert material.map is made
    material.map = np.zeros((2, 2, 3), np.uint8)
    assert isinstance(material.map, cc.Image)
    material.map = made
    assert material.map is made
    material.map = None
    assert material.map is None
    with pytest.raises(TypeError, match="map: expected an Image, an array"):
        kind(map="screen.png")
    with pytest.raises(TypeError):
        kind(map=cc.Scene())


def room():
    """A scene with a monitor that shows this scene; the node `stand`, which the monitor leaves out; the monitor."""
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    stand = scene.add(name="stand")
    made = cc.RenderTexture(
        scene,
        cc.PerspectiveCamera(fov=33, position=(1, 2, 3), target=(0, 0, 0)),
        size=(20, 10),
        format="rgba16f",
        samples=2,
        mipmaps=True,
        wrap="repeat",
        exclude=[stand],
        name="monitor",
    )
    scene.add(cc.Mesh.plane(1, 1), cc.PhongMaterial(map=made), parent=stand)
    return scene, stand, made


def check_room(scene, stand, made):
    assert made.scene is scene
    assert scene.nodes[0] is stand
    assert scene.nodes[1].material.map is made
    assert made.exclude == (stand,)
    assert made.camera.fov == 33
    assert made.size == (20, 10)
    assert (made.format, made.samples, made.mipmaps, made.wrap) == ("rgba16f", 2, True, "repeat")
    assert made.name == "monitor"
    np.testing.assert_allclose(scene.background, [0.1, 0.2, 0.3, 1], rtol=1e-6)


@copies
@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1), (1, 2, 0), (2, 1, 0)])
def test_copies_keep_scene_users_and_nodes_together(make_copy, order):
    things = room()
    made = make_copy(tuple(things[i] for i in order))
    back = [made[order.index(i)] for i in range(3)]
    check_room(*back)
    assert all(a is not b for a, b in zip(back, things, strict=True))


@copies
def test_a_copy_of_the_texture_alone_brings_its_scene(make_copy):
    made = make_copy(room()[2])
    check_room(made.scene, made.scene.nodes[0], made)


@copies
def test_a_copy_of_what_shows_it(make_copy):
    material = make_copy(cc.BasicMaterial(map=texture(size=(3, 4))))
    assert material.map.size == (3, 4)


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_every_protocol(protocol):
    scene, *_ = pickle.loads(pickle.dumps(room(), protocol))
    assert scene.nodes[1].material.map.scene is scene


def test_two_scenes_that_show_each_other_come_back():
    a, b = texture(name="a"), texture(name="b")
    for one, other in ((a, b), (b, a)):
        one.scene.add(cc.Mesh.plane(1, 1), cc.BasicMaterial(map=other))
    for back in (pickle.loads(pickle.dumps(a)), copy.deepcopy(a)):
        other = back.scene.nodes[0].material.map
        assert (back.name, other.name) == ("a", "b")
        assert other.scene.nodes[0].material.map is back


def test_subclasses_come_back_as_such():
    back = copy.deepcopy(Screen(cc.Scene(), camera(), name="x"))
    assert type(back) is Screen
    assert back.name == "x"


class Screen(cc.RenderTexture):
    pass


def test_it_keeps_its_scene_and_not_what_it_leaves_out():
    scene = cc.Scene()
    node = scene.add(name="gone")
    made = cc.RenderTexture(scene, camera(), exclude=[node])
    scene.remove(node)
    del scene, node
    gc.collect()
    assert made.exclude == ()
    assert made.scene.nodes == ()
    made.scene.add()
    assert len(made.scene.nodes) == 1


@pytest.mark.slow
def test_a_monitor_in_its_room_keeps_neither_for_ever():
    """A room and its monitor refer to each other. A room's cubemap has 6 MB: a hundred kept rooms would need 600 MB.

    The test runs in its own process, because other objects of a process change when the next search for cycles runs.
    """
    need_own_memory()
    done = run_python(
        """
        import numpy as np, psutil
        import cubecam as cc

        def one():
            scene = cc.Scene(environment=cc.CubeMap(np.ones((6, 256, 256, 4), np.float32)))
            screen = scene.add(cc.Mesh.plane(1, 1))
            made = cc.RenderTexture(scene, cc.PerspectiveCamera(), exclude=[screen])
            screen.material = cc.BasicMaterial(map=made)

        for _ in range(20):
            one()
        before = psutil.Process().memory_info().rss / 2**20
        for _ in range(100):
            one()
        print(psutil.Process().memory_info().rss / 2**20 - before)
        """
    )
    assert float(done.stdout) < 250, f"{done.stdout.strip()} MB more after a hundred rooms"


@pytest.mark.parametrize("kept", ["scene", "texture", "node", "material", "another scene"])
def test_what_leads_to_a_monitor_keeps_its_room(kept):
    """If any part of the cycle is referred to from outside, the whole cycle stays."""
    scene, _, made = room()
    node = scene.nodes[1]
    other = cc.Scene()
    other.add(cc.Mesh.plane(1, 1), cc.BasicMaterial(map=made))
    held = {
        "scene": scene,
        "texture": made,
        "node": node,
        "material": node.material,
        "another scene": other,
    }[kept]
    del scene, node, made, other
    for _ in range(80):  # enough new rooms to start a search for cycles
        room()
    gc.collect()
    made = {
        "scene": lambda: held.nodes[1].material.map,
        "texture": lambda: held,
        "node": lambda: held.material.map,
        "material": lambda: held.map,
        "another scene": lambda: held.nodes[0].material.map,
    }[kept]()
    check_room(made.scene, made.scene.nodes[0], made)


def test_rooms_that_show_each_other_are_let_go_together():
    def pair():
        a, b = texture(name="a"), texture(name="b")
        for one, other in ((a, b), (b, a)):
            one.scene.add(cc.Mesh.plane(1, 1), cc.PhongMaterial(map=other))
        return a

    kept = [pair() for _ in range(30)]
    for _ in range(100):
        pair()
    for a in kept:
        assert a.scene.nodes[0].material.map.scene.nodes[0].material.map is a


def test_setters_on_several_threads():
    made = texture()

    def work(width):
        for _ in range(300):
            made.size = (width, width)
            made.name = str(width)
            assert made.size[0] == made.size[1]

    threads = [threading.Thread(target=work, args=(width,)) for width in (1, 2, 3, 4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert made.size[0] in (1, 2, 3, 4)
