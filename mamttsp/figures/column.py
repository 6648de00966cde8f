"""What drawings for one printed column (3.5 in, 88 mm) share: its width, its sizes of type and lines, its legend."""

import textwrap

WIDTH = 3.5
#: matplotlib's settings; `@plt.rc_context(COLUMN)` applies them to all that a function draws
COLUMN = {"font.size": 7, "axes.titlesize": 7, "figure.titlesize": 7, "legend.fontsize": 6.5, "axes.linewidth": 0.6}
COLUMN |= {"legend.title_fontsize": 7}
COLUMN |= {"lines.linewidth": 1.1, "lines.markersize": 3.5, "hatch.linewidth": 0.5, "patch.linewidth": 0.6}
COLUMN |= {"xtick.labelsize": 6.5, "ytick.labelsize": 6.5, "axes.labelpad": 2.0}


def legend_above(ax):
    """Put the axes' legend, if anything is in it, above them, where it covers nothing."""
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)


def caption_below(figure, text):
    """Write a caption, its lines broken to the column, below all that the figure's layout holds."""
    lines, inch = textwrap.wrap(text, 70), 1.0 / figure.get_figheight()
    size = COLUMN["legend.fontsize"]
    bottom = (1.3 * size * len(lines) + 4.0) / 72.0 * inch
    figure.text(0.02, 0.03 * inch, "\n".join(lines), fontsize=size, va="bottom")
    figure.get_layout_engine().set(rect=(0.0, bottom, 1.0, 1.0 - bottom))
