"""Writes the tables of Documentation/Performance.md from the measurements.

    tables.py performance.json Performance.md

Other files beside performance.json are those of other machines: in place of it they fill the table
of machines alone.
"""
import glob
import json
import os
import sys

from measured import (EMBREE, EMPTY, EXACT, OURS, PACKETS, PHASES, PLAIN, SHADOWS, SITUATIONS, SPOT,
                      WALKED, best, crossing, meshes, only, overtaking, ratio, rays_against, some,
                      values)
from pages import fill, number, table

SETS = ["AVX-512", "AVX2", "SSE4", "scalar"]
MISSING = "not measured"


def ms(value):
    return "" if value is None else f"{value:.0f}" if value >= 99.5 else f"{value:.2g}"


def difference(a, b):
    return None if None in (a, b) else a - b


def times(value):
    return "" if value is None else f"{value:.2f}x"


def count(value):
    return f"{value:,.0f}".replace(",", " ")


def rate(value):
    return "" if value is None else f"{value / 1e6:.1f}"


def rows_or_missing(head, lines):
    return table(head, lines) if lines else f"({MISSING})"


def bar_figures(rows):
    """The bars of the fast frame: what, bar, aim, measured, whether more is better, form; and where
    the figure is one of the clock, what it would be by processor time."""
    def frame(key, method, situation):
        return only(rows, key, "scenes", scene="paper4", method=method, situation=situation)

    def against(experiment, **wanted):
        return ratio(only(rows, "processorMs", experiment, "now", scene="paper4", **wanted),
                     only(rows, "processorMs", experiment, "before", scene="paper4", **wanted))

    def refined(method, which, key="processorMs", situation="camera"):
        counts = values(some(rows, "refined"), "triangles")
        return only(rows, key, "refined", method=method, situation=situation,
                    triangles=counts[which]) if counts else None

    yield ("`paper4`, everything retraced, processor time of the frame, by that of 3a32caf", 1.03,
           1.0, against("scenes", method=OURS, situation="retraced"), False, times)
    yield ("the same, AVX2", 1.03, 1.0,
           against("instructionSets", method=OURS, instructionSet="AVX2"), False, times)
    # On the clock the fastest frame counts: what it took is least due to other programs.
    yield ("nothing moves, `paper4`: ms beyond VTK's empty frame", 5, 2,
           difference(frame("wallLeastMs", OURS, "nothing"), frame("wallLeastMs", EMPTY, "nothing")),
           False, ms,
           difference(frame("processorMs", OURS, "nothing"), frame("processorMs", EMPTY, "nothing")))
    yield ("one of ten moves, camera still, by everything retraced", 0.3, 0.15,
           ratio(frame("processorMs", OURS, "one"), frame("processorMs", OURS, "retraced")), False,
           times)
    for which, name, bar, aim in ((0, "17 k", 2.5, 4), (-1, "1.1 M", 10, 15)):
        yield (f"camera orbits ten objects of {name} triangles: rate by that of `vtkShadowMapPass`",
               bar, aim,
               ratio(refined(SHADOWS, which, "wallLeastMs"), refined(SPOT, which, "wallLeastMs")),
               True, times, ratio(refined(SHADOWS, which), refined(SPOT, which)))
    for name, ours, theirs, bars_of_views in (
            ("exact", EXACT, EMBREE, (("far", 0.8, 1.2), ("near", 1.5, 3))),
            ("walked", WALKED, PACKETS, (("far", 1.4, 2), ("near", 1.1, 1.5)))):
        for camera, bar, aim in bars_of_views:
            for which in ("AVX-512", "AVX2"):
                yield (f"{name} rays a core, level 10, {camera}, {which}, by Embree's best"
                       + (" packet" if theirs == PACKETS else ""), bar, aim,
                       rays_against(rows, ours, theirs, camera, which), True, times)
    yield ("ten objects of 1.1 M triangles, by ten of 17 k, retraced", 1.8, 1.3,
           ratio(refined(OURS, -1, situation="retraced"), refined(OURS, 0, situation="retraced")),
           False, times)
    yield ("`ShadowRays`, by a buffer of 2048, `paper4` retraced", 2.0, 1.3,
           ratio(only(rows, "processorMs", "shadows", method="rays"),
                 only(rows, "processorMs", "shadows", method="2048")), False, times)
    yield ("ParaView, orbit, one light, 1920x1080: rate by that of *Surface* without shadows", 0.7,
           1.0, ratio(*(only(rows, "framesPerSecond", "paraview", method=method,
                             scene="one light", situation="still")
                        for method in ("SVO", "Surface"))), True, times)


