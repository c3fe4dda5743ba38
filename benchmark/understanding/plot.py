"""Risk against coverage, drawn: how many answers are wrong when only those above a threshold are given."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt

from .cross_validation import Told, calibration_error, risk_and_coverage

PICTURE = Path("docs/images/risk-coverage.svg")


def draw(told: Sequence[Told], path: Path = PICTURE) -> None:
    """Writes two panels as SVG: risk against coverage, and right answers against confidence in ten bins."""
    mpl.rcParams["svg.hashsalt"] = "querycad"
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    curve = risk_and_coverage(told)
    left.plot([c for _, c, _ in curve], [r for _, _, r in curve], marker="o", markersize=3)
    for threshold, coverage, risk in curve:
        if round(threshold * 100) in (0, 50, 80, 90):
            left.annotate(f"{threshold:.1f}", (coverage, risk), textcoords="offset points", xytext=(5, -9), fontsize=8)
    left.set(xlabel="share of questions answered", ylabel="share of those that are wrong", xlim=(0, 1), ylim=(0, None))
    left.set_title("Risk against coverage, by threshold of confidence", fontsize=10)
    known = [one for one in told if not one.refused]
    points = []
    for i in range(10):
        inside = [one for one in known if i / 10 <= one.confidence < (i + 1) / 10 + (i == 9)]
        if inside:
            points.append(
                (sum(one.confidence for one in inside) / len(inside), sum(one.right for one in inside) / len(inside))
            )
    right.plot([0, 1], [0, 1], color="0.7", linewidth=1)
    right.plot([p for p, _ in points], [q for _, q in points], marker="o", markersize=4)
    right.set(xlabel="confidence", ylabel="share of right answers", xlim=(0, 1), ylim=(0, 1))
    right.set_title(f"Calibration (expected error {calibration_error(told):.3f})", fontsize=10)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
