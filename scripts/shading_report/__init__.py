"""The report of compare_shading: one HTML file, with all it shows inside."""

from shading_report.page import write

__all__ = ["write"]
