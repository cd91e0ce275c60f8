"""`layout`: the faces of a cube, flat as in a picture or folded up, turned by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._core import BasicMaterial, CubeMap, Image, Mesh, Node, PerspectiveCamera, Scene
from .._core import axis_angle as turn_about
from ..plot._figure import are_colors, faces_of, on_screen
from ..plot._layout import places_of
from ..typing import Place, Tonemap
from ..viewer.lettering import Lettering
from ..viewer.live import shown_at
from ..viewer.panel import Control, Section
from ..viewer.settings import choice, number
from ..viewer.viewer import Viewer

if TYPE_CHECKING:
    from .._core import Renderer
    from ..plot._layout import Placed

__all__ = ["LayoutView", "layout"]

Array = npt.NDArray[Any]

#: Pixels along an edge of a face's picture at least, so that its name is sharp.
_LEAST = 256
#: Seconds in which the key f folds the faces.
_SECONDS = 1.5
#: How much of a copy is seen while the faces lie flat.
_COPY = 0.6


class Hinge(NamedTuple):
    """A face that turns about an edge: where, the axis, which way it folds, and the middle of the face."""

    at: tuple[float, float, float]
    axis: tuple[float, float, float]
    sign: float
    middle: tuple[float, float]


_RIGHT = Hinge((1, 0, 0), (0, 1, 0), 1, (1, 0))
_LEFT = Hinge((-1, 0, 0), (0, 1, 0), -1, (-1, 0))
_UP = Hinge((0, 1, 0), (1, 0, 0), -1, (0, 1))
_DOWN = Hinge((0, -1, 0), (1, 0, 0), 1, (0, -1))
#: The row of the layout: each side with the side that it is joined to, and its hinge.
_ROW = {"-X": ("+Z", _LEFT), "+X": ("+Z", _RIGHT), "-Z": ("+X", _RIGHT)}


class LayoutView(Viewer):
    """The live view of `cubecam.explore.layout`, which makes it.

    `fold` and `repeat` can be set in Python, by the panel and by keys; the picture follows. All else is as in `Viewer`.
    """

    fold = number(
        "float: 0, the faces lie flat, to 1, they are the cube, seen from outside.",
        0.0, 1.0, step=0.01,
    )  # fmt: skip
    repeat = choice(
        '{"+X", "-X", "-Z", "all"} or None: the sides with copies of +Y and -Y.',
        ("-Z", "-X", "+X", "all", None),
    )

    _SETTINGS: ClassVar[dict[str, Any]] = {"fold": 0.0, "repeat": "-Z"}

    @checked_call
    def __init__(
        self,
        cube: CubeMap | npt.ArrayLike | None = None,
        *,
        exposure: float = 0.0,
        tonemap: Tonemap | None = "neutral",
        size: tuple[int, int] = (800, 600),
        renderer: Renderer | None = None,
        **settings: Any,
    ) -> None:
        self._hinged: list[tuple[Node, Hinge]] = []
        self._copies: dict[str, list[Node]] = {}
        # The options are checked in either case.
        white = np.ones((6, 1, 1, 3), np.float32)
        shown = _pictures(white if cube is None else cube, exposure, tonemap)
        pictures = None if cube is None else shown
        scene = Scene(background=(0.93, 0.93, 0.93, 1))
        self._root = scene.add()
        self._build(scene, pictures)
        camera = PerspectiveCamera(fov=32, position=(0, 0, 13), target=(0, 0, 0), near=0.1, far=100)
        super().__init__(
            scene, camera, size=size, renderer=renderer, tonemap=None, encode=None, title="layout"
        )
        for name, value in {**self._SETTINGS, **settings}.items():
            if name not in self._SETTINGS:
                from .._calls import unknown_name

                raise TypeError(unknown_name("LayoutView()", name, list(self._SETTINGS)))
            setattr(self, name, value)
        self._place()

    # Scene ----------------------------------------------------------------------------------------------------

    def _build(self, scene: Scene, pictures: Array | None) -> None:
        """Add the six faces, each joined to its neighbour by a hinge, and all copies."""
        placed = places_of("gl", ("+X", "-X", "-Z"), False)
        own = {place.cell.name: place for place in placed if not place.copy}
        nodes = {"+Z": self._face(scene, own["+Z"], None, self._root, pictures)}
        for name, (before, hinge) in _ROW.items():
            nodes[name] = self._face(scene, own[name], hinge, nodes[before], pictures)
        for name, hinge in (("+Y", _UP), ("-Y", _DOWN)):
            nodes[name] = self._face(scene, own[name], hinge, nodes["+Z"], pictures)
        columns = {own[name].column: name for name in _ROW}
        for place in placed:
            if place.copy:
                side = columns[place.column]
                hinge = _UP if place.row == 0 else _DOWN
                node = self._face(scene, place, hinge, nodes[side], pictures)
                node.name = f"copy of {place.cell.name} beside {side}"
                self._copies.setdefault(side, []).append(node)

    def _face(
        self,
        scene: Scene,
        place: Placed,
        hinge: Hinge | None,
        parent: Node,
        pictures: Array | None,
    ) -> Node:
        """Add one face below its parent; the coordinates of a node begin in the middle of its face."""
        material = BasicMaterial(
            map=Image(_picture(place, pictures), mag_filter="linear", wrap="clamp"),
            double_sided=True,
        )
        if hinge is None:
            return scene.add(_quad(), material, parent=parent, name=place.cell.name)
        pivot = scene.add(position=hinge.at, parent=parent)
        self._hinged.append((pivot, hinge))
        return scene.add(
            _quad(), material, position=(*hinge.middle, 0), parent=pivot, name=place.cell.name
        )

    def _place(self) -> None:
        """Turn the hinges, and move the whole so that its middle stays in the view."""
        for pivot, hinge in self._hinged:
            pivot.rotation = turn_about(hinge.axis, 90 * hinge.sign * self.fold)
        # Flat, the middle of the row of four is half a face to the right of +Z; the cube's is one unit behind +Z, and
        # is shown larger.
        grown = 1 + 0.7 * self.fold
        self._root.scale = grown
        self._root.position = (-1 + self.fold, 0, grown * self.fold)
        shown = {None: (), "all": tuple(self._copies)}.get(self.repeat, (self.repeat,))
        for side, nodes in self._copies.items():
            for node in nodes:
                # Folded up, a copy lies where the face itself is.
                node.visible = side in shown and self.fold < 0.999
                assert isinstance(node.material, BasicMaterial)
                node.material.opacity = _COPY * (1 - self.fold)

    # Events ---------------------------------------------------------------------------------------------------

    def changed(self, moving: bool = True) -> None:
        """Draw soon, with all faces at their places."""
        if "_repeat" in vars(self):  # all settings are set
            self._place()
        super().changed(moving)

    @property
    def help(self) -> str:
        """What mouse and keys do, one line each."""
        return f"f  fold, unfold\nc  copies of +Y and -Y\n{super().help}"

    def _key(self, key: str) -> None:
        if key == "f":
            self._fold_by_itself()
        elif key == "c":
            names = ("-Z", "all", None)
            at = names.index(self.repeat) if self.repeat in names else -1
            self.repeat = names[(at + 1) % 3]
            self._tell("panel", None)
        else:
            super()._key(key)

    def _fold_by_itself(self) -> None:
        first, last = self.fold, 0.0 if self.fold > 0.5 else 1.0

        def move(seconds: float) -> None:
            share = min(1.0, seconds / _SECONDS)
            smooth = share * share * (3 - 2 * share)
            self.fold = first + (last - first) * smooth
            if share == 1:
                self.animate(None)
                self._tell("panel", None)

        self.animate(move)

    def panel(self) -> list[Section]:
        """List what can be set: the layout, then the scene's objects."""
        controls: tuple[Control, ...] = tuple(
            vars(LayoutView)[name].control(self) for name in self._SETTINGS
        )
        return [Section("layout", controls), *super().panel()]


