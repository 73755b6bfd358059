"""Thousands of random edits of everything that can be set, in windows that come and go. Every so many frames each
picture is the picture, to the bit, of the same scene made afresh: a new window, renderer and pass, new meshes. And what
all of it took is given back when all is closed.

usage: soak.py [--frames 3000] [--every 100] [--round 500] [--seed 1] [--trace] [--plain]

A failure names the seed and the frame, lists the edits since the last comparison, and leaves both pictures. Where
VTK's own pictures of the two scenes, without the pass, differ as well it is counted, and is no failure.
--trace names each edit; --every 1 finds the first wrong frame; --plain never sets a pass: what VTK does itself.
"""

import argparse
import copy
import ctypes
import gc
import json
import random
import sys

import vtkmodules.vtkInteractionStyle
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.vtkCommonCore import vtkObject
from model import ACTOR, CAMERA, LIGHT, PASS, SOURCES, View, apply, mesh_of, shift_points

# What resident memory with everything closed may grow by between the second third of a run and its end, in MiB. Random
# scenes leave a heap in pieces.
GROWTH = 32


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096 / 2**20


class Values:
    """Random values of what can be set, by name."""

    def __init__(self, rng):
        self.rng = rng
        point = lambda low, high: [rng.uniform(low, high) for _ in range(3)]
        flag = lambda often=0.5: rng.random() < often
        self.of = {
            "actor": {
                "position": lambda: point(-2, 2), "orientation": lambda: point(-180, 180),
                "scale": lambda: [rng.choice((1, 1, 0.5, 2, -1)) for _ in range(3)],
                "matrix": lambda: None if flag(0.7) else [(i % 4 == 0) + rng.uniform(-0.4, 0.4) for i in range(9)],
                "visible": lambda: flag(0.9), "color": lambda: point(0.2, 1),
                "opacity": lambda: rng.choice((1, 1, 1, 0.5, 0.2)), "ambient": lambda: rng.choice((0, 0, 0.3)),
                "specular": lambda: rng.choice((0, 0, 0.5)), "power": lambda: rng.choice((1, 10, 60)),
                "lit": lambda: rng.choice(("lit", "lit", "lit", "tubes", "flat")),
                "interpolation": lambda: rng.choice((0, 1, 2, 2, 3)),
                "representation": lambda: rng.choice((2, 2, 2, 2, 1, 0)), "edges": lambda: flag(0.1),
                "width": lambda: rng.choice((1, 1, 4)), "culled": lambda: flag(0.1),
                "texture": lambda: None if flag(0.9) else point(0.2, 1),
                "colors": lambda: rng.choice(("none", "none", "points", "cells", "table", "holes")),
                "clipped": lambda: None if flag(0.9) else rng.uniform(-1, 1),
                "casts": lambda: flag(0.8), "receives": lambda: flag(0.9), "traced": lambda: flag(0.9),
                "catcher": lambda: flag(0.05), "pixel error": lambda: rng.choice((-1, -1, 0, 4)),
            },
            "light": {
                "type": lambda: rng.choice((3, 3, 3, 2, 1)), "position": lambda: point(-5, 5),
                "focus": lambda: point(-1, 1), "positional": lambda: flag(), "cone": lambda: rng.choice((30, 60, 180)),
                "exponent": lambda: rng.choice((1, 1, 4)), "color": lambda: point(0.3, 1),
                "intensity": lambda: rng.uniform(0.2, 1), "on": lambda: flag(0.9), "casts": lambda: flag(0.8),
            },
            "camera": {
                "position": lambda: [rng.choice((-1, 1)) * rng.uniform(2, 6) for _ in range(3)],
                "focus": lambda: point(-0.5, 0.5), "up": lambda: rng.choice(([0, 0, 1], [0, 1, 0.1])),
                "angle": lambda: rng.uniform(15, 60), "parallel": lambda: flag(0.2), "scale": lambda: rng.uniform(1, 4),
                "range": lambda: [rng.uniform(0.1, 1), rng.uniform(12, 40)],
            },
            "pass": {
                "ShadowTechnique": lambda: rng.choice((0, 1, 1, 1, 2, 3)),
                "ShadowBufferResolution": lambda: rng.choice((64, 256, 512, 1024)),
                "AutomaticShadowBias": lambda: flag(0.9), "ShadowBias": lambda: rng.choice((0, 0, 2)),
                "ShadowIntensity": lambda: rng.choice((1, 1, 0.6)), "TranslucentShadows": lambda: flag(0.8),
                "PixelError": lambda: rng.choice((1, 1, 0, 4)), "ConvertPolyData": lambda: flag(0.9),
                "MaximumLevel": lambda: rng.choice((5, 7, 8, 9)), "LeafGeometry": lambda: rng.randrange(4),
                "OctreeMemoryLimit": lambda: rng.choice((1 << 20, 1 << 20, 2000, 0)),
                "FrameCoherence": lambda: flag(0.8), "LayerMemoryLimit": lambda: rng.choice((1 << 19, 1 << 19, 500, 0)),
                "AntiAliasing": lambda: flag(0.3), "ViewCulling": lambda: flag(0.8),
                "OcclusionCulling": lambda: flag(0.8), "ShadowsForEverything": lambda: flag(0.1),
                "Backend": lambda: rng.choice((1, 1, 2)), "GPUMemoryLimit": lambda: rng.choice((1 << 20, 1 << 20, 200)),
            },
        }

    def all(self, kind):
        return {name: value() for name, value in self.of[kind].items()}

    def mesh(self):
        return {"kind": self.rng.choice(list(SOURCES)), "size": self.rng.randrange(60),
                "normals": self.rng.random() < 0.6, "shift": None}

    def actor(self, meshes):
        return dict(self.all("actor"), mesh=self.rng.randrange(meshes))

    def view(self, meshes):
        return {"size": self.size(), "samples": self.rng.choice((0, 0, 4)),
                "background": [self.rng.random() for _ in range(3)], "camera": self.all("camera"),
                "pass": self.all("pass"), "actors": [self.actor(meshes) for _ in range(5)],
                "lights": [self.all("light") for _ in range(2)]}

    def size(self):
        return [self.rng.randrange(60, 300), self.rng.randrange(60, 240)]


