"""Compile the module for the sanitizers of the compiler, and run the tests with it.

    python scripts/sanitize.py                      both runs, one after the other
    python scripts/sanitize.py address [OPTIONS]    AddressSanitizer and UndefinedBehaviorSanitizer
    python scripts/sanitize.py thread [OPTIONS]     ThreadSanitizer

Options are options of pytest, for example the names of test files. Without options, `address` runs tests/unit and
tests/gl, and `thread` runs the tests that start threads.

The module lies in build/address or build/thread beside a copy of the Python files. Both modules have faults that are
planted (cpp/bindings/planted): a run begins with them and ends there if one of them is not reported. Tests that find
another module than this one do not start.

The interpreter, numpy and Mesa are not compiled for a sanitizer. AddressSanitizer sees all memory that they allocate;
ThreadSanitizer sees their locks and no access to memory, so that only reports with a frame of cubecam count.
"""

from __future__ import annotations

import argparse
import dataclasses
import itertools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import build_version

ROOT = Path(__file__).resolve().parent.parent
#: What stands in the line of a stack that lies in cubecam's module. A line without a function's name is of a library
#: that was unloaded, whose place the module seems to hold.
OWN_FRAME = re.compile(
    r"^ +#\d+ (?!0x[0-9a-f]+ +\().*(?:_core[^/ ]*\.so|/cpp/(?:cubecam|bindings|shader_trial)/)",
    re.MULTILINE,
)


@dataclasses.dataclass(frozen=True)
class Run:
    """One module and what it is for."""

    flags: str
    libraries: tuple[str, ...]  # preloaded, because the interpreter does not contain them
    environment: dict[str, str]
    suppressions: str
    tests: tuple[str, ...]
    planted: dict[str, str]  # a script of Python, and what a report of it must say


RUNS = {
    "address": Run(
        flags="-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer",
        # AddressSanitizer alone would stop at the first exception of C++.
        libraries=("libasan.so", "libubsan.so"),
        environment={
            "PYTHONMALLOC": "malloc",  # the interpreter's own pools would hide what lies past an end
            # A block that is too large is an error of the caller's, as it is without a sanitizer.
            "ASAN_OPTIONS": "allocator_may_return_null=1:strict_string_checks=1",
            "UBSAN_OPTIONS": "print_stacktrace=1",
        },
        # The interpreter never frees all that it holds.
        suppressions="leak:libpython3\nleak:_PyObject\nleak:PyType\n",
        tests=("tests/unit", "tests/gl"),
        planted={
            "from cubecam import _core; _core._planted_overflow()": "heap-buffer-overflow",
            "from cubecam import _core; _core._planted_undefined()": "signed integer overflow",
        },
    ),
    "thread": Run(
        flags="-O1 -g1 -fsanitize=thread -fno-omit-frame-pointer",
        libraries=("libtsan.so",),
        environment={
            "TSAN_OPTIONS": "ignore_noninstrumented_modules=1:report_thread_leaks=0:history_size=7:exitcode=0"
        },
        suppressions="",
        tests=(
            "tests/gl/test_threads.py",
            "tests/gl/test_kept_snapshots.py",
            "tests/gl/test_lifetime.py",
            "tests/gl/test_dynamic_meshes.py",
            "tests/gl/test_render_texture_circles.py",
            "tests/gl/test_result_memory.py",
            "tests/unit/test_render_textures.py",
            "tests/unit/test_prefilter.py",
            "tests/unit/test_cubemap_equirect.py",
            "tests/unit/test_cubemap_resize.py",
        ),
        planted={"from cubecam import _core; _core._planted_race()": "data race"},
    ),
}


def library(name: str) -> str:
    """Return the path at which the compiler finds a library."""
    command = [os.environ.get("CXX", "c++"), f"-print-file-name={name}"]
    path = subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    if not Path(path).is_absolute():  # the compiler repeats a name that it does not find
        raise SystemExit(f"expected the compiler's {name}: install it (Debian: g++ has it)")
    return path


def build(name: str, run: Run) -> Path:
    """Compile the module beside a copy of the Python files. Return the module's path."""
    folder = ROOT / "build" / name
    package = folder / "python" / "cubecam"
    shutil.rmtree(package, ignore_errors=True)
    files = shutil.ignore_patterns("*.so", "__pycache__")
    shutil.copytree(ROOT / "python" / "cubecam", package, ignore=files)
    print(f"[sanitize] compiling for {name}", flush=True)
    # A build type of its own: Release would append -O3 and leave out all assertions.
    options = [
        "-DCMAKE_BUILD_TYPE=Sanitize",
        f"-DCMAKE_C_FLAGS_SANITIZE={run.flags}",
        f"-DCMAKE_CXX_FLAGS_SANITIZE={run.flags} -D_GLIBCXX_ASSERTIONS",
        "-DCUBECAM_PLANTED_FAULTS=ON",
    ]
    return build_version.compile_into(package, ROOT, folder / "objects", *options)


