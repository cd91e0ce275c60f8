"""Draw many pictures with this version and with an older one, and compare their bytes.

    python scripts/compare_versions.py                          the older one is built from git
    python scripts/compare_versions.py --before DIR             it lies, compiled, in DIR (see build_version.py)
    python scripts/compare_versions.py --only P14 --only world3 --save-differences out
    python scripts/compare_versions.py --keep DIR               the older version's pictures are kept in DIR and
                                                                not drawn again by the next comparison

The pictures are the first, middle and last frame of the programs P1 to P17, those of tests/images, and random
worlds (random_worlds.py). Each version draws in a process of its own and uses the examples and reference pictures
of its own tree; this version is the `cubecam` that Python finds. The exit code is 1 if any picture differs.
Pictures that show a sample photograph differ from those of versions whose photographs are others.

With --allow-ties a pixel may differ where both versions see different nodes at exactly the same distance.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib
import inspect
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
BEFORE = "f890032"  # the last commit before the renderer was opened up
WORLDS = 30
FRAME_SIZE = 256  # height of the programs' pictures, pixels


# Drawing, in a process of its own


class Recorder:
    """A renderer that remembers its last call of `render`, to draw the same with outputs."""

    def __init__(self, renderer: Any) -> None:
        self.renderer = renderer
        self.last: tuple[Any, ...] = ()

    def __getattr__(self, name: str) -> Any:
        return getattr(self.renderer, name)

    def render(self, scene: Any, camera: Any, size: Any, **options: Any) -> Any:
        self.last = (scene, camera, size, options)
        return self.renderer.render(scene, camera, size, **options)

    def surfaces(self) -> dict[str, Any]:
        """The distance and id of what the last call drew, or nothing where its pictures have no such outputs."""
        scene, camera, size, options = self.last
        options = {**options, "outputs": ("distance", "id"), "effects": (), "samples": 1}
        try:
            frame = self.renderer.render(scene, camera, size, **options)
        except ValueError:  # there is no depth buffer, or the picture is an anaglyph
            return {}
        return {"distance": frame.distance, "id": frame.id}


def program_pictures(name: str, renderer: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    from cubecam import examples

    module: Any = examples.load(name)
    width, height = module.SIZE
    size = (FRAME_SIZE * width // height, FRAME_SIZE)
    # Older versions have one scene for each program: that of its document.
    known = inspect.signature(module.build).parameters
    program = module.build(document=True) if "document" in known else module.build()
    for frame in sorted({0, module.FRAMES // 2, module.FRAMES - 1}):
        recorder = Recorder(renderer)
        color = np.asarray(module.draw(program, recorder, frame, size=size))
        arrays = {"color": color}
        if recorder.last and color.shape[:2] == tuple(recorder.last[2])[::-1]:
            arrays.update(recorder.surfaces())
        yield f"{module.PROGRAM}.{frame}", arrays


def reference_pictures(renderer: Any, wanted: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    for module in ("tests.images.pictures", "tests.images.test_images"):
        try:
            pictures = importlib.import_module(module).PICTURES
            break
        except ModuleNotFoundError as error:
            if error.name != module:
                raise
    for name, draw in pictures.items():
        if wanted(f"image.{name}"):
            yield f"image.{name}", {"color": np.asarray(draw(renderer))}


def is_wanted(name: str, only: list[str]) -> bool:
    return not only or any(f"{name}.".startswith(f"{known}.") for known in only)


def all_pictures(only: list[str], renderer: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every picture whose name begins with one of `only`; all if there are none."""
    import random_worlds

    def wanted(name: str) -> bool:
        return is_wanted(name, only)

    def part(name: str) -> bool:
        return wanted(name) or any(known.startswith(f"{name}.") for known in only)

    for number in range(1, 18):
        if part(f"P{number}"):
            for name, arrays in program_pictures(f"P{number}", renderer):
                if wanted(name):
                    yield name, arrays
    if part("image"):
        yield from reference_pictures(renderer, wanted)
    for number in range(WORLDS):
        if part(f"world{number}"):
            for name, arrays in random_worlds.pictures(number, renderer):
                if wanted(f"world{number}.{name}"):
                    yield f"world{number}.{name}", arrays


