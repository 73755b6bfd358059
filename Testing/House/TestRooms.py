"""Files include those of their own room and of lower ones only, modules those of lower modules; of the
tracer all others see its face only; what lies behind a view's hits sees nothing of how they are found;
every room opens with a README.md that names each of its files and no other; and no folder, whatever
is in it, has more than 30 files.

The order of the modules stands in the CMakeLists.txt of the project, that of the rooms in
vtksvo_rooms() of each module, lowest first.
"""
import os
import re
import sys


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def modules_of(root):
    """Folders of the modules, lowest first."""
    found = re.findall(r"^  (\w+/\w+)/vtk\.module", text_of(root, "CMakeLists.txt"), re.M)
    plugin = [
        os.path.join("Plugin", name)
        for name in sorted(os.listdir(os.path.join(root, "Plugin")))
        if os.path.exists(os.path.join(root, "Plugin", name, "vtk.module"))
    ]
    return found + plugin


def rooms_of(root, module):
    """Rooms of a module, lowest first; "" is the module's own folder, above all of them."""
    found = re.search(r"\bROOMS((?:\s+\w+)+?)\s*(?:\)|INSTALL|PRECOMPILED)", text_of(root, module, "CMakeLists.txt"))
    return (found.group(1).split() if found else []) + [""]


def is_source(name):
    return name.endswith((".h", ".cxx", ".glsl"))


def place_files(root):
    """Name of a file -> (rank of its module, rank of its room, path)."""
    places, problems = {}, []
    for rank, module in enumerate(modules_of(root)):
        rooms = rooms_of(root, module)
        folder = os.path.join(root, module)
        for name in os.listdir(folder):
            if os.path.isdir(os.path.join(folder, name)) and name not in rooms:
                problems.append(f"{module}/{name} is no room in {module}/CMakeLists.txt")
        for level, room in enumerate(rooms):
            for name in os.listdir(os.path.join(folder, room)):
                if is_source(name):
                    if name in places:
                        problems.append(f"{name} exists twice")
                    places[name] = (rank, level, os.path.join(module, room, name))
    return places, problems


def check_includes(root, places):
    problems = []
    for rank, level, path in places.values():
        for name in re.findall(r'^#include "([^"]+)"', text_of(root, path), re.M):
            if name in places and places[name][:2] > (rank, level):
                problems.append(f"{path} includes {places[name][2]}, which lies above it")
    return problems


def check_face(root, places):
    """Renderers see Rendering/Tracing/Face, no tracer."""
    problems = []
    for _, _, path in places.values():
        if path.startswith(("Rendering/Pass", "Plugin")):
            for name in re.findall(r'^#include "([^"]+)"', text_of(root, path), re.M):
                lies = places[name][2] if name in places else ""
                if lies.startswith("Rendering/Tracing/") and not lies.startswith("Rendering/Tracing/Face/"):
                    problems.append(f"{path} includes {lies}, which is behind the tracer's face")
    return problems


# Those who have views that are traced. All others behind Rendering/Tracing/Layers read hits.
VIEW_OWNERS = ("svoShadowBuffer.cxx", "svoCPUTracer.cxx")


def check_hits(root, places):
    """Whoever reads hits knows nothing of how they are found, not even by way of other headers."""
    rooms = rooms_of(root, "Rendering/Tracing")
    behind = tuple(f"Rendering/Tracing/{room}/" for room in rooms[rooms.index("Layers") + 1 : -1])
    problems = []
    for _, _, path in places.values():
        if not path.startswith(behind) or os.path.basename(path) in VIEW_OWNERS:
            continue
        seen, left = set(), [path]
        while left:
            including = left.pop()
            for name in re.findall(r'^#include "([^"]+)"', text_of(root, including), re.M):
                lies = places[name][2] if name in places else ""
                if lies.startswith("Rendering/Tracing/Layers/"):
                    problems.append(f"{path} gets {lies} from {including}: it is to read svoHits.h")
                elif lies and lies not in seen:
                    seen.add(lies)
                    left.append(lies)
    return problems


MOST_FILES = 30  # that somebody can look over
MADE = {"build", "__pycache__"}  # not the tree's own


def check_folders(root):
    problems, looked_at = [], 0
    for folder, folders, files in os.walk(root):
        if "CMakeCache.txt" in files:  # a build tree
            folders.clear()
            continue
        folders[:] = [name for name in folders if name not in MADE and not name.startswith(".")]
        looked_at += 1
        if len(files) > MOST_FILES:
            problems.append(f"{os.path.relpath(folder, root)} has {len(files)} files: more than {MOST_FILES}")
    return problems if looked_at > 80 else problems + [f"only {looked_at} folders found"]


def check_readmes(root):
    problems = []
    for module in modules_of(root):
        for room in filter(None, rooms_of(root, module)):
            folder = os.path.join(module, room)
            if not os.path.exists(os.path.join(root, folder, "README.md")):
                problems.append(f"{folder} has no README.md")
                continue
            named = set(re.findall(r"`(\w+(?:-inl)?)`", text_of(root, folder, "README.md")))
            there = {
                name.rsplit(".", 1)[0] for name in os.listdir(os.path.join(root, folder)) if is_source(name)
            }
            problems += [f"{folder}/README.md does not name {name}" for name in sorted(there - named)]
            problems += [f"{folder}/README.md names {name}, which is not there" for name in sorted(named - there)]
    return problems


def main(root):
    places, problems = place_files(root)
    if len(places) < 150:
        problems.append(f"only {len(places)} files found")
    problems += check_includes(root, places) + check_face(root, places) + check_hits(root, places)
    problems += check_readmes(root) + check_folders(root)
    for problem in problems:
        print(problem)
    print(f"{len(places)} files, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
