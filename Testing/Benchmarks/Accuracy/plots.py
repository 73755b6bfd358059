"""Draws the plots of Documentation/Accuracy.md from accuracy.json.

    plots.py accuracy.json folder
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

COLOURS = {"voxel": "#c1440e", "plane": "#d9a400", "triangle": "#1b6ca8", "automatic": "#3a8c3f"}


def meshes(rows):
    return list(dict.fromkeys(r["mesh"] for r in rows))


def panels(names, title):
    columns = min(2, len(names))
    lines = (len(names) + columns - 1) // columns
    figure, axes = pyplot.subplots(
        lines, columns, figsize=(4.6 * columns, 3.4 * lines), squeeze=False, constrained_layout=True
    )
    figure.suptitle(title, fontsize=11)
    for name, axis in zip(names, axes.flat):
        axis.set_title(name, fontsize=10)
        axis.grid(True, which="major", linewidth=0.4, color="#cccccc")
        axis.set_axisbelow(True)
    for axis in list(axes.flat)[len(names):]:
        axis.set_visible(False)
    return figure, list(axes.flat)[: len(names)]


def save(figure, path):
    figure.savefig(path, dpi=100)
    pyplot.close(figure)
    print(path)


def leaves(rows, folder):
    rows = [r for r in rows if r["experiment"] == "leaves"]
    figure, axes = panels(
        meshes(rows), "Depth error (95 % of the pixels are better) against time; numbers are octree levels"
    )
    for axis, mesh in zip(axes, meshes(rows)):
        for kind, colour in COLOURS.items():
            some = [r for r in rows if r["mesh"] == mesh and r["leaves"] == kind]
            x = [r["processorMs"] for r in some]
            y = [r["rayP95"] / 2 ** r["level"] for r in some]
            axis.plot(x, y, "o-", color=colour, label=kind, markersize=4, linewidth=1)
            for r, u, v in zip(some, x, y):
                if r["level"] % 2 == 1:
                    axis.annotate(str(r["level"]), (u, v), fontsize=7, xytext=(3, 3),
                                  textcoords="offset points", color=colour)
        axis.set_yscale("log")
        axis.set_xscale("log")
        axis.set_xlabel("processor time of a frame, ms")
        axis.set_ylabel("depth error, object sizes")
    axes[0].legend(fontsize=8)
    save(figure, folder + "/accuracy-leaves.png")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = json.load(file)
    leaves(rows, sys.argv[2])


if __name__ == "__main__":
    main()