def bars(rows):
    lines = []
    for what, bar, aim, measured, more, form, *by_processor in bar_figures(rows):
        line = [what, ("at least " if more else "at most ") + form(bar), form(aim)]
        alone = measured is None and by_processor
        if alone:
            measured = by_processor[0]
        if measured is None:
            lines.append(line + [MISSING, ""])
            continue
        met = measured >= bar if more else measured <= bar
        missed_by = bar / measured if more else measured / bar
        note = " by processor time" if alone else f" (by processor time {form(by_processor[0])})" if by_processor else ""
        lines.append(line + [form(measured) + note,
                             "met" if met else f"**missed** by {missed_by:.2f}x"])
    return table(["what", "bar", "aim", "measured", ""], lines)


def machine(rows):
    row = some(rows, "machine")[0]
    text = (f"One run on {row['processors']} cores of an {row['processor']}, commit "
            f"{row.get('commit', 'unknown')}")
    text += f"; medians of {row['frames']} frames, fewer where a frame takes seconds"
    if row["load"] > row["processors"]:
        text += f"; other programs ran beside it (load average {row['load']:.0f})"
    return text + (f"; in turn with {row['against']}." if row.get("against") else ".")


def overtakes(rows):
    lines = []
    for name, points in overtaking(rows).items():
        found = crossing(points)
        text = ("never" if found is None else "at all numbers" if found <= points[0][0]
                else f"from about {count(float(f'{found:.2g}'))} on")
        lines.append([name, text] + [times(y) for _, y in points[:1] + points[-1:]])
    return rows_or_missing(["what, and beside whom", "ours is faster", "at the fewest triangles",
                            "at the most"], lines)


def scenes(rows):
    lines = []
    for scene in values(some(rows, "scenes"), "scene"):
        for situation, text in SITUATIONS.items():
            here = [only(rows, key, "scenes", scene=scene, situation=situation, method=method)
                    for method in (OURS, SPOT, SHADOWS, PLAIN, EMPTY)
                    for key in ("processorMs", "wallMs")]
            if here[0] is not None:
                lines.append([scene, text]
                             + [f"{ms(p)} / {ms(w)}" for p, w in zip(here[::2], here[1::2])]
                             + [times(ratio(here[4], here[2])), times(ratio(here[6], here[2]))])
    return rows_or_missing(["scene", "what moves", "ours, point light", "ours, spot light",
                            "`vtkShadowMapPass`", "VTK, no shadows", "empty frame",
                            "times as fast as `vtkShadowMapPass`", "as VTK without shadows"], lines)


def phase_lines(rows, names, suffix="Ms"):
    lines = []
    for name, row in zip(names, rows):
        parts = [row[phase + suffix] for phase in PHASES]
        whole = row["processorMs" if suffix == "Ms" else "wallLeastMs"]
        lines.append([name] + [ms(part) for part in parts] + [ms(whole)])
    return lines


def phases(rows):
    here = some(rows, "scenes", scene="paper4", method=OURS)
    return rows_or_missing(["`paper4`"] + PHASES + ["frame"],
                           phase_lines(here, [SITUATIONS[r["situation"]] for r in here]))


