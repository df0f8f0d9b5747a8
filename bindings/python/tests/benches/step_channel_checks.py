"""Benches that test checkers: each asserts what its checker reports."""

import os
import random

import cocotb
import pytest
from cocotb.clock import Clock
from cocotb.handle import Force, Release
from cocotb.triggers import FallingEdge, Timer
from cocotb.types import Logic, LogicArray

import motion_rtl as mr

MAP = {"half_period": "i_next_half", "period": "i_next_limit", "step": "!o_step_n"}
NAMES = os.environ["NAMES"]


def checker(dut, **options):
    options = {"clock": dut.clk, "reset": dut.srst, "map": MAP, "waves": False} | options
    return mr.cocotb.Checker(dut, "unit_law", {"width": 16}, **options)


async def play(dut, ticks=500, reset=True):
    """Reset the design and play random half-periods."""
    Clock(dut.clk, 10, unit="ns").start()
    dut.srst.value = reset
    dut.i_next_half.value = 0
    dut.i_next_limit.value = 0
    for tick in range(ticks):
        await FallingEdge(dut.clk)
        dut.srst.value = reset and tick < 2
        dut.i_next_half.value = random.randrange(8)
        dut.i_next_limit.value = random.randrange(60)


@cocotb.test()
async def from_power_on(dut):
    # The first test, as the design is at power-on.
    check = checker(dut, from_power_on=True)
    await play(dut, reset=False)
    report = check.finish()
    assert report.text.startswith("PASS: 500 values equal in 500 ticks\n"), report
    assert check.finish() is report


@cocotb.test()
async def after_a_reset(dut):
    check = checker(dut, map=NAMES)
    await play(dut)
    report = check.finish()
    assert report and report.first == "", report
    assert report.text.startswith("PASS: 499 values equal in 499 ticks\n"), report
    assert "moved, how often: half_period 4" in report.text


@cocotb.test()
async def without_a_reset(dut):
    check = checker(dut)
    await play(dut, reset=False)
    report = check.finish()
    assert not report and report.verdict == "VACUOUS", report
    assert "rst was 1 in none of 500 edges" in report.text


@cocotb.test()
async def without_a_move(dut):
    Clock(dut.clk, 10, unit="ns").start()
    dut.srst.value = 1
    await FallingEdge(dut.clk)
    check = checker(dut)
    for _ in range(20):
        await FallingEdge(dut.clk)
    report = check.finish()
    assert report.verdict == "VACUOUS" and "no output port moved" in report.text, report


@cocotb.test()
async def without_a_clock(dut):
    check = checker(dut)
    await Timer(1, unit="us")
    report = check.finish()
    assert report.text.startswith("VACUOUS: there was no clock edge"), report


@cocotb.test(expect_error=RuntimeError)
async def without_time(dut):
    # cocotb has not begun the checker's task when the test ends.
    checker(dut)


@cocotb.test()
async def without_an_output(dut):
    check = checker(dut, leave="step", clock="clk")
    await play(dut)
    report = check.finish()
    assert report.verdict == "VACUOUS" and "no output port is compared" in report.text, report
    assert "left out: step" in report.text


@cocotb.test()
async def unknown_input(dut):
    check = checker(dut)
    await play(dut, 30)
    dut.i_next_half.value = LogicArray("00000000000000xz")
    await FallingEdge(dut.clk)
    await play(dut, 30)
    report = check.finish()
    assert report.verdict == "FAIL", report
    stop = "tick 30: input half_period is 00000000000000XZ (binary, unknown)"
    assert stop in report.first, report
    assert "an unknown input has stopped the comparison after 29 ticks" in report.text, report


@cocotb.test()
async def unknown_output(dut):
    check = checker(dut)
    await play(dut, 30)
    dut.o_step_n.value = Force(Logic("Z"))
    await FallingEdge(dut.clk)
    dut.o_step_n.value = Release()
    report = check.finish()
    assert report.verdict == "FAIL" and "design Z (binary, unknown), model" in report.first, report
    assert "FAIL: 1 of " in report.text


