"""What the scripts and the whole-run tests share: input files, runs of EnergyPlus, their results.

Only Python's standard library is used, so that compare_shading works with any Python 3.11 or later.
"""
