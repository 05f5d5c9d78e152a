# SPDX-License-Identifier: Apache-2.0
"""What needs no run: dispersion, wavelength clusters, an environment's lights, metrics. All of it is in `nephroid`
itself, too."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .core import _nephroid as _core
from .core._nephroid import BadInput

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .core._nephroid import Doubles, Floats


def wavelengths_nm() -> Doubles:
    """The 401 wavelengths that everything is computed on: 380, 381, ..., 780 nm."""
    return np.arange(380.0, 781.0)


class Dispersion:
    """n and k of a material by wavelength."""

    def __init__(self, core: _core.DispersionCurve) -> None:
        self._core = core

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def range_nm(self) -> tuple[float, float]:
        """That the data have; beyond it a formula goes on and a table stays as at its end."""
        low, high = self._core.range_nm()
        return low, high

    def n(self, nm: ArrayLike) -> Doubles:
        """The index of refraction, of the same shape as nm; NaN where there is none."""
        return self._core.sample(np.asarray(nm, dtype=float))[0]

    def k(self, nm: ArrayLike) -> Doubles:
        """The extinction coefficient."""
        return self._core.sample(np.asarray(nm, dtype=float))[1]

    def extrapolated(self, nm: ArrayLike) -> NDArray[np.bool_]:
        """Where nm lies outside of the data."""
        return self._core.sample(np.asarray(nm, dtype=float))[2].astype(bool)

    def __repr__(self) -> str:
        return f"<nephroid.Dispersion {self.name!r}>"


def dispersion(material: str | os.PathLike[str]) -> Dispersion:
    """Of a refractiveindex.info file, or of a shipped material: "N-BK7"."""
    return Dispersion(_core.load_dispersion(str(material)))


@dataclass(frozen=True)
class Cluster:
    wavelengths_nm: NDArray[np.int32]  #: by falling n
    n_mean: float
    theta_deg2: float  #: change of the refraction angle inside, over all angles of incidence


@dataclass(frozen=True)
class Clusters:
    method: str
    threshold_deg: float
    total_theta_deg2: float
    clusters: list[Cluster]


def clusters(material: Dispersion | str | ArrayLike, threshold_deg: float = 0.1, method: str = "optimal") -> Clusters:
    """Which of the 401 wavelengths may share a path.

    material: a Dispersion, its name, or n for each of wavelengths_nm(). threshold_deg: the change of angle that is
    allowed in a cluster, in the mean. method: "optimal" or "thesis".
    """
    if isinstance(material, str):
        material = dispersion(material)
    n = material.n(wavelengths_nm()) if isinstance(material, Dispersion) else np.asarray(material, dtype=float)
    made = _core.clusters(n, threshold_deg, method)
    return Clusters(made["method"], made["threshold_deg"], made["total_theta_deg2"],
                    [Cluster(**one) for one in made["clusters"]])


@dataclass(frozen=True)
class Lights:
    """An environment as directional lights."""

    directions: Doubles  #: [light][3], unit, where the light comes from
    flux: Doubles  #: [light][3], radiance times solid angle, linear sRGB
    solid_angles_sr: Doubles
    #: [light]: face (+x, -x, +y, -y, +z, -z), x0, y0, x1, y1 in texels of the cube, half open
    rectangles: NDArray[np.int32]
    cube_size: int


def segment(environment: ArrayLike | str | os.PathLike[str], lights: int, method: str = "variance") -> Lights:
    """environment: a picture's file, or height x width x 3 texels; the centre column looks along -z, the top row along
    +y.

    lights: at least 6. method: "variance" or "thesis".
    """
    is_file = isinstance(environment, (str, os.PathLike))
    texels = read_picture(environment) if is_file else _linear(environment, "environment")
    return Lights(**_core.segment(texels, lights, method))


def read_picture(file: str | os.PathLike[str]) -> Floats:
    """Linear sRGB, height x width x 3: floats as they are, integers decoded."""
    return _core.read_picture(str(file))


def _linear(values: ArrayLike, name: str) -> Floats:
    """As the core takes it. Unsigned integers are a picture's codes, and no light."""
    array = np.asarray(values)
    if array.dtype.kind == "u":
        raise BadInput(f"{name}: is of {array.dtype}, which is not linear; expected linear sRGB; decode it to linear "
                       f"floats first, "
                       "as nephroid.read_picture does")
    if array.dtype.kind not in "fib":
        raise BadInput(f"{name}: is of {array.dtype}; expected real numbers, linear sRGB; make floats of it")
    return array.astype(np.float32, copy=False)


def compare(picture: ArrayLike, reference: ArrayLike, mask: ArrayLike | None = None) -> dict[str, float]:
    """All metrics of `nephroid compare`, of linear sRGB pictures of one size. mask: height x width, pixels that
    count."""
    return _core.compare(_linear(picture, "picture"), _linear(reference, "reference"),
                         None if mask is None else np.asarray(mask, dtype=bool))
