"""Benches of a design whose ports are bits of others."""

import random

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge

import motion_rtl as mr


async def play(dut, bits):
    model = mr.Model("enable_counter", width=8)
    names = {"period": bits, "enable": "!both[1]"}
    check = mr.cocotb.Checker(dut, model, clock=dut.clk, reset="!rst_n", map=names, waves=False)
    model["period"] = 3
    Clock(dut.clk, 10, unit="ns").start()
    dut.rst_n.value = 0
    dut.ascending.value = 5
    dut.bus.value = 0
    for tick in range(400):
        await FallingEdge(dut.clk)
        dut.rst_n.value = tick > 3
        if tick % 20 == 0:
            dut.bus.value = random.randrange(1 << 28)
    return check.finish()


@cocotb.test()
async def bits_of_a_bus(dut):
    report = await play(dut, "bus[15:8]")
    assert report.text.startswith("PASS: 399 values equal"), report


@cocotb.test()
async def other_bits(dut):
    report = await play(dut, "bus[16:9]")
    assert report.verdict == "FAIL", report


@cocotb.test()
async def ascending_bits(dut):
    # The period of the model is constant, that of the design is not.
    report = await play(dut, "ascending[0:7]")
    assert report.verdict == "FAIL" and "period  05  05" in report.first, report
