"""Weather files."""

LATITUDE = 6  # of the first line's fields


def move(path, latitude, folder):
    """Writes a copy of an EPW file for another latitude (degrees, north positive). Returns its path.

    EnergyPlus takes the sun positions from that file's location.
    """
    first, rest = path.read_text(encoding="latin-1").split("\n", 1)
    fields = first.split(",")
    fields[LATITUDE] = f"{latitude:.2f}"
    moved = folder / f"{path.stem}_at_{latitude:g}.epw"
    moved.write_text(",".join(fields) + "\n" + rest, encoding="latin-1")
    return moved
