"""Threads, and Ctrl-C."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import motion_rtl as mr

#: More ticks than any test waits for.
ENDLESS = 10**15


def test_other_threads_run_meanwhile():
    model = mr.Model("linear_interpolator")
    started = threading.Event()
    counted = 0

    def run():
        started.set()
        model.step(20_000_000)

    thread = threading.Thread(target=run)
    thread.start()
    started.wait()
    while thread.is_alive():
        counted += 1
        time.sleep(0.001)
    assert model.tick == 20_000_000
    assert counted > 10


def test_threads_use_a_model_one_at_a_time():
    model = mr.Model("enable_counter", width=8)
    model["period"] = 7

    def step():
        for _ in range(50):
            model.step(1_000)

    threads = [threading.Thread(target=step) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (model.tick, model["count"]) == (200_000, 200_000 % 7)


def test_runs_of_two_threads_do_not_mix():
    model = mr.Model("enable_counter", width=8)
    results = {}

    def run(period):
        values = np.full(100_000, period)
        results[period] = model.run({"period": values}, "period")["period"]

    threads = [threading.Thread(target=run, args=(period,)) for period in (5, 6, 7)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert model.tick == 300_000
    assert all(np.all(values == period) for period, values in results.items())


@pytest.mark.parametrize(
    "call", [f"m.step({ENDLESS})", "m.run(watch=[], ticks=2**40)"], ids=["step", "run"]
)
def test_ctrl_c_ends_a_run(call):
    # A parent in the background leaves the signal ignored.
    code = f"""
        import signal
        import motion_rtl as mr
        signal.signal(signal.SIGINT, signal.default_int_handler)
        m = mr.Model("enable_counter")
        m["period"] = 1000
        print("begins", flush=True)
        try:
            {call}
        except KeyboardInterrupt:
            print(m.tick > 0, m["count"] == m.tick % 1000)
            m.step()
    """
    child = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True
    )
    assert child.stdout.readline() == "begins\n"
    time.sleep(0.3)
    os.kill(child.pid, signal.SIGINT)
    out, _ = child.communicate(timeout=20)
    assert (out, child.returncode) == ("True True\n", 0)


def test_a_signal_handler_cannot_use_a_model_that_runs():
    code = f"""
        import signal
        import motion_rtl as mr
        m = mr.Model("enable_counter")
        signal.signal(signal.SIGALRM, lambda *_: print(m.tick))
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        try:
            m.step({ENDLESS})
        except RuntimeError as error:
            print(error)
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        capture_output=True,
        text=True,
        timeout=20,
        check=True,
    )
    assert done.stdout.startswith("the model is in the middle of a call of this thread")


def test_a_fork_during_a_call_of_another_thread_is_told():
    code = f"""
        import os, signal, threading, time
        import motion_rtl as mr
        m = mr.Model("enable_counter")
        before = m.copy()
        threading.Thread(target=lambda: m.step({ENDLESS}), daemon=True).start()
        time.sleep(0.2)
        child = os.fork()
        if child == 0:
            signal.alarm(10)
            before.step()
            try:
                m.step()
            except RuntimeError as error:
                print(error, flush=True)
            os._exit(0)
        print(os.waitpid(child, 0)[1], flush=True)
        os._exit(0)
    """
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", textwrap.dedent(code)],
        capture_output=True,
        text=True,
        timeout=20,
        check=True,
    )
    text = "the process was forked while another thread was in a call of the model"
    assert done.stdout.startswith(text) and done.stdout.endswith("\n0\n"), done.stdout


def test_ctrl_c_at_the_first_array_is_no_panic():
    # NumPy is asked for its version and its functions once, and Ctrl-C could come then.
    code = """
        import motion_rtl as mr
        import numpy as np

        def interrupted(*_):
            raise KeyboardInterrupt

        np.lib.NumpyVersion = interrupted
        print(mr.Model("enable_counter").run({"period": [1, 2]})["enable"])
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == ("[ True False]\n", "")
