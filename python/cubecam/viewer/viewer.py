"""`Viewer`: a scene that one can turn, walk in, pick from and change."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._calls import checked_call
from .._checks import finite_number, one_of, truth, whole_number
from .._core import (
    Frame,
    Node,
    OrthographicCamera,
    PerspectiveCamera,
    Probe,
    Renderer,
    Scene,
    _newest_revision,
)
from ..navigation import Standing
from ..typing import ControlsName, Encode, Output, Place, Tonemap
from .controls import Controls, FirstPerson, Orbit, make_controls
from .live import LiveView, shown_at
from .outputs import OUTPUTS, output_picture, probe_picture
from .picking import Pick, pick_of
from .player import Player
from .scene_camera import camera_names, free_camera

if TYPE_CHECKING:
    import numpy.typing as npt

    from .panel import Section

__all__ = ["Viewer", "show_scene"]

_PANEL = 0.5  # seconds after which the panel shows the time of a running animation again
_PICKED = ("id", "position", "normal", "distance")


class Viewer(LiveView):
    """Explore a scene: drag to turn, wheel to come nearer, double click to set the pivot, ``h`` for all keys.

    Parameters
    ----------
    scene : Scene
        What is shown. Changes of the scene show at once.
    camera : PerspectiveCamera or OrthographicCamera, optional
        The view, which the controls move. Default: a camera that sees the whole scene, or one that stands at the
        origin in a scene without nodes.
    controls : {"orbit", "first_person", "fly"} or Controls
        What mouse and keys do: turn the scene round the camera's target, or stand in it.
    size : (int, int)
        The (width, height) in logical pixels.
    renderer : Renderer, optional
        What draws; several viewers may share one. Default: a renderer of its own, which `close` closes.
    samples : int
        Samples of each pixel at rest, as in `Renderer.render`. While something moves there is one.
    exposure : float
        Stops, as in `Renderer.render`.
    tonemap : {"neutral", "reinhard", "aces"} or None
        The tone curve, as in `Renderer.render`.
    encode : "srgb" or None
        As in `Renderer.render`. None shows the numbers of the colours unchanged.
    output : {"color", "distance", "normal", "id"} or Probe
        What the picture shows: the colour; the distance to the camera, near is bright; normals, (n + 1) / 2; one
        colour for each node; or the cubemap that a probe sees, as a cross.
    title : str
        The title of the page or of the window.

    Raises
    ------
    TypeError
        For an object that is no scene, camera, renderer or probe.
    ValueError
        For another name of controls or outputs, or a size below 1.

    Notes
    -----
    At rest the picture equals ``renderer.render(scene, camera, size, samples=samples, exposure=exposure,
    tonemap=tonemap, encode=encode).color`` bit for bit.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background="white")
    >>> ball = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial(color="red"), name="ball")
    >>> with cc.Viewer(scene, size=(64, 48)) as viewer:
    ...     picture = viewer.draw()
    ...     found = viewer.pick(32, 24)
    >>> picture.shape, found.node is ball
    ((48, 64, 4), True)
    """

    __module__ = "cubecam"

    @checked_call
    def __init__(
        self,
        scene: Scene,
        camera: PerspectiveCamera | OrthographicCamera | None = None,
        controls: ControlsName | Controls = "orbit",
        *,
        size: tuple[int, int] = (640, 480),
        renderer: Renderer | None = None,
        samples: int = 4,
        exposure: float = 0.0,
        tonemap: Tonemap | None = "neutral",
        encode: Encode | None = "srgb",
        output: Output | Probe = "color",
        title: str = "cubecam",
    ) -> None:
        _expect(scene, Scene, "scene")
        if camera is not None:
            _expect(camera, (PerspectiveCamera, OrthographicCamera), "camera")
        if renderer is not None:
            _expect(renderer, Renderer, "renderer")
        super().__init__(size=size, title=title)
        self._frame: tuple[tuple[int, tuple[int, int]], Frame] | None = None
        self._node_of: tuple[int, dict[int, Node]] = (-1, {})
        self._scene = scene
        self._player = Player(scene)
        self._follows: PerspectiveCamera | OrthographicCamera | None = None
        bounds = _extent(scene)
        if camera is None:
            camera = PerspectiveCamera()
            if bounds is not None:
                camera.fit(scene, aspect=self.size[0] / self.size[1])
            elif controls == "orbit":
                controls = "first_person"  # there is nothing to turn
        self._controls = make_controls(controls)
        self._owned: Renderer | None = None
        self._renderer = renderer
        self.samples = samples
        self.exposure = exposure
        self.tonemap = tonemap
        self.encode = encode
        self.output = output
        self.camera = camera
        self._clicked: tuple[float, float] | None = None
        self._panel_told = 0.0  # when the panel last followed an animation
        self.picked: Pick | None = None

    # ----- settings

    @property
    def scene(self) -> Scene:
        """What is shown; another scene shows at once."""
        return self._scene

    @scene.setter
    def scene(self, value: Scene) -> None:
        _expect(value, Scene, "scene")
        with self._lock:
            self._scene = value
            before, self._player, self._follows = self._player, Player(value), None
            self._player.playing, self._player.speed = before.playing, before.speed
            self._frame, self._node_of = None, (-1, {})
        self._set_something()

    @property
    def camera(self) -> PerspectiveCamera | OrthographicCamera:
        """The view, which the controls move; the key r gives it the pose that it has when it is set here."""
        return self._camera

    @camera.setter
    def camera(self, value: PerspectiveCamera | OrthographicCamera) -> None:
        _expect(value, (PerspectiveCamera, OrthographicCamera), "camera")
        with self._lock:
            self._camera = value
            self._frame = None
            if value.target is None and isinstance(self._controls, Orbit):
                _give_target(value, _extent(self._scene))
            self._home = _pose(value)
        self._set_something()

    @property
    def scene_camera(self) -> str | None:
        """The camera of the scene whose view is shown, by its name; None after a person has moved the view.

        A camera without a name has that of its node, else a number. The view follows the camera when its node moves.
        """
        found = (w for w, camera in camera_names(self._scene).items() if camera is self._follows)
        return next(found, None) if self._follows is not None else None

    @scene_camera.setter
    def scene_camera(self, value: str | None) -> None:
        known = camera_names(self._scene)
        one_of(value, "scene_camera", (*known, None))
        with self._lock:
            self._follows = None if value is None else known[value]
            if value is not None:
                self.camera = free_camera(known[value], self._ahead(known[value]))
        self._set_something()

    def _ahead(self, camera: PerspectiveCamera | OrthographicCamera) -> float:
        """Give the distance from a camera to the middle of the scene, which the view then turns round."""
        bounds = _extent(self._scene)
        if bounds is None:
            return 1.0
        away = (bounds[0] + bounds[1]) / 2 - free_camera(camera).position
        return max(float(np.linalg.norm(away)), 1e-6)

    def _follow(self) -> None:
        """Bring the view to the scene's camera, which may have moved with its node."""
        if self._follows is None:
            return
        now = free_camera(self._follows, self._ahead(self._follows))
        for name, value in _pose(now).items():
            setattr(self._camera, name, value)

    # ----- time

    @property
    def animation(self) -> str:
        """The animation of the scene that plays, by its name; one without a name has a number. Empty without any."""
        return self._player.animation

    @animation.setter
    def animation(self, value: str) -> None:
        with self._lock:
            self._player.animation = value
        self._set_something()

    @property
    def playing(self) -> bool:
        """Whether the animation's time runs while the view is shown; the space bar changes it."""
        return self._player.playing

    @playing.setter
    def playing(self, value: bool) -> None:
        playing = truth(value, "playing")
        with self._lock:
            self._player.playing = playing
        self._set_something()

    @property
    def time(self) -> float:
        """The seconds since the beginning of the animation; after its end it begins again."""
        return self._player.time

    @time.setter
    def time(self, value: float) -> None:
        with self._lock:
            self._player.time = value
        self._set_something()

    @property
    def speed(self) -> float:
        """How fast the animation's time runs: 1 as it was made, 2 twice as fast, below 0 backwards."""
        return self._player.speed

    @speed.setter
    def speed(self, value: float) -> None:
        speed = finite_number(value, "speed")
        with self._lock:
            self._player.speed = speed
        self._set_something()

    @property
    def controls(self) -> Controls:
        """What mouse and keys do; a name, "orbit", "first_person" or "fly", can be set as well."""
        return self._controls

    @controls.setter
    def controls(self, value: ControlsName | Controls) -> None:
        made = make_controls(value)
        with self._lock:
            self._controls = made
            if self._camera.target is None and isinstance(made, Orbit):
                _give_target(self._camera, _extent(self._scene))
        self._set_something()

    @property
    def renderer(self) -> Renderer:
        """What draws; made at its first use, if none was given."""
        self._check_open()
        if self._renderer is None:
            self._renderer = self._owned = Renderer()
        return self._renderer

    @property
    def samples(self) -> int:
        """Samples of each pixel at rest."""
        return self._samples

    @samples.setter
    def samples(self, value: int) -> None:
        self._samples = whole_number(value, "samples", 1)
        self._set_something()

    @property
    def exposure(self) -> float:
        """Stops: the light is multiplied by ``2**exposure``."""
        return self._exposure

    @exposure.setter
    def exposure(self, value: float) -> None:
        self._exposure = finite_number(value, "exposure")
        self._set_something()

    @property
    def tonemap(self) -> Tonemap | None:
        """The tone curve, or None."""
        return self._tonemap

    @tonemap.setter
    def tonemap(self, value: Tonemap | None) -> None:
        from ..io.screen import CURVES

        self._tonemap = one_of(value, "tonemap", (*CURVES, None))
        self._set_something()

    @property
    def encode(self) -> Encode | None:
        """How colours become 8 bits: "srgb", or None for the numbers unchanged."""
        return self._encode

    @encode.setter
    def encode(self, value: Encode | None) -> None:
        self._encode = one_of(value, "encode", ("srgb", None))
        self._set_something()

    @property
    def output(self) -> Output | Probe:
        """What the picture shows."""
        return self._output

    @output.setter
    def output(self, value: Output | Probe) -> None:
        self._output = (
            value if isinstance(value, Probe) else one_of(value, "output", OUTPUTS, "a Probe")
        )
        self._set_something()

    @property
    def help(self) -> str:
        """What mouse and keys do, one line each."""
        lines = [self.controls.help, "click  pick", "r  the first view again"]
        if self._player.names and " " not in self.controls.keys:
            lines.append("space  play, pause")
        if "o" not in self.controls.keys:
            lines.append("o  colour, distance, normals, ids")
        return "\n".join([*lines, super().help])

    def panel(self) -> list[Section]:
        """Give the sections for the scene's objects: see `cubecam.viewer.scene_panel`."""
        from .scene_panel import scene_sections

        return list(scene_sections(self))

    def _set_something(self) -> None:
        self.changed()
        self._tell("panel", None)

    # ----- pictures

    def _picture(self, size: tuple[int, int], moving: bool) -> npt.NDArray[np.uint8]:
        self._follow()
        output = self._output
        if isinstance(output, Probe):
            return probe_picture(
                self.renderer, self.scene, output, size, self._exposure, self._tonemap
            )
        if output != "color":
            frame = self.renderer.render(
                self.scene, self.camera, size, outputs=(output,), format=None
            )
            return output_picture(frame, output)
        frame = self.renderer.render(
            self.scene,
            self.camera,
            size,
            samples=1 if moving else self._samples,
            exposure=self._exposure,
            tonemap=self._tonemap,
            encode=self._encode,
        )
        return np.asarray(frame.color, np.uint8)

    # ----- picking

    @checked_call
    def pick(self, x: float, y: float, *, size: tuple[float, float] | None = None) -> Pick | None:
        """Find what a pixel shows.

        Parameters
        ----------
        x, y : float
            Logical pixels from the top left corner.
        size : (float, float), optional
            The (width, height) of the picture in the same pixels; the view's `size` by default.

        Returns
        -------
        Pick or None
            None where the picture shows the background.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> ball = scene.add(cc.Mesh.sphere(1), name="ball")
        >>> with cc.Viewer(scene, size=(64, 64)) as viewer:
        ...     print(viewer.pick(32, 32).node.name, viewer.pick(0, 0))
        ball None
        """
        width, height = self.size if size is None else size
        if not (0 <= x < width and 0 <= y < height):
            return None
        with self._lock:
            frame = self._outputs((max(1, round(width)), max(1, round(height))))
            return pick_of(frame, x / width, y / height, self._nodes(), self)

    def _outputs(self, size: tuple[int, int]) -> Frame:
        """Draw what picking needs, or give it again while nothing has changed."""
        key = (_newest_revision(), size)
        if self._frame is None or self._frame[0] != key:
            frame = self.renderer.render(
                self.scene, self.camera, size, outputs=_PICKED, format=None
            )
            self._frame = ((_newest_revision(), size), frame)
        return self._frame[1]

    def _nodes(self) -> dict[int, Node]:
        revision = _newest_revision()
        if self._node_of[0] != revision:
            self._node_of = (revision, {node.id: node for node in self.scene.nodes})
        return self._node_of[1]

    # ----- events

    def _handle(self, event: dict[str, Any]) -> None:
        kind = event["event_type"]
        size = event.get("size", self.size)
        if kind == "double_click":
            self._set_pivot(event, size)
        elif kind == "key_down" and not event.get("modifiers"):
            self._key(str(event.get("key", "")))
        if kind == "pointer_leave":
            self.controls.let_go()  # what is let go of elsewhere is not reported
        if self.controls.handle(event, self.camera, size):
            self._clicked = None
            self._follows = None
            self.changed()
        elif kind == "pointer_down":
            self._clicked = (event["x"], event["y"])
        elif kind == "pointer_up" and self._clicked == (event["x"], event["y"]):
            self.picked = self.pick(event["x"], event["y"], size=size)
            self.text = "background" if self.picked is None else str(self.picked)
            self._tell("picked", self.picked)
        elif kind == "pointer_move" and not event.get("buttons") and not self.moving:
            found = self.pick(event["x"], event["y"], size=size)
            self.text = "" if found is None else found.short()

    def _key(self, key: str) -> None:
        if key in self.controls.keys:
            return
        if key == "r":
            self._follows = None
            for name, value in self._home.items():
                setattr(self.camera, name, value)
            self.changed()
        elif key == " " and self._player.names:
            self.playing = not self.playing
        elif key == "o":
            now = OUTPUTS.index(self._output) if self._output in OUTPUTS else -1
            self.output = OUTPUTS[(now + 1) % len(OUTPUTS)]  # type: ignore[assignment]

    def _set_pivot(self, event: dict[str, Any], size: tuple[float, float]) -> None:
        if isinstance(self.controls, FirstPerson):
            return
        found = self.pick(event["x"], event["y"], size=size)
        if found is not None and (found.position != self.camera.world_position).any():
            standing = Standing(self.camera)
            standing.place(standing.position, found.position)
            self.changed()

    def _tick(self, now: float) -> None:
        with self._lock:
            if self.closed:
                return
            if self.controls.tick(now, self.camera):
                self._follows = None
                self.changed()
            if self._player.tick(now):
                self.changed()
                if now - self._panel_told > _PANEL:
                    self._panel_told = now
                    self._tell("panel", None)  # the slider of the time

    def _release(self) -> None:
        self._frame = None
        if self._owned is not None:
            self._owned.close()


