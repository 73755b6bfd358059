"""ParaView's panels and the classes behind them agree: each property of Plugin/XML/*.xml has a setting in
its class, with the same default and the same range. (TestRenderPassSettings has the class and the tracer.)
"""

import os
import pathlib
import re
import unittest
import xml.etree.ElementTree

import vtkmodules.vtkRenderingOpenGL2
import vtksvo
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

PLUGIN = pathlib.Path(__file__).resolve().parents[2] / "Plugin"
GENERATED_VIEWS = os.environ["VTKSVO_VIEWS"]  # of Views.xml.in and Rendering/Settings.cmake

# Properties of views that the pass has no setting for: the ground is ParaView's prop, reasons come from all processes.
ONLY_IN_PARAVIEW = [("SVOShadowCatcher", "SetShadowGround"), ("SVOReasons", "GetClassName")]
# Beyond one end of their range is before the other.
GO_ROUND = ["SetLongitude"]
# ParaView has an Information panel, which shows what VTK's programs need to be asked for; its scenes have one light
# more often than a paper's picture to match.
OTHER_IN_PARAVIEW = {"WriteStatistics": 1, "ShadowIntensity": 0.7}


def properties_of(file, element):
    """The properties of the first such element in a file."""
    path = GENERATED_VIEWS if file == "Views.xml" else PLUGIN / "XML" / file
    root = xml.etree.ElementTree.parse(path).getroot().find(f".//{element}")
    return [child for child in root if child.tag.endswith("Property") and "command" in child.attrib]


def is_setting(prop):
    return "information_only" not in prop.attrib and "default_values" in prop.attrib


