"""Break the sources, one place at a time, in a copy: the tests must fail each time.

    python tests/mutation.py [--list] [--only NAME ...] [--keep]

Copies the tree, builds the module once, checks that the chosen tests pass, then for each mutation applies it,
rebuilds what it touches and runs the tests named with it. Ends with 1 if a mutation survives, does not build, or
if its old text is no longer to be found exactly once: then tests/mutations.py must be brought up to date.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.mutations import MUTATIONS  # noqa: E402

LEFT_OUT = {
    ".git",
    ".venv",
    "build",
    "dist",
    "out",
    ".ruff_cache",
    ".mypy_cache",
    ".pytest_cache",
    "__pycache__",
}


class Copy:
    """A copy of the tree with a build of its own, which `import cubecam` finds first."""

    def __init__(self, folder):
        self.tree = folder / "tree"
        self.build = folder / "build"
        shutil.copytree(ROOT, self.tree, ignore=lambda _, names: LEFT_OUT & set(names))
        self.environment = {
            **os.environ,
            "PYTHONPATH": str(self.tree / "python"),
            "PYTHONDONTWRITEBYTECODE": "1",
        }

    def configure(self):
        import pybind11

        self.run(
            tool("cmake"), "-S", self.tree, "-B", self.build, "-G", "Ninja",
            f"-DCMAKE_MAKE_PROGRAM={tool('ninja')}", f"-DPython_EXECUTABLE={sys.executable}",
            f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", "-DCUBECAM_BUILD_MODULE=ON",
            # Small units and little optimisation make the next build fast.
            "-DCUBECAM_UNITY=OFF", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1",
        )  # fmt: skip

    def compile(self):
        """Build, and put the module beside its package; return the compiler's error, or None."""
        done = self.run(tool("cmake"), "--build", self.build, "--target", "_core", check=False)
        if done.returncode != 0:
            return (done.stdout + done.stderr)[-2000:]
        (module,) = self.build.rglob("_core.*.so")
        for built in (module, module.parent / "_shader_trial"):
            shutil.copy2(built, self.tree / "python" / "cubecam")
        return None

    def has_module(self):
        """Whether the module that was built in the tree came with it, which is enough for mutations of Python."""
        return any((self.tree / "python" / "cubecam").glob("_core*.so"))

    def check_import(self):
        """Check that the tests import the copy, not an installed package."""
        code = "import cubecam, cubecam._core as c; print(cubecam.__file__); print(c.__file__)"
        done = self.run(sys.executable, "-c", code)
        for line in done.stdout.split():
            if not Path(line).is_relative_to(self.tree):
                raise SystemExit(f"expected the copy in {self.tree} to be imported, got {line}")

    def test(self, names):
        return self.run(
            sys.executable, "-m", "pytest", "-x", "-q", "--no-header", "-p", "no:cacheprovider",
            "-o", "addopts=--import-mode=importlib", *names, check=False, cwd=self.tree, timeout=900,
        )  # fmt: skip

    def run(self, *command, check=True, **options):
        done = subprocess.run(
            [str(part) for part in command],
            env=self.environment,
            capture_output=True,
            text=True,
            check=False,
            **options,
        )
        if check and done.returncode != 0:
            raise SystemExit(
                f"{' '.join(map(str, command))}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
            )
        return done


def tool(name):
    beside = Path(sysconfig.get_path("scripts")) / name
    found = str(beside) if beside.exists() else shutil.which(name)
    if not found:
        raise SystemExit(f"expected {name} in {beside.parent} or on PATH")
    return found


def places(name):
    """The sources that have a name, relative to the tree."""
    return [
        path.relative_to(ROOT)
        for part in ("cpp", "shaders", "python")
        for path in sorted((ROOT / part).rglob(Path(name).name))
        if path.parts[-len(Path(name).parts) :] == Path(name).parts
    ]


def place(mutation):
    """Where a mutation's file lies, relative to the tree."""
    (found,) = places(mutation.file)
    return found


def is_compiled(mutation):
    return place(mutation).parts[0] in ("cpp", "shaders")


def stale(mutations):
    """Mutations whose name fits no source or several, or whose old text is not found exactly once."""
    found = []
    for m in mutations:
        if len(files := places(m.file)) != 1:
            found.append(f"{m.name}: expected one {m.file}, found {[str(file) for file in files]}")
        elif (count := occurrences(ROOT / files[0], m.old)) != 1:
            found.append(f"{m.name}: expected once in {m.file}, found {count} times: {m.old!r}")
    return found


def occurrences(path, text):
    return len(pattern(text).findall(path.read_text()))


def pattern(text):
    """A pattern that finds the text wherever a formatter has broken its lines."""
    return re.compile(r"\s+".join(re.escape(word) for word in text.split()))


def try_mutation(copy, mutation):
    """Return "killed", or a text that says what is wrong."""
    path = copy.tree / place(mutation)
    original = path.read_text()
    compiled = is_compiled(mutation)
    path.write_text(pattern(mutation.old).sub(lambda _: mutation.new, original))
    try:
        if compiled and (complaint := copy.compile()):
            return f"does not build:\n{complaint}"
        done = copy.test(mutation.tests)
    except subprocess.TimeoutExpired:
        return "killed (timeout)"
    finally:
        path.write_text(original)
    if done.returncode == 1:
        broken = [
            word for word in ("ShaderError", "SyntaxError", "ImportError") if word in done.stdout
        ]
        return f"is no program any more: {broken[0]}" if broken else "killed"
    if done.returncode == 0:
        return "SURVIVED"
    return f"pytest ended with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-1000:]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="print the mutations and leave")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="try these only")
    parser.add_argument("--keep", action="store_true", help="keep the copy, and say where it is")
    options = parser.parse_args()
    chosen = [m for m in MUTATIONS if not options.only or m.name in options.only]
    if options.list:
        for m in chosen:
            print(f"{m.name:32} {m.file}: {' '.join(m.old.split())} -> {' '.join(m.new.split())}")
        return 0
    if problems := stale(chosen):
        print(*problems, sep="\n")
        return 1
    folder = Path(tempfile.mkdtemp(prefix="cubecam-mutants-"))
    try:
        return run(Copy(folder), chosen)
    finally:
        if options.keep:
            print(f"kept in {folder}")
        else:
            shutil.rmtree(folder)


def run(copy, chosen):
    begin = time.perf_counter()
    if any(map(is_compiled, chosen)) or not copy.has_module():
        print(f"building a copy in {copy.tree.parent}", flush=True)
        copy.configure()
        if complaint := copy.compile():
            raise SystemExit(f"the sources do not build:\n{complaint}")
    copy.check_import()
    wanted = sorted({name for m in chosen for name in m.tests})
    done = copy.test(wanted)
    if done.returncode != 0:
        raise SystemExit(f"the tests fail without any mutation:\n{done.stdout[-4000:]}")
    print(
        f"built and tested unchanged in {time.perf_counter() - begin:.0f} s; {len(chosen)} mutations",
        flush=True,
    )
    bad = 0
    pending = False  # whether the module holds the last mutation
    for m in chosen:
        if pending and not is_compiled(m):
            copy.compile()
            pending = False
        start = time.perf_counter()
        result = try_mutation(copy, m)
        pending = pending or is_compiled(m)
        bad += not result.startswith("killed")
        print(f"{time.perf_counter() - start:5.0f} s  {m.name:32} {result}", flush=True)
    print(f"{len(chosen) - bad} of {len(chosen)} killed, {time.perf_counter() - begin:.0f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
