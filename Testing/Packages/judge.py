"""Whether a picture has a shadow that another one lacks. Needs no NumPy: it is not there everywhere."""

from vtkmodules.vtkIOImage import vtkPNGReader


def brightness(file):
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    scalars = reader.GetOutput().GetPointData().GetScalars()
    components = scalars.GetNumberOfComponents()
    values = bytes(memoryview(scalars))
    return [max(values[i:i + 3]) for i in range(0, len(values), components)]


def check_shadow(shadowed, plain):
    """Some pixels are less than half as bright, and none is brighter."""
    pairs = list(zip(brightness(shadowed), brightness(plain)))
    dark = sum(2 * with_shadow < without for with_shadow, without in pairs) / len(pairs)
    brighter = sum(with_shadow > without + 3 for with_shadow, without in pairs) / len(pairs)
    print(f"{shadowed}: {dark:.1%} of the picture in shadow")
    assert 0.01 < dark < 0.3, "the shadow is missing, or everywhere"
    assert brighter < 0.001, f"{brighter:.1%} of the picture is brighter with shadows"
