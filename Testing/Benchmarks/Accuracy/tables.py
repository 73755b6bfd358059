"""Writes the tables of Documentation/Accuracy.md from the measurements.

    tables.py accuracy.json Accuracy.md

"""
import json
import sys

from pages import fill, number, percent, table

KINDS = ["voxel", "plane", "triangle", "automatic"]
LIGHTS = ["directional", "spot", "point", "near point"]


def mean(rows, key):
    return sum(r[key] for r in rows) / len(rows) if rows else float("nan")


def worst(rows, key):
    return max(r[key] for r in rows)


def spread(rows, key, form=number):
    """Smallest to largest of the meshes."""
    low, high = min(r[key] for r in rows), max(r[key] for r in rows)
    return form(low) if form(low) == form(high) else f"{form(low)} - {form(high)}"


def bars(rows):
    lines = []
    for r in rows:
        if r["experiment"] == "bars":
            at_least = "union" in r["bar"]
            lines.append([r["bar"], ("at least " if at_least else "") + number(r["limit"]),
                          number(r["measured"]), "met" if r["met"] else "**missed**", r["where"]])
    return table(["what", "bar", "measured, worst", "", "where"], lines)


def leaves(rows):
    lines = []
    for kind in KINDS:
        some = [r for r in rows if r["experiment"] == "leaves" and r["level"] == 10
                and r["leaves"] == kind]
        lines.append([kind, spread(some, "rayMedian"), spread(some, "rayP95"),
                      spread(some, "normalP99"), spread(some, "rayMax"),
                      spread(some, "grazingP95"), spread(some, "edgeP95"),
                      spread(some, "facetAngleMedian"), spread(some, "facetAngleP95"),
                      spread(some, "falseHits"), spread(some, "falseMisses"),
                      spread(some, "silhouetteIoU", lambda v: f"{v:.4f}")])
    raster = [r for r in rows if r.get("method") == "vtkRasterizer" and r["experiment"] == "shadows"
              and r["light"] == "directional"]
    lines.append(["VTK's rasteriser", spread(raster, "rayMedian"), spread(raster, "rayP95"),
                  spread(raster, "normalP99"), spread(raster, "rayMax"),
                  spread(raster, "grazingP95"), spread(raster, "edgeP95"), "", "",
                  spread(raster, "falseHits"), spread(raster, "falseMisses"),
                  spread(raster, "silhouetteIoU", lambda v: f"{v:.4f}")])
    return table(["leaves", "median", "95 %", "along n, 99 %", "worst", "n.v below 0.1, 95 %",
                  "near edges, 95 %", "facet, median", "facet, 95 %", "false hits", "false misses",
                  "IoU"], lines)


def levels(rows):
    lines = []
    some = [r for r in rows if r["experiment"] == "leaves"]
    for level in sorted(set(r["level"] for r in some)):
        here = [r for r in some if r["level"] == level]
        lines.append([str(level), spread(here, "buildMs"),
                      spread(here, "octreeKiB", lambda v: number(v / 1024))])
        for kind in KINDS:
            of = [r for r in here if r["leaves"] == kind]
            lines[-1].append(f"{number(mean(of, 'processorMs'))} ms, {number(mean(of, 'rayP95'))}")
    return table(["level", "build, ms", "octree, MiB"] + KINDS, lines)


def shadow_rows(rows, **wanted):
    return [r for r in rows if r["experiment"] == "shadows"
            and all(r.get(key) == value for key, value in wanted.items())]


def judged(name, rows):
    return [name, number(mean(rows, "processorMs")),
            percent(mean(rows, "mapWrong")) if "mapWrong" in rows[0] else "",
            percent(mean(rows, "meshWrong")), percent(mean(rows, "meshWrongTolerant")),
            percent(mean(rows, "meshFalseDark")), percent(mean(rows, "meshFalseLit")),
            f"{mean(rows, 'meshIoU'):.3f}"]


JUDGED = ["time, ms", "wrong against rays on the octree", "wrong against the mesh",
          "one pixel tolerated", "falsely dark", "falsely lit", "IoU"]


def shadows(rows):
    lines = []
    for light in LIGHTS:
        for resolution in sorted(set(r["resolution"] for r in shadow_rows(rows)
                                     if "resolution" in r)):
            some = shadow_rows(rows, light=light, method="svo", level=10, leaves="automatic",
                               technique="buffer", bias="automatic", resolution=resolution)
            lines.append([light] + judged(f"buffer, {resolution}", some))
        some = shadow_rows(rows, light=light, method="svo", level=10, leaves="automatic",
                           technique="rays")
        lines.append([light] + judged("rays", some))
        for resolution in (1024, 2048, 4096):
            some = shadow_rows(rows, light=light, method="vtkShadowMapPass", resolution=resolution)
            if some:
                lines.append([light] + judged(f"vtkShadowMapPass, {resolution}", some))
    return table(["light", "technique, texels"] + JUDGED, lines)


