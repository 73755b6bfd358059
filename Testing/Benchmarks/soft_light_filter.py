"""What filtering few samples of lights takes and gives: error at equal time, over six scenes.

    soft_light_filter.py [--json file] [--pictures folder] [--size pixels]

RMS error (colours of 0..255, against 1024 samples that are not filtered) of 4 samples a pixel that are filtered,
and of as many that are not as take the same processor time, by a straight line between the whole numbers of
samples beside it. The pictures are those of soft_light_pictures.py, which the filter was not made with. Times
are medians of five, methods by turns. PYTHONPATH has to name the built package.
"""
import argparse
import json
import os
import statistics
import time

import numpy
from PIL import Image
from soft_light_pictures import GAP, Shown, city, isosurface, molecule, save, side_by_side

FEW = 4
MORE = (4, 5, 6, 8)
TRUTH = 1024
RUNS = 5


def numbers(picture):
    return numpy.asarray(picture, float)


def rms(picture, truth):
    return float(numpy.sqrt(((numbers(picture) - truth) ** 2).mean()))


class Timed:
    """A scene by one light, which takes a new view before each picture, so that nothing is kept."""

    def __init__(self, scene, size, **how):
        self.shown, self.how = Shown(scene(), (size, size)), how

    def picture(self, samples, filtered):
        self.shown.svo.SetFilterLightSamples(filtered)
        return self.shown.picture(samples=samples, **self.how)

    def seconds(self, samples, filtered):
        camera = self.shown.renderer.GetActiveCamera()
        self.picture(samples, filtered)
        camera.Azimuth(0.5)
        start = time.process_time()
        self.shown.window.Render()
        taken = time.process_time() - start
        camera.Azimuth(-0.5)
        return taken


def measure(name, kind, timed):
    truth = numbers(timed.picture(TRUTH, False))
    ways = [(FEW, True)] + [(samples, False) for samples in MORE]
    times = {way: [] for way in ways}
    for _ in range(RUNS):
        for way in ways:
            times[way].append(timed.seconds(*way))
    taken = {way: statistics.median(times[way]) for way in ways}
    errors = {way: rms(timed.picture(*way), truth) for way in ways}
    plain = [(taken[samples, False], errors[samples, False]) for samples in MORE]
    equal = float(numpy.interp(taken[FEW, True], *zip(*sorted(plain))))
    row = dict(
        scene=name, light=kind, filteredError=errors[FEW, True], plainError=errors[FEW, False],
        equalTimeError=equal, ratio=errors[FEW, True] / equal, filteredSeconds=taken[FEW, True],
        plainSeconds=taken[FEW, False])
    print(f"{name:10} {kind:10} filtered {row['filteredError']:6.2f} in {taken[FEW, True]:.3f} s, not "
          f"{row['plainError']:6.2f} in {taken[FEW, False]:.3f} s, at equal time {equal:6.2f}: "
          f"{row['ratio']:.2f}", flush=True)
    return row


def panel(timed, box):
    """4 samples, the same filtered, and many: a part, each pixel of which is four."""
    pictures = timed.picture(FEW, False), timed.picture(FEW, True), timed.picture(256, False)
    cut = [p.crop(box) for p in pictures]
    return side_by_side([p.resize((2 * p.width, 2 * p.height), Image.NEAREST) for p in cut])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json")
    parser.add_argument("--pictures")
    parser.add_argument("--size", type=int, default=560)
    asked = parser.parse_args()
    rows, panels = [], []
    for scene in molecule, isosurface, city:
        for kind, how in ("soft light", dict(soft=True)), ("occlusion", dict(occlusion=True)):
            timed = Timed(scene, asked.size, **how)
            rows.append(measure(scene.__name__, kind, timed))
            if scene is not molecule and kind != ("occlusion" if scene is isosurface else "soft light"):
                part = asked.size // 4
                panels.append(panel(timed, (part, part, 3 * part // 2 + part // 2, 2 * part)))
            timed.shown.close()
    if asked.json:
        with open(asked.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    if asked.pictures:
        os.makedirs(asked.pictures, exist_ok=True)
        height = panels[0].height
        whole = Image.new("RGB", (panels[0].width, len(panels) * (height + GAP) - GAP), (255, 255, 255))
        for i, each in enumerate(panels):
            whole.paste(each, (0, i * (height + GAP)))
        save(whole, asked.pictures, "soft-light-filter.png")


if __name__ == "__main__":
    main()
