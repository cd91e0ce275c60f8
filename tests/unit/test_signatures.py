"""Which arguments may be given by position. All others need their name, so that options can be added in any order.

The table lists what the redesign decided, and what follows from it: the one or two arguments that a call needs.
The tests read the stubs and the exports of `cubecam`, so that a new function cannot be forgotten.
"""

import ast
import inspect
import pathlib

import pytest

import cubecam as cc
from cubecam import demo, navigation, pictures
from cubecam.io import cubemap_save, cubemaps, images, meshes

STUB = pathlib.Path(cc.__file__).with_name("_core.pyi")

#: Callable: its arguments that may be given by position, without self. A callable that is not
#: listed has none.
BY_POSITION = {
    # The redesign lists these callables.
    "Renderer.render": ["scene", "camera", "size"],
    "Renderer.capture": ["scene", "position", "size"],
    "Scene.add": ["mesh", "material"],
    "Mesh": ["positions", "indices"],
    "Mesh.box": ["size"],
    "Mesh.plane": ["width", "depth"],
    "Mesh.sphere": ["radius", "segments", "rings"],
    "Mesh.icosphere": ["radius", "subdivisions"],
    "Mesh.cylinder": ["radius", "height", "segments"],
    "Mesh.cone": ["radius", "height", "segments"],
    "Mesh.torus": ["radius", "tube", "segments", "sides"],
    "CubeMap": ["faces"],
    "CubeMap.from_equirect": ["image"],
    "load_image": ["path"],
    "load_mesh": ["path"],
    "load_cubemap": ["path"],
    "load_environment": ["path"],
    "save_image": ["path", "pixels"],
    "save_animation": ["path", "frames"],
    "CubeMap.save": ["path"],
    "ShaderMaterial": ["fragment"],
    "ImageEffect": ["fragment"],
    "Blend": ["src", "dst"],
    "axis_angle": ["axis", "degrees"],
    "PointLight": ["position"],
    "SpotLight": ["position", "direction"],
    "DirectionalLight": ["direction"],
    # These callables have no meaning without the arguments listed.
    "Image": ["pixels"],
    "CubeMap.from_layout": ["image"],
    "CubeMap.to_layout": ["layout"],
    "CubeMap.to_convention": ["convention"],
    "CubeMap.set_face": ["face", "pixels"],
    "CubeMap.sample": ["directions"],
    "CubeMap.resize": ["size"],
    "Mesh.resized": ["size"],
    "Probe": ["position"],
    "RenderTexture": ["scene", "camera"],
    "StereoCamera": ["left", "right"],
    "StereoCamera.off_axis": ["camera"],
    "StereoCamera.toe_in": ["camera"],
    "Scene.remove": ["thing"],
    "Scene.set_positions": ["nodes", "positions"],
    "Scene.set_matrices": ["nodes", "matrices"],
    "Renderer.update_probes": ["scene"],
    "Renderer.read_probe": ["probe"],
    "Renderer.read_texture": ["render_texture"],
    "Renderer.shadow_map": ["scene", "light"],
    "Camera.projection": ["aspect"],
    "sample_data": ["name"],
    **{
        f"{camera}.{verb}": [argument]
        for camera in ("PerspectiveCamera", "OrthographicCamera")
        for verb, argument in {
            "yaw": "degrees",
            "pitch": "degrees",
            "walk": "distance",
            "strafe": "distance",
            "look": "direction",
        }.items()
    },
    # These functions belong to modules.
    "navigation.yaw": ["camera", "degrees"],
    "navigation.pitch": ["camera", "degrees"],
    "navigation.walk": ["camera", "distance"],
    "navigation.strafe": ["camera", "distance"],
    "navigation.orbit": ["camera"],
    "navigation.look": ["camera", "direction"],
    "pictures.cube_picture": ["cube"],
    "pictures.cube_png": ["cube"],
    "pictures.frame_png": ["frame"],
    "pictures.image_png": ["image"],
    "demo.run": ["out"],
    "demo.named_cross": ["cube"],
    "DemoScene.turn": ["angle"],
    "to_screen": ["picture"],
    "images.save_frame": ["frame", "path"],
    "Frame.save": ["path"],
    "images.encode_picture": ["target", "pixels", "srgb", "half", "exposure", "tonemap"],
    "images.prepare": ["pixels", "target", "srgb", "exposure", "tonemap", "name"],
    "cubemap_save.save_cubemap": ["cube", "path"],
    "cubemap_save.arrange": ["values", "layout", "convention"],
}

