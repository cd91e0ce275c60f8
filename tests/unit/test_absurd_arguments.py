"""Every argument and every property gets values that it does not expect.

A value of the right kind may be accepted or refused as a wrong number. Every other one raises one of the exceptions
that callers expect, with a short message: never SystemError, OverflowError, RecursionError or a crash. Where the
annotation names nothing but bool, int, float, str, None and lists of names, a value of another kind is never accepted,
and the message says "expected ..., got ...".
"""

import contextlib
import functools
import itertools
import sys
import warnings
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam import cluster, demo, explore, navigation, plot, truth
from cubecam.viewer.cube_view import CubeView
from cubecam.viewer.viewer import Viewer
from tests import absurd
from tests.gl import pool_scenes

PLACES = list(absurd.places())
BY_CALLABLE = {
    name: list(some)
    for name, some in itertools.groupby(
        sorted(PLACES, key=lambda p: p.callable), lambda p: p.callable
    )
}

#: What a call may raise. A missing file is an OSError, an animation or a node that is not there a KeyError.
EXPECTED = (TypeError, ValueError, IndexError, KeyError, OSError, cc.Error)
LONGEST = 1500  # letters of a message, for a list of many names

FACES = np.full((6, 2, 2, 3), 0.5, np.float32)
PICTURE = np.full((2, 4, 3), 0.5, np.float32)
TRIANGLE: dict[str, Any] = {"positions": np.eye(3), "indices": [[0, 1, 2]]}
SHADE = "vec3 shade(Surface s) { return vec3(1.0); }"
EFFECT = "vec4 effect(vec2 uv) { return frame(uv); }"


def cube():
    return cc.CubeMap(FACES)


def node():
    return cc.Scene().add(cc.Mesh(**TRIANGLE), cc.PhongMaterial())


def channel():
    return cc.AnimationChannel(node(), "translation", [0.0, 1.0], np.zeros((2, 3)))


def animated_scene():
    scene = cc.Scene()
    mover = scene.add(cc.Mesh(**TRIANGLE))
    moves = cc.AnimationChannel(mover, "translation", [0.0, 1.0], np.zeros((2, 3)))
    scene.add(animation=cc.Animation([moves]))
    return scene


def lit_scene():
    scene = cc.Scene()
    light = scene.add(cc.DirectionalLight(shadow=cc.Shadow(size=16)))
    return {"scene": scene, "light": light}


@functools.cache
def demo_scene():
    return demo.build_scene(environment=cube(), probe_size=2)


@functools.cache
def baking():
    """A renderer for calls that take one."""
    return cc.Renderer()


#: An object of a class whose methods and properties are used.
OBJECTS: dict[str, Any] = {
    "Node": node,
    "CubeMap": cube,
    "Mesh": lambda: cc.Mesh(**TRIANGLE),
    "Material": cc.PhongMaterial,
    "Light": cc.PointLight,
    "Camera": lambda: cc.Camera(view=np.eye(4), projection=np.eye(4)),
    "StereoCamera": lambda: cc.StereoCamera(cc.PerspectiveCamera(), cc.PerspectiveCamera()),
    "RenderTexture": lambda: cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera()),
    "ProbeBlend": lambda: cc.ProbeBlend([cc.Probe(size=2)]),
    "ProbeGrid": lambda: cc.ProbeGrid(((0, 0, 0), (1, 1, 1)), (2, 2, 2), size=1, resolution=4),
    "ShaderMaterial": lambda: cc.ShaderMaterial(SHADE),
    "ImageEffect": lambda: cc.ImageEffect(EFFECT),
    "AnimationChannel": channel,
    "Scene": animated_scene,
    "DemoScene": lambda: demo_scene(),
}