def draw(folder: Path, only: list[str]) -> None:
    """Draw everything with the imported cubecam, and write one file for each picture."""
    import cubecam as cc

    print(f"cubecam at {Path(cc.__file__).parent}", flush=True)
    with cc.Renderer(device=os.environ.get("CUBECAM_TEST_DEVICE", "software")) as renderer:
        for number, (name, arrays) in enumerate(all_pictures(only, renderer)):
            np.savez(folder / f"{number:05} {name}.npz", **arrays)


def start(tree: Path, path: str | None, folder: Path, only: list[str]) -> subprocess.Popen[str]:
    """Start drawing with a tree's version; `path`: where its cubecam lies, None for the installed one."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = [part for part in (path, str(tree), os.environ.get("PYTHONPATH")) if part]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(paths),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, __file__, f"--draw={folder}", *(f"--only={name}" for name in only)]
    return subprocess.Popen(
        command,
        cwd=tree,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


# Comparing


def same_bytes(a: Any, b: Any) -> bool:
    return bool(a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes())


def differing_pixels(a: Any, b: Any) -> Any:
    """True for each pixel in which two arrays differ; the result has no channels."""
    bits = [np.ascontiguousarray(x).view(f"u{x.dtype.itemsize}") for x in (a, b)]
    differ = bits[0] != bits[1]
    return differ.any(axis=-1) if differ.ndim > 2 and differ.shape[-1] <= 4 else differ


def ties(before: Any, after: Any) -> Any:
    """True where both versions see different nodes at exactly the same distance; None if that is not known."""
    if "distance" not in before or "id" not in before:
        return None
    return (before["distance"] == after["distance"]) & (before["id"] != after["id"])


def compare(before: Any, after: Any, allow_ties: bool) -> tuple[str, bool]:
    """A text about a picture's difference, and whether this difference is allowed."""
    if sorted(before) != sorted(after):
        return f"DIFFERS: {sorted(before)} before, {sorted(after)} after", False
    if "error" in before:
        fine = str(before["error"]) == str(after["error"])
        told = f"{before['error']} before, {after['error']} after"
        return (f"refused by both ({before['error']})" if fine else f"DIFFERS: {told}"), fine
    said, fine = [], True
    for name in before:
        a, b = before[name], after[name]
        if same_bytes(a, b):
            continue
        if a.dtype != b.dtype or a.shape != b.shape:
            said.append(f"{name} is {a.dtype} {a.shape} before, {b.dtype} {b.shape} after")
            fine = False
            continue
        differ = differing_pixels(a, b)
        tied = ties(before, after)
        known = tied is not None and tied.shape == differ.shape
        excused = int((differ & tied).sum()) if known else 0
        count = int(differ.sum())
        with np.errstate(invalid="ignore"):  # infinity minus infinity is NaN
            gap = np.abs(a.astype(np.float64) - b.astype(np.float64))
        most = np.nanmax(gap[np.isfinite(gap)], initial=0)
        said.append(
            f"{name}: {count} of {differ.size} pixels, by up to {most:.3g}, {excused} of them ties of depth"
        )
        fine = fine and allow_ties and excused == count
    if not said:
        return "equal", True
    return ("ties only: " if fine else "DIFFERS: ") + "; ".join(said), fine


def save_difference(folder: Path, name: str, before: Any, after: Any) -> None:
    """Write PNG files: the picture by each version, and the places where the two differ."""
    from PIL import Image

    folder.mkdir(parents=True, exist_ok=True)
    for key in before:
        if key not in after or before[key].shape != after[key].shape or before[key].ndim < 2:
            continue
        if same_bytes(before[key], after[key]):
            continue
        differ = differing_pixels(before[key], after[key])
        shown = {"before": before[key], "after": after[key], "difference": differ * np.uint8(255)}
        for word, array in shown.items():
            Image.fromarray(flat(array)).save(folder / f"{name}.{key}.{word}.png")


