"""Time series of surfaces for the animation tests."""

import os
import struct

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

SYDNEY = "/usr/share/assimp/models/MD2/sydney.md2"  # of the package assimp-testmodels


def mesh(points, triangles):
    result = vtkPolyData()
    result.SetPoints(vtkPoints())
    result.GetPoints().SetData(numpy_to_vtk(numpy.ascontiguousarray(points, "f"), deep=True))
    cells = numpy.column_stack([numpy.full(len(triangles), 3), triangles]).astype("int64")
    result.SetPolys(vtkCellArray())
    result.GetPolys().ImportLegacyFormat(numpy_to_vtkIdTypeArray(cells.ravel(), deep=True))
    return result


def write(folder, meshes):
    """A .pvd file of numbered .vtp files, one per whole second. None leaves that file out."""
    os.makedirs(folder, exist_ok=True)
    entries = []
    for i, step in enumerate(meshes):
        name = f"step{i:03}.vtp"
        path = os.path.join(folder, name)
        if os.path.exists(path):
            os.remove(path)
        if step is not None:
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(path)
            writer.SetInputData(step)
            # With today's libexpat of Debian 12 its ParaView cannot read appended data, VTK's default.
            writer.SetDataModeToBinary()
            writer.Write()
        entries.append(f'<DataSet timestep="{i}" part="0" file="{name}"/>')
    path = os.path.join(folder, "series.pvd")
    with open(path, "w") as file:
        file.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order='
                   '"LittleEndian"><Collection>' + "\n".join(entries) + "</Collection></VTKFile>\n")
    return path


def breathing_ball(steps):
    """A ball above the ground whose poses all differ."""
    columns, rows = 48, 24
    u, v = numpy.meshgrid(numpy.arange(columns), numpy.arange(rows + 1))
    theta, phi = u * 2 * numpy.pi / columns, v * numpy.pi / rows
    across = numpy.stack([numpy.cos(theta) * numpy.sin(phi), numpy.sin(theta) * numpy.sin(phi),
                          numpy.cos(phi)], axis=-1).reshape(-1, 3)
    quads = []
    for row in range(rows):
        for column in range(columns):
            a, b = row * columns + column, row * columns + (column + 1) % columns
            quads += [(a, a + columns, b + columns), (a, b + columns, b)]
    for step in range(steps):
        wave = 1 + 0.2 * numpy.sin(3 * theta + step).reshape(-1, 1) * numpy.sin(phi).reshape(-1, 1)
        yield mesh([0, 0, 0.8] + 0.45 * wave * across, quads)


def md2(path):
    """The key frames of a Quake II model, as tall as 1, on the ground."""
    data = open(path, "rb").read()
    header = struct.unpack_from("<17i", data)
    if header[:2] != (0x32504449, 8):
        raise ValueError(f"{path} is no MD2 file")
    frame_size, points, triangles, frames = header[4], header[6], header[8], header[10]
    at_triangles, at_frames = header[13], header[14]
    corners = numpy.frombuffer(data, "<u2", 6 * triangles, at_triangles).reshape(-1, 6)[:, :3]
    poses = []
    for i in range(frames):
        start = at_frames + i * frame_size
        numbers = numpy.frombuffer(data, "<f4", 6, start)
        bytes_ = numpy.frombuffer(data, "u1", 4 * points, start + 40).reshape(-1, 4)[:, :3]
        poses.append(bytes_ * numbers[:3] + numbers[3:])
    low, high = poses[0].min(axis=0), poses[0].max(axis=0)
    for pose in poses:
        yield mesh((pose - [0, 0, low[2]]) / (high[2] - low[2]), corners.astype("int64"))
