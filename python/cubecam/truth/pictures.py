"""What `render` and `capture` give: a frame or a cubemap, with how exact its colours are."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .. import _core

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping

    from .._core import CubeMap, Frame

Floats = npt.NDArray[np.float32]


@dataclass(frozen=True, kw_only=True)
class _Measured(ABC):
    """What both results have: how exact they are, and all that their frame or cubemap can do."""

    samples: npt.NDArray[np.int64]
    deviation: Floats
    noise: float
    seconds: float
    complete: bool

    @property
    @abstractmethod
    def _shown(self) -> Any:
        """Give the frame or the cubemap."""

    @property
    def outputs(self) -> Mapping[str, npt.NDArray[Any]]:
        """dict of str to ndarray: the requested outputs, as those of a `Frame` or a `CubeMap`."""
        outputs: Mapping[str, npt.NDArray[Any]] = self._shown.outputs
        return outputs

    def __getattr__(self, name: str) -> Any:
        # The outputs (distance, normal, ...) have the names that they have in a frame and a cubemap.
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._shown, name)

    def __array__(
        self, dtype: np.dtype[Any] | None = None, copy: bool | None = None
    ) -> npt.NDArray[Any]:
        array: npt.NDArray[Any] = self._shown.__array__(dtype, copy)
        return array

    def save(self, path: str | os.PathLike[str], **options: Any) -> None:
        """Write the picture to a file, with the options of `Frame.save` or `CubeMap.save`."""
        self._shown.save(path, **options)

    def _repr_png_(self) -> bytes | None:
        png: bytes | None = self._shown._repr_png_()
        return png


@dataclass(frozen=True)
class TruthFrame(_Measured):
    """A picture by exact rays. It has the arrays of a `Frame`, and says how far they can be trusted.

    Attributes
    ----------
    frame : Frame
        The picture, of format "rgba32f" and linear, with the requested outputs.
    samples : ndarray (H, W) int64
        Paths of each pixel; 0 where the picture was ended before one.
    deviation : ndarray (H, W) float32
        The standard error of each pixel's luminance, in its units. It is an upper estimate, since the samples of a
        pixel are spread evenly. Infinite where there is one sample or none.
    noise : float
        The root mean square of `deviation` over the root mean square of the luminance: 0.01 is 1 %.
    seconds : float
        The wall time of the call.
    complete : bool
        False if a deadline or Ctrl-C ended the picture before its samples, or its target, were reached.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(1, 0, 0))
    >>> picture = cc.truth.render(scene, cc.PerspectiveCamera(), (4, 2), samples=4)
    >>> picture.color.shape, picture.color[0, 0].tolist(), picture.noise, picture.complete
    ((2, 4, 4), [1.0, 0.0, 0.0, 1.0], 0.0, True)
    """

    frame: Frame

    @property
    def _shown(self) -> Frame:
        return self.frame

    @property
    def color(self) -> Floats:
        """ndarray (H, W, 4) float32: linear colour and alpha, row 0 on top."""
        return np.asarray(self.frame.color)

    @property
    def size(self) -> tuple[int, int]:
        """tuple of int: (width, height), pixels."""
        return self.frame.size

    @property
    def encoding(self) -> str:
        """str: what the numbers are, "linear"."""
        return self.frame.encoding


@dataclass(frozen=True)
class TruthCube(_Measured):
    """A cubemap by exact rays. It has the arrays and methods of a `CubeMap`, and says how far they can be trusted.

    Attributes
    ----------
    cube : CubeMap
        The faces, float32 and linear, with the requested outputs.
    samples : ndarray (6, N, N) int64
        Paths of each texel.
    deviation, noise, seconds, complete
        As those of a `TruthFrame`; `deviation` is (6, N, N).

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(0, 0, 1))
    >>> found = cc.truth.capture(scene, (0, 0, 0), 4, samples=1, outputs=("distance",))
    >>> found.faces.shape, found.sample((0, 1, 0)).tolist(), float(found.distance[0, 0, 0])
    ((6, 4, 4, 4), [0.0, 0.0, 1.0, 1.0], inf)
    """

    cube: CubeMap

    @property
    def _shown(self) -> CubeMap:
        return self.cube

    @property
    def faces(self) -> Floats:
        """ndarray (6, N, N, 4) float32: linear colour and alpha, in the layout of `CubeMap.faces`."""
        return np.asarray(self.cube.faces)

    @property
    def size(self) -> int:
        """int: texels along an edge."""
        return self.cube.size


def frame_of(color: Floats, outputs: dict[str, npt.NDArray[Any]]) -> Frame:
    """Make a `Frame` of arrays (H, W, ...), by the way on which pickles make one."""
    height, width = color.shape[:2]
    state = (width, height, color, outputs, "rgba32f", "linear", False)
    frame: Frame = _core._restore_frame((2, state))
    return frame


def cube_of(faces: Floats, outputs: dict[str, npt.NDArray[Any]]) -> CubeMap:
    """Make a `CubeMap` with outputs of arrays (6, N, N, ...), by the way on which pickles make one."""
    cube = _core.CubeMap.__new__(_core.CubeMap)
    cube.__setstate__((2, (faces, False, outputs, "linear")))
    return cube