class World:
    """Meshes that views share, the views, and the data that they were made of."""

    def __init__(self, rng, plain):
        self.rng, self.values, self.plain = rng, Values(rng), plain
        self.mesh_data = [self.values.mesh() for _ in range(6)]
        self.meshes = [mesh_of(data) for data in self.mesh_data]
        self.views = [View(self.new_view(), self.meshes)]

    def new_view(self):
        return dict(self.values.view(len(self.meshes)), traced=not self.plain)

    def edit(self):
        """One random edit, of the data and of what was made of it; what was done, in words."""
        rng, values = self.rng, self.values
        number = rng.randrange(len(self.views))
        view = self.views[number]
        data = view.data
        where = f"view {number}: "
        kind = rng.choices(("actor", "light", "camera", "pass", "mesh", "other mesh", "add", "remove", "light +-",
                            "window", "resize", "traced"), (30, 10, 15, 10, 6, 6, 6, 5, 3, 3, 3, 2))[0]
        if kind in ("actor", "light") and data[kind + "s"]:
            i = rng.randrange(len(data[kind + "s"]))
            made = (view.actors if kind == "actor" else view.lights)[i]
            return where + self.set(kind, data[kind + "s"][i], made, f"{kind} {i}")
        if kind == "camera":
            return where + self.set(kind, data[kind], view.renderer.GetActiveCamera(), kind)
        if kind == "pass":
            return where + self.set(kind, data[kind], view.svo, kind)
        if kind == "mesh":
            i = rng.randrange(len(self.meshes))
            self.mesh_data[i]["shift"] = rng.randrange(10**6)
            shift_points(self.meshes[i], self.mesh_data[i]["shift"])
            return f"points of mesh {i} moved"
        if kind == "other mesh" and data["actors"]:
            i, m = rng.randrange(len(data["actors"])), rng.randrange(len(self.meshes))
            if rng.random() < 0.3 and not any(one["mesh"] == m for each in self.views for one in each.data["actors"]):
                self.mesh_data[m] = values.mesh()
                self.meshes[m] = mesh_of(self.mesh_data[m])
            data["actors"][i]["mesh"] = m
            view.set_mesh(i)
            return where + f"actor {i} has mesh {m}"
        if kind == "add" and len(data["actors"]) < 12:
            data["actors"].append(values.actor(len(self.meshes)))
            view.add_actor(data["actors"][-1])
            return where + "an actor more"
        if kind == "remove" and len(data["actors"]) > 2:
            i = rng.randrange(len(data["actors"]))
            del data["actors"][i]
            view.remove_actor(i)
            return where + f"without actor {i}"
        if kind == "light +-":
            if len(data["lights"]) < 3:
                data["lights"].append(values.all("light"))
                view.add_light(data["lights"][-1])
                return where + "a light more"
            i = rng.randrange(len(data["lights"]))
            del data["lights"][i]
            view.remove_light(i)
            return where + f"without light {i}"
        if kind == "window":
            what = rng.randrange(3)
            if what == 0 and len(self.views) < 3:
                self.views.append(View(self.new_view(), self.meshes))
                return "a window more"
            view.close()
            if what == 1 and len(self.views) > 1:
                del self.views[number]
                return where + "closed"
            data["samples"] = rng.choice((0, 0, 4))
            view.open()
            return where + f"closed, and shown in a new window with {data['samples']} samples"
        if kind == "resize":
            data["size"] = values.size()
            view.window.SetSize(data["size"])
            return where + f"has size {data['size']}"
        if kind == "traced":
            data["traced"] = (not data["traced"] or rng.random() < 0.5) and not self.plain
            view.set_traced(data["traced"])
            return where + ("the pass" if data["traced"] else "no pass")
        return "nothing"

    def set(self, kind, data, made, name):
        key = self.rng.choice(list(self.values.of[kind]))
        data[key] = self.values.of[kind][key]()
        table = {"actor": ACTOR, "light": LIGHT, "camera": CAMERA, "pass": PASS}[kind]
        table[key](made, data[key])
        if kind == "light" and key == "type":
            apply(LIGHT, made, data)
        return f"{name}: {key} {data[key]}"

    def afresh(self, i, **other):
        """The picture of view i, of a scene that shares nothing with this one."""
        view = View(dict(copy.deepcopy(self.views[i].data), **other), [mesh_of(data) for data in self.mesh_data])
        picture = view.picture()
        view.close()
        return picture

    def differs_in_vtk(self, i):
        """Whether VTK alone shows something else after all edits than of a scene made afresh."""
        view = self.views[i]
        view.set_traced(False)
        picture = view.picture()
        view.set_traced(view.data["traced"])
        return picture != self.afresh(i, traced=False)

    def close(self):
        for view in self.views:
            view.close()
        self.views, self.meshes = [], []