def biases(rows):
    lines = []
    for bias in ("automatic", "none", "1 voxel", "2 voxels", "4 voxels"):
        some = shadow_rows(rows, method="svo", level=10, leaves="automatic", technique="buffer",
                           resolution=2048, bias=bias)
        lines.append(judged(bias, some))
    return table(["bias"] + JUDGED, lines)


def shadow_levels(rows):
    lines = []
    for level in sorted(set(r["level"] for r in shadow_rows(rows, method="svo"))):
        for technique in ("buffer", "rays"):
            some = [r for r in shadow_rows(rows, method="svo", level=level, leaves="automatic",
                                           technique=technique)
                    if technique == "rays" or (r["resolution"] == 2048 and r["bias"] == "automatic")]
            lines.append(judged(f"{level}, automatic, {technique}", some))
    for kind in ("voxel", "plane", "triangle"):
        for technique in ("buffer", "rays"):
            some = shadow_rows(rows, method="svo", level=10, leaves=kind, technique=technique)
            lines.append(judged(f"10, {kind}, {technique}", some))
    return table(["level, leaves, technique"] + JUDGED, lines)


def contact(rows):
    lines = []
    for kind, filtered in [(kind, False) for kind in KINDS] + [("automatic", True)]:
        gaps, acne = ([r for r in rows if r["experiment"] == experiment and r["leaves"] == kind
                       and r["filterShadows"] == filtered] for experiment in ("contact", "acne"))
        line = [kind + (", filtered" if filtered else "")]
        line += [number(next(r["gapVoxels"] for r in gaps if r["light"] == light))
                 for light in LIGHTS]
        lines.append(line + [f"{sum(r['selfShadowed'] for r in acne)} of "
                             f"{sum(r['litPixels'] for r in acne)}"])
    return table(["leaves"] + [f"gap, {light}" for light in LIGHTS] + ["self-shadowed pixels"],
                 lines)


def terminator(rows):
    lines = []
    some = [r for r in rows if r["experiment"] == "terminator"]
    for kind, technique, filtered in ([(kind, technique, False) for kind in KINDS
                                       for technique in ("buffer", "rays")]
                                      + [("automatic", "buffer", True)]):
        here = [r for r in some if r["leaves"] == kind and r["technique"] == technique
                and r["filterShadows"] == filtered]
        lines.append([f"{kind}, {technique}" + (", filtered" if filtered else ""),
                      f"{sum(r['toothed'] for r in here)} of {sum(r['litPixels'] for r in here)}",
                      percent(worst(here, "throughWall"))])
    return table(["leaves, technique", "pixels darkened by their own facets",
                  "lit through a thin wall, worst"], lines)


def pixel_errors(rows):
    lines = []
    some = [r for r in rows if r["experiment"] == "pixelError"]
    for kind in ("voxel", "automatic"):
        for error in sorted(set(r["pixelError"] for r in some)):
            here = [r for r in some if r["pixelError"] == error and r["leaves"] == kind]
            lines.append([kind, number(error), spread(here, "level", str),
                          number(here[0]["promisedPixels"]), number(worst(here, "movedMax")),
                          number(worst(here, "movedP99")), number(worst(here, "movedMedian")),
                          percent(worst(here, "beyondPromise")), number(mean(here, "processorMs")),
                          spread(here, "falseMisses")])
    return table(["leaves", "pixel error", "level taken", "promised, pixels", "worst", "99 %",
                  "median", "beyond the promise", "time, ms", "false misses"], lines)


def anti_aliasing(rows):
    lines = []
    some = [r for r in rows if r["experiment"] == "antiAliasing"]
    ways = {(False, False): "off", (True, False): "more rays only", (True, True): "on"}
    for technique, resolution in dict.fromkeys((r["technique"], r["resolution"]) for r in some):
        for way, name in ways.items():
            here = [r for r in some if r["technique"] == technique and
                    r["resolution"] == resolution and
                    (r["antiAliasing"], r["filterShadows"]) == way]
            if here:
                lines.append(["rays" if technique == "rays" else f"buffer, {resolution}",
                              "on" if technique == "rays" and way[0] else name,
                              number(mean(here, "shadowEdgeRms")), number(mean(here, "edgeRms")),
                              number(mean(here, "rms")), number(mean(here, "processorMs"))])
    return table(["shadows", "anti-aliasing", "error of shadow edges", "error of all edges",
                  "error of all pixels", "time, ms"], lines)


