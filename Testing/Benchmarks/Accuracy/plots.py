"""Draws the plots of Documentation/Accuracy.md.

    plots.py accuracy.json folder-of-difference-pictures folder
"""
import json
import os
import sys

import matplotlib
from matplotlib import pyplot

from figures import label, note, panels, plain_numbers, save, values

COLOURS = {"voxel": "#c1440e", "plane": "#d9a400", "triangle": "#1b6ca8", "automatic": "#3a8c3f"}
LIGHTS = ["directional", "spot", "point", "near point"]


def leaves(rows, folder):
    rows = [r for r in rows if r["experiment"] == "leaves"]
    figure, axes = panels(values(rows, "mesh"),
                          "Depth error that 95 % of the pixels stay below, against the time of a "
                          "frame\n(numbers: octree level; left and down is better)")
    for axis, mesh in zip(axes, values(rows, "mesh")):
        for kind, colour in COLOURS.items():
            some = [r for r in rows if r["mesh"] == mesh and r["leaves"] == kind]
            x = [r["processorMs"] for r in some]
            y = [r["rayP95"] / 2 ** r["level"] for r in some]
            axis.plot(x, y, "o-", color=colour, label=kind, markersize=3.5, linewidth=1)
            if kind in ("voxel", "plane"):
                note(axis, [r["level"] for r in some if r["level"] % 2], x[::2], y[::2], colour)
        axis.set_yscale("log")
        axis.set_xscale("log")
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:g}"))
        axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        axis.set_xticks([t for t in (10, 20, 30, 50, 70, 100, 200)
                         if axis.get_xlim()[0] <= t <= axis.get_xlim()[1]])
        label(axis, "processor time of a frame, ms", "depth error, sizes of the object",
              axis is axes[0])
    save(figure, folder, "accuracy-leaves.png")


def incidence(rows, folder):
    rows = [r for r in rows if r["experiment"] == "leaves" and r["level"] == 10]
    middles = [0.05, 0.15, 0.3, 0.55, 0.85]
    figure, axes = panels(["median, signed (negative: nearer)", "95 % of the pixels are below"],
                          "Depth error along the ray against the angle of incidence, level 10")
    for axis, key in zip(axes, ["SignedMedian", "P95"]):
        for kind, colour in COLOURS.items():
            some = [r for r in rows if r["leaves"] == kind]
            mean = [sum(r[f"incidence{k}{key}"] for r in some) / len(some) for k in range(5)]
            axis.plot(middles, mean, "o-", color=colour, label=kind, markersize=4, linewidth=1)
        axis.set_xlim(1, 0)
        label(axis, "n.v (1: head-on, 0: grazing)", "voxels, mean of the meshes", axis is axes[0])
    save(figure, folder, "accuracy-incidence.png")


def mean_by(rows, key, x, y):
    """Means over the meshes of two figures for each value of a key."""
    found = []
    for value in sorted(set(r[key] for r in rows)):
        some = [r for r in rows if r[key] == value]
        found.append((value, sum(r[x] for r in some) / len(some),
                      sum(r[y] for r in some) / len(some)))
    return found


def shadows(rows, folder):
    rows = [r for r in rows if r["experiment"] == "shadows"]
    figure, axes = panels(LIGHTS, "Pixels with a wrong shadow against the time of a frame, mean of "
                                  "the meshes\n(numbers: texels along an edge of a map; left and "
                                  "down is better)")
    for axis, light in zip(axes, LIGHTS):
        here = [r for r in rows if r["light"] == light]
        ours = [r for r in here if r["method"] == "svo" and r["level"] == 10]
        curves = [
            ("shadow buffer", "#3a8c3f", [r for r in ours if r["technique"] == "buffer" and
                                          r["bias"] == "automatic" and r["leaves"] == "automatic"]),
            ("vtkShadowMapPass", "#888888", [r for r in here if r["method"] == "vtkShadowMapPass"])]
        for name, colour, some in curves:
            if some:
                found = mean_by(some, "resolution", "processorMs", "meshWrong")
                x = [f[1] for f in found]
                y = [100 * f[2] for f in found]
                axis.plot(x, y, "o-", color=colour, label=name, markersize=4, linewidth=1)
                note(axis, [f[0] for f in found], x, y, colour)
        for kind, mark in (("automatic", "s"), ("triangle", "^")):
            some = [r for r in ours if r["technique"] == "rays" and r["leaves"] == kind]
            x = sum(r["processorMs"] for r in some) / len(some)
            y = 100 * sum(r["meshWrong"] for r in some) / len(some)
            axis.plot([x], [max(y, 1e-3)], mark, color=COLOURS[kind],
                      label=f"shadow rays, {kind} leaves" + (" (below 0.001 %)" if y < 1e-3 else ""))
        axis.set_xscale("log")
        axis.set_yscale("log")
        plain_numbers(axis)
        label(axis, "processor time of a frame, ms", "wrong pixels, %", legend=False)
    axes[0].legend(fontsize=7, loc=(0.02, 0.12))  # of all panels; there it hides nothing
    save(figure, folder, "accuracy-shadows.png")


