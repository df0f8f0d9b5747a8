"""Prints what a checker adds to a tick of a simulation, for a circuit printed as Verilog."""

import subprocess
import sys
from pathlib import Path

from cocotb_tools.runner import get_runner
from run import find_verilator


def main(circuit, sim="icarus", ticks="20000"):
    directory = Path(f"build/cocotb/{circuit}_{sim}").resolve()
    words = [sys.executable, "-m", "motion_rtl", "verilog", circuit, "--out", str(directory)]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
    if sim == "verilator":
        find_verilator()
    runner = get_runner(sim)
    runner.build(
        sources=sorted(directory.glob("*.v")),
        hdl_toplevel=circuit,
        build_dir=directory / "sim",
        timescale=("1ns", "1ps"),
    )
    runner.test(
        test_module="speed_bench",
        hdl_toplevel=circuit,
        build_dir=directory / "sim",
        test_dir=directory / "sim",
        extra_env={"CIRCUIT": circuit, "TICKS": ticks},
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
