"""Which arguments may be given by position. All others need their name, so that options can be added in any order.

The table lists what the redesign decided, and what follows from it: the one or two arguments that a call needs.
The tests read the stubs and the exports of `cubecam`, so that a new function cannot be forgotten.
"""

# Most calls are wrong on purpose.
# mypy: disable-error-code="arg-type, assignment, call-arg, call-overload, misc"

import ast
import inspect
import pathlib
import re

import pytest

import cubecam as cc
from cubecam import cluster, demo, explore, navigation, plot, truth
from cubecam._calls import checked_call
from cubecam.io import cubemap_save, cubemaps, images, meshes
from cubecam.pictures import results
from tests.absurd import pool_functions

CAMERAS = ("PerspectiveCamera", "OrthographicCamera")
MODULES = (navigation, results, demo, images, cubemaps, meshes, cubemap_save)
STUB = pathlib.Path(cc.__file__).with_name("_core.pyi")

#: Callable: its arguments that may be given by position, without self. A callable that is not
#: listed has none.
BY_POSITION = {
    # The redesign lists these callables.
    "Renderer.render": ["scene", "camera", "size"],
    "Renderer.capture": ["scene", "position", "size"],
    "Renderer.capture_many": ["scene", "positions", "size"],
    "Renderer.iter_captures": ["scene", "positions", "size"],
    "Renderer.render_many": ["scene", "cameras", "size"],
    "capture_scenes": ["make_scene", "count"],
    "Pool": ["workers"],
    "Pool.capture_many": ["scene", "positions", "size"],
    "Pool.iter_captures": ["scene", "positions", "size"],
    "Pool.render_many": ["scene", "cameras", "size"],
    "Pool.capture_scenes": ["make_scene", "count"],
    "Renderer.render_async": ["scene", "camera", "size"],
    "Renderer.capture_async": ["scene", "position", "size"],
    "Scene.add": ["mesh", "material"],
    "Mesh": ["positions", "indices"],
    "Mesh.box": ["size"],
    "Mesh.plane": ["width", "depth"],
    "Mesh.sphere": ["radius", "segments", "rings"],
    "Mesh.icosphere": ["radius", "subdivisions"],
    "Mesh.cylinder": ["radius", "height", "segments"],
    "Mesh.cone": ["radius", "height", "segments"],
    "Mesh.torus": ["radius", "tube", "segments", "sides"],
    "Mesh.arrow": ["length"],
    "Mesh.from_trimesh": ["mesh"],
    "Skin": ["joints", "inverse_bind_matrices"],
    "AnimationChannel": ["node", "path", "times", "values"],
    "AnimationChannel.sample": ["seconds"],
    "Animation": ["channels"],
    "Scene.set_time": ["seconds", "animation"],
    "Scene.find": ["name"],
    "Node.look_at": ["target"],
    "Camera.intrinsics": ["size"],
    "PerspectiveCamera.from_intrinsics": ["K", "size"],
    "CubeMap": ["faces"],
    "CubeMap.from_equirect": ["image"],
    "equirect_to_faces": ["images"],
    "faces_to_equirect": ["faces"],
    "load_image": ["path"],
    "load_mesh": ["path"],
    "load_scene": ["path"],
    "open_batch": ["store"],
    "scene_hash": ["scene"],
    "load_cubemap": ["path"],
    "load_environment": ["path"],
    "save_image": ["path", "pixels"],
    "save_animation": ["path", "frames"],
    "CubeMap.save": ["path"],
    "CubeMap.save_for": ["engine", "folder"],
    "CubeMap.show": ["where"],
    "explore.reflection": ["environment"],
    "explore.layout": ["cube"],
    "ShaderMaterial": ["fragment"],
    "ImageEffect": ["fragment"],
    "Blend": ["src", "dst"],
    "axis_angle": ["axis", "degrees"],
    "PointLight": ["position"],
    "SpotLight": ["position", "direction"],
    "DirectionalLight": ["direction"],
    # These callables have no meaning without the arguments listed.
    "Image": ["pixels"],
    "Texture": ["source"],
    "CubeMap.from_layout": ["image"],
    "CubeMap.to_layout": ["layout"],
    "CubeMap.to_convention": ["convention"],
    "CubeMap.set_face": ["face", "pixels"],
    "CubeMap.sample": ["directions"],
    "CubeMap.to_perspective": ["fov", "size"],
    "CubeMap.from_perspective": ["image", "fov"],
    "CubeMap.to_fisheye": ["size"],
    "CubeMap.from_fisheye": ["image"],
    "CubeMap.to_mirror_ball": ["size"],
    "CubeMap.from_mirror_ball": ["image"],
    "CubeMap.to_angular_map": ["size"],
    "CubeMap.from_angular_map": ["image"],
    "CubeMap.to_octahedral": ["size"],
    "CubeMap.from_octahedral": ["image"],
    "CubeMap.to_dual_paraboloid": ["size"],
    "CubeMap.from_dual_paraboloid": ["image"],
    "CubeMap.to_cylindrical": ["size"],
    "CubeMap.from_cylindrical": ["image"],
    "CubeMap.rotate": ["rotation"],
    "CubeMap.resize": ["size"],
    "CubeMap.prefilter": ["levels", "size"],
    "CubeMap.irradiance": ["size"],
    "CubeMap.sh": ["order"],
    "CubeMap.from_levels": ["levels"],
    "CubeMap.from_sh": ["coefficients"],
    "Mesh.resized": ["size"],
    "Probe": ["position"],
    "ProbeBlend": ["probes"],
    "ProbeGrid": ["box", "counts"],
    "ProbeGrid.bake": ["renderer", "scene"],
    "RenderTexture": ["scene", "camera"],
    "StereoCamera": ["left", "right"],
    "StereoCamera.off_axis": ["camera"],
    "StereoCamera.toe_in": ["camera"],
    "Scene.remove": ["thing"],
    "Scene.save": ["path"],
    "Scene.to_mitsuba": ["camera", "size"],
    "Scene.show": ["where"],
    "Scene.set_positions": ["nodes", "positions"],
    "Scene.set_matrices": ["nodes", "matrices"],
    "Renderer.update_probes": ["scene"],
    "Renderer.read_probe": ["probe"],
    "Renderer.read_texture": ["render_texture"],
    "Renderer.shadow_map": ["scene", "light"],
    "Camera.projection": ["aspect"],
    "sample_data": ["name"],
    "reflect": ["incident", "normal"],
    "brdf": ["n_dot_v", "roughness"],
    "refract": ["incident", "normal", "eta"],
    "fresnel": ["incident", "normal", "eta"],
    "schlick": ["incident", "normal", "f0"],
    **{
        f"{camera}.{verb}": [argument]
        for camera in CAMERAS
        for verb, argument in {
            "yaw": "degrees",
            "pitch": "degrees",
            "walk": "distance",
            "strafe": "distance",
            "look_at": "target",
            "fit": "what",
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
    "results.cube_picture": ["cube"],
    "results.cube_png": ["cube"],
    "results.frame_png": ["frame"],
    "results.image_png": ["image"],
    "cluster.capture_array": ["scene", "positions", "size"],
    "cluster.capture_dataset": ["scene", "positions", "size"],
    "cluster.capture_to_zarr": ["scene", "positions", "store", "size"],
    "truth.capture": ["scene", "position", "size"],
    "truth.compare": ["picture", "truth", "mask"],
    "truth.render": ["scene", "camera", "size"],
    "plot.cross": ["cube", "labels"],
    "plot.faces": ["cube"],
    "plot.layout": ["cube"],
    "plot.panorama": ["cube"],
    "plot.pictures": ["pictures", "titles"],
    "plot.error_map": ["a", "b"],
    "plot.vectors": ["field"],
    "plot.arrows": ["origins", "vectors"],
    "plot.seams": ["cube"],
    "plot.seam_ratios": ["cube"],
    "plot.seam_steps": ["cube"],
    "plot.inner_steps": ["cube"],
    "demo.run": ["out"],
    "demo.named_cross": ["cube"],
    "DemoScene.turn": ["angle"],
    "to_screen": ["picture"],
    "images.save_frame": ["frame", "path"],
    "Frame.save": ["path"],
    "images.encode_picture": ["target", "pixels", "srgb", "half", "exposure", "tonemap"],
    "images.prepare": ["pixels", "target", "srgb", "exposure", "tonemap", "name"],
    "cubemap_save.save_cubemap": ["cube", "path"],
}

#: Callables with one signature for each kind of thing that may be given.
OVERLOADS = {"Scene.add": [["light"], ["camera"], ["animation"], ["mesh", "material"]]}


def positional(arguments):
    return [argument.arg for argument in (*arguments.posonlyargs, *arguments.args)]


def of_the_stub():
    """Yield the name and the positional parameters of each public callable in the stub."""
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield node.name, positional(node.args)
        if not isinstance(node, ast.ClassDef) or node.name.startswith("_"):
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
    exports = {name: getattr(cc, name) for name in cc.__all__}
    functions = {name: thing for name, thing in exports.items() if inspect.isfunction(thing)}
    for module in MODULES:
        short = module.__name__.rpartition(".")[2]
        for name, thing in vars(module).items():
            exported = name in exports
            if inspect.isfunction(thing) and thing.__module__ == module.__name__ and not exported:
                functions[f"{short}.{name}"] = thing
    functions |= {f"plot.{n}": vars(plot)[n] for n in plot.__all__ if callable(vars(plot)[n])}
    functions |= {
        f"truth.{n}": thing for n in truth.__all__ if inspect.isfunction(thing := vars(truth)[n])
    }
    functions |= {f"cluster.{n}": getattr(cluster, n) for n in cluster.__all__}
    functions["explore.reflection"] = explore.reflection
    functions["explore.layout"] = explore.layout
    functions["DemoScene.turn"] = demo.DemoScene.turn
    functions |= pool_functions()
    for name, function in functions.items():
        if name.rpartition(".")[2].startswith("_"):
            continue
        kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
        parameters = inspect.signature(function).parameters.values()
        names = [p.name for p in parameters if p.kind in kinds]
        yield name, names[1:] if names[:1] == ["self"] else names


FOUND = [*of_the_stub(), *of_python()]


def by_name(name):
    """The arguments of a function of the core that go by name only, from the stub."""
    owner, _, member = name.partition(".")
    nodes = list(ast.walk(ast.parse(STUB.read_text(encoding="utf-8"))))
    kind = next(node for node in nodes if isinstance(node, ast.ClassDef) and node.name == owner)
    methods = [node for node in kind.body if isinstance(node, ast.FunctionDef)]
    function = next(node for node in methods if node.name == member)
    return [argument.arg for argument in function.args.kwonlyargs]


def callable_of(name):
    """A callable by the name that FOUND gives; a method of a class is called with an object that is not made yet."""
    owner, _, member = name.rpartition(".")
    modules = {
        module.__name__.rpartition(".")[2]: module
        for module in (*MODULES, cluster, explore, plot, truth)
    }
    if not owner:
        return getattr(cc, name)
    if owner in modules:
        return getattr(modules[owner], member)
    kind = getattr(cc, owner, None) or getattr(demo, owner)
    return getattr(kind.__new__(kind), member)


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
            "render() takes at most 3 arguments by position (scene, camera, size), got 4; "
            f"name the others: {', '.join(by_name('Renderer.render'))}"
        ),
    ),
    "misspelt": (
        lambda r: r.render(cc.Scene(), cc.PerspectiveCamera(), (4, 4), sample=4),
        "render() has no option 'sample'; did you mean 'samples'?",
    ),
    "scene": (
        lambda r: cc.Scene(None),
        (
            "Scene() takes its arguments by name, got 1 by position; it takes environment, background, "
            "environment_intensity, environment_rotation"
        ),
    ),
    "colour": (
        lambda r: cc.PointLight(colour="red"),
        "PointLight() has no option 'colour'; did you mean 'color'?",
    ),
    "nothing similar": (
        lambda r: cc.axis_angle((0, 0, 1), 3, steps=2),
        "axis_angle() has no option 'steps'; it takes axis, degrees",
    ),
    "no argument at all": (
        lambda r: cc.Scene().clear(deep=True),
        "clear() has no option 'deep'; it takes none",
    ),
    "none by position": (
        lambda r: cc.Scene().clear(1),
        "clear() takes no arguments, got 1 by position",
    ),
    "missing": (lambda r: cc.axis_angle((0, 0, 1)), "axis_angle() needs degrees"),
    "two missing": (lambda r: r.render(size=(3, 3)), "render() needs scene and camera"),
    "three missing": (lambda r: r.render(), "render() needs scene, camera and size"),
    "twice": (
        lambda r: cc.axis_angle((0, 0, 1), 3, degrees=4),
        "axis_angle() got degrees by position and by name, expected it once",
    ),
    "type": (lambda r: cc.Scene().add(light=3), "add(): light: expected Light, got 3"),
    "a choice": (
        lambda r: cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), wrap=None),
        'RenderTexture(): wrap: expected "repeat", "clamp" or "mirror", got None',
    ),
    "many arguments of a choice": (
        lambda r: cc.Image([[[0.0]]], wrap="clamp", mipmaps=object()),
        "Image(): mipmaps: expected bool, got object",
    ),
    "a choice or none": (
        lambda r: cc.Probe(depth_format=8),
        (
            'Probe(): depth_format: expected "depth_component16", "depth_component24", "depth_component32f", '
            '"depth24_stencil8", "depth32f_stencil8", "stencil_index8" or None, got 8'
        ),
    ),
    "too large beside choices": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).to_equirect(width=1 << 40),
        "to_equirect(): width: expected an int from -2147483648 to 2147483647, got 1099511627776",
    ),
    "number": (
        lambda r: cc.PerspectiveCamera(fov="wide"),
        "PerspectiveCamera(): fov: expected float, got 'wide'",
    ),
    "whole number": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).resize(2.5),
        "resize(): size: expected int, got 2.5",
    ),
    "too large": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).resize(1 << 40),
        "resize(): size: expected an int from -2147483648 to 2147483647, got 1099511627776",
    ),
    "setter": (
        lambda r: setattr(cc.Scene().add(), "visible", "no"),
        "Node.visible: expected bool, got 'no'",
    ),
    "static": (
        lambda r: cc.Mesh.sphere(1, ring=3),
        "Mesh.sphere() has no option 'ring'; did you mean 'rings'?",
    ),
    "camera": (
        lambda r: cc.Camera([[1]], [[1]], 3),
        "Camera() takes its arguments by name, got 3 by position; it takes view, projection",
    ),
    "an array": (
        lambda r: cc.PointLight(intensity=[1, 2]),
        "PointLight(): intensity: expected float, got list",
    ),
    # Functions written in Python give the same answers.
    "file": (
        lambda r: cc.load_image("a.png", sgrb=True),
        "load_image() has no option 'sgrb'; did you mean 'srgb'?",
    ),
    "no file": (lambda r: cc.load_mesh(), "load_mesh() needs path"),
    "no picture": (lambda r: cc.save_image(), "save_image() needs path and pixels"),
    "by position": (
        lambda r: cc.load_mesh("a.obj", 1),
        "load_mesh() takes at most 1 argument by position (path), got 2; name the others: size",
    ),
    "attached": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).save("a.exr", layouts="row"),
        "save() has no option 'layouts'; did you mean 'layout'?",
    ),
    "attached, nothing given": (
        lambda r: cc.CubeMap([[[[0.0]]]] * 6).save(),
        "save() needs path",
    ),
    "a camera moves": (
        lambda r: cc.PerspectiveCamera().walk(speed=3),
        "walk() has no option 'speed'; it takes distance",
    ),
    "a function moves it": (lambda r: navigation.walk(distance=3), "walk() needs camera"),
    "path twice": (
        lambda r: cc.load_image("a.png", path="b.png"),
        "load_image() got path by position and by name, expected it once",
    ),
    "demo": (
        lambda r: demo.build_scene(256),
        (
            "build_scene() takes its arguments by name, got 1 by position; "
            f"it takes {', '.join(inspect.signature(demo.build_scene).parameters)}"
        ),
    ),
}


