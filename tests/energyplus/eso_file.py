"""Reads eplusout.eso: apart from eplusout.sql, what a run has reported."""

import re


class EsoFile:
    """values[variable, key][(month, day, hour)], of hourly outputs; of TimeStep [(month, day, hour, minute)]."""

    def __init__(self, path, frequency="Hourly"):
        names, self.values = {}, {}
        lines = iter(path.read_text().splitlines())
        for line in lines:
            if line.startswith("End of Data Dictionary"):
                break
            if found := re.fullmatch(rf"(\d+),1,([^,]*),(.*?) \[.*\] !{frequency}", line):
                names[found[1]] = (found[3], found[2])
        when = None
        for line in lines:
            number, *fields = line.split(",")
            if number == "2":  # day of simulation, month, day of month, daylight saving time, hour, minutes, ...
                when = (int(fields[1]), int(fields[2]), int(fields[4]))
                if frequency == "TimeStep":
                    when = (*when, round(float(fields[6])))
            elif number in names:
                self.values.setdefault(names[number], {})[when] = float(fields[0])

    def keys(self, variable):
        return [key for name, key in self.values if name == variable]