#: Callables with one signature for each kind of thing that may be given.
OVERLOADS = {"Scene.add": [["light"], ["mesh", "material"]]}


def positional(arguments):
    return [argument.arg for argument in (*arguments.posonlyargs, *arguments.args)]


def of_the_stub():
    """Yield the name and the positional parameters of each public callable in the stub."""
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield node.name, positional(node.args)
        if not isinstance(node, ast.ClassDef):
            continue
        for member in node.body:
            if not isinstance(member, ast.FunctionDef):
                continue
            decorators = {ast.unparse(d) for d in member.decorator_list}
            if decorators & {"property"} or any(d.endswith(".setter") for d in decorators):
                continue
            parameters = positional(member.args)[0 if "staticmethod" in decorators else 1 :]
            if member.name == "__init__":
                yield node.name, parameters
            elif not member.name.startswith("_"):
                yield f"{node.name}.{member.name}", parameters


def of_python():
    """Yield the same for functions written in Python: those that cubecam exports and those that its modules define."""
    functions = {name: thing for name, thing in vars(cc).items() if inspect.isfunction(thing)}
    for module in (navigation, pictures, demo, images, cubemaps, meshes, cubemap_save):
        short = module.__name__.rpartition(".")[2]
        for name, thing in vars(module).items():
            exported = name in vars(cc)
            if inspect.isfunction(thing) and thing.__module__ == module.__name__ and not exported:
                functions[f"{short}.{name}"] = thing
    functions["DemoScene.turn"] = demo.DemoScene.turn
    for name, function in functions.items():
        if name.rpartition(".")[2].startswith("_"):
            continue
        kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
        parameters = inspect.signature(function).parameters.values()
        names = [p.name for p in parameters if p.kind in kinds]
        yield name, names[1:] if names[:1] == ["self"] else names


FOUND = [*of_the_stub(), *of_python()]


def test_the_walk_finds_them():
    names = {name for name, _ in FOUND}
    assert len(names) > 80
    wrong = set(BY_POSITION) - names
    assert not wrong, f"listed, but there is none: {wrong}"


@pytest.mark.parametrize(("name", "parameters"), FOUND, ids=[name for name, _ in FOUND])
def test_by_position(name, parameters):
    if name in OVERLOADS:
        assert parameters in OVERLOADS[name]
    else:
        assert parameters == BY_POSITION.get(name, [])


def test_load_functions_agree():
    one, other = (
        list(inspect.signature(load).parameters.values())
        for load in (cc.load_cubemap, cc.load_environment)
    )
    assert [p.replace(annotation=None) for p in one] == [p.replace(annotation=None) for p in other]