def surface():
    """An actor that anybody would show."""
    ball = vtkSphereSource()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(ball.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


class Setting:
    """One setting of an object, by its name in methods: Get<name>(), Set<name>()."""

    def __init__(self, owner, name, getter=None, setter=None):
        self.owner = owner
        self.get = getter or getattr(owner, "Get" + name)
        self.set = setter or getattr(owner, "Set" + name)

    def after(self, value):
        """What it is once a value was asked for; None if its type has no such value."""
        try:
            self.set(int(value) if isinstance(self.get(), int) else value)
        except (OverflowError, TypeError):
            return None
        return self.get()


class Defaults(unittest.TestCase):
    def check(self, prop, setting):
        name = prop.attrib["command"]
        if prop.attrib["number_of_elements"] == "3":
            self.assertEqual(setting.get(), tuple(map(float, prop.attrib["default_values"].split())), f"default of {name}")
            return
        default = float(prop.attrib["default_values"])
        expected = OTHER_IN_PARAVIEW.get(name[len("Set"):])
        if expected is None:
            self.assertEqual(setting.get(), default, f"default of {name}")
        else:
            self.assertEqual(default, expected, name)
            self.assertNotEqual(setting.get(), default, f"{name} is no exception any more")
        if prop.find("BooleanDomain") is not None:
            self.assertIsInstance(setting.get(), bool, name)
            return
        self.assertNotIsInstance(setting.get(), bool, name)
        entries = prop.findall("EnumerationDomain/Entry")
        if entries:
            self.check_entries(name, setting, [(float(e.attrib["value"]), e.attrib["text"]) for e in entries])
            return
        domain = prop.find("IntRangeDomain")
        domain = prop.find("DoubleRangeDomain") if domain is None else domain
        self.assertIsNotNone(domain, f"{name} has a range")
        self.check_range(name, setting, domain.attrib)

    def check_range(self, name, setting, domain):
        for end, beyond in (("min", -1), ("max", 1)):
            if end in domain:
                last = float(domain[end])
                self.assertEqual(setting.after(last), last, f"{name} takes its {end}")
                if name in GO_ROUND:
                    other = float(domain["max" if end == "min" else "min"]) + beyond
                    self.assertEqual(setting.after(last + beyond), other, f"{name} goes round")
                    continue
                self.assertIn(setting.after(last + beyond), (last, None), f"{name} ends at its {end}")

    def check_entries(self, name, setting, entries):
        values = [value for value, _ in entries]
        self.check_range(name, setting, {"min": min(values), "max": max(values)})
        self.assertEqual(values, [float(i) for i in range(len(values))], name)
        for value, text in entries:
            getattr(setting.owner, name + "To" + text.replace(" ", ""))()
            self.assertEqual(setting.get(), value, f"{name}: {text}")

    def test_the_view_is_its_pass(self):
        settings = 0
        for prop in properties_of("Views.xml", "Extension"):
            command = prop.attrib["command"]
            self.assertEqual(prop.attrib["si_class"], "vtkSISVOViewProperty")
            if (prop.attrib["name"], command) in ONLY_IN_PARAVIEW:
                continue
            self.assertEqual(prop.attrib["name"], "SVO" + command[len("Set"):])
            render_pass = vtksvo.vtkSVORenderPass()
            with self.subTest(command):
                if is_setting(prop):
                    settings += 1
                    self.check(prop, Setting(render_pass, command[len("Set"):]))
                else:
                    self.assertTrue(command.startswith("Get"))
                    self.assertIsInstance(getattr(render_pass, command)(), (int, float, str))
        self.assertGreater(settings, 9)

    def test_the_filter_is_its_class(self):
        settings = 0
        for prop in properties_of("Filters.xml", "SourceProxy"):
            command = prop.attrib["command"]
            to_octree = vtksvo.vtkPPolyDataToSVO()
            with self.subTest(command):
                if is_setting(prop):
                    settings += 1
                    self.assertEqual(prop.attrib["name"], command[len("Set"):])
                    self.check(prop, Setting(to_octree, command[len("Set"):]))
                elif "information_only" in prop.attrib:
                    self.assertIsInstance(getattr(to_octree, command)(), (int, float))
        self.assertGreater(settings, 5)

    def test_the_shadow_filter_is_its_class(self):
        settings = 0
        for prop in properties_of("Shadows.xml", "SourceProxy"):
            command = prop.attrib["command"]
            shadows = vtksvo.vtkSVOExposureFilter()
            with self.subTest(command):
                if is_setting(prop) and prop.attrib["number_of_elements"] == "1":
                    settings += 1
                    self.assertEqual(prop.attrib["name"], command[len("Set"):])
                    self.check(prop, Setting(shadows, command[len("Set"):]))
                elif is_setting(prop):
                    settings += 1
                    default = tuple(map(float, prop.attrib["default_values"].split()))
                    self.assertEqual(getattr(shadows, "Get" + command[len("Set"):])(), default)
                elif "information_only" in prop.attrib:
                    self.assertIsInstance(getattr(shadows, command)(), (int, float))
                else:
                    self.assertTrue(hasattr(shadows, command))
        self.assertGreater(settings, 15)

    def test_the_representation_is_its_filter_and_its_actor(self):
        render_pass, actor = vtksvo.vtkSVORenderPass, surface()

        def of_actor(name):
            return Setting(actor, name, lambda: getattr(render_pass, "Get" + name)(actor),
                           lambda value: getattr(render_pass, "Set" + name)(value, actor))

        others = {"SetPixelError": of_actor("PropPixelError"), "SetCastShadows": of_actor("CastShadow"),
                  "SetReceiveShadows": of_actor("ReceiveShadow")}
        # Without ParaView there is its header only.
        header = (PLUGIN / "Views" / "vtkSVORepresentation.h").read_text(encoding="utf-8")
        methods = set(re.findall(r"^  [\w ]+\b([GS]et\w+)\(", header, re.M))
        settings = 0
        for prop in properties_of("Representations.xml", "SVORepresentationProxy"):
            command = prop.attrib["command"]
            with self.subTest(command):
                self.assertIn(command, methods)
                if is_setting(prop):
                    settings += 1
                    name = command[len("Set"):]
                    self.assertIn("Get" + name, methods)
                    self.check(prop, others.pop(command, None) or Setting(vtksvo.vtkPolyDataToSVO(), name))
        self.assertGreater(settings, 5)
        self.assertEqual(others, {})

    def test_the_pass_builds_what_the_filter_builds(self):
        render_pass, to_octree = vtksvo.vtkSVORenderPass(), vtksvo.vtkPolyDataToSVO()
        for name, other in (("MaximumLevel", "MaximumLevel"), ("LeafGeometry", "LeafGeometry"),
                            ("OctreeMemoryLimit", "CacheMemoryLimit")):
            one, two = Setting(render_pass, name), Setting(to_octree, other)
            with self.subTest(name):
                self.assertEqual(one.get(), two.get())
                for value in (-1, 0, 1, 20, 21):
                    self.assertIn(two.after(value), (one.after(value), None))
        names = [[n for n in dir(c) if re.fullmatch("SetLeafGeometryTo.*", n)] for c in (render_pass, to_octree)]
        self.assertEqual(*names)
        for name in names[0]:
            getattr(render_pass, name)()
            getattr(to_octree, name)()
            self.assertEqual(render_pass.GetLeafGeometry(), to_octree.GetLeafGeometry(), name)


if __name__ == "__main__":
    unittest.main()
