"""Compares an enable counter in plain Python with the model, on random periods.

``--fault`` plants a fault: the counter compares with ``>`` in place of ``>=``.
"""

import sys

import numpy as np

import motion_rtl as mr

WIDTH = 8
TICKS = 100_000


def design(periods, fault):
    """Return `enable` of each tick: high in the last tick of a period, of which 0 counts as 1."""
    count, enables = 0, []
    for period in periods:
        last = count + 1 > period if fault else count + 1 >= period
        enables.append(last)
        count = 0 if last else (count + 1) % 2**WIDTH
    return np.array(enables)


def main():
    # A new period every hundred ticks.
    random = np.random.default_rng(1)
    periods = np.repeat(random.integers(0, 50, TICKS // 100), 100)
    model = mr.Model("enable_counter", width=WIDTH)
    golden = model.run({"period": periods}, watch=["enable"])["enable"]
    own = design(periods, "--fault" in sys.argv[1:])

    moves = np.count_nonzero(golden[1:] != golden[:-1])
    different = np.flatnonzero(own != golden)
    if moves == 0:
        sys.exit("VACUOUS: enable never moved")
    if different.size:
        tick = different[0]
        sys.exit(
            f"FAIL: tick {tick}: enable: design {own[tick]}, model {golden[tick]}; "
            f"{different.size} ticks differ"
        )
    print(f"PASS: {TICKS} ticks compared, enable moved {moves} times")


if __name__ == "__main__":
    main()
