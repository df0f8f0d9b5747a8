"""Bench of a step channel, with the circuit unit_law beside it."""

import os
import random

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge

import motion_rtl as mr

TICKS = int(os.environ.get("TICKS", "20000"))


@cocotb.test()
async def half_periods(dut):
    """Plays random half-periods in random unit times."""
    mr.cocotb.Checker(
        dut,
        "unit_law",
        {"width": 16},
        clock=dut.clk,
        reset=dut.srst,
        map={
            "half_period": "i_next_half",
            "period": "i_next_limit",
            "step": "!o_step_n",
        },
    )
    Clock(dut.clk, 10, unit="ns").start()
    dut.srst.value = 1
    dut.i_next_half.value = 0
    dut.i_next_limit.value = 0
    for tick in range(TICKS):
        await FallingEdge(dut.clk)
        dut.srst.value = tick < 2
        if tick % 50 == 0:
            dut.i_next_half.value = random.randrange(8)
            dut.i_next_limit.value = random.randrange(60)