def threads(rows):
    lines = []
    for situation in ("retraced", "one"):
        here = sorted(some(rows, "threads", method=OURS, situation=situation),
                      key=lambda r: r["threads"])
        lines += phase_lines(here, [f"{SITUATIONS[situation]}, {r['threads']}" for r in here],
                             "WallLeastMs")
        if len(here) > 1:
            ends = here[0], here[-1]
            lines.append(["... times as fast"] + [
                times(ratio(*(r[key] for r in ends)))
                for key in [phase + "WallLeastMs" for phase in PHASES] + ["wallLeastMs"]])
    return rows_or_missing(["`paper4`, threads"] + PHASES + ["frame"], lines)


def cores(rows):
    lines = []
    for situation, text in SITUATIONS.items():
        for row in some(rows, "cores", situation=situation):
            alone = row["tracerCores1Ms"]
            for name, key in [("1 core", "Cores1"), ("in no loop", "Serial")] + [
                    (f"{n} cores", f"Cores{n}") for n in (2, 16, 64)]:
                whole = row[f"tracer{key}Ms"]
                lines.append([f"{text}, {name}"]
                             + [ms(row[f"{phase}{key}Ms"]) for phase in PHASES[1:-1]] + [ms(whole)]
                             + ["" if key == "Cores1" else f"{100.0 * whole / alone:.1f} %"
                                if key == "Serial" else times(alone / whole)])
    return rows_or_missing(["`paper4`, the tracer"] + PHASES[1:-1] + ["tracer", "by one core"], lines)


def instruction_sets(rows):
    lines = []
    for name in SETS:
        here = some(rows, "instructionSets", instructionSet=name)
        line = phase_lines(here, [name])[0] if here else [name] + [""] * (len(PHASES) + 1)
        for kernels, theirs in ((EXACT, EMBREE), (WALKED, PACKETS)):
            for camera in ("far", "near"):
                line.append(times(rays_against(rows, kernels, theirs, camera, name)))
        lines.append(line)
    return table(["`paper4` retraced"] + PHASES
                 + ["frame", "exact rays, far, by Embree's", "near", "walked rays, far", "near"],
                 lines)


def machines(measured):
    """Of lists of rows, one a machine."""
    lines = []
    for rows in measured:
        def frame(method, situation):
            return only(rows, "processorMs", "scenes", scene="paper4", method=method,
                        situation=situation)

        def orbit(method):
            counts = values(some(rows, "refined"), "triangles")
            return only(rows, "processorMs", "refined", method=method, situation="camera",
                        triangles=counts[0]) if counts else None

        host = some(rows, "machine")[0]
        name = f"{host['processor']}, {host.get('commit', 'unknown')}"
        sets = [s for s in SETS[:2] if some(rows, "instructionSets", instructionSet=s)]
        for which in sets:
            # The best set is what everybody has, and what others were measured in turn with.
            best_set = which == sets[0]
            in_turn = some(rows, "scenes", scene="paper4", method=OURS, situation="retraced")
            here = best_set and in_turn or some(rows, "instructionSets", instructionSet=which)
            line = phase_lines(here, [name])[0]
            line.insert(1, which)
            theirs = [frame(SHADOWS, "retraced"), frame(PLAIN, "retraced")]
            line += [ms(t) for t in theirs] + [times(ratio(t, here[0]["processorMs"])) for t in theirs]
            line += [times(ratio(a, b)) if best_set else "" for a, b in (
                (frame(SHADOWS, "all"), frame(SPOT, "all")),
                (frame(SHADOWS, "camera"), frame(SPOT, "camera")), (orbit(SHADOWS), orbit(SPOT)))]
            line += [times(rays_against(rows, kernels, peer, camera, which))
                     for kernels, peer in ((EXACT, EMBREE), (WALKED, PACKETS))
                     for camera in ("far", "near")]
            lines.append(line)
    return rows_or_missing(
        ["processor, commit", "instruction set"] + PHASES
        + ["frame", "`vtkShadowMapPass`", "VTK, no shadows", "times as fast as `vtkShadowMapPass`",
           "as VTK without shadows", "all move: `vtkShadowMapPass`", "the camera moves",
           "it orbits ten of 17 k", "exact rays, far, by Embree's", "near", "walked rays, far",
           "near"], lines)