@checked_call
def show_scene(
    self: Scene,
    where: Place | None = None,
    *,
    camera: PerspectiveCamera | OrthographicCamera | None = None,
    controls: ControlsName | Controls = "orbit",
    browser: bool = True,
    block: bool | None = None,
    size: tuple[int, int] = (640, 480),
    renderer: Renderer | None = None,
    samples: int = 4,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    encode: Encode | None = "srgb",
    output: Output | Probe = "color",
    title: str = "cubecam",
) -> Viewer:
    """Explore the scene: in the notebook, in a window, on a page of the browser or in the terminal.

    Parameters
    ----------
    where : {"notebook", "page", "window", "terminal", "offscreen"}, optional
        Default: the notebook in Jupyter, a window where there is a screen and Qt, the terminal over SSH, else a page
        for a browser on this machine.
    camera, controls, size, renderer, samples, exposure, tonemap, encode, output, title
        As in `Viewer`.
    browser : bool
        Whether a page is opened in the browser.
    block : bool, optional
        Whether the call returns only after the view was closed or Ctrl-C was typed. Default: in scripts yes, in
        notebooks and in Python's prompt no.

    Returns
    -------
    Viewer

    Raises
    ------
    ValueError, TypeError
        As `Viewer`.
    ImportError
        If a package is missing; the message names the extra of cubecam that has it.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> ball = scene.add(cc.Mesh.sphere(1))
    >>> viewer = scene.show("offscreen", size=(64, 48))
    >>> viewer.camera.orbit(yaw=30)
    >>> viewer.draw().shape
    (48, 64, 4)
    >>> viewer.close()
    """
    viewer = Viewer(
        self,
        camera,
        controls,
        size=size,
        renderer=renderer,
        samples=samples,
        exposure=exposure,
        tonemap=tonemap,
        encode=encode,
        output=output,
        title=title,
    )
    return shown_at(viewer, where, browser, block)


