"""Jobs, and the program that runs them."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import motion_rtl as mr

WAVES = Path(__file__).parents[3] / "waves"


def test_a_job_gives_summary_and_series():
    result = mr.Job(WAVES / "weld.toml", feed_mm_per_min=300).run()
    assert result.exact
    assert result.summary["settings"]["feed_mm_per_min"] == 300
    assert result.series["tick"].dtype == np.uint64
    lengths = {len(column) for column in result.series.values()}
    assert len(lengths) == 1 and lengths != {0}
    commanded = next(name for name in result.series if "_commanded_" in name)
    assert np.ptp(result.series[commanded]) > 0
    assert "rows" in repr(result)


def test_a_wrong_setting_is_refused():
    with pytest.raises(ValueError, match="feed_mm_per_min"):
        mr.Job(WAVES / "weld.toml", feed_mm_per_mn=300).run()
    with pytest.raises(ValueError, match="feed_mm_per_min"):
        mr.Job(WAVES / "weld.toml", feed_mm_per_min=-1).run()


def test_a_wrong_file_is_refused(tmp_path):
    path = tmp_path / "job.toml"
    path.write_text('circuit = "machin"\n')
    with pytest.raises(ValueError, match="job.toml"):
        mr.Job(path).run()


def test_scenarios_of_the_package_need_no_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = mr.Job("waves/weld.toml", feed_mm_per_min=300).run()
    assert result.exact and result.summary["settings"]["feed_mm_per_min"] == 300
    with pytest.raises(ValueError, match="feed_mm_per_mn: unknown key"):
        mr.Job("waves/weld.toml", feed_mm_per_mn=300).run()
    assert list(tmp_path.iterdir()) == []


def test_a_missing_file_is_told(tmp_path):
    with pytest.raises(FileNotFoundError, match="nothing.toml"):
        mr.Job(tmp_path / "nothing.toml").run()


def test_a_program_that_fails_is_told(monkeypatch):
    monkeypatch.setattr(sys, "executable", "/bin/false")
    with pytest.raises(mr.JobError, match="motion-rtl ended with code 1"):
        mr.Job(WAVES / "weld.toml").run()
    monkeypatch.setattr(sys, "executable", "")
    with pytest.raises(mr.JobError, match="sys.executable is empty"):
        mr.Job(WAVES / "weld.toml").run()


def test_files_of_the_working_directory_are_not_imported(tmp_path, monkeypatch):
    (tmp_path / "motion_rtl.py").write_text("raise SystemExit(7)")
    monkeypatch.chdir(tmp_path)
    assert mr.Job(WAVES / "weld.toml").run(series=False).exact


def program(*words):
    words = [sys.executable, "-m", "motion_rtl", *words]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def test_the_package_has_the_program(tmp_path):
    done = program("-V")
    first = done.stdout.splitlines()[0]
    assert (first, done.returncode) == (f"motion-rtl {mr.__version__}", 0)
    assert "features: cli, jit\n" in program("--version").stdout
    assert "Usage: motion-rtl " in program("--help").stdout
    done = program("lst")
    assert done.returncode == 2 and "did you mean list" in done.stderr
    done = program("list", "--json")
    circuits = json.loads(done.stdout)["circuits"]
    assert "machine" in {circuit["name"] for circuit in circuits}
    done = program("verilog", "enable_counter", "--out", str(tmp_path))
    assert done.returncode == 0 and (tmp_path / "enable_counter.v").exists()


def test_the_command_is_installed():
    command = Path(sys.executable).with_name("motion-rtl")
    done = subprocess.run([command, "-V"], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[0] == f"motion-rtl {mr.__version__}"


def test_a_job_is_shown():
    job = mr.Job("a.toml", {"program.g54_mm": [1, 2, 0.5]}, circuit="machine")
    assert repr(job) == "<Job a.toml program.g54_mm=[1, 2, 0.5] circuit=machine>"
