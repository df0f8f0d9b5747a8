"""Prints the time of a tick: signals set and read by name, and runs with arrays."""

import sys
import time

import numpy as np

import motion_rtl as mr

CIRCUITS = [
    ("enable_counter", "period", "enable"),
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

        def arrays(model=model, port=port, watched=watched, values=np.ones(10 * ticks, int)):
            model.run({port: values}, watch=[watched])

        print(
            f"{name}: made in {made * 1e3:.1f} ms; "
            f"set, get, step {least(by_name) / ticks * 1e6:.2f} us; "
            f"run {least(arrays) / (10 * ticks) * 1e9:.0f} ns a tick"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
