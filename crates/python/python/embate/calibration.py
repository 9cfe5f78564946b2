"""Parameters of a model that make it follow what was measured: nonlinear least squares (scipy), the runs of a step beside each other."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Union

import numpy as np

from . import _embate
from ._optional import needed
from .errors import RunError
from .errors import Warning as EmbateWarning
from .model import Model
from .progress import bar
from .simulation import Simulation
from .sweep import Table, sweep

#: A number, or a curve: its points x and y.
Measured = Union[float, "tuple[Any, Any]"]
#: What is compared: a column of the history, (column of x, column of y), or a name that ``measure`` returns.
Name = Union[str, "tuple[str, str]"]
Array = np.ndarray[Any, Any]


@dataclass
class Calibration:
    """What a calibration has found; made by :func:`embate.calibrate`."""

    #: Path of the key -> the value found, SI.
    parameters: dict[str, float]
    #: Path of the key -> standard error of the value, as far as the fit is linear near it; infinite where the measurement does not depend on it.
    errors: dict[str, float]
    #: Correlation of the values, in the order of the parameters: near 1 or -1 where only a combination of two is known.
    correlation: Array
    #: The model with the values found.
    model: Model
    #: Root mean square of the differences, as a fraction of the largest measured value of each curve.
    residual: float
    #: The same before.
    residual_start: float
    #: Every run: values of the parameters, ``residual``, ``error``.
    table: Table
    #: What was measured.
    measured: dict[Name, Measured]
    #: The same of the model found, at the measured x.
    fitted: dict[Name, Measured]
    #: The same of the model at the start.
    start: dict[Name, Measured]
    #: Parameters that ended at one of their bounds.
    at_bounds: list[str]
    #: Whether the search came to an end by itself, and what it says.
    success: bool
    message: str = field(default="")

    def plot(self, ax: Any = None) -> Any:
        """Draws measured and fitted curves (matplotlib); returns the axes, one for each curve."""
        plt = needed("matplotlib.pyplot", "plot")
        curves = [name for name, value in self.measured.items() if isinstance(value, tuple)]
        if not curves:
            raise ValueError("there is no curve to draw: numbers were measured")
        axes = [ax] if ax is not None else plt.subplots(len(curves), 1, squeeze=False, layout="constrained")[1][:, 0]
        for name, own in zip(curves, axes):
            x, y = self.measured[name]  # type: ignore[misc]
            own.plot(x, y, "k.", label="measured")
            own.plot(x, self.start[name][1], "0.7", label="start")  # type: ignore[index]
            own.plot(x, self.fitted[name][1], label="found")  # type: ignore[index]
            own.set_xlabel(name[0] if isinstance(name, tuple) else "time (s)")
            own.set_ylabel(name[1] if isinstance(name, tuple) else name)
            own.legend()
        return axes[0] if len(axes) == 1 else axes

    def __repr__(self) -> str:
        values = ", ".join(f"{path} = {value:.6g} ± {self.errors[path]:.2g}" for path, value in self.parameters.items())
        return f"<embate calibration: {values}; residual {100 * self.residual:.3g} % after {100 * self.residual_start:.3g} %, {len(self.table)} runs>"


def calibrate(
    model: Model,
    measured: Mapping[Any, Any],
    parameters: Mapping[str, Sequence[float]],
    *,
    measure: Callable[[Simulation], Mapping[Any, Any]] | None = None,
    weights: Mapping[Any, float] | None = None,
    until: float | None = None,
    step: float = 0.01,
    tolerance: float = 1e-3,
    max_runs: int = 200,
    workers: int | None = None,
    progress: bool = False,
) -> Calibration:
    """Finds values of keys with which a model follows what was measured.

    The sum of the squared differences becomes as small as can be, by a trust-region method within the bounds (``scipy.optimize.least_squares``); derivatives are differences between runs, which go
    beside each other.

    Parameters
    ----------
    model : embate.Model
        The model.
    measured : dict
        What was measured. ``{"tip.x": (times, values)}`` is a column of the history over time, ``{("punch.y", "obstacle.force_y[die]"): (x, y)}`` a column over another one, a number the last value
        of a column. With ``measure`` the names are those that it returns. Units are SI. Curves are followed in their order, as by ``embate fit``: the value of a point is taken where the run
        passes its x at or after the point before, so loading is compared with loading and unloading with unloading; going back by less than 1 % of the measured range of x turns no curve. A
        run that does not come to a point counts as one that fails.
    parameters : dict
        Path of a key -> (lowest, highest) or (lowest, first, highest), SI numbers: ``{"material.steel.yield": (200e6, 600e6)}``.
    measure : callable, optional
        Gets the simulation at its end; returns a number or a curve (x, y) for each name.
    weights : dict, optional
        How much each counts, 1 where it is left out. Differences are fractions of the largest measured value, the mean over a curve counts as much as a number.
    until : float, optional
        Time at which runs end, s.
    step : float
        Steps of the differences, as a part of the range between the bounds: large enough that noise of the runs does not show.
    tolerance : float
        Relative change of the values, or of the sum of squares, at which the search ends.
    max_runs : int
        So many runs at most, about.
    workers : int, optional
        Runs at a time; None: one for each processor. Changes no result.
    progress : bool
        Shows how far it is.

    Returns
    -------
    Calibration

    Raises
    ------
    embate.RunError
        The model fails with the first values, or does not come to a measured point. Later failures count as bad fits.
    """
    optimize = needed("scipy.optimize", "calibrate")
    if not isinstance(model, Model):
        raise TypeError(f"model is a {type(model).__name__}; an embate.Model is wanted")
    search = _Search(model, _measured(measured), _bounds(parameters), measure, dict(weights or {}), until, workers)
    search.check(step, tolerance, max_runs)
    search.shown = bar(max_runs, "run") if progress else None
    try:
        first = search.residuals(search.first)
        found = optimize.least_squares(
            search.residuals,
            search.first,
            jac=lambda at: search.jacobian(at, step),
            bounds=(np.zeros(len(search.first)), np.ones(len(search.first))),
            x_scale="jac",
            xtol=tolerance,
            ftol=tolerance,
            gtol=1e-10,
            max_nfev=max(1, max_runs // (len(search.first) + 1)),
        )
    finally:
        if search.shown is not None:
            search.shown.close()
    return search.result(found, first)


def _measured(measured: Mapping[Any, Any]) -> dict[Name, Measured]:
    if not isinstance(measured, Mapping) or not measured:
        raise TypeError("measured is a dict of names and what was measured, {'tip.x': (times, values)} for example")
    out: dict[Name, Measured] = {}
    for name, value in measured.items():
        if not isinstance(value, (tuple, list)) and np.ndim(value) == 0:
            number = float(value)
            if not math.isfinite(number):
                raise ValueError(f"measured[{name!r}] is {number}: numbers are finite")
            out[name] = number
            continue
        if not (isinstance(value, (tuple, list)) and len(value) == 2):
            raise TypeError(f"measured[{name!r}]: a number, or a curve as (x, y) is wanted")
        x, y = (np.asarray(one, float) for one in value)
        if x.ndim != 1 or x.shape != y.shape or not len(x):
            raise ValueError(f"measured[{name!r}]: x has the shape {x.shape} and y {y.shape}; as many of both are wanted")
        if not (np.isfinite(x).all() and np.isfinite(y).all()):
            raise ValueError(f"measured[{name!r}] has values that are not finite")
        out[name] = (x, y)
    return out


def _bounds(parameters: Mapping[str, Sequence[float]]) -> dict[str, tuple[float, float, float]]:
    """Lowest, first, highest."""
    if not isinstance(parameters, Mapping) or not parameters:
        raise TypeError("parameters is a dict of paths and their bounds, {'material.steel.yield': (200e6, 600e6)} for example")
    out = {}
    for path, given in parameters.items():
        try:
            values = [float(value) for value in given]
        except (TypeError, ValueError):
            raise TypeError(f"parameters[{path!r}] is {given!r}; two or three numbers in SI units are wanted") from None
        if len(values) == 2:
            low, high = values
            # Of what spans decades the middle is that of the logarithms.
            values = [low, math.sqrt(low * high) if low > 0 and high > 10 * low else 0.5 * (low + high), high]
        if len(values) != 3 or not all(map(math.isfinite, values)) or not values[0] <= values[1] <= values[2] or values[0] == values[2]:
            raise ValueError(f"parameters[{path!r}] is {given!r}; (lowest, highest) or (lowest, first, highest) are wanted, in this order")
        out[path] = (values[0], values[1], values[2])
    return out


class _Search:
    """Values between 0 and 1 for the bounds, and the differences that come from them."""

    def __init__(
        self,
        model: Model,
        measured: dict[Name, Measured],
        bounds: dict[str, tuple[float, float, float]],
        measure: Callable[[Simulation], Mapping[Any, Any]] | None,
        weights: dict[Any, float],
        until: float | None,
        workers: int | None,
    ) -> None:
        self.model, self.measured, self.bounds, self.own, self.weights = model._for_threads(), measured, bounds, measure, weights
        self.until, self.workers = until, workers
        self.first = np.array([(first - low) / (high - low) for low, first, high in bounds.values()])
        self.known: dict[tuple[float, ...], tuple[Array, dict[Name, Measured]]] = {}
        self.rows = Table()
        self.worst = 1.0
        self.shown: Any = None
        for name in weights:
            if name not in measured:
                raise ValueError(f"weights: {name!r} was not measured")

    def check(self, step: float, tolerance: float, max_runs: int) -> None:
        """What can be wrong before a run."""
        for name, value in (("step", step), ("tolerance", tolerance)):
            if not 0 < value < 0.5:
                raise ValueError(f"{name} is {value}; it is between 0 and 0.5")
        if max_runs < 1:
            raise ValueError(f"max_runs is {max_runs}; at least one run is needed")
        self.model.with_set(self.values(self.first)).check()

    def values(self, at: Array) -> dict[str, float]:
        """Values of the keys."""
        return {path: float(low + share * (high - low)) for share, (path, (low, _, high)) in zip(at, self.bounds.items())}

    def runs(self, places: list[Array]) -> list[Array]:
        """Differences at several places; a place is computed once."""
        new = list(dict.fromkeys(tuple(place.tolist()) for place in places if tuple(place.tolist()) not in self.known))
        if new:
            rows = [self.values(np.array(place)) for place in new]
            vary = {path: [row[path] for row in rows] for path in self.bounds}
            table = sweep(self.model, vary, workers=self.workers, measure=lambda simulation: {"seen": self.seen(simulation)}, until=self.until, together=True)
            for place, row in zip(new, table):
                self.take(place, row)
        return [self.known[tuple(place.tolist())][0] for place in places]

    def take(self, place: tuple[float, ...], row: dict[str, Any]) -> None:
        """Differences of one run; one that has failed is worse than all others."""
        seen = row.pop("seen", None)
        if seen is None:
            if not self.known:
                raise RunError(f"with the first values the model fails: {row['error']}")
            size = len(next(iter(self.known.values()))[0])
            differences = np.full(size, 2.0 * self.worst)
        else:
            differences = np.concatenate([self.difference(name, seen[name]) for name in self.measured])
            self.worst = max(self.worst, float(np.abs(differences).max()))
        self.known[place] = (differences, seen or {})
        self.rows.append({**{path: row[path] for path in self.bounds}, "residual": self.size(differences), "error": row["error"]})
        if self.shown is not None:
            self.shown.to(len(self.rows), f"residual {100 * min(float(one['residual']) for one in self.rows):.3g} %")

    def seen(self, simulation: Simulation) -> dict[Name, Measured]:
        """What was measured, of a simulation; curves at the measured x."""
        found = self.own(simulation) if self.own is not None else None
        history = simulation.history
        out: dict[Name, Measured] = {}
        for name, wanted in self.measured.items():
            if found is not None and name not in found:
                raise KeyError(f"measure returns no {name!r}; it returns {', '.join(map(repr, found))}")
            if isinstance(wanted, tuple):
                pair = found[name] if found is not None else _columns(history, name)
                out[name] = (wanted[0], _at(wanted[0], pair, name, found is None))
            else:
                out[name] = float(found[name] if found is not None else history[str(name)][-1])
        return out

    def difference(self, name: Name, seen: Measured) -> Array:
        """Weighted differences, as fractions of the largest measured value."""
        wanted, weight = self.measured[name], math.sqrt(self.weights.get(name, 1.0))
        if isinstance(wanted, tuple) and isinstance(seen, tuple):
            size = float(np.abs(wanted[1]).max()) or 1.0
            return np.asarray(weight * (seen[1] - wanted[1]) / size / math.sqrt(len(wanted[1])))
        return np.array([weight * (float(seen) - float(wanted)) / (abs(float(wanted)) or 1.0)])  # type: ignore[arg-type]

    def size(self, differences: Array) -> float:
        """Root mean square over what was measured."""
        return math.sqrt(float((differences**2).sum()) / len(self.measured))

    def residuals(self, at: Array) -> Array:
        """Differences at a place."""
        return self.runs([np.asarray(at, float)])[0]

    def jacobian(self, at: Array, step: float) -> Array:
        """Derivatives of the differences, by one run more for each parameter, away from the nearer bound."""
        places = []
        for k in range(len(at)):
            beside = np.array(at, float)
            beside[k] += step if beside[k] + step <= 1.0 else -step
            places.append(beside)
        here, *others = self.runs([np.asarray(at, float), *places])
        columns = [(other - here) / (place[k] - at[k]) for k, (other, place) in enumerate(zip(others, places))]
        return np.column_stack(columns)

    def result(self, found: Any, first: Array) -> Calibration:
        """What comes of it."""
        values, jacobian = self.values(found.x), np.asarray(found.jac)
        differences, fitted = self.known[tuple(np.asarray(found.x, float).tolist())]
        errors, correlation = self.uncertainty(jacobian, differences)
        at_bounds = [path for path, share in zip(self.bounds, found.x) if share < 1e-3 or share > 1 - 1e-3]
        blind = [path for path, error in errors.items() if math.isinf(error)]
        if blind:
            warnings.warn(f"what was measured does not depend on {', '.join(blind)}", EmbateWarning, stacklevel=3)
        return Calibration(
            parameters=values,
            errors=errors,
            correlation=correlation,
            model=self.model.with_set(values),
            residual=self.size(differences),
            residual_start=self.size(first),
            table=self.rows,
            measured=self.measured,
            fitted=fitted,
            start=self.known[tuple(self.first.tolist())][1],
            at_bounds=at_bounds,
            success=bool(found.status > 0),
            message=str(found.message),
        )

    def uncertainty(self, jacobian: Array, differences: Array) -> tuple[dict[str, float], Array]:
        """Standard errors s² (JᵀJ)⁻¹ with s² the sum of squares over the degrees of freedom, and correlations."""
        count = jacobian.shape[1]
        spans = np.array([high - low for low, _, high in self.bounds.values()])
        _, sizes, directions = np.linalg.svd(jacobian, full_matrices=False)
        small = sizes <= 1e-10 * sizes.max(initial=0.0) if len(sizes) else np.ones(count, bool)
        inverse = np.where(small, 0.0, 1.0 / np.where(small, 1.0, sizes)) ** 2
        covariance = directions.T @ (inverse[:, None] * directions)
        freedom = max(len(differences) - count, 1)
        covariance *= float((differences**2).sum()) / freedom
        deviation = np.sqrt(np.diag(covariance))
        # A direction along which nothing changes.
        lost = (np.abs(directions[small]) > 1e-3).any(axis=0) if small.any() else np.zeros(count, bool)
        errors = {path: math.inf if gone else float(size * span) for path, gone, size, span in zip(self.bounds, lost, deviation, spans)}
        outer = np.outer(deviation, deviation)
        correlation = np.divide(covariance, outer, out=np.eye(count), where=outer > 0)
        return errors, correlation


def _columns(history: Any, name: Name) -> tuple[Array, Array]:
    x, y = name if isinstance(name, tuple) else ("time", name)
    return history[x], history[y]


def _at(wanted: Array, pair: Any, name: Name, is_of_history: bool) -> Array:
    """A simulated curve at the measured x, followed in its order."""
    x, y = (np.asarray(one, float) for one in pair)
    if x.shape != y.shape or x.ndim != 1 or len(x) < 2:
        raise ValueError(f"{name!r}: the simulated curve has the shapes {x.shape} and {y.shape}")
    if isinstance(name, str) and is_of_history and wanted.max() > x[-1] * (1 + 1e-6):
        raise ValueError(f"{name!r} was measured until {wanted.max():.6g} s, and the run ends at {x[-1]:.6g} s; give it a later end")
    try:
        return np.asarray(_embate.followed(x.tolist(), y.tolist(), wanted.tolist()))
    except ValueError as error:
        raise RunError(f"{name!r}: {error}") from None
