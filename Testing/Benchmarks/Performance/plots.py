"""Draws the plots of Documentation/Performance.md.

    plots.py performance.json folder
"""
import json
import sys

from figures import label, panels, pyplot, save
from measured import (EMBREE, EMPTY, EXACT, OURS, PHASES, PLAIN, SHADOWS, SITUATIONS, SPOT, WALKED,
                      best, only, overtaking, some, values)

COLOURS = {SPOT: "#1b6ca8", OURS: "#1b6ca8", SHADOWS: "#888888", PLAIN: "#d9a400",
           EMPTY: "#c8c8c8"}
NAMES = {SPOT: "ours", OURS: "ours", SHADOWS: "vtkShadowMapPass", PLAIN: "VTK, no shadows",
         EMPTY: "empty frame"}
PHASE_COLOURS = ["#bbbbbb", "#1b6ca8", "#8fc1e3", "#d9a400", "#3a8c3f", "#777777"]


def logarithmic(axis, x_ticks=None):
    axis.set_xscale("log")
    axis.set_yscale("log")
    low, high = axis.get_ylim()
    y_ticks = [d * 10 ** e for e in range(-2, 5) for d in (1, 2, 5) if low <= d * 10 ** e <= high]
    axis.set_yticks(y_ticks, [f"{t:g}" for t in y_ticks])
    if x_ticks:
        axis.set_xticks(x_ticks, [f"{t:.2g}" for t in x_ticks])
    axis.minorticks_off()


def room_for_legend(axis, factor=1.35):
    axis.set_ylim(top=factor * axis.get_ylim()[1])


def scenes(rows, folder):
    names = values(some(rows, "scenes"), "scene")
    if len(names) < 2:
        return
    figure, axes = panels(names, "Processor time of a frame, 1920x1080, a spot light", 2.7)
    methods = [SPOT, SHADOWS, PLAIN]
    for axis, scene in zip(axes, names):
        situations = [s for s in SITUATIONS if some(rows, "scenes", scene=scene, situation=s)]
        for i, method in enumerate(methods):
            heights = [only(rows, "processorMs", "scenes", scene=scene, situation=s, method=method)
                       for s in situations]
            axis.bar([x + 0.27 * (i - 1) for x in range(len(situations))], heights, 0.25,
                     color=COLOURS[method], label=NAMES[method])
        axis.set_xticks(range(len(situations)), situations)
        axis.grid(False, axis="x")
        room_for_legend(axis)
        label(axis, "what moves", "ms", axis is axes[0])
    save(figure, folder, "performance-scenes.png")


def stacked(axis, rows, names, suffix):
    lower = [0.0] * len(rows)
    for phase, colour in zip(PHASES, PHASE_COLOURS):
        heights = [row[phase + suffix] for row in rows]
        axis.bar(names, heights, 0.6, bottom=lower, color=colour, label=phase)
        lower = [a + b for a, b in zip(lower, heights)]
    axis.grid(False, axis="x")


def phases(rows, folder):
    frames = some(rows, "scenes", scene="paper4", method=OURS)
    sets = some(rows, "instructionSets")
    threads = sorted(some(rows, "threads", method=OURS, situation="retraced"),
                     key=lambda r: r["threads"])
    shadows = some(rows, "shadows")
    if not (frames and sets and threads and shadows):
        return
    figure, axes = panels(["what moves", "instruction sets, everything retraced",
                           "threads, everything retraced, on the clock, least",
                           "shadow technique, everything retraced"],
                          "paper4, point light: where the time of a frame goes", 2.9)
    stacked(axes[0], frames, [r["situation"] for r in frames], "Ms")
    stacked(axes[1], sets, [r["instructionSet"] for r in sets], "Ms")
    stacked(axes[2], threads, [str(r["threads"]) for r in threads], "WallLeastMs")
    stacked(axes[3], shadows, [r["method"] for r in shadows], "Ms")
    for axis, unit in zip(axes, ("processor time, ms", "processor time, ms", "ms",
                                 "processor time, ms")):
        label(axis, "", unit, legend=False)
    room_for_legend(axes[0])
    axes[0].legend(fontsize=7, ncol=3)
    save(figure, folder, "performance-phases.png")


def sweeps(rows, folder):
    panel = [("triangles", "triangles", "triangles of one object, the camera moves", "camera"),
             ("triangles", "triangles", "triangles of one object, it moves", "all"),
             ("objects", "objects", "objects of 17 000 triangles, the camera moves", "camera"),
             ("sizes", "million pixels", "pixels of the window, paper4 retraced", "retraced")]
    panel = [p for p in panel if some(rows, p[0])]
    if not panel:
        return
    figure, axes = panels([p[2] for p in panel], "Processor time of a frame, a spot light", 2.9)
    for axis, (experiment, key, _, situation) in zip(axes, panel):
        for method in (SPOT, SHADOWS, PLAIN, EMPTY):
            here = [{**r, "million pixels": 1e-6 * r["width"] * r["height"]}
                    for r in some(rows, experiment, method=method, situation=situation)]
            here.sort(key=lambda r: r[key])
            if here:
                axis.plot([r[key] for r in here], [r["processorMs"] for r in here], "o-",
                          color=COLOURS[method], label=NAMES[method], markersize=4, linewidth=1)
        logarithmic(axis, [r[key] for r in here] if experiment == "sizes" else None)
        label(axis, key, "ms", experiment == "sizes" or axis is axes[0])
    save(figure, folder, "performance-sweeps.png")


