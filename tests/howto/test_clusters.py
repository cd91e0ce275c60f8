"""docs/howto/slurm.md, kubernetes.md, million.md: files that a cluster reads, programs, and the arithmetic of a page.

tests/cluster/test_pages.py runs what needs Dask.
"""

import ast
import inspect
import re
import runpy
import subprocess
import sys

import numpy as np
import pytest

import cubecam as cc
from benchmarks import million
from cubecam.cli import app
from tests.documents import ROOT, fenced, rows_below, text_of

new_python = pytest.mark.skipif(sys.version_info < (3, 11), reason="zarr 3 needs Python 3.11")


def named_blocks(page):
    """The blocks of a page whose first line is the name of a file."""
    found = {}
    for language in ("py", "yaml"):
        for code in fenced(page, language):
            name = re.match(r"# (\w+\.\w+)\n", code)
            assert name, code
            found[name[1]] = code
    return found


def options_of(line):
    """The option of a line `#SBATCH --name=value`."""
    found = re.fullmatch(r"#SBATCH --([a-z-]+)(?:=(\S+))?", line)
    assert found, line
    return found.groups()


def the_number(pattern, text):
    """The whole number that a pattern finds once in a text."""
    (found,) = re.findall(pattern, text, re.MULTILINE)
    return int(found)


def check_calls_of_cubecam(code):
    """Names after `cc.` and `cluster.` exist, and calls of capture_to_zarr have no keyword that it lacks."""
    from cubecam import cluster

    known = inspect.signature(cluster.capture_to_zarr).parameters
    modules = {"cc": cc, "cluster": cluster}
    calls = 0
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            module = modules.get(node.value.id)
            assert module is None or hasattr(module, node.attr), node.attr
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "capture_to_zarr":
            calls += 1
            assert {keyword.arg for keyword in node.keywords} - {None} <= set(known)
    return calls


def check_commands(page):
    """Each line of the page that starts with `cubecam` names a command and options that exist."""
    lines = re.findall(r"^cubecam ([\w-]+)(.*)", "\n".join(fenced(page, "sh")), re.MULTILINE)
    for name, rest in lines:
        known = {o for parameter in app.commands[name].params for o in parameter.opts}
        assert set(re.findall(r"(?<=\s)--?[a-z-]+", rest)) <= known
    return len(lines)


def with_fewer_places(code):
    """The program with 12 places in place of 1,000."""
    assert code.count("(1000, 3)") == 1
    return code.replace("(1000, 3)", "(12, 3)").replace('"size": 64', '"size": 16')


@pytest.fixture(scope="module")
def job():
    """The Job of docs/howto/kubernetes.md, as YAML gives it."""
    yaml = pytest.importorskip("yaml")
    return yaml.safe_load(named_blocks(TestKubernetes.NAME)["job.yaml"])


@pytest.fixture(scope="module")
def measured():
    """By scene: milliseconds of drawing and writing, and bytes, raw and stored, by array."""
    found = {
        name: {"draw": float(draw), "write": float(write), "start": start, "size": int(size)}
        for name, size, draw, write, start, _ in rows_below(TestMillion.NAME, "| scene | faces |")
    }
    rows = rows_below(TestMillion.NAME, "| KB of a cubemap")
    for column, name in enumerate(found, 1):
        for row in rows:
            raw, stored = (float(part) * 1000 for part in row[column].split(" / "))
            found[name][row[0]] = raw, stored
    return found