def peers(experiment, key, form, methods=(SPOT, SHADOWS, PLAIN), situations=("camera", "all")):
    def make(rows):
        lines = []
        for situation in situations:
            here = some(rows, experiment, situation=situation)
            for value in values(here, key):
                figures = [only(rows, "processorMs", experiment, situation=situation, method=method,
                                **{key: value}) for method in methods]
                lines.append([SITUATIONS[situation], form(value)] + [ms(f) for f in figures]
                             + [times(ratio(f, figures[0])) for f in figures[1:3]])
        return rows_or_missing(["what moves", key, "ours, ms", "`vtkShadowMapPass`",
                                "VTK, no shadows"] + (["empty frame"] if len(methods) > 3 else [])
                               + ["times as fast as `vtkShadowMapPass`", "as VTK without shadows"],
                               lines)
    return make


def refined(rows):
    lines = []
    for situation in ("camera", "retraced"):
        here = some(rows, "refined", situation=situation)
        for triangles in values(here, "triangles"):
            figures = [only(rows, "processorMs", "refined", situation=situation, method=method,
                            triangles=triangles)
                       for method in (OURS, OURS + ", shadow rays", SPOT, SHADOWS, PLAIN)]
            lines.append([SITUATIONS[situation], count(triangles)] + [ms(f) for f in figures]
                         + [times(ratio(f, figures[2])) for f in figures[3:]])
    return rows_or_missing(["what moves", "triangles of each A", "ours, point light", "shadow rays",
                            "ours, spot light", "`vtkShadowMapPass`", "VTK, no shadows",
                            "times as fast as `vtkShadowMapPass`", "as VTK without shadows"], lines)


def light_kit(rows):
    lines = []
    for situation in SITUATIONS:
        figures = [only(rows, "processorMs", "lightKit", situation=situation, method=method)
                   for method in (SPOT, SHADOWS, PLAIN)]
        if figures[0] is not None:
            lines.append([SITUATIONS[situation]] + [ms(f) for f in figures]
                         + [times(ratio(f, figures[0])) for f in figures[1:]])
    return rows_or_missing(["what moves", "ours, ms", "`vtkShadowMapPass`", "VTK, no shadows",
                            "times as fast as `vtkShadowMapPass`", "as VTK without shadows"], lines)


def shadows(rows):
    order = ["none", "512", "1024", "2048", "4096", "rays"]
    here = sorted(some(rows, "shadows"), key=lambda r: order.index(r["method"]))
    return rows_or_missing(["shadows"] + PHASES + ["frame"],
                           phase_lines(here, [r["method"] for r in here]))


def levels(rows):
    lines = []
    kinds = ["voxel", "plane", "triangle", "automatic"]
    for level in values(some(rows, "levels"), "level"):
        line = [str(level)]
        for kind in kinds:
            line.append(ms(only(rows, "processorMs", "levels", level=level, method=kind)))
        line.append(number(only(rows, "octreeMiB", "levels", level=level, method="automatic")))
        lines.append(line)
    return rows_or_missing(["level"] + [f"{kind}, ms" for kind in kinds] + ["octree, MiB"], lines)


def ray_levels(rows):
    lines = []
    here = [r for r in some(rows, "rays", mesh="armadillo.off") if r["camera"] in ("far", "near")]
    for camera in ("far", "near"):
        for level in values(here, "level"):
            wanted = {"mesh": "armadillo.off", "camera": camera, "level": level}
            lines.append([camera, str(level)] + [
                rate(best(rows, [kernel], **wanted)) for kernel in (
                    "voxel, blocks", "plane, blocks", "triangle, blocks", "automatic, blocks",
                    "triangle, whole tiles", "Embree, 16 rays", "voxel, NanoVDB")])
    return rows_or_missing(["armadillo", "level", "voxel", "plane", "triangle", "automatic",
                            "whole tiles", "Embree, 16 rays", "NanoVDB"], lines)


