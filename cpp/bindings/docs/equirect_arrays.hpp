/// Docstrings of bind_equirect_arrays.cpp.
#pragma once

namespace cubecam::bindings::docs {

inline constexpr const char* equirect_to_faces =
    R"doc(Make the faces of cubes from panoramas of one size.

The numbers are those of `CubeMap.from_equirect`. Arrays go in and come out, with any axes in front: a film or a
batch is one call, in which each part of the filter is made once for all pictures, and all cores share the work.

Parameters
----------
images : array_like (..., H, 2H, C)
    uint8 (value/255), float16, float32 or float64, with 1 to 4 channels; not mirrored, row 0 at +Y. NaN raises
    ValueError; inf counts as the largest finite number of its picture, or 65504 if that is more.
size : int, optional
    N, texels along an edge of a face. None: the next power of two from W / pi, which loses no detail.
center : {"-z", "+z", "+x", "-x"}, default "-z"
    The axis at the center column.
sampling : {"centers", "borders"}, default "centers"
    Where the samples of `images` lie; with "borders" (OpenEXR) any shape from (2, 2) is allowed.
dtype : dtype, optional
    "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `out`, or else that of
    `images`.
out : ndarray (..., 6, N, N, C), optional
    Memory for the result, in C order and not that of `images`. None: a new array.

Returns
-------
ndarray (..., 6, N, N, C) in `dtype`
    +X -X +Y -Y +Z -Z in the convention "gl", as `CubeMap.faces`; `out` if that was given. Numbers are filtered in
    float32, then rounded as `CubeMap.to_equirect` rounds.

Raises
------
ValueError
    For pictures that are not twice as wide as high, NaN, a size below 1, an unknown center or sampling, another
    dtype, or an `out` that does not fit; after NaN, the contents of `out` are undefined.
TypeError
    For images of bool, complex, text, or integers other than uint8, and an `out` that is no array.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> film = np.zeros((8, 64, 128, 3), np.uint8)
>>> cc.equirect_to_faces(film, size=32).shape
(8, 6, 32, 32, 3)
)doc";

inline constexpr const char* faces_to_equirect =
    R"doc(Make panoramas from the faces of cubes of one size.

The numbers are those of `CubeMap.to_equirect`; the reverse of `equirect_to_faces`, also for many cubes in one call.

Parameters
----------
faces : array_like (..., 6, N, N, C)
    uint8 (value/255), float16, float32 or float64, with 1 to 4 channels: +X -X +Y -Y +Z -Z in the convention "gl",
    as `CubeMap.faces`. NaN and inf stay where they have a weight.
width : int, optional
    Pixels of a row, an even number. None: 4 * N, which keeps the resolution.
center : {"-z", "+z", "+x", "-x"}, default "-z"
    The axis at the center: "-z" camera forward; "+z" OpenEXR, Mitsuba; "+x" three.js.
sampling : {"centers", "borders"}, default "centers"
    Where samples of the result lie, as in `CubeMap.to_equirect`.
dtype : dtype, optional
    "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `out`, or else that of
    `faces`.
out : ndarray (..., width / 2, width, C), optional
    Memory for the result, in C order and not that of `faces`. None: a new array.

Returns
-------
ndarray (..., width / 2, width, C) in `dtype`
    The panoramas, not mirrored, with row 0 at +Y; `out` if that was given. Numbers are filtered in float32, then
    rounded as `CubeMap.to_equirect` rounds.

Raises
------
ValueError
    For a width that is not even and positive, an unknown center or sampling, another dtype, or an `out` that does
    not fit.
TypeError
    For faces of bool, complex, text, or integers other than uint8, and an `out` that is no array.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> faces = np.ones((5, 6, 16, 16, 2), np.float16)
>>> panoramas = np.empty((5, 32, 64, 2), np.float16)
>>> cc.faces_to_equirect(faces, out=panoramas) is panoramas
True
)doc";

}  // namespace cubecam::bindings::docs