@pytest.mark.parametrize(("call", "message"), CALLS.values(), ids=CALLS)
def test_one_line_tells_what_is_wrong(call, message):
    """A number that is too large is of the right type."""
    with pytest.raises(ValueError if "from -2147483648" in message else TypeError) as caught:
        call(cc.Renderer.__new__(cc.Renderer))
    assert str(caught.value) == message


#: Modules whose functions users call by names of cubecam or as methods only.
INNER = ("results.", "images.", "cubemaps.", "meshes.", "cubemap_save.")
ANSWERING = sorted({name for name, _ in FOUND if not name.startswith(INNER)})


@pytest.mark.parametrize("name", ANSWERING)
def test_every_callable_answers_in_one_line(name):
    """Functions of the core and of Python: an option that does not exist, by its name."""
    with pytest.raises(TypeError) as caught:
        callable_of(name)(no_such_option=1)
    message = str(caught.value)
    assert re.match(r"^[\w.]+\(\) (has no option 'no_such_option'; |needs )", message), message
    assert "\n" not in message


def test_an_answer_hides_no_error_of_the_function_itself():
    """A TypeError from inside a function stays, even if its text looks like that of a wrong call."""

    @checked_call
    def outer(path, *, size=None):
        """Say what it does."""
        return inner(path, size=size)

    def inner(path):
        return path

    with pytest.raises(TypeError, match=r"inner\(\) got an unexpected keyword argument 'size'"):
        outer("a")
    with pytest.raises(
        TypeError, match=r"^outer\(\) has no option 'sizes'; did you mean 'size'\?$"
    ):
        outer("a", sizes=1)
    assert (outer.__name__, outer.__doc__) == ("outer", "Say what it does.")
    assert list(inspect.signature(outer).parameters) == ["path", "size"]


