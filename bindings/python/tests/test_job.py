"""Jobs, on a program that is built beside the package."""

import os
import shutil
import stat
from pathlib import Path

import numpy as np
import pytest

import motion_rtl as mr

WAVES = Path(__file__).parents[3] / "waves"
HAS_PROGRAM = shutil.which(os.environ.get("MOTION_RTL", "motion-rtl")) is not None
needs_program = pytest.mark.skipif(not HAS_PROGRAM, reason="needs the program motion-rtl")


@needs_program
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


@needs_program
def test_a_wrong_setting_is_refused():
    with pytest.raises(ValueError, match="feed_mm_per_min"):
        mr.Job(WAVES / "weld.toml", feed_mm_per_mn=300).run()
    with pytest.raises(ValueError, match="feed_mm_per_min"):
        mr.Job(WAVES / "weld.toml", feed_mm_per_min=-1).run()


@needs_program
def test_a_wrong_file_is_refused(tmp_path):
    path = tmp_path / "job.toml"
    path.write_text('circuit = "machin"\n')
    with pytest.raises(ValueError, match="job.toml"):
        mr.Job(path).run()


def test_missing_files_are_told(tmp_path):
    with pytest.raises(FileNotFoundError, match="nothing.toml"):
        mr.Job(tmp_path / "nothing.toml").run()
    with pytest.raises(FileNotFoundError, match="no such program"):
        mr.Job(WAVES / "weld.toml", program=tmp_path / "motion-rtl").run()


def script(path, text):
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


def test_a_program_of_another_version_is_refused(tmp_path):
    program = script(tmp_path / "motion-rtl", "echo motion-rtl 99.0.0")
    with pytest.raises(mr.JobError, match="is motion-rtl 99.0.0; allowed: motion-rtl"):
        mr.Job(WAVES / "weld.toml", program=program).run()


def test_a_program_that_fails_is_told(tmp_path):
    text = f'if [ "$1" = -V ]; then echo motion-rtl {mr.__version__}; else echo broken >&2; exit 3; fi'
    program = script(tmp_path / "motion-rtl", text)
    with pytest.raises(mr.JobError, match="broken"):
        mr.Job(WAVES / "weld.toml", program=program).run()


def test_a_job_is_shown():
    job = mr.Job("a.toml", {"program.g54_mm": [1, 2, 0.5]}, circuit="machine")
    assert repr(job) == "<Job a.toml program.g54_mm=[1, 2, 0.5] circuit=machine>"