#: The arguments without which a call has no meaning, and those that keep it small or quiet.
NEEDED: dict[str, Any] = {
    "Node.look_at": lambda: {"target": (9, 9, 9)},
    "RenderTexture": lambda: {"scene": cc.Scene(), "camera": cc.PerspectiveCamera()},
    "ProbeBlend": lambda: {"probes": [cc.Probe(size=2)]},
    "ProbeGrid": lambda: {"box": ((0, 0, 0), (1, 1, 1)), "counts": (2, 2, 2), "resolution": 4},
    "ProbeGrid.bake": lambda: {"renderer": baking(), "scene": cc.Scene()},
    "Scene.__contains__": dict,
    "Scene.__getitem__": dict,
    "Scene.remove": dict,
    "Scene.set_matrices": lambda: {"nodes": [], "matrices": np.zeros((0, 4, 4))},
    "Scene.set_positions": lambda: {"nodes": [], "positions": np.zeros((0, 3))},
    "Scene.set_time": lambda: {"seconds": 0.5},
    "Scene.save": lambda: {"path": "a.glb"},
    "Scene.to_mitsuba": lambda: {"camera": cc.PerspectiveCamera(), "size": (8, 8), "path": "a.xml"},
    "Scene.show": lambda: {"where": "offscreen", "size": (8, 8)},
    "CubeMap": lambda: {"faces": FACES},
    "CubeMap.from_equirect": lambda: {"image": PICTURE, "size": 1},
    "equirect_to_faces": lambda: {"images": PICTURE[None], "size": 1},
    "faces_to_equirect": lambda: {"faces": FACES, "width": 2},
    "CubeMap.to_perspective": lambda: {"fov": 60, "size": 2},
    "CubeMap.from_perspective": lambda: {"image": PICTURE, "fov": 60, "size": 1},
    "CubeMap.from_cylindrical": lambda: {"image": PICTURE, "size": 1},
    "CubeMap.from_dual_paraboloid": lambda: {"image": PICTURE, "size": 1},
    "CubeMap.from_fisheye": lambda: {"image": PICTURE[:, :2], "size": 1},
    "CubeMap.from_mirror_ball": lambda: {"image": PICTURE[:, :2], "size": 1},
    "CubeMap.from_angular_map": lambda: {"image": PICTURE[:, :2], "size": 1},
    "CubeMap.from_octahedral": lambda: {"image": PICTURE[:, :2], "size": 1},
    "CubeMap.rotate": lambda: {"rotation": (1, 0, 0, 0)},
    "CubeMap.from_layout": lambda: {"image": np.zeros((1, 6, 3), np.float32)},
    "CubeMap.from_levels": lambda: {"levels": [cube(), cube()]},
    "CubeMap.from_sh": lambda: {"coefficients": np.ones((1, 3)), "size": 1},
    "CubeMap.irradiance": lambda: {"size": 1},
    "CubeMap.prefilter": lambda: {"levels": 2, "size": 2},
    "CubeMap.resize": lambda: {"size": 1},
    "CubeMap.sample": lambda: {"directions": [1, 0, 0]},
    "CubeMap.save": lambda: {"path": "a.exr"},
    "CubeMap.save_for": lambda: {"engine": "three", "folder": "three"},
    "CubeMap.set_face": lambda: {"face": 0, "pixels": FACES[0]},
    "CubeMap.show": lambda: {"where": "offscreen", "size": (8, 8)},
    "CubeMap.to_convention": lambda: {"convention": "gl"},
    "Image": lambda: {"pixels": PICTURE},
    "MorphTarget": lambda: {"positions": np.zeros((3, 3))},
    "Skin": lambda: {"joints": [node()]},
    "Mesh": lambda: dict(TRIANGLE),
    "Mesh.from_trimesh": dict,
    "Mesh.resized": lambda: {"size": 1},
    "Blend": lambda: {"src": "one", "dst": "one"},
    "Texture": lambda: {"source": PICTURE},
    "ShaderMaterial": lambda: {"fragment": SHADE},
    "ImageEffect": lambda: {"fragment": EFFECT},
    "Camera": lambda: {"view": np.eye(4), "projection": np.eye(4)},
    "Camera.intrinsics": lambda: {"size": (4, 4)},
    "PerspectiveCamera.from_intrinsics": lambda: {
        "K": [[100.0, 0.0, 32.0], [0.0, 100.0, 24.0], [0.0, 0.0, 1.0]],
        "size": (64, 48),
    },
    **{
        f"{kind}.{method}": arguments
        for kind in ("PerspectiveCamera", "OrthographicCamera")
        for method, arguments in {
            "fit": lambda: {"what": [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]]},
            "look": lambda: {"direction": (1, 0, 0)},
            "look_at": lambda: {"target": (9, 9, 9)},
            "pitch": lambda: {"degrees": 1},
            "yaw": lambda: {"degrees": 1},
            "walk": lambda: {"distance": 1},
            "strafe": lambda: {"distance": 1},
        }.items()
    },
    **{
        f"navigation.{name}": lambda name=name: (
            {"camera": cc.PerspectiveCamera(target=(0, 0, -1))}
            | ({"direction": (1, 0, 0)} if name == "look" else {})
            | ({"degrees": 1} if name in ("yaw", "pitch") else {})
            | ({"distance": 1} if name in ("walk", "strafe") else {})
        )
        for name in navigation.__all__
    },
    "AnimationChannel": lambda: {
        "node": node(),
        "path": "translation",
        "times": [0.0, 1.0],
        "values": np.zeros((2, 3)),
    },
    "AnimationChannel.sample": lambda: {"seconds": 0.5},
    "Animation": lambda: {"channels": [channel()]},
    "StereoCamera": lambda: {"left": cc.PerspectiveCamera(), "right": cc.PerspectiveCamera()},
    "StereoCamera.off_axis": lambda: {"camera": cc.PerspectiveCamera(), "convergence": 1.0},
    "StereoCamera.toe_in": lambda: {"camera": cc.PerspectiveCamera(target=(0, 0, -1))},
    "Frame.save": lambda: {"path": "a.png"},
    "Renderer.capture": lambda: {"scene": cc.Scene(), "size": 1},
    "Renderer.capture_many": lambda: {
        "scene": cc.Scene(),
        "positions": [(0, 0, 0)],
        "size": 1,
    },
    "Renderer.iter_captures": lambda: {
        "scene": cc.Scene(),
        "positions": [(0, 0, 0)],
        "size": 1,
    },
    "Renderer.render_many": lambda: {
        "scene": cc.Scene(),
        "cameras": [cc.PerspectiveCamera()],
        "size": (2, 2),
    },
    "capture_scenes": lambda: {"make_scene": lambda number: cc.Scene(), "count": 1, "size": 1},
    "Pool.capture_many": lambda: {"scene": cc.Scene(), "positions": [(0, 0, 0)], "size": 1},
    "Pool.iter_captures": lambda: {"scene": cc.Scene(), "positions": [(0, 0, 0)], "size": 1},
    "Pool.render_many": lambda: {
        "scene": cc.Scene(),
        "cameras": [cc.PerspectiveCamera()],
        "size": (2, 2),
    },
    "Pool.capture_scenes": lambda: {"make_scene": pool_scenes.numbered, "count": 1, "size": 1},
    "Renderer.capture_async": lambda: {"scene": cc.Scene(), "size": 1},
    "Renderer.render": lambda: {
        "scene": cc.Scene(),
        "camera": cc.PerspectiveCamera(),
        "size": (2, 2),
    },
    "Renderer.render_async": lambda: {
        "scene": cc.Scene(),
        "camera": cc.PerspectiveCamera(),
        "size": (2, 2),
    },
    "Renderer.read_probe": dict,
    "Renderer.read_texture": dict,
    "Renderer.shadow_map": lit_scene,
    "Renderer.update_probes": lambda: {"scene": cc.Scene()},
    "axis_angle": lambda: {"axis": (0, 0, 1), "degrees": 30},
    "brdf": lambda: {"n_dot_v": 0.5, "roughness": 0.5},
    "reflect": lambda: {"incident": (0, -1, 0), "normal": (0, 1, 0)},
    "refract": lambda: {"incident": (0, -1, 0), "normal": (0, 1, 0), "eta": 0.5},
    "fresnel": lambda: {"incident": (0, -1, 0), "normal": (0, 1, 0), "eta": 0.5},
    "schlick": lambda: {"incident": (0, -1, 0), "normal": (0, 1, 0), "f0": 0.5},
    "load_cubemap": lambda: {"path": "cube.exr"},
    "load_environment": lambda: {"path": "cube.exr"},
    "load_image": lambda: {"path": "image.png"},
    "load_mesh": lambda: {"path": "mesh.obj"},
    "load_scene": lambda: {"path": "scene.glb"},
    "open_batch": lambda: {"store": "batch.zarr"},
    "save_animation": lambda: {"path": "a.gif", "frames": [PICTURE]},
    "save_image": lambda: {"path": "a.png", "pixels": PICTURE},
    "to_screen": lambda: {"picture": PICTURE},
    "plot.arrows": lambda: {"origins": [0, 0, 0], "vectors": {"x": [1, 0, 0]}},
    "plot.cross": lambda: {"cube": FACES},
    "plot.error_map": lambda: {"a": PICTURE, "b": PICTURE},
    "plot.faces": lambda: {"cube": FACES},
    "plot.inner_steps": lambda: {"cube": FACES},
    "plot.layout": lambda: {"cube": FACES},
    "plot.panorama": lambda: {"cube": FACES, "width": 4},
    "plot.pictures": lambda: {"pictures": [PICTURE]},
    "plot.seam_ratios": lambda: {"cube": FACES},
    "plot.seam_steps": lambda: {"cube": FACES},
    "plot.seams": lambda: {"cube": FACES},
    "plot.vectors": lambda: {"field": FACES},
    "cluster.capture_array": lambda: {"scene": cc.Scene(), "positions": [(0, 0, 0)], "size": 1},
    "cluster.capture_dataset": lambda: {"scene": cc.Scene(), "positions": [(0, 0, 0)], "size": 1},
    "cluster.capture_to_zarr": lambda: {
        "scene": cc.Scene(),
        "positions": [(0, 0, 0)],
        "store": "new.zarr",
        "size": 1,
        "overwrite": True,
    },
    "truth.capture": lambda: {"scene": cc.Scene(), "size": 2, "samples": 1},
    "truth.compare": lambda: {"picture": PICTURE, "truth": PICTURE},
    "truth.render": lambda: {
        "scene": cc.Scene(),
        "camera": cc.PerspectiveCamera(),
        "size": (2, 2),
        "samples": 1,
    },
    "explore.reflection": lambda: {"environment": cube(), "where": "offscreen", "size": (8, 8)},
    "explore.layout": lambda: {"where": "offscreen", "size": (8, 8)},
    "demo.run": lambda: {"out": "out", "frames": 1, "size": 1},
    "demo.build_scene": lambda: {"environment": cube()},
    "DemoScene.turn": lambda: {"angle": 0.5},
    "Viewer": lambda: {"scene": cc.Scene(), "size": (8, 8)},
    "CubeView": lambda: {"cube": cube(), "size": (8, 8)},
    "ReflectionView": lambda: {"environment": cube(), "size": (8, 8)},
    "LayoutView": lambda: {"size": (8, 8)},
    **{
        f"{view}.{method}": arguments
        for view in ("Viewer", "CubeView", "ReflectionView", "LayoutView")
        for method, arguments in {
            "draw": lambda: {"size": (4, 4)},
            "pick": lambda: {"x": 1, "y": 1},
            "at": lambda: {"x": 1, "y": 1},
            "record": lambda: {"path": "a.gif", "seconds": 0.1, "fps": 10},
            "show": lambda: {"where": "offscreen", "block": False},
            "look_at": lambda: {"direction": (1, 0, 0)},
        }.items()
    },
}

