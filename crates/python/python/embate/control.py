"""Arguments of what changes a simulation between two steps: which nodes, and a vector for each of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .simulation import Simulation


def node_numbers(simulation: Simulation, where: Any) -> np.ndarray[Any, Any]:
    """Numbers of the nodes of a part, a side or a group, or those that are given: an array of numbers, or a mask with a value for each node."""
    native = simulation._native
    if isinstance(where, str):
        data = native.nodes(where)
        if data is None:
            parts = ", ".join(simulation.model.parts)
            raise ValueError(f"where: there is no part, side or group {where!r}; parts are {parts}, a side is PART.SIDE")
        return np.frombuffer(data, np.uint32)
    count = len(native.positions()) // (8 * native.dimension)
    given = np.atleast_1d(np.asarray(where))
    if given.dtype == np.bool_:
        if given.shape != (count,):
            raise ValueError(f"where: a mask of shape {given.shape} is given; there are {count} nodes")
        return np.flatnonzero(given).astype(np.uint32)
    if given.size == 0:
        return np.empty(0, np.uint32)
    if given.dtype.kind not in "iu":
        raise TypeError(f"where: an array of {given.dtype} is given; the name of a part, side or group, numbers of nodes or a mask are wanted")
    if given.ndim != 1:
        raise ValueError(f"where: numbers of nodes have one dimension, these have the shape {given.shape}")
    if given.min() < 0 or given.max() >= count:
        wrong = given[(given < 0) | (given >= count)][0]
        raise ValueError(f"where: there is no node {wrong}; nodes are numbered from 0 to {count - 1}")
    if len(np.unique(given)) != len(given):
        raise ValueError("where: a node is named twice")
    return given.astype(np.uint32)


def vectors(value: Any, count: int, dimension: int, name: str, unit: str, *, is_shared: bool = False) -> np.ndarray[Any, Any]:
    """A vector for each of ``count`` nodes: from as many, or from one, which all have or (``is_shared``) which is all of them together."""
    given = np.asarray(value)
    if given.dtype.kind not in "iuf":
        raise TypeError(f"{name}: an array of {given.dtype} is given; numbers in {unit} are wanted")
    if given.shape == (dimension,):
        whole = np.broadcast_to(given.astype(np.float64), (count, dimension))
        given = whole / max(count, 1) if is_shared else whole
    elif given.shape != (count, dimension):
        raise ValueError(f"{name}: an array of shape {given.shape} is given; ({dimension},) or ({count}, {dimension}) is wanted")
    given = np.ascontiguousarray(given, np.float64)
    if not np.isfinite(given).all():
        row = int(np.flatnonzero(~np.isfinite(given).all(axis=1))[0])
        raise ValueError(f"{name}: {given[row].tolist()} (the vector {row}) is not finite")
    return given
