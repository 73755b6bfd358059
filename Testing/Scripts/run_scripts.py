"""Runs scripts of VTK's twice, plain and with vtkSVORenderPass (without shadows) on every renderer, and compares what
their windows show and what they say: a pass that only draws must not be noticed.

usage: run_scripts.py [options] folder or script...
  --output DIR    results lie there; what is there already and no older than the script and the libraries is not run
                  again (scripts-results)
  --samples N,N   of multisampling (0,4)
  --jobs N        at once (the number of processors)
  --timeout S     seconds for one run (120)
  --reasons FILE  what may differ, and why: lines of pattern, tab, reason. The pattern is one of a shell's, for the
                  path below the folder, and may end in @samples
  --interpreter P (this one)

It fetches nothing: the scripts are there already, and so is the data that they read, if any. One line is printed for
each script of which something differs; then the sums. The exit code is 1 if one of them
- shows another picture: more than 1 % of a window's pixels are off by more than 8 of 255,
- prints an error or a warning that it does not print without the pass,
- crashes, fails or runs out of time, and does not without the pass,
unless it is named in the file of reasons. Scripts whose own two plain runs differ are not judged by their pictures.
"""

import argparse
import collections
import concurrent.futures
import fnmatch
import json
import os
import re
import shutil
import signal
import subprocess
import sys

here = os.path.dirname(os.path.abspath(__file__))
LIMIT = 0.01
OFF = 8


def scripts_of(arguments):
    """(path, name) of each script; the name is its path below the folder that was given."""
    for argument in arguments:
        if os.path.isfile(argument):
            yield os.path.abspath(argument), os.path.basename(argument)
        elif not os.path.isdir(argument):
            sys.exit(f"run_scripts.py: there is no {argument}")
        for folder, _, files in sorted(os.walk(argument)):
            for file in sorted(files):
                path = os.path.abspath(os.path.join(folder, file))
                if file.endswith(".py") and file != "__init__.py":
                    yield path, os.path.relpath(path, argument)


def time_of_libraries(interpreter):
    """When the newest library of vtksvo was made."""
    code = ("import vtksvo; print(max(__import__('os').path.getmtime(line.split()[-1])"
            " for line in open('/proc/self/maps') if 'vtkSVO' in line))")
    found = subprocess.run([interpreter, "-c", code], stdout=subprocess.PIPE, text=True)
    if found.returncode != 0:
        sys.exit("run_scripts.py: vtksvo cannot be imported; is it on PYTHONPATH?")
    return float(found.stdout)


def messages_of(text):
    """Errors and warnings of VTK and of Python, without what differs from run to run."""
    found = []
    for line in re.sub(r"\x1b\[[0-9;]*m", "", text).splitlines():
        match = re.search(r"(?:ERR|WARN)\|.*|(?:ERROR|Warning):.*|\b\w+(?:Error|Exception|Warning)\b.*", line)
        if match:
            found.append(re.sub(r"0x[0-9a-f]+|/\S*/|line \d+|\.cxx:\d+", "", match.group()).strip())
    return found