def test_an_attribute_that_does_not_exist_cannot_be_set(renderer):
    """A misspelt attribute is an error and not a new attribute, for objects of each public class."""
    scene = cc.Scene()
    frame = renderer.render(scene, cc.PerspectiveCamera(), (2, 2))
    things = [scene, scene.add(), frame, renderer, renderer.info, renderer.stats, cc.devices()[0]]
    things += [cc.PhongMaterial(), cc.PerspectiveCamera(), cc.PointLight(), cc.Probe(), cc.Shadow()]
    things += [cc.Mesh.box(1), cc.Stencil(), cc.Blend("one", "one"), demo.build_scene(probe_size=4)]
    things += [cc.Texture([[[0.0]]])]
    for thing in things:
        with pytest.raises(AttributeError, match=r"^.*has no attribute 'colour'.*$") as caught:
            thing.colour = 1
        assert "\n" not in str(caught.value)
    kinds = [kind for kind in vars(cc).values() if type(kind).__name__ == "pybind11_type"]
    assert len(kinds) > 20
    assert [kind.__name__ for kind in kinds if kind.__dictoffset__ != 0] == []


def test_errors_of_the_call_itself_stay():
    """Only errors about calls that fit no signature are reworded."""
    with pytest.raises(TypeError, match=r"^exclude: expected Nodes, got int$"):
        cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), exclude=[3])  # type: ignore[list-item]


def test_overloads_are_explained_by_what_was_named():
    with pytest.raises(TypeError, match=r"^add\(\): visible: expected bool, got 'no'$"):
        cc.Scene().add(visible="no")
    with pytest.raises(
        TypeError, match=r"^add\(\) has no option 'colour'; it takes light, camera, animation, "
    ):
        cc.Scene().add(colour="red")