def rays(rows):
    lines = []
    for name in SETS:
        for camera in ("far", "near", "10 instances"):
            for mesh in meshes(rows):
                wanted = {"mesh": mesh, "camera": camera, "level": 10, "instructionSet": name}
                figures = [best(rows, [kernel], **wanted) for kernel in (
                    "voxel, blocks", "triangle, blocks", "triangle, whole tiles",
                    "a frame's rays", "Embree, 1 ", "Embree, 8", "Embree, 16", "voxel, NanoVDB")]
                if any(figures):
                    lines.append([name, camera, mesh[:-4]] + [rate(f) for f in figures])
    return rows_or_missing(["instruction set", "view", "mesh", "walked, cubes", "walked, triangles",
                            "whole tiles", "instances", "Embree, 1 ray", "8 rays", "16 rays",
                            "NanoVDB"], lines)


def builders(rows):
    lines = []
    methods = list(dict.fromkeys(r["method"] for r in some(rows, "build")))
    for level in values(some(rows, "build"), "level"):
        here = some(rows, "build", level=level)
        for mesh in dict.fromkeys(r["mesh"] for r in here):
            triangles = next(r["triangles"] for r in here if r["mesh"] == mesh)
            lines.append([mesh[:-4], count(triangles), str(level)] + [
                ms(only(rows, "processorMs", "build", level=level, mesh=mesh, method=method))
                for method in methods])
    return rows_or_missing(["mesh", "triangles", "level"]
                           + [m if m != "octree" else "ours, ms" for m in methods], lines)


def paraview(rows):
    lines = []
    for lights in ("one light", "light kit"):
        for situation in ("still", "interactive"):
            rates = [only(rows, "framesPerSecond", "paraview", scene=lights, situation=situation,
                          method=method) for method in ("SVO", "Surface")]
            if rates[0]:
                lines.append([lights, situation] + [number(r) for r in rates]
                             + [times(ratio(*rates))])
    return rows_or_missing(["light", "frames", "SVO, frames a second", "Surface, no shadows",
                            "ours by Surface's"], lines)


def against(rows):
    lines = []
    for row in rows:
        if row.get("turn") != "now" or "processorMs" not in row or row["method"] == EMPTY:
            continue
        wanted = {key: row.get(key) for key in ("scene", "situation", "method", "instructionSet",
                                                "width")}
        before = only(rows, "processorMs", row["experiment"], "before", **wanted)
        if before:
            name = row.get("instructionSet") or {"lightKit": "light kit"}.get(
                row["experiment"], "point light" if row["method"] == OURS else "spot light")
            lines.append([row["scene"], SITUATIONS[row["situation"]], name, ms(before),
                          ms(row["processorMs"]), times(row["processorMs"] / before)])
    return rows_or_missing(["scene", "what moves", "light, or instruction set", "before, ms",
                            "now, ms", "now by before"], lines)


SECTIONS = {
    "machine": machine, "bars": bars, "overtakes": overtakes, "scenes": scenes, "phases": phases,
    "threads": threads, "cores": cores, "instruction-sets": instruction_sets,
    "triangles": peers("triangles", "triangles", count),
    "objects": peers("objects", "objects", str), "refined": refined,
    "sizes": peers("sizes", "width", str, (SPOT, SHADOWS, PLAIN, EMPTY), ("retraced",)),
    "lights": peers("lights", "lights", str, situations=("retraced",)), "light-kit": light_kit,
    "shadows": shadows, "levels": levels, "ray-levels": ray_levels, "rays": rays,
    "builders": builders, "paraview": paraview, "against": against}


def read(path):
    with open(path, encoding="utf-8") as measurements:
        return json.load(measurements)


if __name__ == "__main__":
    OWN = os.path.join(os.path.dirname(sys.argv[1]), "performance.json")
    FILES = glob.glob(os.path.join(os.path.dirname(sys.argv[1]), "*.json"))
    FILES.sort(key=lambda path: (path != OWN, path))
    fill(sys.argv[2], SECTIONS if sys.argv[1] == OWN else {},
         read(sys.argv[1]))
    fill(sys.argv[2], {"machines": machines}, [read(path) for path in FILES])
