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


if __name__ == "__main__":
    main(sys.argv[1])
