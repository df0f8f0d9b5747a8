"""Prints times of a tick: signals set and read by name, runs with arrays, a checker's model."""

import sys
import time

import numpy as np

import motion_rtl as mr
from motion_rtl._motion_rtl import _bound_ports, _Checker

CIRCUITS = [
    ("enable_counter", "period", "enable"),
    ("unit_law", "period", "step"),
    ("linear_interpolator", None, None),
    ("machine", None, None),
]


def least(run, times=5):
    """Return the least time of some runs in seconds."""
    best = float("inf")
    for _ in range(times):
        begin = time.process_time()
        run()
        best = min(best, time.process_time() - begin)
    return best


def checker(name, ticks):
    """Return the time of an edge of a checker, whose ports have the digits of the model's."""
    model = mr.Model(name)
    model.reset()
    ports, _ = _bound_ports(model)
    digits = [f"{model[path] % (1 << width):0{width}b}" for path, _, width, _ in ports]
    checker = _Checker(model, [(False, 0, width) for _, _, width, _ in ports], [], True, None)

    def edges():
        for _ in range(ticks):
            checker.edge("0", False, digits)

    return least(edges) / ticks


def main(ticks):
    for name, port, watched in CIRCUITS:
        begin = time.process_time()
        model = mr.Model(name)
        model.step()
        made = time.process_time() - begin
        ports = {way: [s for s in model.signals.values() if s.port == way] for way in ("in", "out")}
        port = port or ports["in"][0].path
        watched = watched or ports["out"][0].path

        def by_name(model=model, port=port, watched=watched):
            for _ in range(ticks):
                model[port] = 1
                model[watched]
                model.step()

        # Inputs that move; a circuit in which nothing moves is not compiled.
        high = 1 if model.signals[port].kind == "bit" else 5
        values = np.where(np.arange(10 * ticks) >> 6 & 1, high, high // 4)

        def arrays(model=model, port=port, watched=watched, values=values):
            model.run({port: values}, watch=[watched])

        print(
            f"{name}: made in {made * 1e3:.1f} ms; "
            f"set, get, step {least(by_name) / ticks * 1e6:.2f} us; "
            f"run {least(arrays) / (10 * ticks) * 1e9:.0f} ns a tick; "
            f"edge of a checker {checker(name, ticks // 10) * 1e6:.2f} us"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