def write(path, size, picture):
    rows = [picture[3 * size[0] * y:3 * size[0] * (y + 1)] for y in range(size[1])]
    with open(path, "wb") as file:
        file.write(b"P6 %d %d 255\n" % tuple(size) + b"".join(reversed(rows)))


def differ(world, number, one, other, edits, seed, frame):
    data = world.views[number].data
    write("soak-edited.ppm", data["size"], one)
    write("soak-afresh.ppm", data["size"], other)
    pixels = sum(one[i:i + 3] != other[i:i + 3] for i in range(0, len(one), 3))
    largest = max(abs(a - b) for a, b in zip(one, other))
    print(f"FAILED: seed {seed}, frame {frame}, view {number} of {len(world.views)}: {pixels} of {len(one) // 3} pixels"
          f" are not what they are in a scene made afresh, by up to {largest}; soak-edited.ppm, soak-afresh.ppm")
    print("Edits since the last comparison:")
    for edit in edits:
        print(" ", edit)
    print("The view, as data:", json.dumps(data))
    print("Meshes:", json.dumps(world.mesh_data))


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--frames", type=int, default=3000)
    parser.add_argument("--every", type=int, default=100)
    parser.add_argument("--round", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--trace", action="store_true")
    parser.add_argument("--plain", action="store_true")
    options = parser.parse_args()
    vtkObject.GlobalWarningDisplayOff()
    rng = random.Random(options.seed)
    world, edits, closed, most = World(rng, options.plain), [], [], 0
    failures = compared = vtk = 0
    for frame in range(1, options.frames + 1):
        edits.append(world.edit())
        if options.trace:
            print(frame, edits[-1], flush=True)
        for view in world.views:
            view.window.Render()
        most = max(most, resident())
        if frame % options.every == 0:
            for i, view in enumerate(world.views):
                one, other = view.picture(), world.afresh(i)
                compared += 1
                if one != other and world.differs_in_vtk(i):
                    vtk += 1
                elif one != other:
                    differ(world, i, one, other, edits, options.seed, frame)
                    failures += 1
            edits = []
        if frame % 100 == 0:
            print(f"frame {frame}: {resident():.0f} MiB resident, {most:.0f} at most", flush=True)
            most = 0
        if frame % options.round == 0:
            world.close()
            del world
            gc.collect()
            ctypes.CDLL(None).malloc_trim(0)
            closed.append(resident())
            print(f"frame {frame}: {closed[-1]:.0f} MiB with everything closed", flush=True)
            world, edits = World(rng, options.plain), []
    print(f"{compared} pictures compared, {failures} differ, and {vtk} of which VTK's own do, too")
    if len(closed) >= 6:
        growth = closed[-1] - closed[len(closed) // 3]
        print(f"With everything closed memory grew by {growth:.0f} MiB after the first third; {GROWTH} may be")
        failures += growth > GROWTH
    world.close()
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
