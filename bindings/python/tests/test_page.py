"""The page of the notes: its commands and its code."""

import re
import subprocess
import sys
from pathlib import Path

import motion_rtl as mr

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "rtl_notes/bindings/python.md").read_text()
EXAMPLE = Path(__file__).parents[1] / "examples" / "counter.py"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)


def test_the_code_of_the_page_runs(tmp_path):
    blocks = BLOCK.findall(PAGE)
    assert len(blocks) > 5
    (tmp_path / "waves").symlink_to(ROOT / "waves")
    words = [sys.executable, "-c", "\n".join(blocks)]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def example(*arguments):
    words = [sys.executable, EXAMPLE, *arguments]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def test_the_example_passes():
    done = example()
    assert done.returncode == 0
    assert re.fullmatch(r"PASS: 100000 ticks compared, enable moved [1-9]\d+ times\n", done.stdout)


def test_the_example_finds_its_fault():
    done = example("--fault")
    assert done.returncode == 1
    assert re.match(
        r"FAIL: tick \d+: enable: design (True|False), model (True|False); ", done.stderr
    )


def test_the_page_begins_with_five_commands():
    block = re.search(r"```sh\n(.*?)```", PAGE, re.S)
    commands = block[1].splitlines()
    assert len(commands) == 5
    assert str(EXAMPLE.relative_to(ROOT)) in commands[-1]
    assert len(PAGE.splitlines()) <= 150


def test_the_version_is_that_of_the_crate():
    cargo = (ROOT / "Cargo.toml").read_text()
    assert re.search(r'^version = "(.*)"', cargo, re.M)[1] == mr.__version__
