"""Rows into numbers: means by setting, times side by side, true gaps, the best that is known of each setting."""
