"""Checkers for benches in cocotb: a model beside the design, compared at every clock edge."""

from __future__ import annotations

import json
import os
import re
from asyncio import CancelledError
from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from ._motion_rtl import Model, _bound_ports, _Checker

try:
    import cocotb
except ModuleNotFoundError as error:
    text = 'cocotb is not installed; pip install "./bindings/python[cocotb]" installs it'
    raise ImportError(text) from error
# Before, a task that fails when the test ends does not fail the test.
if tuple(int(number) for number in cocotb.__version__.split(".")[:2]) < (2, 1):
    raise ImportError(f"cocotb {cocotb.__version__} is installed; allowed: 2.1 or newer")

from cocotb.handle import (  # noqa: E402
    LogicArrayObject,
    LogicObject,
    PackedObject,
    SimHandleBase,
)
from cocotb.triggers import RisingEdge  # noqa: E402

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
        Settings of the circuit, as those of ``Model``. A model has its own.
    clock : handle or str
        Clock, or its name below `dut`.
    reset : handle or str, optional
        Synchronous reset, or its name below `dut`, with ``!`` before it if it is active low;
        ``dut.rst`` if it is left out. ``False`` if there is none.
    map : path or dict, optional
        Names that differ: a file as for ``compare``, or a dict from port to the name of a port of
        `dut`, such as ``"!step_n"`` or ``"bus[27:4]"``. Ports with equal names need no entry.
    leave : str or sequence of str
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
        The design has not all ports with their widths, or a map, a setting or the extension of
        `waves` is refused.
    TypeError
        An argument has another type.
    """

    def __init__(
        self,
        dut: SimHandleBase,
        circuit: str | Model,
        settings: Mapping[str, Any] | None = None,
        *,
        clock: SimHandleBase | str,
        reset: SimHandleBase | str | bool | None = None,
        map: str | os.PathLike[str] | Mapping[str, str] | None = None,
        leave: str | Sequence[str] = (),
        from_power_on: bool = False,
        waves: str | os.PathLike[str] | bool | None = None,
    ) -> None:
        if not isinstance(dut, SimHandleBase):
            raise TypeError(f"dut: is {type(dut).__name__}; allowed: a handle of the design")
        if isinstance(circuit, Model):
            if settings is not None:
                text = "settings: given with a model, which has its own; allowed: neither"
                raise ValueError(text)
            model = circuit
        else:
            model = Model(circuit, settings)
        leave = [leave] if isinstance(leave, str) else leave
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
        rises = _clock(dut, clock, wrong)
        reads_reset, inverts = _reset(dut, reset, wrong)
        if wrong:
            raise ValueError("\n".join(wrong))
        if waves is None or waves is True:
            waves = f"{model.name}_checker.vcd"
        self._checker = _Checker(model, slices, left, from_power_on, waves or None)
        self._reads = reads
        self._reset = reads_reset
        self._inverts = inverts
        self._rises = rises
        self._first = ""
        self._report: Report | None = None
        self._log = dut._log
        self._task = cocotb.start_soon(_Begun(self._watch()))

    async def _watch(self) -> None:
        edge, reads, reset, rises = self._checker.edge, self._reads, self._reset, self._rises
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


class _Begun(Coroutine[Any, Any, None]):
    """Coroutine that is begun before it is cancelled, even if its test ends at once."""

    def __init__(self, inner: Coroutine[Any, Any, None]) -> None:
        self._inner = inner
        self._has_begun = False

    def send(self, value: Any) -> Any:
        self._has_begun = True
        return self._inner.send(value)

    def throw(self, *error: Any) -> Any:
        if not self._has_begun:
            self.send(None)
        return self._inner.throw(*error)

    def close(self) -> None:
        self._inner.close()

    def __await__(self) -> Any:
        return self._inner.__await__()


def _ports(
    model: Model,
    map: str | os.PathLike[str] | Mapping[str, str] | None,
    leave: Sequence[str],
) -> tuple[list[tuple[str, str, int, str]], list[str]]:
    """Return the ports to compare, input ports first, and the paths of those that are left out."""
    if isinstance(map, Mapping) or map is None:
        lines = [_line(port, name) for port, name in (map or {}).items()]
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


def _line(port: Any, name: Any) -> str:
    """Return a pair of a map as a line of a map file."""
    for text in (port, name):
        if not isinstance(text, str):
            raise TypeError(f"map: {port}: is {type(text).__name__}; allowed: names as str")
    if "." in name:
        raise ValueError(f"map: {port}: {name} has a dot; allowed: a port of the design itself")
    return f"{json.dumps(port)} = {json.dumps(name)}"


#: Name below the design with an inversion and one bit or some bits.
_EXPRESSION = re.compile(r"(~?)(.+?)(?:\[(\d+)(?::(\d+))?\])?")


def _read(
    dut: SimHandleBase, expression: str, width: int
) -> tuple[Callable[[], str], tuple[bool, int, int]]:
    """Return a function that reads the digits of a signal, and inversion and digits of the port."""
    parts = _EXPRESSION.fullmatch(expression)
    assert parts is not None
    inverts, name, high, low = parts.groups()
    handle = _find(dut, name, "a pair of names in map")
    read, digits = _digits(handle)
    first, end = 0, digits
    if high is not None and digits > 1:
        left, step = handle.range.left, 1 if handle.range.direction == "to" else -1
        first = (int(high) - left) * step
        end = (int(low if low is not None else high) - left) * step + 1
        if not 0 <= first < end <= digits:
            bits = f"[{left}:{handle.range.right}]"
            raise ValueError(f"{expression}: {name} of the design is {bits}; allowed: bits of it")
    if end - first != width:
        raise ValueError(f"has {width} bits, but {expression} of the design has {end - first}")
    return read, (inverts == "~", first, end)


def _find(dut: SimHandleBase, name: str, allowed: str) -> SimHandleBase:
    """Return the handle of a name below the design."""
    handle = getattr(dut, name, None)
    # An attribute of Python is no part of the design.
    if isinstance(handle, SimHandleBase):
        return handle
    near = get_close_matches(name, [handle._name for handle in dut], 3)
    meant = f"; near it: {', '.join(near)}" if near else ""
    raise ValueError(f"the design {dut._path} has no {name}{meant}; allowed: {allowed}")


def _digits(handle: SimHandleBase) -> tuple[Callable[[], str], int]:
    """Return a function that reads the digits of a signal, the highest first, and their number."""
    if not isinstance(handle, (LogicObject, LogicArrayObject, PackedObject)):
        kind = type(handle).__name__.removesuffix("Object")
        raise ValueError(f"{handle._name} of the design is a {kind}; allowed: one or more bits")
    digits = 1 if isinstance(handle, LogicObject) else len(handle)
    # Making a value of the digits would take longer than the comparison.
    return handle._handle.get_signal_val_binstr, digits


def _bit(dut: SimHandleBase, signal: Any, allowed: str) -> SimHandleBase:
    """Return the handle of one bit, which is a handle or a name below the design."""
    if isinstance(signal, str):
        signal = _find(dut, signal, allowed)
    if not isinstance(signal, SimHandleBase):
        raise ValueError(f"is {type(signal).__name__}; allowed: {allowed}")
    _, digits = _digits(signal)
    if digits != 1:
        raise ValueError(f"{signal._name} of the design has {digits} bits; allowed: 1")
    return signal


def _clock(dut: SimHandleBase, clock: Any, wrong: list[str]) -> RisingEdge | None:
    """Return the trigger of a rising edge; `None` if there is none."""
    try:
        return RisingEdge(_bit(dut, clock, "a handle of the clock, or its name"))
    except ValueError as error:
        wrong.append(f"clock: {error}")
        return None


def _reset(
    dut: SimHandleBase, reset: SimHandleBase | str | bool | None, wrong: list[str]
) -> tuple[Callable[[], str], bool]:
    """Return a function that reads the reset, and whether it is active low."""
    if reset is False:
        return lambda: "0", False
    inverts = isinstance(reset, str) and reset.startswith("!")
    signal = "rst" if reset is None else reset.removeprefix("!") if inverts else reset
    try:
        allowed = "a handle of the reset, its name, or False for a design without one"
        return _digits(_bit(dut, signal, allowed))[0], inverts
    except ValueError as error:
        wrong.append(f"reset: {error}")
        return lambda: "0", False
