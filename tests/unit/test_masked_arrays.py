"""Masked arrays that hide values are refused wherever an array comes in: the numbers behind a mask mean nothing.

The tests read the stubs and the signatures of functions written in Python, so that a new argument cannot be forgotten.
"""

import ast
import inspect
import pathlib
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam import navigation, plot
from cubecam.io import movie
from cubecam.viewer.cube_view import CubeView
from tests.absurd import pool, pool_functions
from tests.gl import pool_scenes

STUB = pathlib.Path(cc.__file__).with_name("_core.pyi")
MESSAGE = (
    r"expected an array without hidden values, got a masked array; fill them with \.filled\(value\)"
)
CUBE = np.full((6, 4, 4, 3), 0.5, np.float32)
PICTURE = np.full((4, 8, 3), 0.5, np.float32)
TRIANGLE: dict[str, Any] = {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "indices": [[0, 1, 2]]}
DIRECTIONS = {"incident": [0, -1, 0], "normal": [0, 1, 0]}
DECLARED = "vec3 shade() { return vec3(1.0); }"
EFFECT = "vec4 effect(vec2 uv) { return frame(uv); }"


def morphing_mesh():
    target = cc.MorphTarget(positions=TRIANGLE["positions"])
    return cc.Mesh(**TRIANGLE, morph_targets=[target])


#: A value for each name of an argument or attribute, where its class does not matter.
VALUES: dict[str, Any] = {
    "position": [1.0, 2.0, 3.0],
    "target": [1.0, 2.0, 3.0],
    "axis": [1.0, 2.0, 3.0],
    "origins": [1.0, 2.0, 3.0],
    "scale": [1.0, 2.0, 3.0],
    "size": [1.0, 2.0, 3.0],
    "eye": [0.0, -1.0, 0.0],
    "incident": [0.0, -1.0, 0.0],
    "up": [0.0, 1.0, 0.0],
    "normal": [0.0, 1.0, 0.0],
    "direction": [0.5, 0.25, -1.0],
    "color": [0.25, 0.5, 1.0],
    "tint": [0.25, 0.5, 1.0],
    "background": [0.25, 0.5, 1.0],
    "rotation": [1.0, 0.0, 0.0, 0.0],
    "matrix": np.eye(4),
    "proxy_matrix": np.eye(4),
    "box": [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]],
    "influence": [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]],
    "distances": np.ones((2, 2, 2, 16, 16, 2)),
    "active": np.ones((2, 2, 2), bool),
    "view": np.eye(4),
    "projection": np.eye(4),
    "world_to_camera_cv": np.eye(4),
    "K": [[100.0, 0.0, 32.0], [0.0, 100.0, 24.0], [0.0, 0.0, 1.0]],
    "what": [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]],
    "shift": [0.0, 0.5],
    "matrices": np.eye(4)[None],
    "positions": TRIANGLE["positions"],
    "indices": TRIANGLE["indices"],
    "normals": [[0.0, 0.0, 1.0]] * 3,
    "uvs": [[0.0, 1.0]] * 3,
    "uvs1": [[0.0, 1.0]] * 3,
    "tangents": [[1.0, 0.0, 0.0, -1.0]] * 3,
    "colors": [[0.0, 1.0, 0.5]] * 3,
    "joints": [[0, 1, 0, 0]] * 3,
    "joint_weights": [[0.5, 0.5, 0.0, 0.0]] * 3,
    "weights": [0.5],
    "times": [0.0, 1.0, 2.0],
    "values": [[1.0, 2.0, 3.0]] * 3,
    "inverse_bind_matrices": np.eye(4)[None],
    "image": PICTURE,
    "images": PICTURE,
    "map": PICTURE,
    "pixels": PICTURE,
    "picture": PICTURE,
    "a": PICTURE,
    "b": PICTURE,
    "faces": CUBE,
    "cube": CUBE,
    "field": CUBE,
    "directions": [[1.0, 2.0, 3.0]],
    "lod": [0.0],
    "eta": [0.5],
    "f0": [0.5],
    "source": PICTURE,
    "offset": [1.0, 2.0],
    "emissive": [0.25, 0.5, 1.0],
    "environment_rotation": [1.0, 0.0, 0.0, 0.0],
    "coefficients": np.ones((9, 3)),
    "n_dot_v": [0.5],
    "roughness": [0.5],
}
#: The same for names with these ends.
ENDS: dict[str, Any] = {"_map": PICTURE, "_color": [0.25, 0.5, 1.0]}
#: Projections whose pictures are square.
ROUND = ("fisheye", "mirror_ball", "angular_map", "octahedral")
OF_FUNCTIONS: dict[tuple[str, str], Any] = {
    ("Scene.set_positions", "positions"): [[1.0, 2.0, 3.0]],
    ("Renderer.capture_many", "positions"): [[1.0, 2.0, 3.0]],
    ("Renderer.iter_captures", "positions"): [[1.0, 2.0, 3.0]],
    ("Renderer.capture_many", "rotations"): [[1.0, 0.0, 0.0, 0.0]],
    ("Renderer.iter_captures", "rotations"): [[1.0, 0.0, 0.0, 0.0]],
    ("Pool.capture_many", "positions"): [[1.0, 2.0, 3.0]],
    ("Pool.iter_captures", "positions"): [[1.0, 2.0, 3.0]],
    ("Pool.capture_many", "rotations"): [[1.0, 0.0, 0.0, 0.0]],
    ("Pool.iter_captures", "rotations"): [[1.0, 0.0, 0.0, 0.0]],
    ("CubeMap.set_face", "pixels"): CUBE[0],
    ("MorphTarget", "tangents"): [[1.0, 0.0, 0.0]] * 3,
    ("Texture", "scale"): [1.0, 2.0],
    ("ProbeGrid.coefficients", "coefficients"): np.ones((2, 2, 2, 9, 3)),
    **{(f"CubeMap.from_{name}", "image"): CUBE[0] for name in ROUND},
}

