"""The package: it imports beside vtkmodules, holds every public class, and each has its help text."""

import inspect
import os
import re
import subprocess
import sys
import unittest

import vtksvo
from vtkmodules.vtkCommonCore import vtkObject, vtkObjectBase

PUBLIC = ["vtkImageToSVO", "vtkImplicitFunctionToSVO", "vtkMandelbulbFunction", "vtkPolyDataToSVO",
          "vtkSVOExposureFilter", "vtkSVORenderPass", "vtkSVOShadowFilter", "vtkSVOSky", "vtkSVOSunPath",
          "vtkSVOToHyperTreeGrid", "vtkSVOToPolyData", "vtkSparseVoxelOctree"]


def help_without_signatures(method):
    lines = (method.__doc__ or "").splitlines()
    return [
        line for line in lines
        if line.strip() and not line.startswith(("C++:", "V.")) and "->" not in line
    ]


class Package(unittest.TestCase):
    def test_every_public_class_is_there(self):
        for name in PUBLIC:
            with self.subTest(name):
                instance = getattr(vtksvo, name)()
                self.assertIsInstance(instance, vtkObjectBase)
                self.assertTrue(instance.IsA(name))
                self.assertIn(name, str(instance))

    def test_version_is_the_projects(self):
        self.assertEqual(vtksvo.__version__, os.environ["VTKSVO_VERSION"])

    def test_classes_and_methods_have_help(self):
        for name in PUBLIC:
            cls = getattr(vtksvo, name)
            with self.subTest(name):
                self.assertGreater(len(cls.__doc__.split()), 15, "the class says what it is for")
            for member, method in cls.__dict__.items():
                # Limits of clamped values, and what every VTK class has, are VTK's own.
                inherited = hasattr(vtkObject, member) or re.search("M(in|ax)Value$", member)
                if inspect.isroutine(method) and not inherited and not member.startswith("_"):
                    with self.subTest(name + "." + member):
                        self.assertTrue(help_without_signatures(method), "says what it does")

    def test_import_order_does_not_matter(self):
        for first, second in (("vtksvo", "vtkmodules.all"), ("vtkmodules.all", "vtksvo")):
            script = f"import {first}, {second}, vtksvo; vtksvo.vtkSVORenderPass()"
            subprocess.run([sys.executable, "-c", script], check=True)


if __name__ == "__main__":
    unittest.main()
