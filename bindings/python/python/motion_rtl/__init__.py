"""Motion-control circuits as cycle-accurate models.

A :class:`Model` is a circuit of the catalogue, stepped tick by tick::

    import motion_rtl as mr

    m = mr.Model("enable_counter", width=8)
    m["period"] = 4
    m.step(3)
    assert m["enable"]

:func:`compare` compares two waveforms. A :class:`Job` runs a scenario, a drawing or a part program.
"""

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