def paper(rows):
    lines = []
    some = [r for r in rows if r["experiment"] == "paper"]
    names = list(dict.fromkeys(
        (r["method"], r.get("resolution")) for r in some if r["method"] != "vtkRasterizer"))
    for method, resolution in names:
        line = [method + (f", {resolution}" if resolution else "")]
        for light in ("point", "spot"):
            here = [r for r in some if r["method"] == method and r.get("resolution") == resolution
                    and r["light"] == light]
            line += [f"{number(mean(here, 'processorMs'))}", percent(mean(here, "meshWrong")),
                     number(mean(here, "rayP95"))] if here else ["", "", ""]
        lines.append(line)
    return table(["settings", "point: ms", "wrong shadows", "depth error, 95 %", "spot: ms",
                  "wrong shadows", "depth error, 95 %"], lines)


def passes(rows):
    lines = []
    for light in LIGHTS:
        some = shadow_rows(rows, light=light, method="vtkSVORenderPass")
        lines.append([light] + [number(mean(some, key)) for key in (
            "frameMs", "collectMs", "traceMs", "shadowMs", "presentMs")] +
            [number(mean(some, "octreeKiB") / 1024)])
    return table(["light", "frame, ms", "collect", "trace", "shadow", "present", "octrees, MiB"],
                 lines)


# What the settings of the paper's scenes are called, as one writes them.
SETTINGS = {
    "defaults": "nothing",
    "level 8": "`MaximumLevel` 8",
    "level 9": "`MaximumLevel` 9",
    "level 11": "`MaximumLevel` 11",
    "voxel leaves": "`LeafGeometry` voxel",
    "triangle leaves": "`LeafGeometry` triangle",
    "full depth": "`PixelError` 0",
    "pixel error 2": "`PixelError` 2",
    "pixel error 4": "`PixelError` 4",
    "512 texels": "`ShadowBufferResolution` 512",
    "1024 texels": "`ShadowBufferResolution` 1024",
    "4096 texels": "`ShadowBufferResolution` 4096",
    "shadow rays": "`ShadowTechnique` rays",
    "voxel leaves, level 8, 512 texels":
        "`LeafGeometry` voxel, `MaximumLevel` 8, `ShadowBufferResolution` 512",
    "triangle leaves, full depth, rays":
        "`LeafGeometry` triangle, `PixelError` 0, `ShadowTechnique` rays",
}


def wishes(rows):
    """I want ... then set ...: the fastest settings that were measured and are good enough."""
    means = {}
    for name in SETTINGS:
        some = [r for r in rows if r["experiment"] == "paper" and r["method"] == name]
        means[name] = (mean(some, "processorMs"), mean(some, "meshWrong"),
                       mean(some, "octreeKiB") / 1024)

    def figures(name):
        time, wrong, memory = means[name]
        return [SETTINGS[name], f"{number(time)} ms, {percent(wrong)} wrong shadows, "
                f"{number(memory)} MiB of octrees"]

    def fastest(limit):
        good = [name for name in means if means[name][1] <= limit]
        return figures(min(good, key=lambda name: means[name][0]))

    smooth = {r: [row for row in rows if row["experiment"] == "antiAliasing"
                  and row["technique"] == "buffer" and row["resolution"] == 2048
                  and row["antiAliasing"] == r and row["filterShadows"] == r]
              for r in (False, True)}
    gain = mean(smooth[True], "edgeRms") / mean(smooth[False], "edgeRms")
    cost = mean(smooth[True], "processorMs") / mean(smooth[False], "processorMs")
    return table(["I want", "then set", "the paper's scenes, measured"], [
        ["a good picture without thinking"] + figures("defaults"),
        ["speed; 1 % of wrong shadows do no harm"] + fastest(0.01),
        ["the fastest with at most 0.3 % wrong"] + fastest(0.003),
        ["the fastest with at most 0.1 % wrong"] + fastest(0.001),
        ["the exact picture"] + fastest(1e-4),
        ["small octrees"] + figures("level 8"),
        ["smooth edges", "`AntiAliasing` on", f"{number(cost)} times the time, edges {number(gain)}"
         " times as wrong as without ([below](#anti-aliasing))"],
    ])


SECTIONS = {"bars": bars, "leaves": leaves, "levels": levels, "shadows": shadows, "biases": biases,
            "shadow-levels": shadow_levels, "contact": contact, "terminator": terminator,
            "pixel-error": pixel_errors, "anti-aliasing": anti_aliasing, "paper": paper, "passes": passes, "wishes": wishes}


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as measurements:
        fill(sys.argv[2], SECTIONS, json.load(measurements))
