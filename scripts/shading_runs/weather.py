"""Weather files."""

LATITUDE = 6  # of the first line's fields


def move(path, latitude, folder):
    """Writes a copy of an EPW file at another latitude (degrees, north positive), and returns its path.

    EnergyPlus takes the sun's positions from there.
    """
    first, rest = path.read_text(encoding="latin-1").split("\n", 1)
    fields = first.split(",")
    fields[LATITUDE] = f"{latitude:.2f}"
    moved = folder / f"{path.stem}_at_{latitude:g}.epw"
    moved.write_text(",".join(fields) + "\n" + rest, encoding="latin-1")
    return moved
