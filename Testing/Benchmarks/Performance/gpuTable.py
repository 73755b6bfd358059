"""Prints the table of run-gpu.sh: gpuTable.py gpu.json"""
import json
import sys


def main(path):
    with open(path, encoding="utf-8") as file:
        rows = json.load(file)
    rows = [row for row in rows if row["experiment"] == "openGL"]
    methods = list(dict.fromkeys(row["method"] for row in rows))
    frames = {}
    for row in rows:
        key = (row["scene"], row["triangles"], row["situation"])
        frames.setdefault(key, {})[row["method"]] = row
    print("Milliseconds of the clock, medians. `triangles`: of each object.")
    print("| scene | triangles | moves | " + " | ".join(methods) + " |")
    print("|---" * (3 + len(methods)) + "|")
    for (scene, triangles, situation), found in frames.items():
        times = [f"{found[name]['wallMs']:.2f}" if name in found else "" for name in methods]
        print(f"| {scene} | {triangles} | {situation} | " + " | ".join(times) + " |")
    print("\nOf the first frame, which builds octrees, compiles shaders and sends all, processor time (ms); MiB in OpenGL.")
    print("| scene | triangles | " + " | ".join(methods) + " |")
    print("|---" * (2 + len(methods)) + "|")
    for (scene, triangles, situation), found in frames.items():
        if situation != next(iter(frames))[2]:
            continue
        cells = [f"{row.get('firstProcessorMs', 0):.0f}" + (f", {row['gpuMiB']:.0f}" if row.get("gpuMiB") else "")
                 for row in (found[name] for name in methods if name in found)]
        print(f"| {scene} | {triangles} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main(sys.argv[1])
