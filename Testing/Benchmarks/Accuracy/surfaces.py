"""How exact octrees of surfaces that are no meshes are: rays against the analytic sphere and torus, as functions
and as images of distances. Prints the table of Documentation/Surfaces.md; no truth of ours is involved.

usage: surfaces.py [rays]      with the Python package on PYTHONPATH
"""
import sys
import time

import numpy
import vtk
import vtksvo
from vtk.util.numpy_support import numpy_to_vtk

RADIUS, RING, TUBE = 0.8, 0.6, 0.25


def sphere(p):
    return numpy.linalg.norm(p, axis=-1) - RADIUS


def torus(p):
    return numpy.hypot(numpy.hypot(p[..., 0], p[..., 1]) - RING, p[..., 2]) - TUBE


SHAPES = {"sphere": sphere, "torus": torus}


def gradient(shape, p):
    h = 1e-6
    g = numpy.array([(shape(p + h * e) - shape(p - h * e)) / (2 * h) for e in numpy.eye(3)])
    return g / numpy.linalg.norm(g)


def function(level):
    """The sphere; VTK has no torus."""
    quadric = vtk.vtkSphere()
    quadric.SetRadius(RADIUS)
    convert = vtksvo.vtkImplicitFunctionToSVO()
    convert.SetImplicitFunction(quadric)
    convert.SetModelBounds(-1, 1, -1, 1, -1, 1)
    convert.SetMaximumLevel(level)
    return convert


def image(shape, points, level):
    axis = numpy.linspace(-1, 1, points)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
    values = shape(numpy.stack([x, y, z], axis=-1))
    data = vtk.vtkImageData()
    data.SetDimensions(points, points, points)
    data.SetSpacing([2 / (points - 1)] * 3)
    data.SetOrigin(-1, -1, -1)
    data.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=1))
    convert = vtksvo.vtkImageToSVO()
    convert.SetInputData(data)
    convert.SetMaximumLevel(level)
    return convert


def first_hit(shape, origin, direction):
    """By steps of the distance, to 1e-12; nan on a miss. Where a ray grazes it takes thousands."""
    t = 0.0
    for _ in range(20000):
        d = float(shape(origin + t * direction))
        t += d
        if d < 1e-12:
            return t
        if t > 6.0:
            break
    return numpy.nan


def near_edge(shape, origin, direction, exact, voxel):
    """Whether a ray a voxel to the side sees nothing, or something more than 12 voxels off: more than a slope explains."""
    side = numpy.cross(direction, [0.3, 0.5, 0.8])
    side *= voxel / numpy.linalg.norm(side)
    for beside in (side, -side, numpy.cross(direction, side), -numpy.cross(direction, side)):
        t = first_hit(shape, origin + beside, direction)
        if not abs(t - exact) < 12 * voxel:
            return True
    return False


def measure(convert, shape, rays):
    start = time.process_time()
    convert.Update()
    seconds = time.process_time() - start
    octree = vtksvo.vtkSparseVoxelOctree()
    octree.Initialize(convert.GetOutput())
    voxel = octree.GetVoxelSize()
    random = numpy.random.default_rng(1)
    errors, wrong = [], 0
    for _ in range(rays):
        origin, target = random.normal(size=3), random.uniform(-0.9, 0.9, 3)
        origin *= 3 / numpy.linalg.norm(origin)
        direction = (target - origin) / numpy.linalg.norm(target - origin)
        exact = first_hit(shape, origin, direction)
        t, x, cell = vtk.reference(0.0), [0.0] * 3, vtk.reference(0)
        hit = octree.IntersectWithLine(origin, origin + 6 * direction, t, x, cell)
        if bool(hit) != bool(numpy.isfinite(exact)):
            wrong += 1
        elif hit:
            facing = abs(float(gradient(shape, origin + exact * direction) @ direction))
            if facing > 0.1 and not near_edge(shape, origin, direction, exact, voxel):
                error = (6 * float(t) - exact) / voxel
                errors.append((abs(error), abs(error * facing)))
    errors = numpy.array(errors)
    size = octree.GetActualMemorySize() * 1024 / octree.GetNumberOfVoxels()
    return (1000 * seconds, octree.GetNumberOfVoxels(), size,
            *numpy.sqrt((errors ** 2).mean(axis=0)), *errors.max(axis=0), 100 * wrong / rays)


def main():
    rays = int(sys.argv[1]) if len(sys.argv) > 1 else 20000
    print("| surface | source | level | build, ms | voxels | bytes a voxel | depth: RMS, largest | "
          "along the normal: RMS, largest | rays wrong about hit or miss |\n|" + 9 * "---|")
    for name, shape in SHAPES.items():
        cases = [(f"image of {2 ** k + 1}^3 points", level, image(shape, 2 ** k + 1, level))
                 for k, level in ((6, 6), (7, 7), (7, 8), (7, 9))]
        if name == "sphere":
            cases = [("function", level, function(level)) for level in (7, 9)] + cases
        for source, level, convert in cases:
            ms, voxels, size, rms, rms_n, most, most_n, wrong = measure(convert, shape, rays)
            print(f"| {name} | {source} | {level} | {ms:.0f} | {voxels} | {size:.1f} | "
                  f"{rms:.3f}, {most:.2f} | {rms_n:.3f}, {most_n:.2f} | {wrong:.2f} % |", flush=True)


if __name__ == "__main__":
    main()