#: Calls that take long get no values of the right kind, which are tested where the callable is, and of an argument
#: whose annotation names other types only every fourth value.
SLOW = (
    "demo.run", "demo.build_scene", "Scene.show", "CubeMap.show", "explore.reflection", "explore.layout", "Renderer",
    "Pool", "Viewer", "CubeView", "ReflectionView", "LayoutView", "load_environment", "plot.", "CubeMap.save_for",
    "Frame.save", "save_animation", "CubeMap.save", "cluster.",
)  # fmt: skip


@functools.cache
def views():
    """Give one view of each class, since making one makes a renderer."""
    return {
        "Viewer": Viewer(animated_scene(), size=(8, 8)),
        "CubeView": CubeView(cube(), size=(8, 8)),
        "ReflectionView": explore.ReflectionView(cube(), size=(8, 8)),
        "LayoutView": explore.LayoutView(size=(8, 8)),
    }


def function_of(name, renderer):
    """Give the callable of a name, bound to a new object if it is a method."""
    owner, _, member = name.rpartition(".")
    if not owner:
        kinds = {"LayoutView": explore.LayoutView, "ReflectionView": explore.ReflectionView}
        return {**kinds, "CubeView": CubeView}.get(name) or getattr(cc, name)
    modules = {
        "plot": plot,
        "navigation": navigation,
        "explore": explore,
        "cluster": cluster,
        "demo": demo,
        "truth": truth,
    }
    if owner in modules:
        return getattr(modules[owner], member)
    kind = getattr(cc, owner, None)
    if kind is not None and isinstance(vars(kind).get(member), staticmethod):
        return getattr(kind, member)
    return getattr(object_of(owner, member, renderer), member)


