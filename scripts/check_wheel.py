"""Check the contents of wheels: python scripts/check_wheel.py [--tag manylinux_2_28] WHEEL...

- The extension links the C and C++ run times and nothing else, and the wheel brings no libraries:
  libGL, libEGL and libX11 are opened at run time, so that it installs on a machine without them.
- The extension and the helper program have what compilers and linkers do against the abuse of
  mistakes (`cmake/compile_options.cmake`).
- The licences and the list (software bill of materials) of what is compiled in are there.
- The symbols that it needs exist: those of Python in the Python that it is for, those of the C and
  C++ run times in the oldest that its tag, or --tag, promises.

`make wheel` calls this, and so does cibuildwheel in its image: only the standard library and
readelf are needed. Where jsonschema and CycloneDX's schema are installed, the list is checked by it.
"""

from __future__ import annotations

import argparse
import ctypes
import json
import re
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

LINKED = re.compile(r"lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+)\.so(\.\d+)?|ld-linux.*")
#: Bytes. Samples take 2.2 million, and the extension 2 to 2.4 million, by compiler and interpreter; debug information
#: would add ten times as much.
LARGEST = 5_500_000
HELPER = "cubecam/_shader_trial"  # the program that tries users' GLSL
EXPECTED = (
    "cubecam/_core.pyi",
    "cubecam/conventions.md",
    "cubecam/data/CREDITS.md",
    "cubecam/py.typed",
    HELPER,
)
LICENCES = ("LICENSE", "licenses/{}.txt", "python/cubecam/data/CREDITS.md")
COMPONENTS = ("glad", "glm", "pybind11")  # compiled into the extension
#: The newest symbols that an image of each tag has (PEP 600; auditwheel's manylinux-policy.json).
NEWEST = {
    "manylinux_2_28": {
        "GLIBC": (2, 28),
        "GLIBCXX": (3, 4, 24),
        "CXXABI": (1, 3, 11),
        "GCC": (7, 0, 0),
    }
}


class WheelError(Exception):
    """What is wrong with a wheel."""


