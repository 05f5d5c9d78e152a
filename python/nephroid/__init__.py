# SPDX-License-Identifier: Apache-2.0
"""Caustics from Python: presets, runs, their pictures as arrays, and the optics behind them.

    import nephroid
    preset = nephroid.Preset("first-light").set("scene.camera.resolution", [256, 256]).set("stop.passes", 8)
    with nephroid.start(preset) as run:
        run.wait()
        picture = run.picture()             # height x width x 3, linear sRGB, where the core has it
        run.save("out/first-light")

What is wrong with a call raises BadInput, a ValueError, with one line that says where, what and what to do; all else
that fails raises Error, a RuntimeError.
"""
from __future__ import annotations

import atexit as _atexit
import json as _json
import os as _os
import time as _time
import weakref as _weakref
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence

from .core import _nephroid as _core
from .core._nephroid import BadInput, Error
from .optics import (Cluster, Clusters, Dispersion, Lights, _linear, clusters, compare, dispersion, read_picture,
                     segment, wavelengths_nm)

if TYPE_CHECKING:
    from numpy import uint8
    from numpy.typing import ArrayLike, NDArray

    from .core._nephroid import Doubles, Floats

__version__: str = _core.version
__all__ = ["BadInput", "Cluster", "Clusters", "Dispersion", "Error", "Lights", "Preset", "Run", "Spectrum", "clusters",
           "compare", "devices",
           "dispersion", "presets", "read_picture", "run", "schema", "segment", "start", "sweep", "wavelengths_nm"]


# Presets


def _overrides(values: Mapping[str, Any]) -> list[str]:
    """As `nephroid run --set` has them. NumPy's numbers and arrays become those of JSON."""
    if not isinstance(values, Mapping):
        raise BadInput(f"values: expected a dict such as {{'seed': 3}}, not {type(values).__name__}")
    overrides = []
    for path, value in values.items():
        try:
            overrides.append(f"{path}={_json.dumps(value, default=lambda of_numpy: of_numpy.tolist())}")
        except (AttributeError, TypeError, ValueError):
            raise BadInput(f"{path}: expected what JSON can hold: numbers, text, lists and dicts; not "
                           f"{type(value).__name__}") from None
    return overrides


class Preset:
    """The whole state of a run. Immutable: set() gives another one.

    name: a file, or the name of a shipped preset ("first-light"); both also without ".json". Throws BadInput as reading
    does.
    """

    def __init__(self, name: str | _os.PathLike[str], values: Mapping[str, Any] | None = None) -> None:
        if not isinstance(name, (str, _os.PathLike)):
            raise BadInput(f"Preset: expected the name of a preset or its file, not {type(name).__name__}; JSON as "
                           f"text goes to Preset.from_json")
        read = _core.read_presets(str(name), _overrides(values or {}))
        if len(read) > 1:
            raise BadInput(f"{name}: is a sweep of {len(read)} runs; expected one run; take nephroid.sweep('{name}')")
        self._core = read[0]

    @classmethod
    def _of(cls, core: _core.Preset) -> Preset:
        preset = cls.__new__(cls)
        preset._core = core
        return preset

    @classmethod
    def from_json(cls, text: str, source: str = "preset") -> Preset:
        """source: what messages call it; files are looked for beside it."""
        return cls._of(_core.parse_preset(text, source, []))

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def engine(self) -> str:
        """"spectral", "environment" or "inverse"."""
        return self._core.engine

    def set(self, path: str, value: Any) -> Preset:
        """The preset with another value: set("scene.lights.0.power_w", 2). path: as for `nephroid run --set`. value:
        what JSON can hold."""
        return self.with_values({path: value})

    def with_values(self, values: Mapping[str, Any]) -> Preset:
        """The same for several at once: what they are together is checked, not each alone."""
        return self._of(_core.parse_preset(self._core.json(), self._core.source, _overrides(values)))

    def get(self, path: str) -> Any:
        """A value by the same path; the preset as a dict where it is empty."""
        value: Any = _json.loads(self._core.json())
        for key in path.split(".") if path else []:
            try:
                value = value[int(key)] if isinstance(value, list) else value[key]
            except (KeyError, IndexError, ValueError, TypeError):
                raise BadInput(f"{path}: the preset has no such field; expected one of nephroid.schema()") from None
        return value

    __getitem__ = get

    def to_json(self) -> str:
        """Complete: every field is there."""
        return self._core.json()

    def plan(self) -> dict[str, Any]:
        """What would run, what is left out and why, and the memory that it takes."""
        plan: dict[str, Any] = _json.loads(_core.plan_json(self._core))
        return plan

    def displayed(self, picture: ArrayLike) -> NDArray[uint8]:
        """The bytes that image.png has of a linear picture, by "display": height x width x 3."""
        return _core.displayed(self._core, _linear(picture, "picture"))

    def __repr__(self) -> str:
        return f"<nephroid.Preset {self.name!r}, engine {self.engine}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Preset) and self.to_json() == other.to_json()

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __reduce__(self) -> tuple[Any, ...]:
        return Preset.from_json, (self.to_json(), self._core.source)