@cocotb.test()
async def first_difference(dut):
    check = checker(dut, waves="around.fst")
    await play(dut, 300)
    dut.o_step_n.value = Force(~dut.o_step_n.value)
    await FallingEdge(dut.clk)
    dut.o_step_n.value = Release()
    await play(dut, 150)
    report = check.finish()
    assert report.verdict == "FAIL", report
    lines = report.first.splitlines()
    assert lines[0] == "first difference in tick 300:" and lines[1].startswith("  step: design "), (
        report
    )
    ticks = [line.split() for line in lines if line.startswith("tick ")][0]
    assert ticks[1:] == [str(tick) for tick in range(293, 301)]
    assert "waves of the model, ticks 200 to 399: around.fst" in report.first, report
    assert "step: 1 difference, the first in tick 300" in report.text, report
    assert mr.compare("around.fst", "around.fst").as_dict()["ticks"] == 200


@cocotb.test()
async def mistakes(dut):
    def refused(match, error=ValueError, **options):
        with pytest.raises(error, match=match):
            checker(dut, **options)

    refused(r"unit_law.period: the design step_channel has no period; .*allowed: a pair", map={})
    refused("i_next_lim; near it: i_next_limit", map=MAP | {"period": "i_next_lim"})
    refused("has 16 bits, but lap of the design has 1", map=MAP | {"period": "lap"})
    refused(
        r"has 16 bits, but i_next_half\[7:0\] of the design has 8",
        map=MAP | {"period": "i_next_half[7:0]"},
    )
    refused(
        r"i_next_half\[16:1\]: i_next_half of the design is \[15:0\]; allowed: bits of it",
        map=MAP | {"period": "i_next_half[16:1]"},
    )
    refused("no signal of unit_law is called so", map=MAP | {"stp": "o_step_n"})
    refused("leave: stp is not a port of unit_law; did you mean step?", leave=["stp"])
    refused("reset: the design step_channel has no rst", reset=None)
    refused("reset: i_next_half of the design has 16 bits; allowed: 1", reset="i_next_half")
    refused("u_timer of the design is a Hierarchy; allowed: one", map=MAP | {"period": "u_timer"})
    refused("nothing.toml", map="nothing.toml")
    refused("reset: is bool; allowed: a handle of the reset, its name, or False", reset=True)
    refused("clock: is NoneType; allowed: a handle of the clock, or its name", clock=None)
    refused("clock: i_next_half of the design has 16 bits; allowed: 1", clock=dut.i_next_half)
    refused("clock: the design step_channel has no ck; near it: clk", clock="ck")
    refused("map: step: is LogicObject", TypeError, map=MAP | {"step": dut.o_step_n})
    refused("map: step: is NoneType", TypeError, map=MAP | {"step": None})
    refused(
        "map: period: u_timer.i_limit has a dot; allowed: a port of the design itself",
        map=MAP | {"period": "u_timer.i_limit"},
    )
    refused("unit_law.step: the design step_channel has no _log", map=MAP | {"step": "_log"})
    refused("a.txt: the extension names no format; allowed: .vcd, .fst", waves="a.txt")
    with pytest.raises(ValueError, match="settings: given with a model, which has its own"):
        mr.cocotb.Checker(dut, mr.Model("unit_law"), {"width": 16}, clock=dut.clk)
    with pytest.raises(TypeError, match="dut: is str; allowed: a handle of the design"):
        mr.cocotb.Checker("dut", "unit_law", clock=dut.clk)
    with pytest.raises(KeyError, match="did you mean unit_law"):
        mr.cocotb.Checker(dut, "unit_lw", clock=dut.clk)
    with pytest.raises(ValueError, match="widht"):
        mr.cocotb.Checker(dut, "unit_law", {"widht": 16}, clock=dut.clk)
    with pytest.raises(TypeError):
        mr.cocotb.Checker(dut, "unit_law", clock=dut.clk, leav=["step"])
