"""The plots of the notes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("matplotlib")
from matplotlib.image import imread

PLOTS = Path(__file__).parents[3] / "rtl_notes" / "python" / "plots.py"


def test_the_plots_are_drawn(tmp_path):
    environment = os.environ | {"MPLBACKEND": "Agg"}
    words = [sys.executable, PLOTS, "pictures"]
    done = subprocess.run(
        words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    pictures = sorted(path.name for path in (tmp_path / "pictures").iterdir())
    assert pictures == ["pulse_counts.png", "weld.png"]
    for name in pictures:
        # Not a single colour, and not a few lines alone.
        pixels = imread(tmp_path / "pictures" / name)[..., :3]
        assert 0.005 < (pixels != pixels[0, 0]).any(axis=-1).mean() < 0.9
