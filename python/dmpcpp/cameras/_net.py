"""A network that is run: by LiteRT where it is installed, else by OpenCV, which takes five times as long."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from dmpcpp._quiet import quiet
from dmpcpp.errors import MissingDependency

__all__ = ["Image", "Net", "load_net"]

Image = NDArray[np.float32]
Net = Callable[[Image], list[Image]]
"""Called with a picture (H, W, 3), RGB from 0 to 1; returns the outputs in the order of the names asked for."""


def load_net(path: Path, outputs: tuple[str, ...], runtime: str | None = None) -> Net:
    """Return a network.

    Parameters
    ----------
    path : Path
        Of a TFLite file.
    outputs : tuple of str
        Names of the outputs that are wanted.
    runtime : {"litert", "opencv"}, optional
        Default: LiteRT where it is installed.

    Raises
    ------
    MissingDependency
        Neither is installed.
    """
    if runtime != "opencv":
        try:
            return _litert(path, outputs)
        except ImportError:
            if runtime == "litert":
                raise MissingDependency('LiteRT is not installed: pip install "dmpcpp[cameras]".') from None
    return _opencv(path, outputs)


def _litert(path: Path, outputs: tuple[str, ...]) -> Net:
    from ai_edge_litert.interpreter import Interpreter

    with quiet():
        interpreter = Interpreter(str(path), num_threads=1)
        interpreter.allocate_tensors()
    place = interpreter.get_input_details()[0]["index"]
    index = {each["name"]: each["index"] for each in interpreter.get_output_details()}

    def run(image: Image) -> list[Image]:
        interpreter.set_tensor(place, image[None])
        interpreter.invoke()
        return [interpreter.get_tensor(index[name])[0] for name in outputs]

    return run


def _opencv(path: Path, outputs: tuple[str, ...]) -> Net:
    from dmpcpp.cameras._opencv import opencv

    dnn = opencv().dnn
    classic = {"engine": dnn.ENGINE_CLASSIC} if hasattr(dnn, "ENGINE_CLASSIC") else {}  # of OpenCV 5: all outputs
    net = dnn.readNetFromTFLite(str(path), **classic)

    def run(image: Image) -> list[Image]:
        net.setInput(np.ascontiguousarray(image.transpose(2, 0, 1))[None])
        return [np.asarray(each)[0] for each in net.forward(list(outputs))]

    return run