def pixel_error(rows, folder):
    rows = [r for r in rows if r["experiment"] == "pixelError"]
    figure, axes = panels(["how far points move on the screen", "what it costs"],
                          "The pixel error: promise and measurement, worst of the meshes")
    for kind in ("voxel", "automatic"):
        some = [r for r in rows if r["leaves"] == kind]
        errors = sorted(set(r["pixelError"] for r in some))
        for key, style in (("movedMax", "o-"), ("movedMedian", "o:")):
            axes[0].plot(errors, [max(max(r[key] for r in some if r["pixelError"] == e), 1e-4)
                                  for e in errors], style, color=COLOURS[kind], markersize=4,
                         linewidth=1, label=f"{kind} leaves, "
                         + ("worst point" if key == "movedMax" else "median"))
        axes[1].plot(errors, [sum(r["processorMs"] for r in some if r["pixelError"] == e)
                              / len(values(rows, "mesh")) for e in errors], "o-",
                     color=COLOURS[kind], markersize=4, linewidth=1, label=f"{kind} leaves")
    axes[0].plot(errors, [3 ** 0.5 * e for e in errors], "--", color="black", linewidth=1,
                 label="promised")
    axes[0].set_yscale("log")
    for axis in axes:
        axis.set_xscale("log", base=2)
        plain_numbers(axis)
    label(axes[0], "pixel error", "pixels")
    label(axes[1], "pixel error", "processor time of a frame, ms")
    save(figure, folder, "accuracy-pixel-error.png")


def paper(rows, folder):
    rows = [r for r in rows if r["experiment"] == "paper" and r["light"] == "spot"
            and r["method"] not in ("vtkRasterizer", "vtkSVORenderPass")]
    figure, (axis,) = panels([""], "The paper's five scenes under a spot light, means: wrong "
                             "shadows against the time of a frame\n(grey: vtkShadowMapPass, texels)", 4.6)
    figure.set_size_inches(9, 4.8)
    groups = []  # points that would lie on each other: [x, y, is VTK's, names]
    for key in dict.fromkeys((r["method"], r.get("resolution")) for r in rows):
        some = [r for r in rows if (r["method"], r.get("resolution")) == key]
        x = sum(r["processorMs"] for r in some) / len(some)
        y = max(100 * sum(r["meshWrong"] for r in some) / len(some), 1e-3)
        vtk = key[0] == "vtkShadowMapPass"
        name = f"VTK, {key[1]}" if vtk else key[0]
        for group in groups:
            if abs(x / group[0] - 1) < 0.15 and abs(y / group[1] - 1) < 0.4 and vtk == group[2]:
                group[3].append(name)
                break
        else:
            groups.append([x, y, vtk, [name]])
    for x, y, vtk, names in groups:
        colour = "#888888" if vtk else "#1b6ca8"
        axis.plot([x], [y], "s" if vtk else "o", color=colour, markersize=5)
        note(axis, ["\n".join(names)], [x], [y], colour)
    axis.set_yscale("log")
    axis.set_xscale("log")
    axis.set_xlim(min(g[0] for g in groups) / 1.1, max(g[0] for g in groups) * 1.5)
    plain_numbers(axis)
    label(axis, "processor time of a frame, ms",
          "wrong shadows, %", False)
    save(figure, folder, "accuracy-paper.png")


def montage(pictures, title, folder, name):
    pictures = [(text, path) for text, path in pictures if os.path.exists(path)]
    if not pictures:
        return
    figure, axes = pyplot.subplots(1, len(pictures), figsize=(3 * len(pictures), 3.3),
                                   squeeze=False, constrained_layout=True)
    figure.suptitle(title, fontsize=10)
    for axis, (text, path) in zip(axes.flat, pictures):
        axis.imshow(pyplot.imread(path), interpolation="nearest")
        axis.set_title(text, fontsize=9)
        axis.axis("off")
    save(figure, folder, name)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = json.load(file)
    pictures, folder = sys.argv[2], sys.argv[3]
    for draw in (leaves, incidence, shadows, pixel_error, paper):
        draw(rows, folder)
    mesh = next(r["mesh"] for r in rows if r["experiment"] == "leaves")
    montage([(kind, f"{pictures}/depth-{mesh}-{kind}.png")
             for kind in ("voxel", "plane", "triangle")],
            "Depth at level 10: white exact, red up to two voxels too near, blue too far, black a "
            "false hit or miss", folder, "accuracy-depth-differences.png")
    montage([(text, f"{pictures}/shadow-{mesh}-spot-{file}.png") for text, file in (
        ("automatic bias (default)", "svo-automatic"), ("no bias (the paper's test)", "svo-none"),
        ("vtkShadowMapPass", "vtkShadowMapPass"))],
            "Shadows at 2048 texels: red dark but should be lit, blue lit but should be dark",
            folder, "accuracy-shadow-differences.png")


if __name__ == "__main__":
    main()