class TestSlurm:
    NAME = "docs/howto/slurm.md"

    def test_the_job_is_one_that_sbatch_reads(self, tmp_path):
        (job,) = (code for code in fenced(self.NAME, "sh") if code.startswith("#!"))
        lines = job.splitlines()
        directives = [line for line in lines if line.startswith("#SBATCH")]
        assert lines[1 : 1 + len(directives)] == directives  # sbatch reads none after a command
        options = dict(map(options_of, directives))
        assert set(options) == {"job-name", "array", "cpus-per-task", "mem", "time", "requeue",
                                "open-mode", "output"}  # fmt: skip
        assert re.fullmatch(r"\d+[KMGT]?", options["mem"])
        assert re.fullmatch(r"(\d+-)?\d\d:\d\d:\d\d", options["time"])
        first, last = map(int, options["array"].split("-"))
        tasks = the_number(r"^TASKS = (\d+)", named_blocks(self.NAME)["part.py"])
        assert (first, last) == (0, tasks - 1)
        assert lines[-1].endswith("python part.py")
        script = tmp_path / "captures.sbatch"
        script.write_text(job)
        subprocess.run(["bash", "-n", script], check=True)

    @new_python
    @pytest.mark.slow
    def test_an_array_job_writes_all_places(self, tmp_path, monkeypatch):
        blocks = named_blocks(self.NAME)
        (tmp_path / "scene.py").write_text(with_fewer_places(blocks["scene.py"]))
        (tmp_path / "part.py").write_text(re.sub(r"TASKS = \d+", "TASKS = 2", blocks["part.py"]))
        (tmp_path / "read.py").write_text(blocks["read.py"])
        monkeypatch.chdir(tmp_path)
        monkeypatch.syspath_prepend(str(tmp_path))
        monkeypatch.setenv("SLURM_CPUS_PER_TASK", "1")
        for task in (1, 0, 1):  # a task that was done does nothing
            monkeypatch.setenv("SLURM_ARRAY_TASK_ID", str(task))
            runpy.run_path("part.py", run_name="__main__")
        sys.modules.pop("scene")
        read = runpy.run_path("read.py")["parts"]
        made = runpy.run_path("scene.py")
        found = np.concatenate([part.positions for part in read])
        np.testing.assert_array_equal(found, made["positions"])
        with cc.Renderer() as renderer:
            want = renderer.capture_many(made["scene"], made["positions"], **made["what"])
        np.testing.assert_array_equal(np.concatenate([part.faces[:] for part in read]), want.faces)
        low, high = made["scene"].bounds
        assert ((low < found) & (found < high)).all()

    def test_programs_name_what_exists(self):
        calls = [check_calls_of_cubecam(code) for code in named_blocks(self.NAME).values()]
        assert sum(calls) == 2
        assert check_commands(self.NAME) == 1

    def test_the_memory_is_that_which_was_measured(self):
        check_memory(self.NAME)


