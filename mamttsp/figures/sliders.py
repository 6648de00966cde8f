"""Sliders for a drawing where somebody runs the notebook, and the drawing itself where nobody does."""

from ..validation import InputError, array, brief


def explore(draw, **sliders):
    """Call `draw` with the values of sliders, again whenever one is moved.

    sliders: name=(lowest, highest, step, start). Where no person is at the kernel, as in a batch run, it is called once
    with the start values: a saved notebook holds that picture, and no widget that would need a kernel. Needs ipywidgets
    only where somebody is there. InputError: `draw` cannot be called, or a slider is not of four numbers.

    >>> from mamttsp.figures import explore
    >>> explore(lambda time: print(f"{time} s"), time=(0.0, 150.0, 0.5, 60.0))
    60.0 s
    """
    if not callable(draw):
        raise InputError(f"draw: expected a function of the sliders' values, found {brief(draw)}")
    for name, values in sliders.items():
        array(name, values, (4,))
    if not _somebody_is_there():
        draw(**{name: start for name, (_, _, _, start) in sliders.items()})
        return
    import ipywidgets  # here: of the extra "notebooks"

    ipywidgets.interact(draw, **{name: _slider(ipywidgets, name, *values) for name, values in sliders.items()})


def _somebody_is_there():
    """Tell whether the cell that runs was sent by a program that can pass questions on to a person."""
    try:
        kernel = get_ipython().kernel
    except (NameError, AttributeError):  # not in IPython, or in IPython without a kernel
        return False
    return kernel.get_parent()["content"].get("allow_stdin", False)


def _slider(ipywidgets, name, lowest, highest, step, start):
    whole = all(isinstance(value, int) for value in (lowest, highest, step, start))
    kind = ipywidgets.IntSlider if whole else ipywidgets.FloatSlider
    # Not while it is dragged: a drawing may have to solve an instance first.
    return kind(start, min=lowest, max=highest, step=step, description=name, continuous_update=False)