def _extent(scene: Scene) -> Any:
    """Return the scene's bounds, or None if nothing in it has an extent."""
    low, high = (np.asarray(corner) for corner in scene.bounds)
    seen = bool(np.isfinite(low).all() and np.isfinite(high).all() and (high > low).any())
    return (low, high) if seen else None


def _expect(value: object, kinds: type | tuple[type, ...], name: str) -> None:
    if not isinstance(value, kinds):
        known = kinds if isinstance(kinds, tuple) else (kinds,)
        words = " or ".join(f"a cubecam.{kind.__name__}" for kind in known)
        raise TypeError(f"{name}: expected {words}, got {type(value).__name__}")


def _give_target(camera: PerspectiveCamera | OrthographicCamera, bounds: Any) -> None:
    """Give a camera without a target one, along its view in the depth of the scene's middle."""
    standing = Standing(camera)
    ahead = 1.0
    if bounds is not None:
        middle = (np.asarray(bounds[0]) + np.asarray(bounds[1])) / 2
        ahead = max(float((middle - standing.position) @ standing.direction), 1.0)
    standing.place(standing.position, standing.position + ahead * standing.direction)


def _pose(camera: PerspectiveCamera | OrthographicCamera) -> dict[str, Any]:
    names = ["target", "position", "target", "up"]
    names.append("height" if isinstance(camera, OrthographicCamera) else "fov")
    return {name: getattr(camera, name) for name in names}
