"""Code shared by the scripts and the whole-run tests: input files, runs of EnergyPlus, and their results.

Only Python's standard library is used, so that compare_shading works with any Python 3.11 or later.
"""
