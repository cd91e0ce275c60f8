"""Compares two scenes object by object: `assert_scenes_equal`. Ids may differ, sharing may not.

The walk follows the properties that pickles hold, so that a property of a new class is compared without a line here.
Two objects correspond if they stand in the same place; each object corresponds to one other everywhere.
"""

import enum
from collections.abc import Mapping

import numpy as np

import cubecam as cc
from cubecam.io.gltf.extras.classes import PLANS, material_names, materials, state_of

#: glTF counts v from the top of a picture, which costs the last bits of small numbers.
UVS = 2.0**-24
#: Numbers of arrays are float32; those of nodes, lights and cameras are written with all digits.
FLOAT32 = 2.0**-23

#: What a node has besides its place.
NODE = (
    "name", "mesh", "material", "own_material", "environment", "visible", "in_captures", "render_order", "cast_shadow",
    "receive_shadow", "label", "skin", "weights", "variants", "parent",
)  # fmt: skip
SCENE = (
    "environment", "background", "environment_intensity", "environment_rotation", "variants", "variant", "lights",
    "cameras", "animations",
)  # fmt: skip
MESH = (
    "positions",
    "indices",
    "normals",
    "colors",
    "tangents",
    "joints",
    "joint_weights",
    "morph_targets",
)
OTHERS = {
    "Skin": ("joints", "inverse_bind_matrices", "skeleton"),
    "Animation": ("name", "channels", "duration"),
    "AnimationChannel": ("node", "path", "times", "values", "interpolation"),
}


def assert_scenes_equal(got, want):
    """Raise AssertionError that names the first property in which two scenes differ."""
    Walk().scene(got, want, "scene")


class Walk:
    def __init__(self):
        self.pairs = {}
        self.partners = {}
        self.kept = []  # so that no id is used twice

    def scene(self, got, want, where):
        if self.known(got, want, where):
            return
        assert len(got.nodes) == len(want.nodes), f"{where}.nodes: {got.nodes} for {want.nodes}"
        for index, (a, b) in enumerate(zip(got.nodes, want.nodes, strict=True)):
            self.known(a, b, f"{where}.nodes[{index}]")
        for index, (a, b) in enumerate(zip(got.nodes, want.nodes, strict=True)):
            self.node(a, b, f"{where}.nodes[{index}]")
        self.properties(got, want, SCENE, where)

    def known(self, got, want, where):
        """Pair two objects; say whether they were paired before."""
        if id(want) in self.pairs or id(got) in self.partners:
            assert self.pairs.get(id(want)) == id(got), f"{where}: another object is shared"
            return True
        self.pairs[id(want)], self.partners[id(got)] = id(got), id(want)
        self.kept += [got, want]
        return False

    def node(self, got, want, where):
        self.close(got.matrix, want.matrix, FLOAT32, f"{where}.matrix")
        self.close(got.world_matrix, want.world_matrix, 1e-6, f"{where}.world_matrix")
        self.properties(got, want, NODE, where)

    def mesh(self, got, want, where):
        self.properties(got, want, MESH, where)
        for name in ("uvs", "uvs1"):
            a, b = getattr(got, name), getattr(want, name)
            assert (a is None) == (b is None), f"{where}.{name}: {a} for {b}"
            if a is not None:
                error = np.abs(np.float64(a) - b) / np.maximum(1, np.abs(b))
                assert error.max() <= UVS, f"{where}.{name}: {error.max()} off"
        smooth = [m.__reduce__()[1][2]["normals"] is None for m in (got, want)]
        assert smooth[0] == smooth[1], f"{where}: smooth normals {smooth}"

    def properties(self, got, want, names, where):
        for name in names:
            if hasattr(want, name):
                self.value(getattr(got, name), getattr(want, name), f"{where}.{name}")

    def value(self, got, want, where):
        if isinstance(want, np.ndarray):
            self.close(np.asarray(got), want, FLOAT32, where)
            assert got.dtype == want.dtype, f"{where}: {got.dtype} for {want.dtype}"
        elif isinstance(want, float):
            self.close(np.float64(got), np.float64(want), FLOAT32, where)
        elif want is None or isinstance(want, (str, bool, int, enum.Enum)):
            assert type(got) is type(want), f"{where}: {got!r} for {want!r}"
            assert got == want, f"{where}: {got!r} for {want!r}"
        elif isinstance(want, tuple | list):
            assert len(got) == len(want), f"{where}: {got} for {want}"
            for index, (a, b) in enumerate(zip(got, want, strict=True)):
                self.value(a, b, f"{where}[{index}]")
        elif isinstance(want, Mapping):
            assert sorted(got) == sorted(want), f"{where}: {sorted(got)} for {sorted(want)}"
            for key in want:
                self.value(got[key], want[key], f"{where}[{key!r}]")
        else:
            self.thing(got, want, where)

    def thing(self, got, want, where):
        assert type(got) is type(want), f"{where}: {type(got).__name__} for {type(want).__name__}"
        kind = type(want).__name__
        if isinstance(want, cc.Scene):
            self.scene(got, want, where)
        elif isinstance(want, (cc.Texture, cc.Blend, cc.Stencil, cc.Shadow)):
            # Equal ones are interchangeable, and properties make a new one at each look.
            self.properties(got, want, PLANS[kind].names, where)
        elif isinstance(want, (cc.Image, cc.MorphTarget)):
            # These never change, so that equal ones are interchangeable, too.
            self.properties(got, want, PLANS[kind].names, where)
        elif self.known(got, want, where):
            return
        elif isinstance(want, cc.Mesh):
            self.mesh(got, want, where)
        elif isinstance(want, cc.CubeMap):
            for a, b, part in zip(state_of(got), state_of(want), range(9), strict=False):
                self.value(a, b, f"{where}[{part}]")
            assert len(state_of(got)) == len(state_of(want)), f"{where}: levels"
        elif kind in materials():
            names = material_names(type(want))  # type: ignore[arg-type]
            self.properties(got, want, (*names, "name"), where)
        elif kind in OTHERS:
            self.properties(got, want, OTHERS[kind], where)
        elif type(want) is cc.Camera:
            self.value(got.view, want.view, f"{where}.view")
            self.value(got.projection(), want.projection(), f"{where}.projection")
        else:
            self.properties(got, want, PLANS[kind].names, where)

    @staticmethod
    def close(got, want, tolerance, where):
        """Compare numbers, with a tolerance relative to each number, or to 1 for the smaller ones."""
        assert np.shape(got) == np.shape(want), f"{where}: {np.shape(got)} for {np.shape(want)}"
        got, want = np.asarray(got, np.float64), np.asarray(want, np.float64)
        with np.errstate(invalid="ignore"):
            error = np.abs(got - want) / np.maximum(1, np.abs(want))
        error = np.where((got == want) | (np.isnan(got) & np.isnan(want)), 0, error)
        assert (error <= tolerance).all(), f"{where}: {got} for {want}"