def _quad() -> Mesh:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    return Mesh(corners, [[0, 1, 2], [0, 2, 3]], uvs=(corners[:, :2] + 1) / 2)


def _pictures(cube: CubeMap | npt.ArrayLike, exposure: float, tonemap: Tonemap | None) -> Array:
    """Turn a cube's colours into uint8 (6, M, M, 3), with pixels enough for letters."""
    pixels = faces_of(cube)
    if not are_colors(pixels, 3):
        raise ValueError(f"cube: expected colours (6, N, N, C), got shape {pixels.shape}")
    shown: Any = cube if isinstance(cube, CubeMap) else pixels
    faces = on_screen(shown, exposure, tonemap)
    times = -(-_LEAST // faces.shape[1])
    return faces.repeat(times, axis=1).repeat(times, axis=2)


def _picture(place: Placed, pictures: Array | None) -> npt.NDArray[np.uint8]:
    """Draw a face with its border and its name, and turn it as its place in the layout needs."""
    plain = pictures is None
    face = (
        np.full((_LEAST, _LEAST, 3), 255, np.uint8)
        if pictures is None
        else place.cell.picture(pictures)
    )
    n = len(face)
    ink = (150, 150, 150) if place.copy else (20, 20, 20)
    letters = Lettering(face, ink, (255, 255, 255), n / 3.2 if plain else n / 9)
    at = (n / 2, n / 2) if plain else (n / 2, n / 9)
    letters.write(place.cell.name, at, anchor="mm", plain=plain)
    letters.draw.rectangle((0, 0, n - 1, n - 1), outline=ink, width=max(1, n // 100))
    turned: npt.NDArray[np.uint8] = np.ascontiguousarray(np.rot90(letters.picture, place.turns))
    return turned


@checked_call
def layout(
    cube: CubeMap | npt.ArrayLike | None = None,
    *,
    fold: float = 0.0,
    repeat: str | None = "-Z",
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    size: tuple[int, int] = (800, 600),
    where: Place | None = None,
    browser: bool = True,
    block: bool | None = None,
) -> LayoutView:
    """Show live how the six faces of a cubemap are joined: flat as in a picture, or folded up to the cube.

    The faces are stored as seen from outside the cube ("gl", docs/conventions.md). Faded copies of +Y and -Y stand
    beside other sides to which they attach, too; when the faces are folded up, each copy comes to lie on the face
    itself. A drag turns everything: from inside the folded cube each face is seen mirrored.

    Parameters
    ----------
    cube : CubeMap or array_like (6, N, N, C), optional
        None: white faces with their names.
    fold : float
        0: the faces lie flat; 1: they are the cube.
    repeat : {"-Z", "-X", "+X", "all"} or None
        The sides that have copies of +Y and -Y; None: no copies.
    exposure, tonemap
        As in `to_screen`.
    size : (int, int)
        Width and height of the picture in logical pixels.
    where : {"notebook", "page", "window", "terminal", "offscreen"}, optional
        Default: the notebook in Jupyter, a window where there is a screen and Qt, the terminal over SSH, else a page
        for a browser on this machine.
    browser : bool
        Whether a page is opened in the browser.
    block : bool, optional
        Whether the call returns only after the view was closed or Ctrl-C was typed. Default: in scripts yes, in
        notebooks and in Python's prompt no.

    Returns
    -------
    LayoutView
        The live view, with the properties `fold` and `repeat`. The key f folds and unfolds, c changes the copies.

    Raises
    ------
    TypeError, ValueError
        For an option of another type, an unknown name, a number out of range, or a cube without colours.
    ImportError
        If a package is missing; the message names the extra of cubecam that has it.

    Notes
    -----
    After the figure of D. Eck, "Introduction to Computer Graphics", section 7.4.4. `plot.layout` draws it for paper.

    Examples
    --------
    >>> import cubecam as cc
    >>> with cc.explore.layout(where="offscreen", fold=1) as view:
    ...     print(view.draw().shape, view.pick(400, 300).node.name)
    (600, 800, 4) +Z
    """
    view = LayoutView(cube, exposure=exposure, tonemap=tonemap, size=size, fold=fold, repeat=repeat)
    return shown_at(view, where, browser, block)
