"""embate: explicit finite elements for contact and impact between flexible bodies in large deformation.

>>> import embate
>>> model = embate.Model("examples/tube-plate")
>>> simulation = model.simulation()
>>> simulation.run(progress=True)
>>> simulation.history["tube.vy"], simulation.state.stress
"""

from ._embate import __version__
from .errors import Error, FileError, InternalError, ModelError, RunError, StateError, Warning
from .mesh import Mesh
from .model import Model
from .simulation import History, Simulation, State, load
from .sweep import sweep

__all__ = [
    "Error",
    "FileError",
    "History",
    "InternalError",
    "Mesh",
    "Model",
    "ModelError",
    "RunError",
    "Simulation",
    "State",
    "StateError",
    "Warning",
    "__version__",
    "load",
    "sweep",
]
