"""Plots of vectors: normals as colours and arrows, arrows in space, the axes of the six faces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of
from .._core import Camera, CubeMap, Frame, _to_array
from ._faces import NAMES, TABLE, cells, cross_of
from ._figure import APART, axes_for, is_cube, numbers_of
from ._pictures import decorate_cross

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from ..typing import Convention

Array = npt.NDArray[Any]

_FIRST_VIEW = (30, -60)  # matplotlib's, with Z up; a view that the caller has turned stays
_AXIS_COLORS = {"s": "#e0483e", "t": "#2fa866", "view": "#3b6fd4"}


@checked_call
def vectors(
    field: CubeMap | Frame | npt.ArrayLike,
    *,
    output: str = "normal",
    every: int | None = None,
    camera: Camera | None = None,
    labels: bool = True,
    legend: bool = True,
    convention: Convention = "inside",
    ax: Axes | None = None,
) -> Axes:
    """Draw directions as colours, with arrows: normals, reflected rays, positions seen from the center.

    A vector v of any length has the colour 0.5 + 0.5 v / |v|: red is +X, green +Y, blue +Z (the legend has all six).
    Vectors of length 0, which is the normal of the background, and NaN are grey. Arrows show the part of v / |v| that
    lies in the plane of the picture; an arrow towards the viewer or away from him is a point.

    Parameters
    ----------
    field : CubeMap, Frame or array_like (6, N, N, 3) or (H, W, 3)
        The vectors, in the world's axes; of a cubemap or frame, the `output` of this name. Cubes are drawn as a cross,
        arrays of cubes are in "gl".
    output : str, default "normal"
        "normal", "position", or an output of three numbers that a ``ShaderMaterial`` declares.
    every : int, optional
        Pixels from one arrow to the next, 0 for no arrows. None: about ten arrows along a face, or twenty along a row.
    camera : Camera, optional
        The camera of a picture (H, W, 3), which tells where the world's axes point in it. Without one, a picture has no
        arrows; cubes need none.
    labels : bool, default True
        Whether the faces of a cube show their names.
    legend : bool, default True
        Whether the colours of the six axes are listed below.
    convention : {"inside", "gl", "three"}, default "inside"
        How a cube's faces are drawn, see `cross`.
    ax : matplotlib Axes, optional
        Where to draw. None: a new figure.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        For an output that the field does not hold, an array of another shape, an `every` below 0, or an unknown
        convention.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> room = scene.add(cc.Mesh.box(2), cc.PhongMaterial(double_sided=True))
    >>> with cc.Renderer() as renderer:
    ...     cube = renderer.capture(scene, size=32, outputs=("normal",))
    >>> ax = cc.plot.vectors(cube)
    """
    values = _vectors_of(field, output)
    if every is not None and every < 0:
        raise ValueError(f"every: expected a number of pixels from 0, got {text_of(every)}")
    cube = is_cube(values)
    length = np.linalg.norm(values, axis=-1, keepdims=True)
    known = np.isfinite(length) & (length > 0)
    unit = np.divide(values, length, out=np.zeros_like(values), where=known)
    colors = np.where(known, 0.5 + 0.5 * unit, float(APART))
    ax = axes_for(ax, (8, 6.2) if cube else (7, 5.4))
    if cube:
        places, n = cells(convention), values.shape[1]
        shown = np.concatenate([colors, np.ones((*colors.shape[:-1], 1))], axis=-1)
        ax.imshow(cross_of(shown, places, 0))
        flat = np.empty((6, n, n, 2))
        for cell in places:
            flat[cell.face] = unit[cell.face] @ np.stack([cell.right, cell.down], axis=-1)
        decorate_cross(ax, places, n, labels=labels)
        _quiver(ax, cross_of(flat, places, 0), max(n // 10, 1) if every is None else every, n)
    else:
        ax.imshow(colors)
        ax.set_axis_off()
        if camera is not None:
            right, up = camera.view[0, :3], camera.view[1, :3]
            flat = unit @ np.stack([right, -up], axis=-1)
            width = values.shape[1]
            _quiver(ax, flat, max(width // 20, 1) if every is None else every, None)
    if legend:
        _legend(ax)
    return ax


def _vectors_of(field: CubeMap | Frame | npt.ArrayLike, output: str) -> npt.NDArray[np.float64]:
    if isinstance(field, (CubeMap, Frame)):
        held = field.outputs
        if output not in held:
            if not held:
                raise ValueError(
                    "expected a picture with vectors, got one without outputs: "
                    f"draw it with outputs=({text_of(output)},)"
                )
            raise ValueError(
                f"output: expected one of {', '.join(held)} (what outputs= requested), got {text_of(output)}"
            )
        values = np.asarray(held[output])
    else:
        values = numbers_of(field)
    cube = is_cube(values) and values.ndim == 4
    if not (cube or values.ndim == 3) or values.shape[-1] != 3 or not values.size:
        raise ValueError(
            f"expected vectors (6, N, N, 3) or (H, W, 3), got an array of shape {values.shape}"
        )
    return np.asarray(values, float)


def _quiver(ax: Axes, flat: Array, every: int, face: int | None) -> None:
    """Draw every n-th of the vectors (H, W, 2), which point right and down; the longest reach the next one."""
    if not every:
        return
    height, width = flat.shape[:2]
    if face is None:
        y, x = np.mgrid[every // 2 : height : every, every // 2 : width : every]
    else:
        # The same places in each face, so that no face begins in the middle of a step.
        inside = np.arange(every // 2, face, every)
        rows = (np.arange(height // face)[:, None] * face + inside).ravel()
        columns = (np.arange(width // face)[:, None] * face + inside).ravel()
        y, x = np.meshgrid(rows, columns, indexing="ij")
    right, down = np.moveaxis(flat[y, x], -1, 0)
    seen = np.hypot(right, down) > 0.02
    ax.quiver(
        x[seen], y[seen], right[seen], down[seen], angles="xy", scale_units="xy",
        scale=1 / (0.85 * every), pivot="tail", color="0.08", width=0.0022, headwidth=4.5,
        headlength=5, alpha=0.8,
    )  # fmt: skip


def _legend(ax: Axes) -> None:
    from matplotlib.patches import Patch

    colors = 0.5 + 0.5 * TABLE[:, 2]
    swatches = [
        Patch(facecolor=tuple(color), edgecolor="0.3", linewidth=0.5, label=name)
        for color, name in zip(colors, NAMES, strict=True)
    ]
    ax.legend(
        handles=swatches, ncols=6, loc="upper center", bbox_to_anchor=(0.5, -0.01), frameon=False,
        handlelength=1, handleheight=1, columnspacing=1.4,
    )  # fmt: skip


@checked_call
def arrows(
    origins: npt.ArrayLike,
    vectors: Mapping[str, npt.ArrayLike],
    *,
    towards: Sequence[str] = (),
    length: float = 1.0,
    sphere: float | None = None,
    ax: Any = None,
) -> Any:
    """Draw arrows in space, for example incident, normal and reflected rays on a ball.

    Parameters
    ----------
    origins : array_like (..., 3)
        Where the arrows begin, in the world.
    vectors : dict of str to array_like (..., 3)
        Arrows of each name have one colour; one vector stands for all origins.
    towards : sequence of str, default ()
        The names of the arrows that end at their origin, as the incident direction of `cc.reflect` does.
    length : float, default 1
        The arrows are drawn this many times as long as the vectors are.
    sphere : float, optional
        The radius of a ball around (0, 0, 0) that is drawn, too.
    ax : matplotlib Axes3D, optional
        Where to draw. None: a new figure.

    Returns
    -------
    mpl_toolkits.mplot3d.axes3d.Axes3D
        With Y up, unless the view of `ax` was turned before, and one scale on all three axes.

    Raises
    ------
    ValueError
        For no origin, for vectors that do not fit the origins, or for a name in `towards` that `vectors` does not have.

    Examples
    --------
    >>> import cubecam as cc
    >>> normal = np.array([[0.6, 0.8, 0], [0, 1, 0]])
    >>> incident = (0, -1, 0)
    >>> rays = {"incident": incident, "normal": normal, "reflected": cc.reflect(incident, normal)}
    >>> ax = cc.plot.arrows(normal, rays, towards=["incident"], sphere=1)
    """
    if not isinstance(vectors, Mapping):
        raise TypeError(
            f"vectors: expected a dict of names to vectors, got {type(vectors).__name__}"
        )
    start = _numbers(origins, "origins")
    if start.shape[-1:] != (3,):
        raise ValueError(f"origins: expected shape (..., 3), got {start.shape}")
    if not start.size:
        raise ValueError("origins: expected at least one point, got none")
    unknown = [name for name in towards if name not in vectors]
    if unknown:
        raise ValueError(f"towards: expected names of vectors, got {text_of(unknown[0])}")
    pairs: dict[str, Array] = {}
    for name, values in vectors.items():
        vector = _numbers(values, name)
        if vector.shape[-1:] != (3,):
            raise ValueError(f"{name}: expected shape (..., 3), got {vector.shape}")
        try:
            begin, vector = np.broadcast_arrays(start, vector * length)
        except ValueError:
            raise ValueError(
                f"{name}: expected vectors for origins {start.shape}, got shape {vector.shape}"
            ) from None
        begin = begin - vector if name in towards else begin
        pairs[name] = np.stack([begin, vector], axis=-2).reshape(-1, 2, 3)
    ax = _space(ax, (6.4, 6))
    if sphere is not None:
        _draw_sphere(ax, sphere)
    for index, (name, pair) in enumerate(pairs.items()):
        x, y, z, u, v, w = pair.reshape(-1, 6).T
        ax.quiver(
            x, y, z, u, v, w, color=f"C{index}", label=name, linewidth=1.6, arrow_length_ratio=0.18
        )  # fmt: skip
    ends = [pair.sum(axis=1) for pair in pairs.values()] + [pair[:, 0] for pair in pairs.values()]
    points = np.concatenate([start.reshape(-1, 3), *ends])
    if sphere is not None:
        points = np.concatenate([points, [[-sphere] * 3, [sphere] * 3]])
    _fit(ax, points)
    if pairs:
        ax.legend(frameon=False)
    return ax


@checked_call
def face_axes(*, gap: float = 1.2, ax: Any = None) -> Any:
    """Draw the six faces in space, with the axes s and t of each and the direction in which its picture looks.

    This is OpenGL's table (docs/conventions.md) as a drawing: s and t begin at the corner of ``faces[f, 0, 0]``;
    "view" leads from the center through the middle of the face.

    Parameters
    ----------
    gap : float, default 1.2
        How far the faces stand off the cube of edge 2, so that all six are seen.
    ax : matplotlib Axes3D, optional
        Where to draw. None: a new figure.

    Returns
    -------
    mpl_toolkits.mplot3d.axes3d.Axes3D
        With Y up, unless the view of `ax` was turned before, and one scale on all three axes.

    Raises
    ------
    ValueError
        For a gap below 0.

    Examples
    --------
    >>> import cubecam as cc
    >>> ax = cc.plot.face_axes()
    """
    if not gap >= 0:
        raise ValueError(f"gap: expected a number from 0, got {text_of(gap)}")
    ax = _space(ax, (7.4, 7))
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    for name, (s, t, view) in zip(NAMES, TABLE, strict=True):
        middle = view * (1 + gap)
        corners = [middle + a * s + b * t for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        color = tuple(0.5 + 0.5 * view)
        ax.add_collection3d(
            Poly3DCollection([corners], facecolor=(*color, 0.3), edgecolor="0.4", linewidth=0.8)
        )
        first = name == NAMES[0]
        for axis, vector in (("s", s), ("t", t)):
            ax.quiver(
                *(middle - 0.9 * s - 0.9 * t), *(1.1 * vector), color=_AXIS_COLORS[axis],
                linewidth=1.8, arrow_length_ratio=0.16, label=axis if first else None,
            )  # fmt: skip
        ax.quiver(
            0, 0, 0, *(view * (1 + gap) * 0.98), color=_AXIS_COLORS["view"], linewidth=1.2,
            arrow_length_ratio=0.1, label="view" if first else None,
        )  # fmt: skip
        ax.text(
            *(middle + 0.45 * s - 0.15 * t), name, fontsize=13, fontweight="bold", ha="center",
            va="center", zorder=20,
        )  # fmt: skip
    _fit(ax, np.array([[-1.0] * 3, [1.0] * 3]) * (1 + gap), zoom=1.15)
    ax.set_axis_off()
    ax.legend(frameon=False)
    return ax


def _space(ax: Any, size: tuple[float, float]) -> Any:
    """Give axes in space with Y up."""
    ax = axes_for(ax, size, projection="3d")
    if not hasattr(ax, "view_init"):
        raise ValueError('ax: expected axes of projection="3d", got flat ones')
    if (ax.elev, ax.azim) == _FIRST_VIEW:
        ax.view_init(elev=26, azim=40, vertical_axis="y")
    ax.set(xlabel="x", ylabel="y", zlabel="z")
    return ax


def _fit(ax: Any, points: Array, zoom: float = 1.0) -> None:
    """Make all points visible at one scale."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, float((high - low).max()) / 2 or 1.0
    for axis, center in zip("xyz", middle, strict=True):
        getattr(ax, f"set_{axis}lim")(center - half, center + half)
    ax.set_box_aspect((1, 1, 1), zoom=zoom)


def _numbers(values: npt.ArrayLike, name: str) -> Array:
    """Give real numbers as float64."""
    given = _to_array(values, name)
    if given.dtype.kind not in "iuf":
        raise TypeError(f"{name}: expected real numbers, got dtype {given.dtype}")
    return np.asarray(given, np.float64)


def _draw_sphere(ax: Any, radius: float) -> None:
    around, down = np.meshgrid(np.linspace(0, 2 * np.pi, 25), np.linspace(0, np.pi, 13))
    x, y, z = np.sin(down) * np.cos(around), np.cos(down), np.sin(down) * np.sin(around)
    ax.plot_wireframe(radius * x, radius * y, radius * z, color="0.7", linewidth=0.5, alpha=0.8)
