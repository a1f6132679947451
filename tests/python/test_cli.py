"""The command line: grammar, exit codes, figures, and files that are whole or absent."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time

import measure
import pfgeom
import pytest
import shapes
from pfgeom import tables

TORUS = shapes.torus(32, 16)


@pytest.fixture
def torus_file(tmp_path):
    path = tmp_path / "torus.obj"
    pfgeom.write_mesh(path, TORUS)
    return path


@pytest.fixture
def torus_pfg(tmp_path, torus_model):
    path = tmp_path / "torus.pfg"
    torus_model.save(path)
    return path


def figures(done) -> dict:
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1
    return json.loads(done.stdout)


# --- what it does ----------------------------------------------------------------------------------------------


def test_there_and_back(command_line, torus_file, tmp_path):
    made = figures(command_line("compress", torus_file, "a.pfg", "--tolerance", "1e-2", "--json"))
    assert made["file_bytes"] == (tmp_path / "a.pfg").stat().st_size
    assert made["ratio"] == pytest.approx(made["raw_bytes"] / made["file_bytes"])
    assert made["triangles"] == len(TORUS[1])
    assert 0 < made["bound_mesh"] <= made["tolerance"]
    assert made["seconds"] > 0

    back = figures(command_line("decompress", "a.pfg", "a.ply", "--json"))
    mesh = pfgeom.read_mesh(tmp_path / "a.ply")
    assert back["triangles"] == len(mesh.faces) == made["mesh_triangles"]
    assert measure.two_sided(TORUS, mesh)[0] <= made["bound_mesh"] * (1 + 1e-6)  # PLY may be float32

    found = figures(command_line("compare", torus_file, "a.ply", "--json", "--samples", 20_000))
    assert {"max", "rms", "mean", "p99", "diagonal", "normal_deg_mean"} <= found.keys()
    assert found["max"] <= made["bound_mesh"] * (1 + 1e-6)
    assert found["diagonal"] == pytest.approx(measure.diagonal(TORUS[0]), rel=1e-6)
    assert figures(command_line("compare", torus_file, "a.pfg", "--json"))["max"] <= made["bound_mesh"] * (1 + 1e-6)

    info = figures(command_line("info", "a.pfg", "--json"))
    assert info["functions"] == made["functions"]
    assert info["bytes"] == made["file_bytes"]


def test_tables(command_line, torus_file):
    made = command_line("compress", torus_file, "a.pfg", "--tolerance", "2e-2", "--threads", 1)
    assert (made.returncode, made.stderr) == (0, "")
    labels = [line.split("  ")[0] for line in made.stdout.splitlines()]
    assert labels[0] == "triangles"
    assert {"raw bytes", "functions", "file bytes", "ratio", "max", "rms", "seconds"} <= set(labels)
    for arguments in (("decompress", "a.pfg", "a.off"), ("info", "a.pfg"), ("compare", torus_file, "a.off")):
        done = command_line(*arguments)
        assert (done.returncode, done.stderr) == (0, "")
        assert len(done.stdout.splitlines()) >= 5


def test_compare_draws_depth_buffers(command_line, torus_file, torus_pfg):
    arguments = ("compare", torus_file, torus_pfg, "--samples", 1000, "--no-bound", "--depth-buffers", 96)
    found = figures(command_line(*arguments, "--json"))
    assert found["surfaces"] == ["mesh", "default mesh"]
    assert found["depth_buffers"]["side"] == 96
    assert len(found["depth_buffers"]["views"]) == 14
    assert found["depth_buffers"]["total"]["both"] > 14 * 1000
    done = command_line(*arguments, "--tolerance", "1e-2")
    assert (done.returncode, done.stderr) == (0, "")
    rows = {line.split("  ")[0]: line for line in done.stdout.splitlines()}
    assert "default mesh" in rows["B"] and "default mesh" not in rows["A"]
    assert f"{found['depth_buffers']['total']['mean']:.4e}" in rows["depth mean"]
    assert f"{3e-2 * found['diagonal']:.4e}" in rows["differing"]


def test_info_lists_the_quadrics_of_set_trees(sphere_model):
    info = {"input": "sphere.pfg", **sphere_model.info()}
    for families in ({"plane": 2, "sphere": 1}, {"plane": 3}):
        info["objects"].append({"kind": "tree", "instances": 1, "families": families})
    rows = {label: (figure, remark) for label, figure, remark in tables.info(info)}
    assert rows["quadrics"] == ("6", "plane: 5, sphere: 1")


def test_info_lists_the_kinds_of_functions(sphere_model):
    info = {"input": "sphere.pfg", **sphere_model.info()}
    plane = {"kind": "plane", "surface": True, "perturbations": 0}
    info["function_list"] += [plane, plane, plane | {"surface": False}, plane | {"kind": "sphere", "perturbations": 7}]
    rows = {label: (figure, remark) for label, figure, remark in tables.info(info)}
    assert rows["kinds"] == ("4", "plane: 2, sphere: 1, sphere with perturbations: 1")
    assert rows["no surface"] == ("1", "plane: 1")


def test_info_says_what_is_proved_of_the_functions(command_line, tmp_path, gear_model, soup_model):
    gear_model.save(tmp_path / "gear.pfg")
    info = figures(command_line("info", "gear.pfg", "--json"))
    assert info["bound_functions"] == gear_model.bound_functions
    assert info["functions_certified"] is True
    row = next(line for line in command_line("info", "gear.pfg").stdout.splitlines() if "max of functions" in line)
    assert f"{gear_model.bound_functions:.4e}" in row
    assert "certified" in row
    soup_model.save(tmp_path / "soup.pfg")
    assert "max of functions" not in command_line("info", "soup.pfg").stdout


def test_quiet(command_line, torus_pfg):
    done = command_line("decompress", torus_pfg, "a.stl", "--quiet")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.parametrize("suffix", ["ply", "obj", "stl", "off", "OFF"])
def test_formats(command_line, torus_pfg, tmp_path, suffix):
    assert command_line("decompress", torus_pfg, f"a.{suffix}", "--resolution", 16).returncode == 0
    assert len(pfgeom.read_mesh(tmp_path / f"a.{suffix}").faces) > 100


def test_options_reach_the_library(command_line, torus_file, torus_pfg):
    rms = figures(command_line("compress", torus_file, "a.pfg", "--metric", "rms", "--tolerance", "1e-2", "--json"))
    assert rms["metric"] == "rms"
    pfgeom.write_mesh(torus_file.with_name("gear.obj"), shapes.gear())
    efforts = [
        figures(command_line("compress", "gear.obj", "g.pfg", "--tolerance", "1e-2", "--effort", e, "--json"))
        for e in ("fast", "best")
    ]
    assert efforts[0]["file_bytes"] > efforts[1]["file_bytes"]
    assert all(made["functions_certified"] for made in efforts)
    length = figures(command_line("compress", torus_file, "b.pfg", "--absolute", "--tolerance", "0.04", "--json"))
    assert length["tolerance"] == pytest.approx(0.04, rel=0.02)
    counts = [
        figures(command_line("decompress", torus_pfg, "a.ply", *option, "--json"))["triangles"]
        for option in (("--tolerance", "2e-2"), ("--tolerance", "1e-3"), ("--tolerance", "1e-3", "--absolute"))
    ]
    assert counts[0] < counts[1] < counts[2]


def test_console_script_is_the_module(command_line):
    assert command_line("--version").stdout.split() == ["pfgeom", pfgeom.__version__]


# --- what it refuses -------------------------------------------------------------------------------------------

WRONG_USAGE = [
    (),
    ("squeeze", "a.obj", "a.pfg"),
    ("compress", "a.obj"),
    ("compress", "a.obj", "b.obj"),
    ("compress", "a.obj", "a.pfg", "--tolerance", "0"),
    ("compress", "a.obj", "a.pfg", "--tolerance", "nan"),
    ("compress", "a.obj", "a.pfg", "--tolerance", "small"),
    ("compress", "a.obj", "a.pfg", "--metric", "mean"),
    ("compress", "a.obj", "a.pfg", "--effort", "heroic"),
    ("compress", "a.obj", "a.pfg", "--threads", "-1"),
    ("decompress", "a.pfg", "a.xyz"),
    ("decompress", "a.pfg", "a.ply", "--tolerance", "1e-3", "--resolution", "64"),
    ("decompress", "a.pfg", "a.ply", "--resolution", "0"),
    ("compare", "a.ply"),
    ("compare", "a.ply", "b.ply", "--samples", "0"),
    ("compare", "a.ply", "b.ply", "--depth-buffers", "0"),
    ("info", "a.pfg", "--quick"),
]


@pytest.mark.parametrize("arguments", WRONG_USAGE, ids=" ".join)
def test_wrong_usage(command_line, tmp_path, arguments):
    done = command_line(*arguments)
    assert done.returncode == 2
    assert done.stderr.startswith("usage: pfgeom")
    assert os.listdir(tmp_path) == []


FAILURES = {
    "absent input": (("compress", "absent.obj", "a.pfg"), "absent.obj"),
    "unknown extension": (("compress", "cube.xyz", "a.pfg"), ".obj"),
    "folder as input": (("compress", "folder.ply", "a.pfg"), "folder.ply"),
    "damaged mesh": (("compress", "bad.obj", "a.pfg"), "line"),
    "mesh without faces": (("compress", "points.obj", "a.pfg"), "face"),
    "folder as output": (("compress", "torus.obj", "folder.pfg"), "folder.pfg"),
    "absent folder": (("compress", "torus.obj", "absent/a.pfg"), "absent"),
    "not a pfg": (("info", "torus.obj"), "torus.obj"),
    "cut pfg": (("decompress", "cut.pfg", "a.ply"), "cut.pfg"),
    "absent pfg": (("decompress", "absent.pfg", "a.ply"), "absent.pfg"),
    "resolution out of range": (("decompress", "torus.pfg", "a.ply", "--resolution", "5000"), "resolution"),
    "absent mesh to compare": (("compare", "torus.obj", "absent.ply"), "absent.ply"),
}


@pytest.mark.parametrize(("arguments", "words"), FAILURES.values(), ids=FAILURES)
def test_failures_are_one_sentence(command_line, tmp_path, torus_file, torus_pfg, arguments, words):
    for folder in ("folder.pfg", "folder.ply"):
        (tmp_path / folder).mkdir()
    (tmp_path / "cube.xyz").write_text("0 0 0\n")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
    (tmp_path / "points.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    (tmp_path / "cut.pfg").write_bytes(torus_pfg.read_bytes()[:-3])
    before = sorted(os.listdir(tmp_path))
    done = command_line(*arguments)
    assert done.returncode == 1
    assert done.stdout == ""
    assert done.stderr.startswith("pfgeom: error: ")
    assert done.stderr.count("\n") == 1
    assert words in done.stderr
    assert sorted(os.listdir(tmp_path)) == before


def test_full_disk_leaves_nothing(command_line, torus_pfg):
    """A file size limit stands for the full disk."""
    resource = pytest.importorskip("resource")

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

    folder = torus_pfg.parent
    done = command_line("decompress", torus_pfg, "a.obj", preexec_fn=limit)
    assert done.returncode == 1
    assert done.stderr.startswith("pfgeom: error: ")
    assert os.listdir(folder) == [torus_pfg.name]


def test_closed_pipe_is_no_traceback(torus_pfg):
    """As in `pfgeom info a.pfg | true`."""
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "pfgeom", "info", str(torus_pfg)]
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, timeout=60)
    os.close(writer)
    assert done.returncode == 1
    assert done.stderr == ""


# --- interrupted -----------------------------------------------------------------------------------------------


@pytest.fixture
def long_file(tmp_path, long_mesh):
    path = tmp_path / "long.ply"
    pfgeom.write_mesh(path, long_mesh)
    return path


def start_compress(long_file, target):
    command = [sys.executable, "-m", "pfgeom", "compress", str(long_file), str(target), "--tolerance", "1e-4"]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_interrupt(long_file, tmp_path):
    process = start_compress(long_file, tmp_path / "a.pfg")
    time.sleep(1.5)  # past the imports
    process.send_signal(signal.SIGINT)
    try:
        stdout, stderr = process.communicate(timeout=5)
    finally:
        process.kill()
    assert process.returncode == 130
    assert (stdout, stderr) == ("", "pfgeom: interrupted\n")
    assert os.listdir(tmp_path) == [long_file.name]


@pytest.mark.parametrize("seed", range(3))
def test_killed_at_any_moment(torus_file, torus_pfg, tmp_path, seed):
    """The target is the old file or the new one, never a part."""
    target = tmp_path / "target.pfg"
    target.write_bytes(torus_pfg.read_bytes())
    process = start_compress(torus_file, target)
    time.sleep(random.Random(seed).uniform(0.1, 1.0))
    process.kill()
    process.communicate(timeout=5)
    pfgeom.load(target)
