"""Pictures of what was measured: every figure as a ratio to its baseline, and how figures grow."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .figures import Measurement, NotMeasured, Series

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

GREY, GREEN, RED = "0.55", "#1a7f37", "#c62828"


def draw(parts: Sequence[tuple[str, Sequence[Measurement]]], series: Sequence[Series], folder: Path) -> list[Path]:
    """The paths of the PNG files written: one a part, one a series. Raises NotMeasured without matplotlib."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise NotMeasured("matplotlib, which draws, is not installed: it is in the group `bench`") from error
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, measurements in parts:
        finite = [one for one in measurements if 0 < one.ratio < math.inf]
        if finite:
            figure = Figure(figsize=(9, 1.1 + 0.34 * len(finite)), layout="constrained")
            _ratios(figure.add_subplot(), name, finite)
            written.append(folder / f"{name}.png")
            figure.savefig(written[-1], dpi=120)
    for one in series:
        figure = Figure(figsize=(5.6, 3.6), layout="constrained")
        _growth(figure.add_subplot(), one)
        written.append(folder / f"{re.sub(r'[^a-z0-9]+', '-', one.name.lower())}.png")
        figure.savefig(written[-1], dpi=120)
    return written


def _ratios(axes: Axes, name: str, measurements: Sequence[Measurement]) -> None:
    """Bars from the baseline, which is one; green holds, red does not."""
    places = range(len(measurements))
    ratios = [one.ratio for one in measurements]
    colors = [GREY if one.holds is None else GREEN if one.holds else RED for one in measurements]
    axes.barh(places, [ratio - 1 for ratio in ratios], left=1, color=colors, height=0.6)
    axes.set_xscale("log")
    low, high = min(*ratios, 1.0), max(*ratios, 1.0)
    axes.set_xlim(low / 1.5, high * 1.5)
    _plain_ticks(axes.xaxis, many=high / low > 300)
    axes.axvline(1, color="black", linewidth=0.8)
    for place, one in zip(places, measurements, strict=True):
        text = f"{one.ratio:.2g} x {one.baseline_name}"
        axes.text(1.01, place, text, va="center", fontsize=7, transform=axes.get_yaxis_transform())
    axes.set_yticks(places, [one.name.strip() for one in measurements], fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("ratio to the baseline of the same run", fontsize=8)
    said = ": green as it is to be, red not" if any(one.holds is not None for one in measurements) else ""
    axes.set_title(name + said, fontsize=9, loc="left")


def _plain_ticks(axis: Axis, *, many: bool) -> None:
    """Few numbers as people write them: those that matplotlib puts between decades run into each other."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0,) if many else (1.0, 2.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def _growth(axes: Axes, series: Series) -> None:
    axes.plot(series.x, series.y, "o-", label="measured")
    axes.plot(series.x, series.expected, "--", color="0.5", label=series.expected_name)
    if series.is_logarithmic:
        axes.set_xscale("log")
        axes.set_yscale("log")
        _plain_ticks(axes.xaxis, many=max(series.x) > 300 * min(series.x))
        _plain_ticks(axes.yaxis, many=max(series.y) > 300 * min(series.y))
    else:
        axes.set_ylim(bottom=0)
        axes.set_xticks(series.x)
    axes.set(xlabel=series.x_name, ylabel=series.y_name)
    axes.set_title(series.name, fontsize=9, loc="left")
    axes.grid(visible=True, which="major", color="0.9")
    axes.legend(frameon=False)