def object_of(owner, member, renderer):
    if owner in ("Viewer", "CubeView", "ReflectionView", "LayoutView"):
        return views()[owner]
    if owner == "Renderer":
        return renderer
    if owner == "Pool":
        return absurd.pool()
    if owner == "Frame":
        return renderer.render(cc.Scene(), cc.PerspectiveCamera(), (2, 2))
    if owner == "Camera" and member != "view":  # which cameras of matrices lack
        return cc.PerspectiveCamera()
    return (OBJECTS.get(owner) or getattr(cc, owner))()


def use(place, value, renderer):
    if not place.argument:
        owner, _, member = place.callable.rpartition(".")
        thing = object_of(owner, member, renderer)
        before = getattr(thing, member) if owner in views() else None
        try:
            setattr(thing, member, value)
        finally:
            if owner in views():
                setattr(thing, member, before)
        return
    function = function_of(place.callable, renderer)
    needed = NEEDED.get(place.callable)
    options = needed() if needed else {}
    if place.callable.startswith("Scene.__"):
        function(value)
    else:
        function(**{**options, place.argument: value})


@pytest.fixture(autouse=True)
def _folder(tmp_path, monkeypatch):
    """Files go into a folder of the test, and no plot opens a window."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")


@pytest.fixture
def files(tmp_path):
    cc.save_image(tmp_path / "image.png", PICTURE)
    cube().save(tmp_path / "cube.exr")
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    cc.Scene().save(tmp_path / "scene.glb")
    if sys.version_info >= (3, 11):
        cc.CubeMapBatch(np.zeros((1, 6, 1, 1, 3), np.float32)).to_zarr(tmp_path / "batch.zarr")


def failure(place, value, renderer):
    """Say what is wrong with the answer to one value; None if it is right."""
    kinds = absurd.Kinds(place.annotation)
    plain, right = kinds.plain, kinds.allows(value)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            use(place, value, renderer)
    except EXPECTED as error:
        message = str(error)
        # Python itself writes the whole path into an OSError.
        if len(message) > LONGEST and not isinstance(error, OSError):
            return f"a message of {len(message)} letters: {message[:200]}"
        if plain and not right:
            if not isinstance(error, (TypeError, ValueError)):
                return f"{type(error).__name__}: {message}"
            if "expected" not in message or "got" not in message:
                return f"a message without 'expected' and 'got': {type(error).__name__}: {message}"
    except BaseException as error:
        # What an iterable or a path raises by itself goes on, as everywhere in Python.
        if not plain and "from the object itself" in str(error):
            return None
        return f"{type(error).__name__}: {str(error)[:300]}"
    else:
        if plain and not right:
            return "accepted"
    return None


@pytest.mark.parametrize("name", BY_CALLABLE)
def test_absurd_values(name, renderer, files):
    wrong = []
    for place in BY_CALLABLE[name]:
        plain = absurd.Kinds(place.annotation).plain
        for at, (word, value) in enumerate(absurd.values().items()):
            if name.startswith(SLOW) and (
                at % 4 if not plain else absurd.Kinds(place.annotation).allows(value)
            ):
                continue
            if str(place) == "demo.run.out" and isinstance(value, str):
                continue  # a folder of any name is right
            found = failure(place, value, renderer)
            if found is not None:
                wrong.append(f"{place} = {word}: {found}")
    with contextlib.suppress(Exception):
        plot_module = __import__("matplotlib.pyplot").pyplot
        plot_module.close("all")
    assert not wrong, "\n" + "\n".join(wrong)


def test_the_walk_finds_them():
    assert len(PLACES) > 900
    assert len(absurd.ABSURD) > 120
    assert {p.callable for p in PLACES} >= {
        "Node.visible",
        "CubeMap.resize",
        "Viewer.samples",
        "plot.cross",
    }


@pytest.mark.filterwarnings("ignore::cubecam.SceneWarning")  # what Mitsuba cannot say of the scene
@pytest.mark.parametrize("name", [name for name, make in NEEDED.items() if make is not dict])
def test_the_calls_are_right_without_absurd_values(name, renderer, files):
    """Otherwise an error would say nothing about the value."""
    if name in BY_CALLABLE:
        function_of(name, renderer)(**NEEDED[name]())


def test_no_public_argument_goes_by_pybind11s_own_check_of_ints():
    """Such an argument shows SupportsInt in the stubs, and takes 2.7 of numpy for 2."""
    assert [str(place) for place in PLACES if "SupportsInt " in place.annotation + " "] == []
