"""Motion-control circuits as cycle-accurate models.

A :class:`Model` is a circuit of the catalogue, stepped tick by tick::

    import motion_rtl as mr

    m = mr.Model("enable_counter", width=8)
    m["period"] = 4
    m.step(3)
    assert m["enable"]

:func:`compare` compares two waveforms. A :class:`Job` runs a scenario, a drawing or a part program.
``motion_rtl.cocotb`` has checkers for benches in cocotb.
"""

from importlib import import_module as _import_module
from typing import Any as _Any

from ._motion_rtl import Model, Report, Signal, Snapshot, __version__, compare
from .job import Job, JobError, Result

__all__ = [
    "Job",
    "JobError",
    "Model",
    "Report",
    "Result",
    "Signal",
    "Snapshot",
    "__version__",
    "compare",
]


def __getattr__(name: str) -> _Any:
    # Where it is not used, cocotb need not be installed.
    if name == "cocotb":
        return _import_module(".cocotb", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
