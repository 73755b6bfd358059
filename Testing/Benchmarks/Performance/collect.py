"""Gathers the rows of all runs of run-performance.sh in one file: medians of rows that measure the same.

    collect.py folder performance.json key=value...

before-*.json are rows of another commit; they and now-*.json, which were measured in turn with them,
have "turn": "before" or "now". Keys and values are kept in the first row, with the machine's.
"""
import glob
import json
import os
import re
import statistics
import sys

SETTINGS = ["turn", "experiment", "scene", "situation", "method", "instructionSet", "triangles",
            "objects", "level", "lights", "threads", "width", "height", "mesh", "camera", "kernel"]


def rows_of(folder):
    for path in sorted(glob.glob(os.path.join(folder, "*.json"))):
        turn = os.path.basename(path).split("-")[0]
        with open(path, encoding="utf-8") as file:
            for row in json.load(file):
                yield {"turn": turn, **row} if turn in ("before", "now") else row
    paraview = os.path.join(folder, "paraview.txt")
    if os.path.exists(paraview):
        with open(paraview, encoding="utf-8") as file:
            for lights, kind, surface, ours in re.findall(
                    r"orbit, (.*), (.*): Surface ([\d.]+), SVO ([\d.]+)", file.read()):
                for method, rate in (("Surface", surface), ("SVO", ours)):
                    yield {"experiment": "paraview", "scene": lights, "situation": kind,
                           "method": method, "framesPerSecond": float(rate)}


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        text = file.read()
    found = [re.search(key + r"\s*: (.*)", text) for key in ("model name", "cpu family", "model\t")]
    name, family, model = [match[1] if match else "unknown" for match in found]
    return {"experiment": "machine", "processor": f"{name} (family {family}, model {model})",
            "processors": os.cpu_count(), "load": round(os.getloadavg()[2], 1)}


def median(group):
    """Of the figures that all rows of a group have."""
    result = {key: group[0][key] for key in SETTINGS if key in group[0]}
    for key in group[0]:
        if key not in SETTINGS and all(key in row for row in group):
            values = [row[key] for row in group]
            result[key] = values[0] if isinstance(values[0], str) else statistics.median(values)
    result["runs"] = len(group)
    return result


def main():
    groups = {}
    for row in rows_of(sys.argv[1]):
        groups.setdefault(tuple(row.get(key) for key in SETTINGS), []).append(row)
    rows = [{**machine(), **dict(pair.split("=", 1) for pair in sys.argv[3:])}]
    rows += [median(group) for group in groups.values()]
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write("[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]\n")


if __name__ == "__main__":
    main()
