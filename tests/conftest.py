"""Settings for every test: figures without a display, and hypothesis with few examples, the same on every run."""

import hypothesis
import matplotlib

matplotlib.use("Agg")
hypothesis.settings.register_profile("few", max_examples=8, deadline=None, derandomize=True)
hypothesis.settings.load_profile("few")
