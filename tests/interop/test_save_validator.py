"""Khronos' validator finds no error in any file that Scene.save writes."""

import warnings
from pathlib import Path

import pytest

import cubecam as cc
from tests.saved_scenes import KINDS, scene_of, scenes

pytestmark = pytest.mark.interop

CODE = """
import validator from "gltf-validator";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
const found = {};
for (const path of process.argv.slice(2)) {
    const externalResourceFunction = (uri) =>
        Promise.resolve(new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri)))));
    const options = { uri: path, maxIssues: 100, externalResourceFunction };
    const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), options);
    found[path] = report.issues.messages.filter((message) => message.severity < 2);
}
console.log(JSON.stringify(found));
"""
#: Warnings that say nothing against a file: tangents are made by cubecam and by other programs in the same way, and a
#: skinned mesh may be wherever the scene has it. A material with a volume may be double-sided if a user says so.
FINE = {
    "KHR_MATERIALS_VOLUME_DOUBLE_SIDED",
    "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE",
    "NODE_SKINNED_MESH_NON_ROOT",
}


def issues(node, paths):
    found = node(CODE, *paths)
    assert sorted(found) == sorted(map(str, paths))
    return [
        (Path(path).name, message["code"], message.get("pointer"), message["message"])
        for path, messages in found.items()
        for message in messages
        if message["severity"] == 0 or message["code"] not in FINE
    ]


def test_the_validator_finds_errors(node, tmp_path):
    path = tmp_path / "x.gltf"
    path.write_text('{"asset": {"version": "2.0"}, "scene": 3, "nodes": [{"mesh": 1}]}')
    assert len(issues(node, [path])) >= 2


def test_scenes_of_every_kind(node, tmp_path):
    paths = []
    for kind in KINDS:
        for ending in ("glb", "gltf"):
            paths.append(tmp_path / f"{kind} ä.{ending}")
            scene_of(kind).save(paths[-1])
    assert issues(node, paths) == []


def test_scenes_of_hypothesis(node, tmp_path):
    paths = []
    for number in range(60):
        paths.append(tmp_path / f"{number}.glb")
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore"
            )  # hypothesis has no other way to give many examples at once
            scenes().example().save(paths[-1])
    assert issues(node, paths) == []


@pytest.mark.parametrize("name", ["suzanne.glb", "bunny.obj"])
def test_files_of_others_after_loading(name, node, tmp_path):
    path = tmp_path / "x.glb"
    cc.load_scene(cc.sample_data(name)).save(path)
    assert issues(node, [path]) == []


def test_primitives(node, tmp_path):
    scene = cc.Scene()
    for shape in (
        cc.Mesh.plane(), cc.Mesh.box(), cc.Mesh.sphere(), cc.Mesh.icosphere(), cc.Mesh.cylinder(),
        cc.Mesh.cone(), cc.Mesh.torus(), cc.Mesh.arrow(),
        cc.Mesh([[0, 0, 0]] * 3, [[0, 1, 2]]),  # without area: a normal of any direction
    ):  # fmt: skip
        scene.add(shape)
        scene.add(shape.with_tangents() if shape.uvs is not None else shape)
    scene.save(tmp_path / "x.glb")
    assert issues(node, [tmp_path / "x.glb"]) == []
