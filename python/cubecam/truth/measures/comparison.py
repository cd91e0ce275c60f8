"""The result of a comparison, as a small table, as JSON and as a figure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy.typing as npt

from ..._calls import checked_call
from ..._checks import one_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

    from ...typing import Convention, Encoding

__all__ = ["Comparison"]

Array = npt.NDArray[Any]

_FACES = ("+X", "-X", "+Y", "-Y", "+Z", "-Z")


@dataclass(frozen=True, eq=False, repr=False)
class Comparison:
    """How far a picture is from the truth; `truth.compare` makes it and defines the numbers.

    Attributes
    ----------
    rmse : float
        The root of the mean square of picture - truth.
    relative_rmse : float or None
        `rmse` over the root of the mean square of the truth; None if the truth is black.
    mean_absolute : float
        The mean of abs(picture - truth).
    max : float
        The largest abs(picture - truth).
    worst : tuple of int
        Where that is: (row, column), or (face, row, column) of a cube.
    picture_value, truth_value : tuple of float
        The colours there.
    error : ndarray float64 (H, W) or (6, N, N)
        The largest abs(picture - truth) of a pixel's channels; NaN where a pixel does not count.
    ssim : float or None
        The mean structural similarity of the screen's values, 1 for equal pictures.
    flip : float or None
        The mean of FLIP, 0 for equal pictures.
    flip_range : {"LDR", "HDR"} or None
        Which FLIP it is.
    flip_map : ndarray float32 (H, W) or (6, N, N), or None
        FLIP of each pixel; NaN where a pixel does not count.
    counted, total : int
        How many pixels count, of how many.
    not_finite : int
        Pixels that the mask has, but where a picture is NaN or infinite; they do not count.
    notes : tuple of str
        Why a number is None.
    picture, truth : ndarray float64 (H, W, C) or (6, N, N, C)
        The colours that were compared.
    encoding : {"linear", "srgb"}
        What these numbers are.
    curve : bool
        Whether linear numbers get a tone curve for the screen.
    """

    rmse: float
    relative_rmse: float | None
    mean_absolute: float
    max: float
    worst: tuple[int, ...]
    picture_value: tuple[float, ...]
    truth_value: tuple[float, ...]
    error: Array
    ssim: float | None
    flip: float | None
    flip_range: Literal["LDR", "HDR"] | None
    flip_map: Array | None
    counted: int
    total: int
    not_finite: int
    notes: tuple[str, ...]
    picture: Array
    truth: Array
    encoding: Encoding
    curve: bool

    @property
    def place(self) -> str:
        """Where the largest error is, in words."""
        *face, row, column = self.worst
        return (
            f"{_FACES[face[0]]}, row {row}, column {column}"
            if face
            else f"row {row}, column {column}"
        )

    def numbers(self) -> dict[str, Any]:
        """Give the numbers without the arrays, as JSON holds them.

        Returns
        -------
        dict of str
            Each attribute that is not an array, with lists in place of tuples.

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> grey = np.full((2, 2, 3), 0.5)
        >>> cc.truth.compare(grey * 1.5, grey).numbers()["rmse"]
        0.25
        """
        names = (
            "rmse", "relative_rmse", "mean_absolute", "max", "worst", "picture_value", "truth_value", "ssim", "flip",
            "flip_range", "counted", "total", "not_finite", "notes", "encoding",
        )  # fmt: skip
        values = {name: getattr(self, name) for name in names}
        return {k: list(v) if isinstance(v, tuple) else v for k, v in values.items()}

    def rows(self) -> list[tuple[str, str]]:
        """Give the table as rows of a name and a text.

        Returns
        -------
        list of (str, str)
            What `repr` prints.

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> grey = np.full((2, 2, 3), 0.5)
        >>> cc.truth.compare(grey * 1.5, grey).rows()[0]
        ('RMSE', '0.25')
        """
        relative = "none" if self.relative_rmse is None else f"{100 * self.relative_rmse:.4g} %"
        kind = f"FLIP ({self.flip_range})" if self.flip_range else "FLIP"
        where = f" at {self.place}" if self.max else ""
        rows = [
            ("RMSE", f"{self.rmse:.4g}"),
            ("relative RMSE", relative),
            ("mean absolute", f"{self.mean_absolute:.4g}"),
            ("max", f"{self.max:.4g}{where}"),
            ("picture there", _color(self.picture_value)),
            ("truth there", _color(self.truth_value)),
            ("SSIM", "none" if self.ssim is None else f"{self.ssim:.6f}"),
            (kind, "none" if self.flip is None else f"{self.flip:.6f}"),
            ("pixels", f"{self.counted} of {self.total} count"),
        ]
        if self.not_finite:
            rows.append(("not finite", f"{self.not_finite} pixels, which do not count"))
        return rows + [("note", note) for note in self.notes]

    def __repr__(self) -> str:
        size = " x ".join(str(n) for n in self.error.shape)
        lines = [f"  {name:<15}{text}" for name, text in self.rows()]
        return "\n".join([f"Comparison of {size} pixels", *lines])

    def _repr_html_(self) -> str:
        from html import escape

        cells = "".join(
            f'<tr><th style="text-align:left">{escape(name)}</th><td style="text-align:left">{escape(text)}</td></tr>'
            for name, text in self.rows()
        )
        return f"<table>{cells}</table>"

    def __rich__(self) -> Table:
        from rich.table import Table
        from rich.text import Text

        table = Table(show_header=False, box=None)
        for name, text in self.rows():
            table.add_row(Text(name, style="bold"), Text(text))
        return table

    @checked_call
    def plot(
        self,
        *,
        exposure: float = 0.0,
        scale: Literal["linear", "log"] = "linear",
        convention: Convention = "inside",
    ) -> Figure:
        """Draw the picture, the truth, the error with its worst place marked, and FLIP if there is one.

        Parameters
        ----------
        exposure : float, default 0
            Stops: the light of both pictures is multiplied by 2 ** exposure.
        scale : {"linear", "log"}, default "linear"
            The scale of the error's colours.
        convention : {"inside", "gl", "three"}, default "inside"
            How a cube's faces are drawn, see `plot.cross`.

        Returns
        -------
        matplotlib.figure.Figure
            A new figure. Its title has the numbers; pixels that do not count are grey in the maps.

        Raises
        ------
        ImportError
            If matplotlib is missing.
        ValueError
            For an exposure beyond -64 to 64, or an unknown `scale` or `convention`.

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> truth = np.linspace(0, 1, 32 * 32 * 3).reshape(32, 32, 3)
        >>> figure = cc.truth.compare(truth**1.1, truth, flip=False).plot()
        >>> [ax.get_title() for ax in figure.axes[:3]]
        ['picture', 'truth', 'error: max 0.03505 at row 12, column 10']
        """
        from .figure import comparison_figure

        one_of(scale, "scale", ("linear", "log"))
        return comparison_figure(self, exposure=exposure, scale=scale, convention=convention)


def _color(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:.4g}" for value in values)