#: The object whose method is called or whose attribute is set.
OBJECTS: dict[str, Any] = {
    "Node": lambda: cc.Scene().add(morphing_mesh()),
    "Probe": cc.Probe,
    "ProbeGrid": lambda: cc.ProbeGrid(VALUES["box"], (2, 2, 2)),
    "Scene": cc.Scene,
    "CubeMap": lambda: cc.CubeMap(CUBE),
    "Mesh": lambda: cc.Mesh(**TRIANGLE, joints=VALUES["joints"], joint_weights=[[1, 1, 0, 0]] * 3),
    "Light": cc.PointLight,
    "Camera": lambda: cc.Camera(view=np.eye(4), projection=np.eye(4)),
    "ShaderMaterial": lambda: cc.ShaderMaterial(DECLARED),
    "ImageEffect": lambda: cc.ImageEffect(EFFECT),
    "Pool": pool,
    "CubeView": lambda: CubeView(cc.CubeMap(CUBE), size=(64, 64)),
}

#: What a call needs besides the argument under test, beyond the arguments listed here under their names.
NEEDED: dict[str, Any] = {
    "CubeMap.to_perspective": lambda: {"fov": 60, "size": 4},
    "CubeMap.from_perspective": lambda: {"image": PICTURE, "fov": 60},
    "CubeMap.from_cylindrical": lambda: {"image": PICTURE},
    "CubeMap.from_dual_paraboloid": lambda: {"image": PICTURE},
    **{f"CubeMap.from_{name}": lambda: {"image": CUBE[0]} for name in ROUND},
    "Mesh": lambda: {
        **TRIANGLE,
        "joints": VALUES["joints"],
        "joint_weights": VALUES["joint_weights"],
    },
    "Camera": lambda: {"view": np.eye(4), "projection": np.eye(4)},
    "ProbeGrid": lambda: {"box": VALUES["box"], "counts": (2, 2, 2)},
    **{
        f"Renderer.{many}": lambda: {"positions": [(0, 0, 0)]}
        for many in ("capture_many", "iter_captures")
    },
    **{
        f"Pool.{many}": lambda: {"scene": cc.Scene(), "positions": [(0, 0, 0)], "size": 2}
        for many in ("capture_many", "iter_captures")
    },
    "Pool.capture_scenes": lambda: {"make_scene": pool_scenes.numbered, "count": 1, "size": 2},
    "capture_scenes": lambda: {"make_scene": lambda number: cc.Scene(), "count": 1, "size": 2},
    "Scene.add": lambda: {"mesh": morphing_mesh()},
    "Skin": lambda: {"joints": [cc.Scene().add()]},
    "AnimationChannel": lambda: {
        "node": cc.Scene().add(),
        "path": "translation",
        "times": VALUES["times"],
        "values": VALUES["values"],
    },
    "ShaderMaterial": lambda: {"fragment": DECLARED},
    "ImageEffect": lambda: {"fragment": EFFECT},
    "Texture": lambda: {"source": PICTURE},
    "brdf": lambda: {"n_dot_v": 0.5, "roughness": 0.5},
    "CubeMap.sample": lambda: {"directions": [[1, 0, 0]]},
    "CubeMap.set_face": lambda: {"face": 0},
    "Node.look_at": lambda: {"target": (9, 9, 9)},
    "PerspectiveCamera.look_at": lambda: {"target": (9, 9, 9)},
    "OrthographicCamera.look_at": lambda: {"target": (9, 9, 9)},
    "PerspectiveCamera.from_intrinsics": lambda: {"K": VALUES["K"], "size": (64, 48)},
    "axis_angle": lambda: {"degrees": 30},
    "reflect": lambda: dict(DIRECTIONS),
    "refract": lambda: {**DIRECTIONS, "eta": 0.5},
    "fresnel": lambda: {**DIRECTIONS, "eta": 0.5},
    "schlick": lambda: {**DIRECTIONS, "f0": 0.5},
    "navigation.look": lambda: {"camera": cc.PerspectiveCamera()},
    "plot.error_map": lambda: {"a": PICTURE, "b": PICTURE},
    "plot.arrows": lambda: {"origins": [0, 0, 0], "vectors": {"x": [1, 0, 0]}},
}


