"""scripts/torch_cpu.py: a library whose requirements are missing can be loaded after `complete`."""

import ctypes
import subprocess
import sys
from pathlib import Path

import pytest

from tests.helpers import load_script

pytestmark = pytest.mark.build

#: Two libraries of NVIDIA's kind: one whose names have a version, one whose names have none.
VERSIONED = (
    "const char *cudartName(void) { return 0; } int cudaGetDeviceCount(int *n) { return 0; }"
)
PLAIN = "int ncclSum(int a) { return 0; }"
USER = """
const char *cudartName(void); int cudaGetDeviceCount(int *); int ncclSum(int);
void *kept[] = {(void *)cudartName, (void *)ncclSum};  /* addresses are wanted when it is loaded */
int plus_one(int x) { return x + 1; }
const char *name(void) { return cudartName(); }
int sum(void) { return ncclSum(1) != 0; }
int devices(void) { int n = 7; return 1000 * cudaGetDeviceCount(&n) + n; }
"""


def compiled(path, source, *options):
    subprocess.run(
        ["cc", "-shared", "-fPIC", "-x", "c", "-", "-x", "none", f"-Wl,-soname,{path.name}",
         "-o", str(path), *map(str, options)],
        input=source, text=True, check=True,
    )  # fmt: skip


def tried(path: Path) -> list[str]:
    """What a new process finds out that loads the library."""
    program = f"""
import ctypes
user = ctypes.CDLL({str(path)!r})
user.name.restype = ctypes.c_char_p
print(user.plus_one(1), user.name().decode(), user.sum(), user.devices(), sep="|")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    return done.stdout.strip().split("|") if done.returncode == 0 else [done.stderr]


def test_what_is_missing_is_there_afterwards(tmp_path):
    versions = tmp_path / "versions"
    versions.write_text("CUDA_13 { global: *; };")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    versioned, plain = elsewhere / "libcudart.so.13", elsewhere / "libnccl.so.2"
    compiled(versioned, VERSIONED, f"-Wl,--version-script={versions}")
    compiled(plain, PLAIN)
    folder = tmp_path / "lib"
    folder.mkdir()
    user = folder / "libuser.so"
    compiled(user, USER, "-Wl,-rpath,$ORIGIN", versioned, plain)
    versioned.unlink()
    plain.unlink()
    (message,) = tried(user)
    assert "cannot open shared object file" in message
    load_script("torch_cpu").complete(folder)
    assert {path.name for path in folder.iterdir()} == {user.name, versioned.name, plain.name}
    count, name, failed, devices = tried(user)
    assert (count, failed) == ("2", "1")
    assert "without CUDA" in name
    assert devices == "100000"  # cudaErrorNoDevice, and no device
    assert ctypes.CDLL(str(folder / plain.name))


def test_nothing_is_added_where_nothing_is_missing(tmp_path):
    compiled(tmp_path / "libalone.so", "int one(void) { return 1; }")
    load_script("torch_cpu").complete(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["libalone.so"]
