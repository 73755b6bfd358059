"""What tables and plots of Documentation/Performance.md ask of the rows."""
import math

OURS, SPOT = "svo, point light", "svo"
SHADOWS, PLAIN, EMPTY = "vtkShadowMapPass", "vtk, no shadows", "vtk, empty frame"
PHASES = ["collect", "eye", "mark", "lights", "shade", "present"]
SITUATIONS = {"retraced": "everything retraced", "all": "all objects move",
              "one": "one object moves", "camera": "only the camera moves",
              "nothing": "nothing moves"}


def some(rows, experiment, turn=None, **wanted):
    return [r for r in rows if r["experiment"] == experiment and r.get("turn") == turn
            and all(r.get(key) == value for key, value in wanted.items())]


def only(rows, key, experiment, turn=None, **wanted):
    """The figure of the one row that is wanted; None if it was not measured."""
    found = some(rows, experiment, turn, **wanted)
    return found[0].get(key) if found else None


def ratio(a, b):
    return None if a is None or not b else a / b


def values(rows, key):
    return sorted({r[key] for r in rows})


def best(rows, kernels, **wanted):
    """The most rays a second of some kernels."""
    rates = [r["raysPerSecond"] for r in some(rows, "rays", **wanted)
             if any(r["kernel"].startswith(kernel) for kernel in kernels)]
    return max(rates) if rates else None


WALKED = ["voxel, blocks"]
EXACT = ["triangle"]
EMBREE = ["Embree, 1 ", "Embree, 8", "Embree, 16"]
PACKETS = EMBREE[1:]


def meshes(rows):
    """The real ones, of which every instruction set was measured."""
    return [m for m in dict.fromkeys(r["mesh"] for r in some(rows, "rays"))
            if m.endswith(".off")]


def rays_against(rows, ours, theirs, camera, instruction_set, level=10):
    """Geometric mean over the meshes of our rays a second by theirs."""
    ratios = []
    for mesh in meshes(rows):
        wanted = {"mesh": mesh, "camera": camera, "level": level,
                  "instructionSet": instruction_set}
        one = ratio(best(rows, ours, **wanted), best(rows, theirs, **wanted))
        if one:
            ratios.append(math.log(one))
    return math.exp(sum(ratios) / len(ratios)) if ratios else None


def crossing(points):
    """From which x on y stays above 1, interpolated between logarithms; points: sorted pairs. The
    least x if all are above, None if the last one is not."""
    if not points or points[-1][1] < 1.0:
        return None
    for (x0, y0), (x1, y1) in reversed(list(zip(points, points[1:]))):
        if y0 < 1.0:
            share = -math.log(y0) / (math.log(y1) - math.log(y0))
            return math.exp(math.log(x0) + share * (math.log(x1) - math.log(x0)))
    return points[0][0]


def overtaking(rows):
    """What is compared -> (triangles, how many times as fast we are), sorted, for each peer."""
    result = {}
    for situation in ("camera", "all"):
        for peer, name in ((SHADOWS, "vtkShadowMapPass"), (PLAIN, "VTK without shadows")):
            points = []
            for count in values(some(rows, "triangles"), "triangles"):
                times = [only(rows, "processorMs", "triangles", method=method, triangles=count,
                              situation=situation) for method in (SPOT, peer)]
                points.append((count, ratio(times[1], times[0])))
            result[f"frames, {SITUATIONS[situation]}: {name}"] = points
    balls = [r for r in some(rows, "rays") if r["mesh"] == "bumpy sphere"]
    for camera in ("far", "near"):
        for name, ours, theirs in (
                ("exact rays, {}: Embree's best", EXACT, EMBREE),
                ("walked rays, {}: Embree's best packet", WALKED, PACKETS),
                ("walked rays, {}: NanoVDB", WALKED, ["voxel, NanoVDB"])):
            points = []
            for count in values(balls, "triangles"):
                wanted = {"mesh": "bumpy sphere", "camera": camera, "triangles": count}
                both = ratio(best(rows, ours, **wanted), best(rows, theirs, **wanted))
                if both:
                    points.append((count, both))
            result[name.format(camera)] = points
    result = {name: [p for p in points if p[1]] for name, points in result.items()}
    return {name: points for name, points in result.items() if points}