class Run:
    """One script in a process of its own."""

    def __init__(self, options, path, name, mode, samples):
        self.folder = os.path.join(options.output, f"{mode}-{samples}", name)
        self.record = os.path.join(self.folder, "record.json")
        newest = max(os.path.getmtime(path), options.libraries if mode == "traced" else 0)
        if os.path.exists(self.record) and os.path.getmtime(self.record) > newest:
            with open(self.record) as file:
                self.__dict__.update(json.load(file))
            return
        shutil.rmtree(self.folder, ignore_errors=True)
        work = os.path.join(self.folder, "work")
        os.makedirs(work)
        command = [options.interpreter, os.path.join(here, "one_script.py"),
                   "plain" if mode.startswith("plain") else mode, str(samples), self.folder, path]
        # Windows of matplotlib would wait for somebody who closes them.
        environment = dict(os.environ, PYTHONHASHSEED="0", PYTHONDONTWRITEBYTECODE="1", VTK_TEMP_DIR=work,
                           MPLBACKEND="Agg")
        said = os.path.join(self.folder, "output.txt")
        with open(said, "wb") as output:
            process = subprocess.Popen(command, cwd=work, env=environment, stdin=subprocess.DEVNULL,
                                       stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
            try:
                self.code = process.wait(options.timeout)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                self.code = None
        shutil.rmtree(work, ignore_errors=True)
        with open(said, errors="replace") as file:
            self.messages = messages_of(file.read())
        self.pictures = sorted(file for file in os.listdir(self.folder) if file.endswith(".ppm"))
        with open(self.record, "w") as file:
            json.dump({"code": self.code, "messages": self.messages, "pictures": self.pictures}, file)

    def end(self):
        if self.code is None:
            return "out of time"
        return "" if self.code == 0 else f"crash ({signal.Signals(-self.code).name})" if self.code < 0 else "fails"

    def picture(self, name):
        with open(os.path.join(self.folder, name), "rb") as file:
            header = file.readline()
            return header, file.read()


def share_of_pixels(before, after):
    """The largest share of a window's pixels that are off. Windows of other numbers or sizes: 1."""
    if len(before.pictures) != len(after.pictures):
        return 1
    largest = 0
    for name in before.pictures:
        (size, one), (other_size, other) = before.picture(name), after.picture(name)
        if size != other_size:
            return 1
        if one != other:
            off = sum(abs(r - s) > OFF or abs(g - h) > OFF or abs(b - c) > OFF for r, g, b, s, h, c in
                      zip(one[0::3], one[1::3], one[2::3], other[0::3], other[1::3], other[2::3]))
            largest = max(largest, 3 * off / len(one))
    return largest


def judge(options, path, name, samples):
    """(kind, text): what differs, in one line."""
    plain = Run(options, path, name, "plain", samples)
    if plain.end():
        # Nothing to compare with, but for what it may have shown before it failed.
        if plain.code is None or plain.code < 0 or not plain.pictures:
            return "ends badly without the pass", plain.end()
    if not plain.pictures:
        return "no picture", ""
    traced = Run(options, path, name, "traced", samples)
    found = []
    if traced.end() and traced.end() != plain.end():
        found.append(traced.end())
    new = collections.Counter(traced.messages) - collections.Counter(plain.messages)
    new = [message for message in new if message not in plain.messages]
    if new:
        found.append("says: " + "; ".join(new)[:300])
    share = share_of_pixels(plain, traced)
    kind = "same" if share == 0 else "a little different"
    if share > LIMIT and share_of_pixels(plain, Run(options, path, name, "plain-again", samples)) > LIMIT:
        kind = "unsteady without the pass"
    elif share > LIMIT:
        found.append(f"{100 * share:.2f} % of the pixels")
    return ("different", ", ".join(found)) if found else (kind, f"{100 * share:.2f} %")


def reason_for(reasons, name, samples):
    return next((reason for pattern, reason in reasons
                 if fnmatch.fnmatch(name, pattern) or fnmatch.fnmatch(f"{name}@{samples}", pattern)), None)


def read_reasons(path):
    if not path:
        return []
    with open(path) as file:
        lines = [line.rstrip("\n") for line in file if line.strip() and not line.startswith("#")]
    for line in lines:
        if "\t" not in line:
            sys.exit(f"run_scripts.py: {path} has a line without a reason: {line}")
    return [tuple(part.strip() for part in line.split("\t", 1)) for line in lines]


def main():
    parser = argparse.ArgumentParser(usage=__doc__, add_help=False)
    parser.add_argument("--output", default="scripts-results")
    parser.add_argument("--samples", default="0,4")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--reasons")
    parser.add_argument("--interpreter", default=sys.executable)
    parser.add_argument("scripts", nargs="+")
    options = parser.parse_args()
    options.output = os.path.abspath(options.output)
    options.libraries = time_of_libraries(options.interpreter)
    reasons = read_reasons(options.reasons)
    work = [(path, name, int(samples)) for path, name in scripts_of(options.scripts)
            for samples in options.samples.split(",")]
    sums = collections.Counter()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        judged = pool.map(lambda one: judge(options, *one), work)
        for (path, name, samples), (kind, text) in zip(work, judged):
            reason = reason_for(reasons, name, samples) if kind == "different" else None
            if reason:
                kind = "different for a reason"
                text += f" ({reason})"
            sums[samples, kind] += 1
            if kind.startswith(("different", "unsteady", "ends")):
                print(f"{name} @{samples}: {kind}: {text}", flush=True)
    print()
    for (samples, kind), number in sorted(sums.items()):
        print(f"{number:6} with {samples} samples: {kind}")
    return 1 if any(kind == "different" for _, kind in sums) else 0


if __name__ == "__main__":
    sys.exit(main())
