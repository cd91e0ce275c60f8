"""The panel of a Viewer: view, materials, lights, environment, probes, lens, nodes, and a button that resets them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

from .._calls import checked_call
from .._core import Material, Node, Probe, ProbeBlend, Scene
from ..io.screen import CURVES
from .control import Control, Section
from .environment import EnvironmentTurn
from .material_panel import groups, maps_shown, material_controls
from .morph_panel import morph_names, weight_controls
from .panel import Memory, properties
from .scene_camera import camera_names

if TYPE_CHECKING:
    from .viewer import Viewer

__all__ = ["probes_of", "scene_sections"]

_OUTPUTS = ("color", "distance", "normal", "id")
# More sections of one sort would make a panel slow and too long to read.
_MOST = 40
# What every material has; a panel shows these options apart from the kind's own, except for the opacity.
_SURFACE = frozenset(
    name for name, member in vars(Material).items() if isinstance(member, property)
) - {"opacity"}
_PLACE = frozenset({"position", "target", "up"})  # the controls of the view move these


@checked_call
def scene_sections(viewer: Viewer) -> list[Section]:
    """Make the panel of a viewer from the objects of its scene; what is added to the scene appears in the next call.

    Parameters
    ----------
    viewer : Viewer

    Returns
    -------
    list of Section
        "View", "Scene" (cameras, variants, animations), sections for each material, one for each light,
        "Environment", one for each probe, "Lens", one for each node, and "Reset". A title names the nodes that have the
        material or the probe.

    Examples
    --------
    >>> import cubecam as cc
    >>> from types import SimpleNamespace
    >>> from cubecam.viewer.scene_panel import scene_sections
    >>> scene = cc.Scene(background="black")
    >>> _ = scene.add(cc.Mesh.sphere(1), cc.GlassMaterial(), name="ball")
    >>> viewer = SimpleNamespace(
    ...     scene=scene, camera=cc.PerspectiveCamera(), exposure=0.0, tonemap=None, output="color"
    ... )
    >>> [section.title for section in scene_sections(viewer)]
    ['View', 'ball: GlassMaterial', 'ball: surface', 'Environment', 'Lens', 'ball: node', 'Reset']
    """
    # The memory lives as long as the viewer: the first values are those of the first panel.
    memory: Memory = vars(viewer).setdefault("_panel_memory", Memory())
    scene, nodes = viewer.scene, viewer.scene.nodes
    sections = [
        _view(memory, viewer, nodes),
        *_time_and_variants(memory, viewer),
        *_few(_materials(memory, nodes), "materials"),
        *_few(_lights(memory, scene), "lights"),
        _environment(memory, scene),
        *_few(_probes(memory, nodes), "probes"),
        Section("Lens", _lens(memory, viewer.camera), open=False),
        *_few(_nodes(memory, nodes), "nodes"),
        Section("Reset", (_reset(memory),)),
    ]
    memory.forget_unseen()
    return [section for section in sections if section.controls or section.title.startswith("and")]


@checked_call
def probes_of(nodes: Iterable[Node]) -> dict[Probe, list[Node]]:
    """Find the probes that nodes or their materials use, in order of the nodes, and the nodes that use each.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.scene_panel import probes_of
    >>> scene, probe = cc.Scene(), cc.Probe((0, 1, 0))
    >>> ball = scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), environment=probe)
    >>> probes_of(scene.nodes) == {probe: [ball]}
    True
    """
    found: dict[Probe, list[Node]] = {}
    for node in nodes:
        shown = node.environment
        cubes: list[object] = list(shown.probes) if isinstance(shown, ProbeBlend) else [shown]
        if node.material is not None:
            cubes.append(getattr(node.material, "cubemap", None))
            cubes.extend(getattr(node.material, "textures", {}).values())
        for cube in dict.fromkeys(cube for cube in cubes if isinstance(cube, Probe)):
            found.setdefault(cube, []).append(node)
    return found


def _few(sections: Iterator[Section], what: str) -> list[Section]:
    listed = list(sections)
    if len(listed) <= _MOST:
        return listed
    return [*listed[:_MOST], Section(f"and {len(listed) - _MOST} more: {what}", (), open=False)]


def _name(node: Node) -> str:
    return node.name or f"node {node.id}"


def _names(nodes: list[Node]) -> str:
    """Name up to three nodes."""
    listed = ", ".join(dict.fromkeys(_name(node) for node in nodes[:3]))
    return f"{listed}, ..." if len(nodes) > 3 else listed


def _value(thing: Any, attribute: str, kind: str, **fields: Any) -> Control:
    """Make the control of an attribute whose type is known here."""

    def keep() -> Callable[[], object]:
        value = getattr(thing, attribute)

        def back() -> None:
            if getattr(thing, attribute) is not value:
                setattr(thing, attribute, value)

        return back

    more = {
        "name": attribute,
        "get": lambda: getattr(thing, attribute),
        "set": lambda value: setattr(thing, attribute, value),
        "keep": keep,
    }
    return Control(kind=kind, **{**more, **fields})


def _pick(thing: Any, name: str, values: dict[str, object], help_: str) -> Control:
    """Make a choice whose words stand for values."""

    def get() -> str:
        today = getattr(thing, name)
        return next((w for w, v in values.items() if v is today or v == today), str(today))

    def set_(word: str) -> None:
        if word in values:  # else the word stands for the present value
            setattr(thing, name, values[word])

    return _value(thing, name, "choice", get=get, set=set_, choices=tuple(values), help=help_)


# ---- the sections, in their order


def _view(memory: Memory, viewer: Any, nodes: tuple[Node, ...]) -> Section:
    outputs: dict[str, object] = {name: name for name in _OUTPUTS}
    for probe, users in probes_of(nodes).items():
        word = f"what the probe of {_names(users)} sees"
        while word in outputs:
            word += "'"
        outputs[word] = probe
    curves: dict[str, object] = {"None": None, **{name: name for name in CURVES}}

    def make() -> tuple[Control, ...]:
        return (
            _value(
                viewer, "exposure", "number", get=lambda: float(viewer.exposure),
                low=-6.0, high=6.0, step=0.1, unit="stops",
                help="The colour is multiplied by 2**exposure, before the tone curve.",
            ),
            _pick(viewer, "tonemap", curves, "The tone curve, which keeps highlights."),
            _pick(viewer, "output", outputs, "What the picture shows."),
        )  # fmt: skip

    shape = tuple((word, id(value)) for word, value in outputs.items())
    return Section("View", memory.controls("view", make, shape=shape))


def _time_and_variants(memory: Memory, viewer: Any) -> Iterator[Section]:
    """Give the section for what a scene from a file may have: cameras, variants, animations."""
    scene = viewer.scene
    cameras, variants = tuple(camera_names(scene)), scene.variants
    animations = tuple(one.name for one in scene.animations)
    if not (cameras or variants or animations):
        return

    def make() -> tuple[Control, ...]:
        found = []
        if cameras:
            words: dict[str, object] = {"free": None, **{name: name for name in cameras}}
            help_ = "The camera of the scene whose view is shown; moving the view makes it free."
            found.append(_pick(viewer, "scene_camera", words, help_))
        if variants:
            looks: dict[str, object] = {"None": None, **{name: name for name in variants}}
            found.append(_pick(scene, "variant", looks, "Which materials the nodes show."))
        if animations:
            names: dict[str, object] = {name: name for name in viewer._player.names}
            found += [
                _pick(viewer, "animation", names, "Which animation plays."),
                _value(viewer, "playing", "flag", help="Whether time runs; the space bar, too."),
                _value(
                    viewer, "time", "number", get=lambda: round(float(viewer.time), 3),
                    low=0.0, high=max(one.duration for one in scene.animations), unit="seconds",
                    help="The time of the animation; after its end it begins again.",
                ),
                _value(
                    viewer, "speed", "number", low=0.0, high=4.0, step=0.05,
                    help="How fast time runs: 1 as the animation was made.",
                ),
            ]  # fmt: skip
        return tuple(found)

    shape = (cameras, variants, animations)
    yield Section("Scene", memory.controls("scene", make, shape=shape))


def _materials(memory: Memory, nodes: tuple[Node, ...]) -> Iterator[Section]:
    users: dict[int, tuple[Material, list[Node]]] = {}
    for node in nodes:
        if node.material is not None:
            users.setdefault(id(node.material), (node.material, []))[1].append(node)
    for material, having in users.values():
        uniforms = getattr(material, "uniforms", {})
        controls = memory.controls(
            material,
            lambda material=material: material_controls(material),  # type: ignore[misc]
            shape=(tuple(uniforms), maps_shown(memory, material)),
        )
        names = _names(having)
        own = tuple(c for c in controls if c.name.split(" ")[0] not in _SURFACE)
        rest = tuple(c for c in controls if c.name.split(" ")[0] in _SURFACE)
        for title, some in groups(material, own):
            first = title == type(material).__name__
            yield Section(f"{names}: {title}", some, open=first and len(users) <= 4)
        yield Section(f"{names}: surface", rest, open=False)


def _lights(memory: Memory, scene: Scene) -> Iterator[Section]:
    lights = scene.lights
    for i, light in enumerate(lights):
        controls = memory.controls(light, lambda light=light: properties(light))  # type: ignore[misc]
        number = f" {i + 1}" if len(lights) > 1 else ""
        yield Section(f"Light{number}: {type(light).__name__}", controls, open=len(lights) == 1)


def _environment(memory: Memory, scene: Scene) -> Section:
    def turn() -> tuple[Control, ...]:
        return (
            _value(
                EnvironmentTurn(scene), "degrees", "number", name="rotation",
                low=-180.0, high=180.0, step=1.0, unit="degrees",
                help="The environment turns about +Y; at 90, what was at +Z is at +X.",
            ),
        )  # fmt: skip

    def others() -> tuple[Control, ...]:
        # The turn is the part of the rotation that people set by hand.
        without = {"environment_rotation"}
        if scene.environment is None:
            without.add("environment_intensity")
        return properties(scene, leave_out=without)

    # The turn comes first in the memory: resetting it may change the background, which is reset afterwards.
    first = () if scene.environment is None else memory.controls("turn", turn)
    rest = memory.controls(scene, others, shape=scene.environment is None)
    return Section("Environment", (*first, *rest))


def _probes(memory: Memory, nodes: tuple[Node, ...]) -> Iterator[Section]:
    for probe, users in probes_of(nodes).items():
        controls = memory.controls(probe, lambda probe=probe: properties(probe))  # type: ignore[misc]
        yield Section(f"{_names(users)}: probe", controls, open=False)


def _lens(memory: Memory, camera: Any) -> tuple[Control, ...]:
    # A StereoCamera has a layout; its two cameras follow the view.
    return memory.controls(camera, lambda: properties(camera, leave_out=_PLACE))


def _nodes(memory: Memory, nodes: tuple[Node, ...]) -> Iterator[Section]:
    for node in nodes:
        names = morph_names(node)
        controls = memory.controls(
            node,
            lambda node=node, names=names: (*weight_controls(node, names), *properties(node)),  # type: ignore[misc]
            shape=names,
        )
        yield Section(f"{_name(node)}: node", controls, open=False)


def _reset(memory: Memory) -> Control:
    return Control(
        name="Reset",
        kind="button",
        get=lambda: None,
        set=lambda _: memory.reset(),
        help="Brings back the values that were there when the panel was first shown.",
    )
