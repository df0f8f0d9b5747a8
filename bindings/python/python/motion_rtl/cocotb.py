"""Checkers for benches in cocotb: a model beside the design, compared at every clock edge."""

from __future__ import annotations

import json
import os
import re
from asyncio import CancelledError
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from ._motion_rtl import Model, _bound_ports, _Checker

try:
    import cocotb
except ModuleNotFoundError as error:
    text = 'cocotb is not installed; pip install "./bindings/python[cocotb]" installs it'
    raise ImportError(text) from error
# Before, a task that fails when the test ends does not fail the test.
if tuple(int(number) for number in cocotb.__version__.split(".")[:2]) < (2, 1):
    raise ImportError(f"cocotb {cocotb.__version__} is installed; allowed: 2.1 or newer")

from cocotb.handle import LogicArrayObject, LogicObject, PackedObject  # noqa: E402
from cocotb.triggers import RisingEdge  # noqa: E402

if TYPE_CHECKING:
    from cocotb.handle import SimHandleBase

__all__ = ["CheckFailed", "Checker", "Report"]


class CheckFailed(AssertionError):
    """The design differs from the model, or nothing was compared; the log has the report."""


@dataclass(frozen=True)
class Report:
    """Result of a check; true if it passed.

    Attributes
    ----------
    verdict : str
        ``"PASS"``, ``"FAIL"``, or ``"VACUOUS"`` if nothing was compared or no output port moved.
    text : str
        Verdict with the number of compared values, what differs, how often each port moved, and
        the files with the waves of the model.
    first : str
        Ports that differ first, with both values, and the last eight ticks; empty if all values
        are equal.
    """

    verdict: str
    text: str
    first: str

    def __bool__(self) -> bool:
        return self.verdict == "PASS"

    def __str__(self) -> str:
        return self.first + self.text


class Checker:
    """Compares all ports of a design with those of a model, at every rising edge of the clock.

    ``Checker(dut, "linear_interpolator", clock=dut.clk)`` starts a task that drives nothing. The
    model takes the inputs and resets of the design. At the end of the test the task logs its
    report; a check that did not pass fails the test.

    Parameters
    ----------
    dut : handle
        Instance with the ports.
    circuit : str or Model
        Name of the circuit, or a model, of which a copy is used.
    settings : dict, optional
        Settings of the circuit, as those of ``Model``.
    clock : handle
        Clock.
    reset : handle or str, optional
        Synchronous reset, or its name below `dut`, with ``!`` before it if it is active low;
        ``dut.rst`` if it is left out. ``False`` if there is none.
    map : path or dict, optional
        Names that differ: a file as for ``compare``, or a dict from port to a name below `dut`,
        such as ``"!step_n"`` or ``"bus[27:4]"``. Ports with equal names need no entry.
    leave : sequence of str
        Ports that are left out.
    from_power_on : bool
        Compare from the first edge, with the model at power-on. Otherwise the comparison begins
        after the first edge with a reset.
    waves : path, optional
        File for the waves of the model around the first difference, .vcd or .fst; by default
        CIRCUIT_checker.vcd in the working directory. ``False`` for none.

    Raises
    ------
    KeyError
        There is no such circuit; the text has the nearest name.
    ValueError
        The design has not all ports with their widths, or a map or setting is refused.
    """

    def __init__(
        self,
        dut: SimHandleBase,
        circuit: str | Model,
        settings: Mapping[str, Any] | None = None,
        *,
        clock: SimHandleBase,
        reset: SimHandleBase | str | bool | None = None,
        map: str | os.PathLike[str] | Mapping[str, str] | None = None,
        leave: Sequence[str] = (),
        from_power_on: bool = False,
        waves: str | os.PathLike[str] | bool | None = None,
    ) -> None:
        model = circuit if isinstance(circuit, Model) else Model(circuit, settings)
        ports, left = _ports(model, map, leave)
        reads, slices, wrong = [], [], []
        for path, _, width, expression in ports:
            try:
                read, digits = _read(dut, expression, width)
            except ValueError as error:
                wrong.append(f"{model.name}.{path}: {error}")
            else:
                reads.append(read)
                slices.append(digits)
        reads_reset, inverts = _reset(dut, reset, wrong)
        if wrong:
            raise ValueError("\n".join(wrong))
        if waves is None or waves is True:
            waves = f"{model.name}_checker.vcd"
        self._checker = _Checker(model, slices, left, from_power_on, waves or None)
        self._reads = reads
        self._reset = reads_reset
        self._inverts = inverts
        self._clock = clock
        self._first = ""
        self._report: Report | None = None
        self._log = dut._log
        self._task = cocotb.start_soon(self._watch())

    async def _watch(self) -> None:
        edge, reads, reset = self._checker.edge, self._reads, self._reset
        rises = RisingEdge(self._clock)
        try:
            while True:
                await rises
                said = edge(reset(), self._inverts, [read() for read in reads])
                if said is not None:
                    self._first += said
                    self._log.error(said.rstrip())
        except CancelledError:
            if self._report is None:
                report = self._end()
                if not report:
                    raise CheckFailed(report.text.splitlines()[0]) from None
            raise

    def _end(self) -> Report:
        verdict, text = self._checker.end()
        self._report = Report(verdict, text, self._first)
        log = self._log.info if self._report else self._log.error
        log(text.rstrip())
        return self._report

    def finish(self) -> Report:
        """End the check and log its report.

        The test has to look at it: ``assert report, report``.

        Returns
        -------
        Report
        """
        if self._report is None:
            self._end()
            self._task.cancel()
        assert self._report is not None
        return self._report