def reports(folder: Path) -> list[str]:
    """Return the sanitizers' reports that the files of a folder hold, those of cubecam alone."""
    found = []
    for path in sorted(folder.glob("report.*")):
        text = path.read_text(encoding="utf-8", errors="replace")
        starts = [
            m.start()
            for m in re.finditer(r"^.*(?:WARNING: Thread|ERROR: |runtime error)", text, re.M)
        ]
        for start, end in itertools.pairwise([*starts, len(text)]):
            if OWN_FRAME.search(text, start, end):
                found.append(text[start:end].rstrip())
    return found


def environment_of(name: str, run: Run, module: Path) -> dict[str, str]:
    """Return the variables of a process that runs with the module; its reports go to files."""
    folder = module.parent.parent.parent
    suppressions = folder / "suppressions.txt"
    suppressions.write_text(run.suppressions)
    made = {**os.environ, **run.environment}
    made["PYTHONPATH"] = str(folder / "python")
    made["LD_PRELOAD"] = " ".join(library(name) for name in run.libraries)
    made["CUBECAM_EXPECT_MODULE"] = str(module)
    for variable in ("ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS"):
        if variable in run.environment:
            made[variable] += f":log_path={folder / 'reports' / 'report'}"
    key = "LSAN_OPTIONS" if name == "address" else "TSAN_OPTIONS"
    made[key] = f"{made.get(key, '')}:suppressions={suppressions}".lstrip(":")
    return made


def sanitize(name: str, arguments: list[str], built: bool = False) -> int:
    """Compile, find the planted faults, run the tests. Return 0 if nothing was found."""
    run = RUNS[name]
    module = build_version.module_of(ROOT / "build" / name) if built else build(name, run)
    if module is None:
        raise SystemExit(f"expected a module in build/{name}: run it once without --built")
    environment = environment_of(name, run, module)
    folder = module.parent.parent.parent / "reports"
    # Some kernels place memory where ThreadSanitizer does not expect it.
    prefix = ["setarch", "-R"] if name == "thread" and shutil.which("setarch") else []
    where = "from cubecam import _core; print(_core.__file__)"
    told = subprocess.run(
        [*prefix, sys.executable, "-c", where], env=environment, capture_output=True, text=True
    )
    if prefix and told.returncode != 0 and "setarch" in told.stderr:  # a container may forbid it
        prefix = []
        told = subprocess.run(
            [sys.executable, "-c", where], env=environment, capture_output=True, text=True
        )
    if told.stdout.strip() != str(module):
        raise SystemExit(f"expected the module {module}, got {told.stdout}{told.stderr}")
    for script, want in run.planted.items():
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        done = subprocess.run(
            [*prefix, sys.executable, "-c", script], env=environment, capture_output=True, text=True
        )
        # UndefinedBehaviorSanitizer writes to stderr, whatever log_path says.
        if not any(want in text and "planted" in text for text in [*reports(folder), done.stderr]):
            raise SystemExit(
                f"expected a report of the planted fault '{want}', got {reports(folder)}\n{done.stderr}"
            )
        print(f"[sanitize] {name}: the planted fault '{want}' is reported", flush=True)
    shutil.rmtree(folder)
    folder.mkdir()
    pytest = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--capture=sys"]
    workers = str(len(os.sched_getaffinity(0)))
    parallel = ["-n", workers, "--dist", "loadfile", "-m", "not slow and not build"]
    chosen = arguments or [*run.tests, *(parallel if name == "address" else [])]
    status = subprocess.run([*prefix, *pytest, *chosen], cwd=ROOT, env=environment).returncode
    found = reports(folder)
    for text in found[:20]:
        print(text, "\n")
    print(f"[sanitize] {name}: pytest ended with {status}, {len(found)} reports", flush=True)
    return status or int(bool(found))


def main() -> int:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", nargs="?", choices=[*RUNS, "all"], default="all")
    parser.add_argument("--built", action="store_true", help="take the module of the last run")
    options, arguments = parser.parse_known_args()
    names = list(RUNS) if options.run == "all" else [options.run]
    return max([sanitize(name, arguments, options.built) for name in names])


if __name__ == "__main__":
    sys.exit(main())