class TestKubernetes:
    NAME = "docs/howto/kubernetes.md"

    def test_the_job_has_what_kubernetes_needs(self, job):
        assert (job["apiVersion"], job["kind"]) == ("batch/v1", "Job")
        assert re.fullmatch(r"[a-z0-9-]+", job["metadata"]["name"])
        spec = job["spec"]
        assert spec["completionMode"] == "Indexed"
        assert spec["parallelism"] <= spec["completions"]
        pod = spec["template"]["spec"]
        assert (
            pod["restartPolicy"] == "Never"
        )  # as podFailurePolicy and backoffLimitPerIndex need it
        for rule in spec["podFailurePolicy"]["rules"]:
            assert rule["action"] in ("Ignore", "FailJob", "FailIndex", "Count")
            assert len(rule.keys() & {"onPodConditions", "onExitCodes"}) == 1
        (container,) = pod["containers"]
        assert {"name", "image", "command"} <= container.keys()
        assert all(isinstance(entry["value"], str) for entry in container["env"])
        volumes = {volume["name"] for volume in pod["volumes"]}
        assert {mount["name"] for mount in container["volumeMounts"]} == volumes
        assert container["resources"]["limits"].keys() == container["resources"]["requests"].keys()

    def test_the_job_and_its_program_agree(self, job):
        code = named_blocks(self.NAME)["part.py"]
        parts = the_number(r"^PARTS = (\d+)", code)
        assert job["spec"]["completions"] == parts
        (container,) = job["spec"]["template"]["spec"]["containers"]
        known = {entry["name"]: entry["value"] for entry in container["env"]}
        read = set(re.findall(r"""environ\[["'](\w+)["']\]""", code))
        assert read == {"STORES", "WORKERS", "JOB_COMPLETION_INDEX"}
        assert read - known.keys() == {"JOB_COMPLETION_INDEX"}
        assert known["WORKERS"] == container["resources"]["limits"]["cpu"]
        mounts = {mount["name"]: mount["mountPath"] for mount in container["volumeMounts"]}
        assert known["STORES"] == mounts["stores"]
        assert container["command"] == ["python", f"{mounts['program']}/part.py"]
        shell = "\n".join(fenced(self.NAME, "sh"))
        assert "create configmap captures --from-file=part.py" in shell
        assert f"job/{job['metadata']['name']}" in shell

    def test_the_image_is_that_of_the_dockerfile(self, job):
        dockerfile = text_of("Dockerfile")
        assert "ARG EXTRAS" in dockerfile
        pod = job["spec"]["template"]["spec"]
        assert f"USER {pod['securityContext']['runAsUser']}" in dockerfile
        assert 'ENTRYPOINT ["cubecam"]' in dockerfile
        (variables,) = set(re.findall(r"NVIDIA_DRIVER_CAPABILITIES=([\w,]+)", text_of(self.NAME)))
        assert f"NVIDIA_DRIVER_CAPABILITIES={variables}" in dockerfile
        shell = "\n".join(fenced(self.NAME, "sh"))
        assert f"--tag {pod['containers'][0]['image']} " in shell
        assert f'image="{pod["containers"][0]["image"]}"' in named_blocks(self.NAME)["with_dask.py"]

    @new_python
    @pytest.mark.slow
    def test_a_pod_writes_its_part(self, tmp_path, monkeypatch):
        code = with_fewer_places(named_blocks(self.NAME)["part.py"])
        (tmp_path / "part.py").write_text(code)
        for name, value in {"STORES": tmp_path, "WORKERS": 1, "JOB_COMPLETION_INDEX": 11}.items():
            monkeypatch.setenv(name, str(value))
        made = runpy.run_path(str(tmp_path / "part.py"), run_name="__main__")
        (place,) = cc.open_batch(tmp_path / "captures-011.zarr").positions
        np.testing.assert_array_equal(place, made["positions"][11])

    def test_programs_name_what_exists(self):
        blocks = named_blocks(self.NAME)
        assert check_calls_of_cubecam(blocks["part.py"]) == 1
        assert check_calls_of_cubecam(blocks["with_dask.py"]) == 1

    def test_the_command_line_says_what_the_table_says(self):
        from click.testing import CliRunner

        said = CliRunner().invoke(app, ["dask-scheduler"])
        (message,) = re.findall(r"`Error: (No such command [^`]+)`", text_of(self.NAME))
        assert message in said.output.replace('"', "'")

    def test_the_memory_is_that_which_was_measured(self):
        check_memory(self.NAME)


def check_memory(page):
    """What a page says of the memory at 64 and 256 pixels is what million.md has measured, rounded up."""
    words = r"(\d+) MiB for a process at faces of 64 pixels, (\d+) MiB at 256"
    ((small, large),) = re.findall(words, text_of(page))
    found = {
        int(size): int(memory)
        for _, size, *_, memory in rows_below("docs/howto/million.md", "| scene | faces |")
    }
    assert found[64] <= int(small) <= 1.25 * found[64]
    assert found[256] <= int(large) <= 1.25 * found[256]


