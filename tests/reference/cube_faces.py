"""Cube faces from the table of ARB_texture_cube_map (GL 4.6 section 8.13), and the layouts of pictures.

Directions are (..., 3) arrays, r; s and t are in 0..1, t growing downwards in `faces[face, row, column]`.
"""

import numpy as np

FACE_NAMES = ("+x", "-x", "+y", "-y", "+z", "-z")
FACE_IDS = ("pos_x", "neg_x", "pos_y", "neg_y", "pos_z", "neg_z")
CONVENTIONS = ("gl", "inside", "three")
LAYOUTS = ("cross", "vertical_cross", "row", "column")

X, Y, Z = np.eye(3)

# Each row of the table holds the vectors whose dot products with r give sc, tc and ma.
TABLE = (
    (-Z, -Y, X),
    (Z, -Y, -X),
    (X, Z, Y),
    (X, -Z, -Y),
    (X, -Y, Z),
    (-X, -Y, -Z),
)

# The capture cameras of the same section: forward along the axis, up as listed.
FORWARD = np.array([X, -X, Y, -Y, Z, -Z])
UP = np.array([-Y, -Y, Z, -Z, -Y, -Y])


def face_uv_to_direction(face, s, t):
    """The direction through (s, t) of a face, on the cube of half extent 1 (not normalised)."""
    s_axis, t_axis, major_axis = TABLE[face]
    sc = 2 * np.asarray(s, float)[..., None] - 1
    tc = 2 * np.asarray(t, float)[..., None] - 1
    return sc * s_axis + tc * t_axis + major_axis


def direction_to_face_uv(directions):
    """(face, s, t) of directions of any length; of two equal components the axis of lower index is taken."""
    r = np.asarray(directions, float)
    axis = np.argmax(np.abs(r), axis=-1)
    major = np.take_along_axis(r, axis[..., None], axis=-1)[..., 0]
    face = 2 * axis + (major < 0)
    s_axes = np.array([row[0] for row in TABLE])[face]
    t_axes = np.array([row[1] for row in TABLE])[face]
    length = np.abs(major)
    s = ((s_axes * r).sum(-1) / length + 1) / 2
    t = ((t_axes * r).sum(-1) / length + 1) / 2
    return face, s, t


def texel_directions(size):
    """(6, size, size, 3) directions of the texel centres, their component along the face's axis being 1."""
    centers = (np.arange(size) + 0.5) / size
    t, s = np.meshgrid(centers, centers, indexing="ij")
    return np.stack([face_uv_to_direction(face, s, t) for face in range(6)])


def unit_texel_directions(size):
    directions = texel_directions(size)
    return directions / np.linalg.norm(directions, axis=-1, keepdims=True)


def view_rotation(face):
    """A matrix with the rows right, up and back of a face's capture camera, which looks along -Z of its own space."""
    forward, up = FORWARD[face], UP[face]
    right = np.cross(forward, up)
    return np.array([right, up, -forward])


def convert(faces, source, target):
    """Convert faces to another convention. "gl" to "inside" is its own inverse, and so is "gl" to "three"."""
    return _gl_to_or_from(_gl_to_or_from(np.asarray(faces), source), target)


def _gl_to_or_from(faces, convention):
    if convention == "gl":
        return faces.copy()
    if convention == "inside":
        flipped = faces[:, :, ::-1].copy()
        flipped[2:4] = faces[2:4, ::-1]
        return flipped
    if convention == "three":
        return faces[[1, 0, 2, 3, 4, 5]][:, :, ::-1].copy()
    raise ValueError(convention)


def middle_row(convention):
    """The faces in a cross's middle row from left to right; +Y stands above the second face and -Y below it."""
    names = "-x -z +x +z" if convention == "inside" else "-x +z +x -z"
    return [FACE_NAMES.index(name) for name in names.split()]


def to_layout(faces, layout, convention="gl"):
    """Arrange faces held in "gl" as one picture of the layout, in the given convention."""
    cells = convert(faces, "gl", convention)
    n = cells.shape[1]
    if layout == "row":
        return np.concatenate(list(cells), axis=1)
    if layout == "column":
        return np.concatenate(list(cells), axis=0)
    middle = middle_row(convention)
    rows, columns = (3, 4) if layout == "cross" else (4, 3)
    picture = np.zeros((rows * n, columns * n, *cells.shape[3:]), cells.dtype)

    def put(row, column, cell):
        picture[row * n : (row + 1) * n, column * n : (column + 1) * n] = cell

    put(0, 1, cells[2])
    put(2, 1, cells[3])
    for column, face in enumerate(middle[:3]):
        put(1, column, cells[face])
    if layout == "cross":
        put(1, 3, cells[middle[3]])
    else:
        put(3, 1, cells[middle[3]][::-1, ::-1])
    return picture
