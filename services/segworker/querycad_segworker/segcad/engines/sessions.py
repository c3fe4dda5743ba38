"""How is an ONNX graph run? In one session a process, on CUDA where there is one, with the threads it is given."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from querycad_contracts.infrastructure import processors

Feeds = Mapping[str, NDArray[Any]]

PREFERRED_PROVIDERS = ("CUDAExecutionProvider", "CPUExecutionProvider")
_DTYPES: dict[str, DTypeLike] = {
    "tensor(float)": np.float32,
    "tensor(float16)": np.float16,
    "tensor(int32)": np.int32,
    "tensor(int64)": np.int64,
    "tensor(uint8)": np.uint8,
    "tensor(bool)": np.bool_,
}


class UnknownLayout(Exception):
    """A graph that cannot be loaded or run, or whose inputs or outputs are not known; `str()` says which and why."""


@dataclass(frozen=True, slots=True)
class Port:
    """What a graph takes at one input: a fixed length for each axis, or None where any length will do."""

    shape: tuple[int | None, ...]
    dtype: DTypeLike


class Graph:
    """An ONNX graph, loaded. Not to be carried over a fork: the session's threads would be missing in the child."""

    def __init__(self, path: Path, threads: int = 0) -> None:
        """Loads the graph at `path` with its external data. `threads`: of one run; 0: the cores of this process.

        Raises UnknownLayout when the file is none, or spoilt.
        """
        import onnxruntime  # 0.2 s, and only those who look at pictures need it

        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = threads or processors()
        options.inter_op_num_threads = 1  # the graphs have no branches worth a second pool of threads
        options.log_severity_level = 3  # exporters leave unused initialisers: not the user's concern
        available = onnxruntime.get_available_providers()
        self.path = path
        providers = [name for name in PREFERRED_PROVIDERS if name in available]
        try:
            self._session = onnxruntime.InferenceSession(str(path), options, providers=providers)
        except Exception as error:  # its own errors have no base class in common
            raise UnknownLayout(f"{path} cannot be loaded: {_first_line(error)}") from error
        self.inputs = {one.name: _port(one) for one in self._session.get_inputs()}
        self.outputs = tuple(str(one.name) for one in self._session.get_outputs())

    @property
    def providers(self) -> tuple[str, ...]:
        """What does the graph run on? First choice first."""
        return tuple(self._session.get_providers())

    def run(self, feeds: Feeds, outputs: Sequence[str]) -> tuple[NDArray[Any], ...]:
        """The named outputs for these inputs, each cast to the type that the graph declares.

        Raises UnknownLayout when an input or output is missing on either side, or the graph does not fit the input.
        """
        missing = [*(self.inputs.keys() - feeds.keys()), *(name for name in outputs if name not in self.outputs)]
        if missing:
            raise UnknownLayout(f"{self.path.name} has inputs or outputs that are not known: {', '.join(missing)}")
        cast = {name: np.asarray(feeds[name], dtype=port.dtype) for name, port in self.inputs.items()}
        try:
            return tuple(self._session.run(list(outputs), cast))
        except Exception as error:
            raise UnknownLayout(f"{self.path} cannot be run: {_first_line(error)}") from error


def _first_line(error: Exception) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]


def _port(declared: Any) -> Port:
    if declared.type not in _DTYPES:
        raise UnknownLayout(f"input {declared.name} is of the unknown type {declared.type}")
    shape = tuple(length if isinstance(length, int) else None for length in declared.shape)
    return Port(shape, _DTYPES[declared.type])
