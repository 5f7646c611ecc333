"""The report of compare_shading: a self-contained HTML file."""

from shading_report.page import write

__all__ = ["write"]