CALLS = {
    "render": (
        lambda r: r.render(cc.Scene(), cc.PerspectiveCamera(), (4, 4), ("id",)),
        (
            "Renderer.render: expected at most 3 arguments by position (scene, camera, size), got 4 by position; "
            "name the others: outputs, format, samples, exposure, tonemap, encode, effects, depth_format"
        ),
    ),
    "scene": (
        lambda r: cc.Scene(None),
        "Scene: expected arguments by name, got 1 by position; name the others: environment, background",
    ),
    "colour": (
        lambda r: cc.PointLight(colour="red"),
        "PointLight: no argument 'colour'; did you mean 'color'? it takes position, color, intensity, decay, shadow",
    ),
    "nothing similar": (
        lambda r: cc.axis_angle((0, 0, 1), 3, steps=2),
        "axis_angle: no argument 'steps'; it takes axis, degrees",
    ),
    "no argument at all": (
        lambda r: cc.Scene().clear(deep=True),
        "Scene.clear: no argument 'deep'; it takes none",
    ),
    "missing": (
        lambda r: cc.axis_angle((0, 0, 1)),
        "axis_angle: expected degrees, got none; it takes axis, degrees",
    ),
    "two missing": (
        lambda r: r.render(size=(3, 3)),
        (
            "Renderer.render: expected scene and camera, got none; it takes scene, camera, size, outputs, format, "
            "samples, exposure, tonemap, encode, effects, depth_format"
        ),
    ),
    "twice": (
        lambda r: cc.axis_angle((0, 0, 1), 3, degrees=4),
        "axis_angle: degrees: expected it once, got it by position and by name",
    ),
    "type": (lambda r: cc.Scene().add(light=3), "Scene.add: light: expected Light, got 3"),
    "a choice": (
        lambda r: cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), wrap=None),
        'RenderTexture: wrap: expected "repeat" or "clamp", got None',
    ),
    "many arguments of a choice": (
        lambda r: cc.Image([[[0.0]]], wrap="clamp", mipmaps=object()),
        "Image: mipmaps: expected bool, got object",
    ),
    "a choice or none": (
        lambda r: cc.Probe(depth_format=8),
        (
            'Probe: depth_format: expected "depth_component16", "depth_component24", "depth_component32f", '
            '"depth24_stencil8", "depth32f_stencil8", "stencil_index8" or None, got 8'
        ),
    ),
    "too large beside choices": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).to_equirect(width=1 << 40),
        (
            "CubeMap.to_equirect: expected (width: int or None, center: str, sampling: str, dtype: DTypeLike or None), "
            "got (width=1099511627776)"
        ),
    ),
    "number": (
        lambda r: cc.PerspectiveCamera(fov="wide"),
        "PerspectiveCamera: fov: expected float, got 'wide'",
    ),
    "whole number": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).resize(2.5),
        "CubeMap.resize: size: expected int, got 2.5",
    ),
    "too large": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).resize(1 << 40),
        "CubeMap.resize: expected (size: int, dtype: DTypeLike or None), got (1099511627776)",
    ),
    "setter": (
        lambda r: setattr(cc.Scene().add(), "visible", "no"),
        "Node.visible: expected bool, got 'no'",
    ),
    "static": (
        lambda r: cc.Mesh.sphere(1, ring=3),
        "Mesh.sphere: no argument 'ring'; did you mean 'rings'? it takes radius, segments, rings",
    ),
    "camera": (
        lambda r: cc.Camera([[1]], [[1]], 3),
        "Camera: expected arguments by name, got 3 by position; name the others: view, projection",
    ),
    "an array": (
        lambda r: cc.PointLight(intensity=[1, 2]),
        "PointLight: intensity: expected float, got list",
    ),
}


@pytest.mark.parametrize(("call", "message"), CALLS.values(), ids=CALLS)
def test_one_line_tells_what_is_wrong(call, message):
    with pytest.raises(TypeError) as caught:
        call(cc.Renderer.__new__(cc.Renderer))
    assert str(caught.value) == message


def test_errors_of_the_call_itself_stay():
    """Only errors about calls that fit no signature are reworded."""
    with pytest.raises(TypeError, match=r"^exclude: expected Nodes, got int$"):
        cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), exclude=[3])


def test_overloads_are_explained_by_what_was_named():
    with pytest.raises(TypeError, match=r"^Scene.add: visible: expected bool, got 'no'$"):
        cc.Scene().add(visible="no")
    with pytest.raises(
        TypeError, match=r"^Scene.add: no argument 'colour'; it takes light, mesh, "
    ):
        cc.Scene().add(colour="red")