class TestMillion:
    NAME = "docs/howto/million.md"

    def test_the_last_table_follows_from_what_was_measured(self, measured):
        """1e6 * (d + w) ms in hours, on 64 cores in minutes; bytes of half floats and the distance."""
        rows = rows_below(self.NAME, "| a million |")
        assert [row[0] for row in rows] == list(measured)
        for name, hours, minutes, raw, stored, rate in rows:
            of = measured[name]
            one = of["draw"] + of["write"]
            colors, distances = of["rgba16f"], of["distance"]
            bytes_raw, bytes_stored = (colors[k] + distances[k] for k in (0, 1))
            expected = {
                hours: 1e6 * one / 3_600_000,
                minutes: 1e6 * one / 60_000 / 64,
                raw: 1e6 * bytes_raw / 1e9,
                stored: 1e6 * bytes_stored / 1e9,
                rate: 64 * 1000 / one * bytes_stored / 1e6,
            }
            for cell, want in expected.items():
                step = 10.0 ** -len(cell.partition(".")[2])
                assert abs(float(cell) - want) < 0.51 * step + 0.004 * want, (name, cell, want)

    def test_raw_bytes_are_those_of_the_arrays(self, measured):
        each = {"rgba8": 4, "rgba16f": 8, "rgba32f": 16, "distance": 4, "id": 4, "normal": 12}
        for of in measured.values():
            for array, size in each.items():
                assert of[array][0] == pytest.approx(6 * of["size"] ** 2 * size, abs=51)
                assert 0 < of[array][1] < of[array][0]

    def test_what_the_page_says_of_its_numbers(self, measured):
        assert measured["boxes"]["write"] > measured["boxes"]["draw"]
        rates = [int(row[-1]) for row in rows_below(self.NAME, "| a million |")]
        assert f"write up to {max(rates) / 1000:.0f} GB a second" in text_of(self.NAME)
        for of in measured.values():
            assert of["rgba8"][1] < 0.5 * of["rgba16f"][1]
            assert of["id"][1] < 0.05 * of["distance"][1]
            cpu, _ = map(float, of["start"].split(" / "))
            assert cpu * 1000 < 100 * (of["draw"] + of["write"])

    def test_the_script_makes_these_tables(self, measured):
        """From the page's own numbers, all tables of the page but for the last digits of what was rounded."""
        (line,) = re.findall(
            r"^Measured on (\d+) cores of (.+?); (.+); rgba", text_of(self.NAME), re.MULTILINE
        )
        kinds = []
        for (name, of), row in zip(
            measured.items(), rows_below(self.NAME, "| scene | faces |"), strict=True
        ):
            cpu, wall = map(float, of["start"].split(" / "))
            arrays = (*million.FORMATS, *million.OUTPUTS)
            kinds.append(
                million.Kind(
                    name,
                    of["size"],
                    of["draw"],
                    of["write"],
                    cpu,
                    wall,
                    int(row[-1]),
                    *({array: of[array][k] for array in arrays} for k in (0, 1)),
                )
            )
        about = dict(zip(("cores", "cpu", "gl"), line, strict=True))
        made = million.tables(kinds, about, "CPU")
        between = text_of(self.NAME).partition(million.BEGIN)[2].partition(million.END)[0].strip()
        assert made.count("\n") == between.count("\n")
        upper = made[: made.index("| a million")]
        assert between.startswith(upper)
        for line, row in zip(
            made.splitlines()[-3:], rows_below(self.NAME, "| a million |"), strict=True
        ):
            name, *cells = (cell.strip() for cell in line.strip("|").split("|"))
            assert name == row[0]
            np.testing.assert_allclose(
                np.array(cells, float), np.array(row[1:], float), rtol=0.02, atol=0.11
            )

    def test_the_scenes_are_those_of_the_script(self, measured):
        assert {name: of["size"] for name, of in measured.items()} == {
            name: size for name, (size, _) in million.KINDS.items()
        }
        for name in measured:
            assert f"**{name}:**" in text_of(self.NAME)
            scene, (low, high) = million.make_scene(name)
            assert (low < high).all()
            assert len(scene.nodes) > 9

    def test_the_targets_and_options_exist(self):
        text = text_of(self.NAME)
        assert "gpu-check:" in text_of("Makefile")
        parts = set(re.findall(r"--only (\w+)", text))
        assert parts == {"info", "readback", "asynchronous"}
        for part in (*parts, "over_pinned_copy"):
            assert part in text_of("docs/gpu.md")
        assert (ROOT / "benchmarks/million.py").exists()

    @new_python
    @pytest.mark.slow
    def test_a_scene_of_ones_own(self, capsys, pages):
        _, scope = pages(self.NAME)
        assert scope["hours"] > 0
        assert 0 < scope["seconds"].min() < 1
        assert scope["batch"].distance.min() > 0.05


def test_a_page_gets_tables_between_its_marks(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(f"above\n{million.BEGIN}\n\nold\n\n{million.END}\nbelow\n")
    for _ in range(2):
        million.write_page(page, "new")
        assert page.read_text() == f"above\n{million.BEGIN}\n\nnew\n\n{million.END}\nbelow\n"
    page.write_text("nothing")
    with pytest.raises(SystemExit, match="expected the lines"):
        million.write_page(page, "new")
