"""Runs into rows: each run in a process of its own, each row of one CSV file that can be resumed at any time."""