def takes_arrays(annotation):
    return any(word in annotation for word in ("ArrayLike", "Color"))


def of_the_stub():
    """Yield (callable or attribute, argument, annotation) of all that takes an array, from the stub."""
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            members = [("", node)]
        elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            members = [(node.name, m) for m in node.body if isinstance(m, ast.FunctionDef)]
        else:
            continue
        for owner, function in members:
            setter = any(ast.unparse(d).endswith(".setter") for d in function.decorator_list)
            made = function.name == "__init__"
            if function.name.startswith("_") and not made:
                continue  # called by cubecam alone
            name = owner if made else f"{owner}.{function.name}".lstrip(".")
            for argument in (*function.args.args, *function.args.kwonlyargs):
                kind = "" if argument.annotation is None else ast.unparse(argument.annotation)
                if takes_arrays(kind):
                    yield name, (None if setter else argument.arg), kind


def of_python():
    """Yield the same for functions written in Python."""
    functions = {name: getattr(cc, name) for name in cc.__all__}
    functions |= {f"plot.{name}": vars(plot)[name] for name in plot.__all__}
    functions |= pool_functions()
    functions |= {"navigation.look": navigation.look, "CubeView.look_at": CubeView.look_at}
    for name, function in functions.items():
        if not inspect.isfunction(function):
            continue
        for parameter in inspect.signature(function).parameters.values():
            if takes_arrays(str(parameter.annotation)):
                yield name, parameter.name, str(parameter.annotation)


FOUND = [*of_the_stub(), *of_python()]
IDS = [f"{name}-{argument or 'set'}" for name, argument, _ in FOUND]


def masked(values, first):
    """The values as a masked array, of which the first number is hidden, or none."""
    made = np.ma.masked_array(np.array(values), mask=np.zeros(np.shape(values), bool))
    if first:
        made[(0,) * made.ndim] = np.ma.masked
        assert made.mask.any()
    return made


def use(name, argument, annotation, convert, renderer, tmp_path):
    """Call what the name says, with the argument made by `convert`; set the attribute if there is no argument."""
    key = argument or name.rpartition(".")[2]
    values = OF_FUNCTIONS.get((name, key))
    if (
        values is None
        and "Mapping" not in annotation
        and key not in ("frames", "pictures", "levels")
    ):
        ends = [value for end, value in ENDS.items() if key.endswith(end)]
        values = VALUES[key] if key in VALUES else ends[0]
    value: Any
    if key in ("uniforms", "vectors"):
        value = {"a": convert([1.0, 0.5, 0.25])}
    elif key == "levels":
        value = [(convert([[0, 1, 2]]), 0.5)]
    elif key == "textures":
        value = {"a": convert(PICTURE)}
    elif key in ("frames", "pictures"):
        value = [convert((PICTURE * 255).astype(np.uint8))]
    else:
        value = convert(values)
    owner, _, member = name.rpartition(".")
    if argument is None:
        setattr(owned(owner), member, value)
        return
    options: dict[str, Any] = dict(NEEDED[name]()) if name in NEEDED else {}
    options[argument] = value
    if name.startswith("save_"):
        options["path"] = tmp_path / "a.png"
    if name.startswith("Scene.set_"):
        scene = cc.Scene()
        options["nodes"] = [scene.add()]
        getattr(scene, member)(**options)
    elif owner == "Renderer":
        getattr(renderer, member)(cc.Scene(), size=4, **options)
    elif owner in ("plot", "navigation"):
        getattr({"plot": plot, "navigation": navigation}[owner], member)(**options)
    elif not owner:
        getattr(cc, name)(**options)
    elif isinstance(inspect.getattr_static(kind_of(owner), member), staticmethod):
        getattr(kind_of(owner), member)(**options)
    else:
        getattr(owned(owner), member)(**options)


