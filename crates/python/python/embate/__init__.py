"""embate: explicit finite elements for contact and impact between flexible bodies in large deformation.

>>> import embate
>>> model = embate.Model("examples/tube-plate")
>>> simulation = model.simulation()
>>> simulation.run(progress=True)
>>> simulation.history["tube.vy"], simulation.state.stress
"""

from ._embate import __version__
from .calibration import Calibration, calibrate
from .errors import Error, FileError, InternalError, ModelError, RunError, StateError, Warning
from .history import History
from .mesh import Mesh
from .model import Model
from .results import Results, results
from .simulation import Simulation, State, load
from .sweep import sweep

__all__ = [
    "Calibration",
    "Error",
    "FileError",
    "History",
    "InternalError",
    "Mesh",
    "Model",
    "ModelError",
    "Results",
    "RunError",
    "Simulation",
    "State",
    "StateError",
    "Warning",
    "__version__",
    "calibrate",
    "load",
    "results",
    "sweep",
]
