"""What a notebook shows of models, simulations, histories and sweeps."""

from __future__ import annotations

import base64
import html
import io
import warnings
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .history import History
    from .model import Model
    from .results import Results
    from .simulation import Simulation

#: Rows that are shown at most.
_ROWS = 20


def model_html(model: Model) -> str:
    """A picture and a table of the parts."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with model.simulation(threads=1) as simulation:
            return _page(simulation, f"{model.name}: {model.dimension}D, end {model.end:.6g} s")


def simulation_html(simulation: Simulation) -> str:
    """The same of a simulation now."""
    if simulation.is_closed:
        return "<i>a closed simulation</i>"
    return _page(simulation, f"{simulation.model.name}: step {simulation.steps}, {simulation.time:.6g} of {simulation.end:.6g} s")


def history_html(history: History) -> str:
    """The first and last rows."""
    names = list(history)
    count = len(history[names[0]]) if names else 0
    shown = range(count) if count <= _ROWS else [*range(_ROWS // 2), *range(count - _ROWS // 2, count)]
    rows = [{name: float(history[name][k]) for name in names} for k in shown]
    return rows_html(rows, f"{count} rows")


def results_html(results: Results) -> str:
    """What is in the folder, and the figures of the summary."""
    figures = [{"figure": name, "value": value} for name, value in results.summary.items() if isinstance(value, (str, int, float)) and value is not None]
    return f"<div><b>{html.escape(repr(results))}</b>{rows_html(figures)}</div>"


def rows_html(rows: list[dict[str, Any]], caption: str = "") -> str:
    """A table of dicts."""
    if not rows:
        return "<i>no rows</i>"
    names = list(dict.fromkeys(name for row in rows for name in row))
    head = "".join(f"<th>{html.escape(str(name))}</th>" for name in names)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(_text(row.get(name)))}</td>" for name in names) + "</tr>" for row in rows)
    return f"<table><caption>{html.escape(caption)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _text(value: Any) -> str:
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)


def _page(simulation: Simulation, title: str) -> str:
    parts = simulation.cell_part
    names = list(dict.fromkeys(parts.tolist()))
    table = rows_html([{"part": name, "elements": int((parts == name).sum())} for name in names])
    return f"<div><b>{html.escape(title)}</b>{_picture(simulation)}{table}</div>"


def _picture(simulation: Simulation) -> str:
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    figure = Figure(figsize=(5, 3.2), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(projection="3d" if simulation.dimension == 3 else None)
    simulation.plot(ax=axes)
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=90)
    return f'<br><img src="data:image/png;base64,{base64.b64encode(out.getvalue()).decode()}" alt="the bodies"/>'
