"""A BSDF file of gpu_shading screen as EnergyPlus's complex fenestration."""

import xml.etree.ElementTree as ElementTree

SPACE = {"w": "http://windows.lbl.gov"}
DIRECTIONS = 145
# Of Klems's full basis: the middle of each row of patches, and how many it has.
BASIS = ((0, 1), (10, 8), (20, 16), (30, 20), (40, 24), (50, 24), (60, 24), (70, 16), (82.5, 12))


def read(path):
    """{(wavelength, direction): 145 x 145 values, row by row}."""
    found = {}
    for block in ElementTree.parse(path).getroot().iterfind(".//w:WavelengthData", SPACE):
        key = block.find("w:Wavelength", SPACE).text, block.find(".//w:WavelengthDataDirection", SPACE).text
        text = block.find(".//w:ScatteringData", SPACE).text
        found[key] = [float(word) for word in text.replace(",", " ").split()]
        assert len(found[key]) == DIRECTIONS**2
    return found


def hemispherical(values, solids):
    """What leaves in all directions together, by the direction of incidence. solids: steradians times the cosine."""
    return [sum(values[DIRECTIONS * out + into] * solids[out] for out in range(DIRECTIONS))
            for into in range(DIRECTIONS)]


def _matrix(name, columns, values):
    rows = len(values) // columns
    lines = [",".join(f"{value:.7g}" for value in values[columns * row:columns * (row + 1)]) for row in range(rows)]
    return f"Matrix:TwoDimension,{name},{rows},{columns},\n" + ",\n".join(lines) + ";\n"


def construction(name, values, solids):
    """The objects of a window that is nothing but the file's layer."""
    passed, returned = (hemispherical(values["Solar", f"{kind} Front"], solids)
                        for kind in ("Transmission", "Reflection"))
    absorbed = [1 - there - back for there, back in zip(passed, returned, strict=True)]
    return "".join([
        "WindowThermalModel:Params,Thermal,ISO15099,ISO15099,1,NoDeflection;\n",
        "WindowMaterial:Glazing,Sheet,SpectralAverage,,0.003,0.3,0.05,0.05,0.3,0.05,0.05,0,0.84,0.84,1;\n",
        f"Construction:ComplexFenestrationState,{name},LBNLWINDOW,None,Thermal,Basis,Front,Back,Light,Light Back,"
        "Sheet,Absorbed,Absorbed;\n",
        _matrix("Basis", 2, [value for row in BASIS for value in row]),
        _matrix("Front", DIRECTIONS, values["Solar", "Transmission Front"]),
        _matrix("Back", DIRECTIONS, values["Solar", "Reflection Back"]),
        _matrix("Light", DIRECTIONS, values["Visible", "Transmission Front"]),
        _matrix("Light Back", DIRECTIONS, values["Visible", "Reflection Back"]),
        _matrix("Absorbed", DIRECTIONS, absorbed),
    ])
