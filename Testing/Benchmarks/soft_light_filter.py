"""What filtering few samples of lights takes and gives: error at equal time, over six scenes.

    soft_light_filter.py [--json file] [--pictures folder] [--size pixels]

RMS error (colours of 0..255, against 512 samples that are not filtered) of 4 samples a pixel that are filtered,
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
TRUTH = 512
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


def picture(folder):
    """4 samples, the same filtered, and many: a fold and a penumbra; each pixel is four."""
    rows = []
    for box, how in ((150, 230, 290, 330), dict(occlusion=True)), ((60, 260, 200, 360), dict(soft=True)):
        timed = Timed(isosurface, 560, **how)
        taken = timed.picture(FEW, False), timed.picture(FEW, True), timed.picture(256, False)
        timed.shown.close()
        rows.append(side_by_side([p.crop(box).resize((280, 200), Image.NEAREST) for p in taken]))
    whole = Image.new("RGB", (rows[0].width, 2 * rows[0].height + GAP), (255, 255, 255))
    for i, row in enumerate(rows):
        whole.paste(row, (0, i * (row.height + GAP)))
    os.makedirs(folder, exist_ok=True)
    save(whole, folder, "soft-light-filter.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json")
    parser.add_argument("--pictures")
    parser.add_argument("--size", type=int, default=560)
    asked = parser.parse_args()
    rows = []
    for scene in molecule, isosurface, city:
        for kind, how in ("soft light", dict(soft=True)), ("occlusion", dict(occlusion=True)):
            timed = Timed(scene, asked.size, **how)
            rows.append(measure(scene.__name__, kind, timed))
            timed.shown.close()
    if asked.json:
        with open(asked.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    if asked.pictures:
        picture(asked.pictures)


if __name__ == "__main__":
    main()
