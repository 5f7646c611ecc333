"""Time of the processors, for benchmarks of programs."""

import resource


def spent_by_children():
    """Seconds of all processes that have been waited for, and of those that they have waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
