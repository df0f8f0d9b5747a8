"""Times of a tick: the clock alone, all ports read with ``value``, and a checker."""

import os
import time

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge

import motion_rtl as mr

TICKS = int(os.environ["TICKS"])
CIRCUIT = os.environ["CIRCUIT"]
TIMES = {}


async def play(dut, name):
    """Drive other inputs in every tick; keep the time of a tick in microseconds."""
    Clock(dut.clk, 10, unit="ns").start()
    inputs = [s for s in mr.Model(CIRCUIT).signals.values() if s.port == "in"]
    handles = [(getattr(dut, signal.verilog), signal.width) for signal in inputs]
    dut.rst.value = 1
    for handle, _ in handles:
        handle.value = 0
    for _ in range(3):
        await FallingEdge(dut.clk)
    dut.rst.value = 0
    began = time.process_time()
    for tick in range(TICKS):
        await FallingEdge(dut.clk)
        handle, width = handles[tick % len(handles)]
        handle.value = tick % (1 << min(width, 8))
    TIMES[name] = (time.process_time() - began) / TICKS * 1e6


@cocotb.test()
async def clock_alone(dut):
    """Runs the design alone."""
    await play(dut, "alone")


@cocotb.test()
async def ports_read(dut):
    """Reads all ports at every edge, as any bench that compares them has to."""
    ports = [s.verilog for s in mr.Model(CIRCUIT).signals.values() if s.port]
    handles = [dut.rst, *(getattr(dut, name) for name in ports)]

    async def read():
        edge = RisingEdge(dut.clk)
        while True:
            await edge
            for handle in handles:
                handle.value  # noqa: B018

    cocotb.start_soon(read())
    await play(dut, "read")


@cocotb.test()
async def checked(dut):
    """Compares all ports at every edge."""
    checker = mr.cocotb.Checker(dut, CIRCUIT, clock=dut.clk)
    await play(dut, "checked")
    report = checker.finish()
    assert report, report
    alone, read, check = (TIMES[name] for name in ("alone", "read", "checked"))
    print(
        f"{CIRCUIT}, {len(checker._reads)} ports: tick {alone:.1f} us; "
        f"reading adds {read - alone:.1f} us, a checker {check - alone:.1f} us"
    )
