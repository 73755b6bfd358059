"""What the plots of the documentation have in common."""
import os

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


def values(rows, key):
    return list(dict.fromkeys(r[key] for r in rows))


def panels(names, title, height=3.2):
    columns = min(2, len(names))
    lines = (len(names) + columns - 1) // columns
    figure, axes = pyplot.subplots(
        lines, columns, figsize=(4.7 * columns, height * lines), squeeze=False,
        constrained_layout=True)
    figure.suptitle(title, fontsize=10)
    for name, axis in zip(names, axes.flat):
        axis.set_title(name, fontsize=10)
        axis.grid(True, which="major", linewidth=0.4, color="#cccccc")
        axis.set_axisbelow(True)
        axis.tick_params(labelsize=8)
    for axis in list(axes.flat)[len(names):]:
        axis.set_visible(False)
    return figure, list(axes.flat)[: len(names)]


def label(axis, x, y, legend=True):
    axis.set_xlabel(x, fontsize=9)
    axis.set_ylabel(y, fontsize=9)
    if legend:
        axis.legend(fontsize=7)


def plain_numbers(axis):
    for which in (axis.xaxis, axis.yaxis):
        which.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:g}"))
        which.set_minor_formatter(matplotlib.ticker.NullFormatter())
    if axis.get_xlim()[1] > 20:
        low, high = axis.get_xlim()
        axis.set_xticks([t for t in (10, 20, 30, 50, 70, 100, 150, 200, 300, 500, 1000)
                         if low <= t <= high])


def note(axis, texts, x, y, colour):
    for text, u, v in zip(texts, x, y):
        axis.annotate(str(text), (u, v), fontsize=6.5, xytext=(3, 3), textcoords="offset points",
                      color=colour)


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, name), dpi=90)
    pyplot.close(figure)
    print(os.path.join(folder, name))
