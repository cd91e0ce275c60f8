"""docs/howto/slurm.md and kubernetes.md: their programs of Dask, with a cluster of this machine in place of the pages'.

What dask-jobqueue and dask-kubernetes make of the pages' arguments is compared where they are installed.
"""

import importlib
import os
import re
import runpy
import subprocess
import sys

import numpy as np
import pytest

import cubecam as cc
from tests.documents import fenced, text_of

distributed = pytest.importorskip("distributed")

pytestmark = [
    pytest.mark.cluster,
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),  # of distributed
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
]

SLURM, KUBERNETES = "docs/howto/slurm.md", "docs/howto/kubernetes.md"


def written(page, folder):
    """Write the programs of a page, with fewer places, and its /stores in the folder."""
    for code in fenced(page, "py"):
        (name,) = re.findall(r"\A# (\w+\.py)\n", code)
        code = code.replace("(1000, 3)", "(40, 3)").replace('"size": 64', '"size": 16')
        (folder / name).write_text(code.replace("/stores/", f"{folder}/"), encoding="utf-8")


#: In place of the classes that ask a scheduler of jobs or pods for workers.
LOCAL = """
import distributed


class LocalCluster(distributed.LocalCluster):
    def __init__(self, **asked):
        super().__init__(n_workers=2, threads_per_worker=1, dashboard_address=":0")

    def adapt(self, **limits):
        pass
"""
JOBQUEUE = LOCAL + "\n\nSLURMCluster = LocalCluster\n"
OPERATOR = (
    LOCAL
    + """

KubeCluster = LocalCluster


def make_cluster_spec(name, image, n_workers, resources, env):
    def pod(command):
        return {"spec": {"containers": [{"image": image, "args": [command]}]}}

    return {"spec": {"scheduler": pod("dask-scheduler"), "worker": pod("dask-worker")}}
"""
)


def run(folder):
    """Run with_dask.py, which finds the folder's modules before others of the same name."""
    done = subprocess.run(
        [sys.executable, "with_dask.py"],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), *filter(None, sys.path)])},
        capture_output=True,
        text=True,
        timeout=180,
    )
    assert done.returncode == 0, done.stderr
    assert "CubeMapBatch(40, size=16" in done.stdout


def check_store(store, made):
    batch = cc.open_batch(store)
    with cc.Renderer() as renderer:
        want = renderer.capture_many(made["scene"], made["positions"], **made["what"])
    np.testing.assert_array_equal(batch.faces[:], want.faces)
    np.testing.assert_array_equal(batch.distance[:], want.distance)


def test_the_program_of_slurm_writes_all_places(tmp_path):
    written(SLURM, tmp_path)
    (tmp_path / "dask_jobqueue.py").write_text(JOBQUEUE)
    run(tmp_path)
    check_store(tmp_path / "captures.zarr", runpy.run_path(str(tmp_path / "scene.py")))


def test_jobqueue_submits_what_the_page_says():
    pytest.importorskip("dask_jobqueue")
    from dask_jobqueue import SLURMCluster

    (code,) = (code for code in fenced(SLURM, "py") if "SLURMCluster(" in code)
    (call,) = re.findall(r"SLURMCluster\((.*?)\n    \)", code, re.DOTALL)
    asked = eval(f"dict({call})")
    jobs = SLURMCluster(**asked, scheduler_options={"dashboard_address": ":0"})
    try:
        script = jobs.job_script()
    finally:
        jobs.close()
    for line in ("#SBATCH --cpus-per-task=8", "#SBATCH --mem=12G", "#SBATCH -t 02:00:00",
                 "#SBATCH --requeue", "export LP_NUM_THREADS=0"):  # fmt: skip
        assert line in script
    for words in ("--nworkers 8", "--nthreads 1", "--lifetime 110m", "--local-directory /tmp"):
        assert words in script
    (limit,) = re.findall(r"--memory-limit ([\d.]+)GiB", script)
    assert 0.8 * 1024 * float(limit) > 750  # MiB at faces of 256 pixels; a worker pauses at 80 %


def test_the_program_of_kubernetes_writes_all_places(tmp_path):
    written(KUBERNETES, tmp_path)
    package = tmp_path / "dask_kubernetes"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "operator.py").write_text(OPERATOR)
    run(tmp_path)
    check_store(tmp_path / "captures.zarr", runpy.run_path(str(tmp_path / "part.py")))


def test_the_operator_gets_pods_with_command_volume_and_thread(tmp_path, monkeypatch):
    pytest.importorskip("dask_kubernetes")
    yaml = pytest.importorskip("yaml")
    written(KUBERNETES, tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    spec = runpy.run_path(str(tmp_path / "with_dask.py"))["specification"](16)
    sys.modules.pop("part")
    (code,) = fenced(KUBERNETES, "yaml")
    job = yaml.safe_load(code)
    image = job["spec"]["template"]["spec"]["containers"][0]["image"]
    assert spec["metadata"]["name"] == "captures"
    assert spec["spec"]["worker"]["replicas"] == 16
    for part, program in (("scheduler", "dask-scheduler"), ("worker", "dask-worker")):
        pod = spec["spec"][part]["spec"]
        (container,) = pod["containers"]
        assert container["command"] == ["env"]
        assert container["args"][0] == program
        assert container["image"] == image
        assert {mount["name"] for mount in container["volumeMounts"]} == {
            volume["name"] for volume in pod["volumes"]
        }
    args = spec["spec"]["worker"]["spec"]["containers"][0]["args"]
    assert args[-2:] == ["--nthreads", "1"]


def test_kubernetes_knows_each_field_of_the_job():
    """The classes of the client for Python are made from Kubernetes' own description."""
    client = pytest.importorskip("kubernetes").client
    yaml = pytest.importorskip("yaml")
    (code,) = fenced(KUBERNETES, "yaml")
    job = yaml.safe_load(code)
    check_fields(client, "V1Job", job)
    assert text_of(KUBERNETES).count("apiVersion:") == 1


def check_fields(client, kind, value):
    """Raise AssertionError for a field that a kind does not have, and for a required one that is missing."""
    if kind.startswith("list["):
        for entry in value:
            check_fields(client, kind[5:-1], entry)
        return
    if kind.startswith("dict(") or not hasattr(client, kind):
        return
    types_of = getattr(client, kind)
    names = {field: attribute for attribute, field in types_of.attribute_map.items()}
    assert set(value) <= set(names), f"{kind}: {set(value) - set(names)}"
    made = {names[field]: given for field, given in value.items()}
    types_of(**made)  # which refuses what is missing
    for attribute, given in made.items():
        check_fields(client, types_of.openapi_types[attribute], given)


def test_the_command_that_makes_workers_exists():
    text = text_of(SLURM)
    assert "dask scheduler --scheduler-file scheduler.json" in text
    names = {p.name for p in importlib.import_module("distributed.cli.dask_worker").main.params}
    assert {"scheduler_file", "nthreads", "lifetime", "resources", "n_workers"} <= names
