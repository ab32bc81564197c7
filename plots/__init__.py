"""Reads result files: tables, figures, pages and comparisons of them, and the commands that plan measurements.

A module imports only its own floor and lower ones, which tests/sources_test.py checks.
"""
# Folders, the lowest first.
FLOORS = (
    "words",  # names of what is measured, numbers as text, tables for the console
    "files",  # JSON files and how all files are written
    "read",  # cells and runs of result files, statistics, rankings
    "program",  # the command line, and the measuring program as a child
    "draw",  # what figures share
    "figures",  # one file per figure, and the catalog of them
    "console",  # tables of `show`
    "comparing",  # `compare` and the baseline of `smoke`
    "exporting",  # formats of `export`
    "page",  # the page of `report`
    "evidence",  # what the documents and committed result files say
    "sweeping",  # `sweep`
    "racing",  # `best`
    "commands",  # one file per command
)