def kind_of(owner):
    return {"CubeView": CubeView}.get(owner) or getattr(cc, owner)


def owned(owner):
    return OBJECTS[owner]() if owner in OBJECTS else kind_of(owner)()


@pytest.fixture(autouse=True)
def _no_windows(monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    yield
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")


@pytest.mark.parametrize(("name", "argument", "annotation"), FOUND, ids=IDS)
def test_every_argument(name, argument, annotation, renderer, tmp_path):
    use(
        name, argument, annotation, np.array, renderer, tmp_path
    )  # otherwise the test proves nothing
    use(name, argument, annotation, lambda v: masked(v, False), renderer, tmp_path)
    for convert in (
        lambda v: masked(v, True),
        lambda v: list(masked(v, True)),
        lambda v: tuple(masked(v, True)),
    ):
        with pytest.raises(TypeError, match=MESSAGE):
            use(name, argument, annotation, convert, renderer, tmp_path)


def test_the_walk_finds_them():
    assert len(FOUND) > 120
    assert {name for name, _, _ in FOUND} >= {"CubeMap", "Mesh", "Image", "save_image", "reflect"}


class Own(np.ma.MaskedArray):
    """A subclass, as astropy, rasterio and others have."""


class Given:
    """An object that gives a masked array to numpy."""

    def __array__(self, dtype=None, copy=None):
        return masked(CUBE, True)


class Foreign(np.ndarray):
    """A class of its own with a mask, as astropy.utils.masked makes them."""

    mask = np.array([True])

    def filled(self, value):
        return np.asarray(self)


@pytest.mark.parametrize(
    "faces",
    [
        masked(CUBE, True).view(Own),
        masked(CUBE, True).astype(np.float16),
        np.ma.masked_array(CUBE, mask=True),
        [masked(face, True) for face in CUBE],
        (*CUBE[:5], masked(CUBE[5], True)),
        [[list(masked(row, True)) for row in face] for face in CUBE],
        Given(),
        CUBE.view(Foreign),
    ],
    ids=["subclass", "half", "all", "six", "the last", "nested", "__array__", "another class"],
)
def test_every_form(faces):
    with pytest.raises(TypeError, match=f"^faces: {MESSAGE}$"):
        cc.CubeMap(faces)


def test_a_mask_that_hides_nothing_is_accepted():
    for mask in (np.ma.nomask, False, np.zeros(CUBE.shape, bool)):
        assert cc.CubeMap(np.ma.masked_array(CUBE, mask=mask)) == cc.CubeMap(CUBE)


def test_filled_values_are_what_the_hint_promises():
    made = cc.CubeMap(masked(CUBE, True).filled(2.0))
    assert made.faces[0, 0, 0, 0] == 2
    assert made.faces.max() == 2


def test_films():
    picture = np.zeros((4, 4, 3), np.uint8)
    movie._pixels(masked(picture, False), None)
    with pytest.raises(TypeError, match=MESSAGE):
        movie._pixels(masked(picture, True), None)


def test_lists_that_hold_themselves_end():
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises((ValueError, TypeError)):
        cc.CubeMap(endless)


def test_numpy_ma_is_not_imported_for_it():
    """What numpy imports by itself is counted off, since that depends on its version."""
    program = (
        "import sys, numpy\nbefore = 'numpy.ma' in sys.modules\nimport cubecam as cc\n"
        "cc.CubeMap([[[[0.5]]]] * 6)\nassert before or 'numpy.ma' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