def overtakes(rows, folder):
    curves = overtaking(rows)
    sides = [side for side in ("frames", "rays") if any(side in name for name in curves)]
    if not sides:
        return
    titles = {"frames": "frames", "rays": "rays of one core, level 10"}
    figure, axes = panels([titles[side] for side in sides],
                          "How many times as fast as its peers ours is, by the triangles of one "
                          "object (above the line: faster)", 3.4)
    styles = {"far": "--", "near": "-", "only the camera moves": "-", "all objects move": "--"}
    colours = {"vtkShadowMapPass": "#888888", "VTK without shadows": "#d9a400",
               "exact rays": "#1b6ca8", "walked rays": "#c1440e", "NanoVDB": "#3a8c3f"}
    for name, points in curves.items():
        axis = next(a for a, side in zip(axes, sides) if side in name)
        colour = next(c for key, c in reversed(colours.items()) if key in name)
        style = next(s for key, s in styles.items() if key in name)
        axis.plot([x for x, _ in points], [y for _, y in points], "o" + style, color=colour,
                  label=name.replace("frames, ", ""), markersize=3.5, linewidth=1)
    for axis in axes:
        axis.set_yscale("log")
        room_for_legend(axis, 12.0)
        logarithmic(axis)
        axis.axhline(1.0, color="black", linewidth=0.8)
        label(axis, "triangles", "times as fast")
    save(figure, folder, "performance-overtakes.png")


def levels(rows, folder):
    frames = some(rows, "levels")
    rays = [r for r in some(rows, "rays", mesh="armadillo.off", camera="near")]
    if not frames or len(values(rays, "level")) < 2:
        return
    figure, axes = panels(["a frame of paper1a", "rays of one core, the armadillo from near"],
                          "Levels and leaf geometry", 3.2)
    colours = {"voxel": "#c1440e", "plane": "#d9a400", "triangle": "#1b6ca8",
               "automatic": "#3a8c3f"}
    for kind, colour in colours.items():
        here = sorted((r for r in frames if r["method"] == kind), key=lambda r: r["level"])
        axes[0].plot([r["level"] for r in here], [r["processorMs"] for r in here],
                     "o--" if kind == "automatic" else "o-", color=colour, label=kind,
                     markersize=4, linewidth=1)
    lines = [("voxels, walked", WALKED, "#c1440e"), ("triangles, walked", ["triangle, bl"], "#d9a400"),
             ("whole tiles", ["triangle, whole"], "#1b6ca8"), ("Embree's best", EMBREE, "#888888"),
             ("NanoVDB", ["voxel, NanoVDB"], "#3a8c3f")]
    for name, kernels, colour in lines:
        points = [(level, best(rows, kernels, mesh="armadillo.off", camera="near", level=level))
                  for level in values(rays, "level")]
        points = [(x, y / 1e6) for x, y in points if y]
        axes[1].plot([x for x, _ in points], [y for _, y in points], "o-", color=colour, label=name,
                     markersize=4, linewidth=1)
    axes[0].set_ylim(bottom=0)
    axes[1].set_ylim(bottom=0)
    room_for_legend(axes[1])
    label(axes[0], "level", "processor time, ms")
    label(axes[1], "level", "million rays a second")
    save(figure, folder, "performance-levels.png")


def rays(rows, folder):
    sets = [s for s in ("AVX-512", "AVX2", "SSE4", "scalar")
            if some(rows, "rays", instructionSet=s, level=10)]
    if len(sets) < 2:
        return
    cameras = ["far", "near", "10 instances"]
    figure, axes = panels(cameras, "Million rays a second of one core, level 10, geometric means of "
                          "four meshes", 2.9)
    bars = [("walked, cubes", WALKED, "#c1440e"), ("exact, walked or tiles",
                                                   EXACT + ["a frame's rays"], "#1b6ca8"),
            ("Embree, 1 ray", EMBREE[:1], "#dddddd"), ("Embree, 8 rays", EMBREE[1:2], "#aaaaaa"),
            ("Embree, 16 rays", EMBREE[2:], "#777777"), ("NanoVDB", ["voxel, NanoVDB"], "#3a8c3f")]
    names = [r["mesh"] for r in some(rows, "rays", instructionSet=sets[0], camera="far", level=10)]
    names = [m for m in dict.fromkeys(names) if m.endswith(".off")]
    for axis, camera in zip(axes, cameras):
        for i, (name, kernels, colour) in enumerate(bars):
            heights = []
            for which in sets:
                rates = [best(rows, kernels, mesh=m, camera=camera, level=10, instructionSet=which)
                         for m in names]
                product = 1.0
                for one in rates:
                    product *= (one or 0.0) / 1e6
                heights.append(product ** (1 / len(names)))
            if any(heights):
                axis.bar([x + 0.14 * (i - 2.5) for x in range(len(sets))], heights, 0.13,
                         color=colour, label=name)
        axis.set_xticks(range(len(sets)), sets)
        axis.grid(False, axis="x")
        label(axis, "", "million rays a second", camera == "far")
    save(figure, folder, "performance-rays.png")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = json.load(file)
    for draw in (scenes, phases, sweeps, overtakes, levels, rays):
        draw(rows, sys.argv[2])


if __name__ == "__main__":
    main()