def readelf(binary: Path, *options: str) -> str:
    command = ["readelf", "--wide", *options, str(binary)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def check_libraries(name: str, binary: Path) -> None:
    needed = re.findall(r"\(NEEDED\).*\[(.+)\]", readelf(binary, "--dynamic"))
    print(f"  {name} links {', '.join(needed)}")
    foreign = [library for library in needed if not LINKED.fullmatch(library)]
    if foreign:
        raise WheelError(f"{name}: expected only C and C++ run times, got {', '.join(foreign)}")


def missing_hardening(binary: Path) -> list[str]:
    """Name what a shared object or program lacks of the options of cmake/compile_options.cmake."""
    shown = readelf(binary, "--dynamic", "--program-headers", "--dyn-syms")
    stack = re.search(r"GNU_STACK\s.*", shown)
    wanted = {
        "BIND_NOW": re.search(r"\(FLAGS\).*BIND_NOW|\(BIND_NOW\)|\(FLAGS_1\).*NOW", shown),
        "RELRO": "GNU_RELRO" in shown,
        "a stack that is not executable": stack is not None and "E" not in stack[0][20:],
        "guards on the stack": "__stack_chk_fail" in shown,
        "checked copies": re.search(r"__\w+_chk\b(?<!stack_chk)", shown),
    }
    return [name for name, found in wanted.items() if not found]


def symbols(binary: Path) -> tuple[set[str], set[str]]:
    """The dynamic symbols that a binary takes from others, and those that it defines for others.

    Weak ones are left out: tables of types of the C++ library, which every C++ library has.
    """
    needed: set[str] = set()
    defined: set[str] = set()
    for line in readelf(binary, "--dyn-syms").splitlines():
        fields = line.split()
        if len(fields) >= 8 and fields[4] == "GLOBAL":
            (needed if fields[6] == "UND" else defined).add(fields[7].partition("@")[0])
    return needed, defined


def missing_in_python(names: Iterable[str]) -> list[str]:
    """The names of CPython's C interface that the Python which runs this lacks."""
    ours = [name for name in names if re.match(r"_?Py[A-Z_]", name)]
    return sorted(name for name in ours if not hasattr(ctypes.pythonapi, name))


def python_of(wheel: Path) -> tuple[int, ...]:
    found = re.search(r"-cp(\d)(\d+)-cp\d+-", wheel.name)
    if not found:
        raise WheelError(f"{wheel.name}: expected a tag such as cp312-cp312, got none")
    return int(found[1]), int(found[2])


def check_name(wheel: Path, name: str) -> None:
    """Check that the Python of the wheel's tag looks for the extension under its name.

    A build for another processor may give it the name of the machine that built it.
    """
    version = "".join(map(str, python_of(wheel)))
    # Platforms are parted by dots and begin with the system, as in manylinux_2_28_aarch64.
    machine = re.sub(r".*(linux(_\d+_\d+)?|linux20\d\d)_", "", wheel.stem.rpartition("-")[2])
    expected = f"_core.cpython-{version}-{machine}-linux-gnu.so"
    if Path(name).name != expected:
        raise WheelError(f"{wheel.name}: expected {expected} in it, got {name}")


def check_symbols(wheel: Path, name: str, binary: Path) -> None:
    needed, defined = symbols(binary)
    if Path(name).name.startswith("_core"):
        if defined != {"PyInit__core"}:
            raise WheelError(f"{name}: expected PyInit__core alone, got {', '.join(defined)}")
        if python_of(wheel) == sys.version_info[:2] and (missing := missing_in_python(needed)):
            raise WheelError(f"{name}: Python {sys.version} has no {', '.join(missing)}")


def newest_symbols(binary: Path) -> dict[str, tuple[int, ...]]:
    """The newest version that a binary needs of GLIBC, GLIBCXX, CXXABI and GCC."""
    newest: dict[str, tuple[int, ...]] = {}
    _, _, needs = readelf(binary, "--version-info").partition("Version needs section")
    for family, version in re.findall(r"Name: ([A-Z]+)_([\d.]+)", needs):
        numbers = tuple(int(number) for number in version.split("."))
        newest[family] = max(numbers, newest.get(family, ()))
    return newest


def too_new(found: dict[str, tuple[int, ...]], tag: str) -> list[str]:
    """The families of symbols that are newer than an image of the tag has."""
    limits = NEWEST[tag]
    return [
        f"{family} {'.'.join(map(str, version))}"
        for family, version in found.items()
        if version > limits.get(family, ())
    ]


def check_versions(wheel: Path, name: str, binary: Path, tag: str | None) -> None:
    found = newest_symbols(binary)
    shown = ", ".join(f"{family} {'.'.join(map(str, found[family]))}" for family in sorted(found))
    print(f"  {name} needs {shown}")
    promised = [known for known in NEWEST if known == tag or known in wheel.name]
    if tag and tag not in NEWEST:
        raise WheelError(f"--tag: expected one of {', '.join(NEWEST)}, got {tag}")
    if tag and tag not in wheel.name:
        raise WheelError(f"expected a wheel for {tag}, got {wheel.name}")
    for known in promised:
        if new := too_new(found, known):
            raise WheelError(f"{name}: expected what {known} has, got {', '.join(new)}")


def validate(sbom: dict[str, Any]) -> bool:
    """Check a bill of materials by CycloneDX's schema, where that is installed. Says whether it is."""
    try:
        from cyclonedx.schema import SchemaVersion
        from cyclonedx.validation.json import JsonStrictValidator
    except ImportError:
        return False
    version = SchemaVersion.from_version(sbom["specVersion"])
    error = JsonStrictValidator(version).validate_str(json.dumps(sbom))
    if error:
        raise WheelError(f"the bill of materials is not CycloneDX {sbom['specVersion']}: {error}")
    return True


def check_notices(archive: zipfile.ZipFile) -> None:
    """Check that the wheel names what is compiled into it, with versions and licences."""
    names = archive.namelist()
    for licence in (path.format(part) for path in LICENCES for part in COMPONENTS):
        if not any(name.endswith(f".dist-info/licenses/{licence}") for name in names):
            raise WheelError(f"expected {licence} among the licences in the wheel, got none")
    # auditwheel lists folders, too.
    sboms = [name for name in names if ".dist-info/sboms/" in name and not name.endswith("/")]
    if len(sboms) != 1 or not sboms[0].endswith("/cubecam.cdx.json"):
        # auditwheel writes another one about the libraries that it puts into a wheel.
        raise WheelError(f"expected one bill of materials, cubecam.cdx.json, got {sboms}")
    sbom = json.loads(archive.read(sboms[0]))
    listed = {part["name"].rstrip("2"): part["version"] for part in sbom["components"]}
    checked = "by CycloneDX's schema, " if validate(sbom) else ""
    print(f"  compiled in ({checked}{len(listed)} parts):",
          ", ".join(f"{name} {version}" for name, version in listed.items()))  # fmt: skip
    wrong = [name for name in COMPONENTS if not re.match(r"\d+\.\d+", listed.get(name, ""))]
    if wrong or sbom["bomFormat"] != "CycloneDX":
        raise WheelError(f"{sboms[0]}: expected versions of {', '.join(COMPONENTS)}, got {listed}")


def check(wheel: Path, tag: str | None = None) -> None:
    """Raise WheelError for the first thing that is wrong with a wheel."""
    size = wheel.stat().st_size
    print(f"{wheel.name}: {size:,} bytes")
    if size >= LARGEST:
        raise WheelError(f"{wheel.name}: expected less than {LARGEST:,} bytes, got {size:,}")
    with zipfile.ZipFile(wheel) as archive, tempfile.TemporaryDirectory() as folder:
        names = archive.namelist()
        missing = [name for name in EXPECTED if name not in names]
        if missing:
            raise WheelError(f"{wheel.name}: expected {', '.join(missing)} in it, got none")
        libraries = [name for name in names if re.search(r"\.so(\.\d+)*$", name)]
        if len(libraries) != 1:
            raise WheelError(f"{wheel.name}: expected one extension module, got {libraries}")
        check_name(wheel, libraries[0])
        check_notices(archive)
        if (archive.getinfo(HELPER).external_attr >> 16) & 0o111 == 0:
            raise WheelError(f"{wheel.name}: expected {HELPER} to be executable")
        for name in (libraries[0], HELPER):
            binary = Path(archive.extract(name, folder))
            check_libraries(name, binary)
            if lacking := missing_hardening(binary):
                raise WheelError(f"{name}: expected {', '.join(lacking)}")
            check_symbols(wheel, name, binary)
            check_versions(wheel, name, binary, tag)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition(":")[0])
    parser.add_argument("wheels", nargs="+", type=Path, metavar="WHEEL")
    parser.add_argument("--tag", help=f"the wheels are for {' or '.join(NEWEST)}")
    arguments = parser.parse_args()
    try:
        for wheel in arguments.wheels:
            check(wheel, arguments.tag)
    except WheelError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
