"""Files of results as vtk reads them, for `interpenetration.py` and `obstacles.py`."""

import xml.etree.ElementTree

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def collection(path):
    """The files of a collection (.pvd), in their order; OSError or ParseError if it can't be read."""
    sets = xml.etree.ElementTree.parse(path).getroot().findall("Collection/DataSet")
    return [path.parent / entry.get("file") for entry in sets]


def read(path):
    """The grid of a file, its points, m, and the nodes and kind of each cell; ValueError if it can't be read or is empty."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if reader.GetErrorCode() or not grid.GetNumberOfPoints():
        raise ValueError(f"{path} can't be read")
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).tolist()
    count = grid.GetNumberOfCells()
    cells = [(grid.GetCellType(i), tuple(nodes[offsets[i] : offsets[i + 1]])) for i in range(count)]
    return grid, points, cells


def array(data, name):
    """An array of points, cells or the whole; None if there is no such."""
    found = data.GetArray(name)
    return None if found is None else vtk_to_numpy(found)