def flat(array: Any) -> Any:
    """An array as an 8-bit picture: layers under each other, other numbers scaled to 0..255."""
    pixels = np.asarray(array)
    if pixels.dtype != np.uint8:
        numbers = np.where(np.isfinite(pixels), pixels, 0).astype(np.float64)
        low, high = (
            (0.0, 1.0) if pixels.shape[-1] == 4 else (numbers.min(), max(numbers.max(), 1e-9))
        )
        pixels = (np.clip((numbers - low) / (high - low or 1), 0, 1) * 255).astype(np.uint8)
    channels = pixels.shape[-1] if pixels.ndim > 2 and pixels.shape[-1] <= 4 else 0
    shape = (-1, pixels.shape[-2], channels) if channels else (-1, pixels.shape[-1])
    if channels:
        return pixels.reshape(shape)[..., :3]
    return pixels.reshape(shape)


def report(before: Path, after: Path, arguments: argparse.Namespace) -> int:
    """Compare two folders of pictures; print a line for each picture, then a summary. Return the exit code."""
    names = [
        {path.name[6:-4]: path for path in sorted(folder.glob("*.npz"))}
        for folder in (before, after)
    ]
    names = [{k: v for k, v in known.items() if is_wanted(k, arguments.only)} for known in names]
    counts = {"equal": 0, "refused": 0, "ties": 0, "differ": 0}
    for name, path in names[0].items():
        if name not in names[1]:
            counts["differ"] += 1
            print(f"{name}: DIFFERS: only before")
            continue
        a, b = dict(np.load(path)), dict(np.load(names[1][name]))
        told, fine = compare(a, b, arguments.allow_ties)
        print(f"{name}: {told}")
        first = told.split()[0].strip(":").lower()
        counts[first if fine else "differ"] += 1
        if not fine and arguments.save_differences:
            save_difference(arguments.save_differences, name, a, b)
    for name in names[1].keys() - names[0].keys():
        print(f"{name}: DIFFERS: only after")
        counts["differ"] += 1
    print(
        f"{sum(counts.values())} pictures: {counts['equal']} equal, {counts['ties']} with ties only, "
        f"{counts['refused']} refused by both, {counts['differ']} differ"
    )
    return 1 if counts["differ"] or not names[0] else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument(
        "--before", type=Path, help="a tree of the older version with its module built"
    )
    parser.add_argument("--revision", default=BEFORE, help="what to build without --before")
    parser.add_argument("--only", action="append", default=[], metavar="NAME")
    parser.add_argument("--keep", type=Path, metavar="DIR")
    parser.add_argument("--save-differences", type=Path, metavar="DIR")
    parser.add_argument("--allow-ties", action="store_true")
    parser.add_argument("--draw", type=Path, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.draw:
        draw(arguments.draw, arguments.only)
        return 0
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch)
        before = (arguments.keep or place / "before").resolve()
        stamp = before / "complete"
        want = stamp_of(arguments)
        runs = {"after": start(ROOT, None, place / "after", arguments.only)}
        if not stamp.exists() or stamp.read_text() != want:
            tree = arguments.before or built(arguments.revision, place / "version")
            for old in (stamp, *before.glob("*.npz")):
                old.unlink(missing_ok=True)
            only = [] if arguments.keep else arguments.only
            runs["before"] = start(tree.resolve(), str(tree.resolve() / "python"), before, only)
        for name, process in runs.items():
            output, _ = process.communicate()
            print(f"{name}: {output.strip()}", flush=True)
            if process.returncode != 0:
                print(f"drawing with the version {name} failed")
                return 2
        stamp.write_text(want)
        return report(before, place / "after", arguments)


def stamp_of(arguments: argparse.Namespace) -> str:
    """What kept pictures depend on: the version and the scripts that drew them."""
    version = str(arguments.before.resolve()) if arguments.before else arguments.revision
    scripts = [ROOT / "scripts" / name for name in ("compare_versions.py", "random_worlds.py")]
    return hashlib.sha256(
        b"".join([version.encode(), *(x.read_bytes() for x in scripts)])
    ).hexdigest()


def built(revision: str, folder: Path) -> Path:
    import build_version

    print(f"building {revision}", flush=True)
    build_version.build(revision, folder)
    return folder


if __name__ == "__main__":
    sys.exit(main())