def sweep(name: str | _os.PathLike[str]) -> list[Preset]:
    """The runs of a preset with a sweep, in its order; of another preset, that one."""
    return [Preset._of(core) for core in _core.read_presets(str(name), [])]


def presets() -> dict[str, str]:
    """The shipped presets, each with a line on what it is."""
    return {name: description for name, description, _ in _core.shipped_presets()}


def schema() -> dict[str, Any]:
    """The JSON schema of presets: every field, its unit and range."""
    made: dict[str, Any] = _json.loads(_core.schema())
    return made


def devices() -> list[dict[str, Any]]:
    """The OpenCL devices."""
    return _core.devices()


# Runs


@dataclass(frozen=True)
class Spectrum:
    """What a pixel shows, by layer: W m^-2 sr^-1 nm^-1, one value for each of wavelengths_nm()."""

    pixel: tuple[int, int]
    layers: dict[str, Doubles]
    notes: list[str]


_runs: _weakref.WeakSet[Run] = _weakref.WeakSet()


class Run:
    """A run that works in the background; start() gives one. Leaving a `with` block stops it and frees its device.

    folder: where it keeps the files of `nephroid run`, a checkpoint among them; None: nowhere.

    Arrays show the core's memory, without a copy, and cannot be written to. They stay as they are, however the run goes
    on.
    """

    def __init__(self, preset: Preset, device: str = "", folder: str | _os.PathLike[str] | None = None,
                 resume: bool = False) -> None:
        if resume and folder is None:
            raise BadInput("resume: there is nothing to go on from without a folder; expected folder='out/NAME' too")
        self.preset = preset
        self.folder = folder
        self._core = _core.Run(preset._core, device, "" if folder is None else str(folder), resume)
        _runs.add(self)

    # How it goes

    @property
    def state(self) -> str:
        """"preparing", "running", "paused", "finished", "stopped" or "failed"."""
        return self._core.state()

    @property
    def running(self) -> bool:
        """Whether more is to come."""
        return self.state in ("preparing", "running", "paused")

    @property
    def doing(self) -> str:
        """What it prepares: "reading bunny.obj"; empty once it works."""
        return self._core.doing()

    @property
    def progress(self) -> float:
        """0..1"""
        return self._core.progress().fraction

    @property
    def passes(self) -> int:
        """Done; for the inverse engine sweeps over the facets."""
        return self._core.progress().step

    @property
    def work_seconds(self) -> float:
        """Of work, without start-up."""
        return self._core.progress().work_seconds

    @property
    def error(self) -> float | None:
        """The newest error that it has measured, in the unit of stop.metric: against the reference, else its own
        estimate."""
        shown = self._core.snapshot()
        values = shown.history().get(shown.error_column()) if shown else None
        return float(values[-1]) if values is not None and len(values) else None

    @property
    def notes(self) -> list[str]:
        """What the plan and the pictures have to say."""
        shown = self._core.snapshot()
        return self._core.notes() + (shown.warnings if shown else [])

    def wait(self, seconds: float | None = None) -> Run:
        """Until it is over, or for so long. Raises what made it fail. Ctrl-C raises KeyboardInterrupt at once, and the
        run goes on."""
        end = None if seconds is None else _time.monotonic() + seconds
        pause = 0.001
        while self.running and (end is None or _time.monotonic() < end):
            _time.sleep(pause)
            pause = min(0.02, 2 * pause)
        self._core.raise_failure()
        return self

    def watch(self, every: float = 0.5) -> Iterator[Run]:
        """for run in start(preset).watch(): ...: once every so many seconds, and once when it is over."""
        while self.running:
            self.wait(every)
            yield self

    def pause(self, paused: bool = True) -> None:
        self._core.pause(paused)

    def stop(self) -> None:
        """After the step in hand. What there is can still be looked at and saved."""
        self._core.stop()

    def close(self) -> None:
        """Stops it and frees the device's memory. Arrays stay."""
        self._core.close()

    def __enter__(self) -> Run:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # What there is

    def _snapshot(self) -> _core.Snapshot:
        while (shown := self._core.snapshot()) is None:
            if not self.running:
                self._core.raise_failure()
                raise Error("the run was stopped before its first picture; expected one that goes on; start it again")
            _time.sleep(0.005)
        return shown

    def picture(self) -> Floats:
        """The newest picture: height x width x 3, linear sRGB over the preset's white, row 0 at the top. Waits for the
        first one."""
        return self._snapshot().picture()

    def layers(self) -> dict[str, Floats]:
        """The same by kind of light; picture() is their sum."""
        return self._snapshot().layers()

    def pictures(self) -> dict[str, Floats]:
        """Those beside it: "receiver_1", "target_1", ... of the inverse engine, "spheres" of the environment's."""
        return self._snapshot().pictures()

    def error_draw(self) -> Floats | None:
        """A draw of the picture's own error, whose covariance is the picture's; None where none is kept."""
        return self._snapshot().error_draw()

    def history(self) -> dict[str, Doubles]:
        """Error against time: "seconds", "work", ... and a column for each metric."""
        return self._snapshot().history()

    def curves(self) -> dict[str, dict[str, Doubles]]:
        """Other figures over the work: "cost" of the inverse engine."""
        return self._snapshot().curves()

    def figures(self) -> dict[str, dict[str, float]]:
        """What run.json has, by group: ["energy"]["emitted_w"]."""
        return self._snapshot().figures()

    def meters(self) -> dict[str, dict[str, Any]]:
        """What the preset's meters show so far, by name: what measure.json has, and "cells": ["W/m^2"]["value"], "low"
        and "high", a value a cell, ["lx"] alike, and their ["place"]. Empty before the first reading."""
        meters = self._snapshot().meters()
        return {name: {**_json.loads(text), "cells": cells} for name, (text, cells) in meters.items()}

    def phases(self) -> dict[str, float]:
        """Seconds by kind of work."""
        return dict(self._snapshot().phases)

    def spectrum(self, column: int, row: int) -> Spectrum:
        """Of a pixel. Raises BadInput where the run keeps none; of the spectral engine those with "spectral.relight"
        true do."""
        height, width, _ = self.picture().shape
        if not (0 <= column < width and 0 <= row < height):
            raise BadInput(f"spectrum: there is none of the pixel {column}, {row}; expected one of {width} x {height}")
        self._core.watch((column, row))
        for _ in range(2000):
            made = self._core.spectrum()
            if made is not None and tuple(made.pixel) == (column, row):
                if made.why_not:
                    raise BadInput(f"spectrum: {made.why_not}")
                return Spectrum((column, row), made.layers(), list(made.notes))
            _time.sleep(0.005)
        raise BadInput(f"spectrum: there is none of the pixel {column}, {row}; expected one of the picture, of a run "
                       f"that keeps spectra")

    def save(self, folder: str | _os.PathLike[str]) -> None:
        """The files that `nephroid run` writes, but for a checkpoint."""
        self._core.save(str(folder))

    def __repr__(self) -> str:
        try:
            return f"<nephroid.Run of {self.preset.name!r}, {self.state}, {100 * self.progress:.0f} %>"
        except Error:  # closed, or another process'
            return f"<nephroid.Run of {self.preset.name!r}, closed>"


@_atexit.register
def _close_all() -> None:
    for one in list(_runs):
        try:
            one.close()
        except Error:
            pass


def start(preset: Preset | str, device: str = "", folder: str | _os.PathLike[str] | None = None,
          resume: bool = False) -> Run:
    """Begins a run and returns at once. device: an index or a part of a name, of devices(). folder: keeps the files of
    `nephroid run` there, a checkpoint among them, also of a run that is stopped or closed. resume: goes on from the
    folder's checkpoint, with the same bits as a run that was never stopped; without one it begins."""
    return Run(preset if isinstance(preset, Preset) else Preset(preset), device, folder, resume)


def run(preset: Preset | str, device: str = "", folder: str | _os.PathLike[str] | None = None,
        resume: bool = False) -> Run:
    """Runs to the preset's own stop. Ctrl-C ends the run. folder, resume: as for start()."""
    one = start(preset, device, folder, resume)
    try:
        return one.wait()
    except BaseException:
        one.close()
        raise