def _ports(
    model: Model,
    map: str | os.PathLike[str] | Mapping[str, str] | None,
    leave: Sequence[str],
) -> tuple[list[tuple[str, str, int, str]], list[str]]:
    """Return the ports to compare, input ports first, and the paths of those that are left out."""
    if isinstance(map, Mapping) or map is None:
        lines = [f"{json.dumps(port)} = {json.dumps(name)}" for port, name in (map or {}).items()]
        ports, left = _bound_ports(model, None, "\n".join(["[signals]", *lines]))
    else:
        ports, left = _bound_ports(model, map, None)
    paths = [path for path, *_ in ports]
    for name in leave:
        if name not in paths + left:
            near = get_close_matches(name, paths, 1)
            meant = f"; did you mean {near[0]}?" if near else ""
            raise ValueError(f"leave: {name} is not a port of {model.name}{meant}")
    left += [name for name in leave if name not in left]
    ports = [port for port in ports if port[0] not in left]
    return sorted(ports, key=lambda port: port[1] != "in"), left


#: Name below the design with an inversion and one bit or some bits.
_EXPRESSION = re.compile(r"(~?)(.+?)(?:\[(\d+)(?::(\d+))?\])?")


def _read(
    dut: SimHandleBase, expression: str, width: int
) -> tuple[Callable[[], str], tuple[bool, int, int]]:
    """Return a function that reads the digits of a signal, and inversion and digits of the port."""
    parts = _EXPRESSION.fullmatch(expression)
    assert parts is not None
    inverts, name, high, low = parts.groups()
    handle = _find(dut, name)
    read, digits = _digits(handle)
    first, end = 0, digits
    if high is not None and digits > 1:
        left, step = handle.range.left, 1 if handle.range.direction == "to" else -1
        first = (int(high) - left) * step
        end = (int(low if low is not None else high) - left) * step + 1
        if not 0 <= first < end <= digits:
            raise ValueError(f"{name} of the design is {handle.range}; allowed: bits of it")
    if end - first != width:
        raise ValueError(f"has {width} bits, but {expression} of the design has {end - first}")
    return read, (inverts == "~", first, end)


def _find(dut: SimHandleBase, name: str) -> SimHandleBase:
    """Return the handle of a name below the design."""
    try:
        return getattr(dut, name)
    except AttributeError:
        near = get_close_matches(name, [handle._name for handle in dut], 3)
        meant = f"; near it: {', '.join(near)}" if near else ""
        text = f"the design {dut._path} has no {name}{meant}; allowed: a pair of names in map"
        raise ValueError(text) from None


def _digits(handle: SimHandleBase) -> tuple[Callable[[], str], int]:
    """Return a function that reads the digits of a signal, the highest first, and their number."""
    if not isinstance(handle, (LogicObject, LogicArrayObject, PackedObject)):
        kind = type(handle).__name__.removesuffix("Object")
        raise ValueError(f"{handle._name} of the design is a {kind}; allowed: one or more bits")
    digits = 1 if isinstance(handle, LogicObject) else len(handle)
    # Making a value of the digits would take longer than the comparison.
    return handle._handle.get_signal_val_binstr, digits


def _reset(
    dut: SimHandleBase, reset: SimHandleBase | str | bool | None, wrong: list[str]
) -> tuple[Callable[[], str], bool]:
    """Return a function that reads the reset, and whether it is active low."""
    if reset is False:
        return lambda: "0", False
    inverts = isinstance(reset, str) and reset.startswith("!")
    try:
        if reset is None:
            reset = _find(dut, "rst")
        elif isinstance(reset, str):
            reset = _find(dut, reset.removeprefix("!"))
        read, digits = _digits(reset)
        if digits != 1:
            raise ValueError(f"{reset._name} of the design has {digits} bits; allowed: 1")
    except ValueError as error:
        wrong.append(f"reset: {error}")
        return lambda: "0", False
    return read, inverts
