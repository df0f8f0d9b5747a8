"""Jobs, which the program ``motion-rtl`` of this package runs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ._motion_rtl import _pairs

#: Program in a process of its own, since it ends that process when a signal ends it. Its package is
#: this one, whatever the working directory holds.
_PROGRAM = """
import sys
package = sys.argv.pop(1)
sys.path[:] = [path for path in sys.path if path] + [package]
from motion_rtl.__main__ import main
main()
"""


class JobError(RuntimeError):
    """The program ended without a summary for another reason than its input."""


@dataclass(frozen=True)
class Result:
    """Result of a job.

    Attributes
    ----------
    summary : dict
        Summary of the run, by the keys that ``motion-rtl run --json`` has; its schema is
        ``rtl_notes/summary.schema.json``.
    series : dict of str to numpy.ndarray
        Arrays of shape (rows,), one row per sampling period: ``tick`` (uint64), ``time_s``
        (float64, seconds), and for each axis its commanded and actual position and their
        difference (float64), as ``x_commanded_counts``, ``x_actual_counts`` and
        ``x_error_counts``. The end of a name is the unit. Empty if it was not asked for.
    exact : bool
        True if the run did what it was to do; else ``summary["complaints"]`` says what is wrong.
    """

    summary: dict[str, Any]
    series: dict[str, np.ndarray]
    exact: bool

    def __repr__(self) -> str:
        circuit = self.summary.get("circuit")
        exact = "exact" if self.exact else "not exact"
        rows = len(next(iter(self.series.values()))) if self.series else 0
        return f"<Result of {circuit}, {exact}, {rows} rows>"


class Job:
    """A job: a scenario (.toml), a drawing (.hpgl), a part program (.ngc) or a position log (.csv).

    ``Job("waves/weld.toml", feed_mm_per_min=300)`` overrides a key of the scenario; keys with dots
    stand in a dict, as in ``Job("job.toml", {"program.g54_mm": [1, 2, 0]})``. ``motion-rtl keys
    CIRCUIT`` prints all keys with their units. The scenarios that ``motion-rtl list`` shows are in
    the package: their files need not be there.

    The program ``motion-rtl`` of this package runs the job, in a process of its own.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        settings: Mapping[str, Any] | None = None,
        /,
        **keywords: Any,
    ) -> None:
        self.path = Path(path)
        self.settings: list[str] = _pairs(settings, keywords)

    def __repr__(self) -> str:
        return f"<Job {' '.join([str(self.path), *self.settings])}>"

    def run(self, *, series: bool = True, series_every: int | None = None) -> Result:
        """Run the job.

        Parameters
        ----------
        series : bool
            True to return positions over time.
        series_every : int, optional
            Ticks between two rows of the series, in place of the sampling period.

        Returns
        -------
        Result

        Raises
        ------
        ValueError
            The file or a setting is refused; the text has file, line, key and the allowed values.
        FileNotFoundError
            There is no such file.
        JobError
            The program failed.
        """
        with tempfile.TemporaryDirectory(prefix="motion-rtl-") as directory:
            rows = Path(directory, "series.npy")
            words = ["run", "--json", "--quiet", "--no-vcd"]
            words += ["--out", directory]
            words += [word for pair in self.settings for word in ("--set", pair)]
            if series:
                words += ["--series", os.fspath(rows)]
            if series_every is not None:
                words += ["--series-every", str(series_every)]
            words += ["--", os.fspath(self.path)]
            done = _run(words)
            summary = self._summary(done)
            arrays = _columns(rows) if series else {}
        return Result(summary, arrays, done.returncode == 0)

    def _summary(self, done: subprocess.CompletedProcess[str]) -> dict[str, Any]:
        """Return the summary that the program printed."""
        try:
            printed = json.loads(done.stdout)
        except ValueError:
            text = done.stderr.strip() or f"motion-rtl ended with code {done.returncode}"
            raise JobError(text) from None
        error = printed.get("error")
        if error is None:
            return printed
        files = [fault["file"] for fault in error["faults"] if fault["field"] == "file"]
        if os.fspath(self.path) in files and not self.path.exists():
            raise FileNotFoundError(error["message"])
        if error["kind"] in ("input", "argument", "usage"):
            raise ValueError(error["message"])
        raise JobError(error["message"])


def _run(words: list[str]) -> subprocess.CompletedProcess[str]:
    """Run the program with the words of its command line."""
    if not sys.executable:
        raise JobError("sys.executable is empty, so that no process can be started")
    package = os.fspath(Path(__file__).parents[1])
    words = [sys.executable, "-c", _PROGRAM, package, *words]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def _columns(rows: Path) -> dict[str, np.ndarray]:
    """Return the columns of a structured array."""
    table = np.load(rows)
    return {name: np.ascontiguousarray(table[name]) for name in table.dtype.names}
