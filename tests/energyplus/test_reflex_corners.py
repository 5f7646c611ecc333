"""Surfaces that are not convex shade and are shaded, whatever vertex is their first.

EnergyPlus takes their planes from three vertices, and does not ask for the sunlit fraction of a receiver with nothing
before it.
"""

import pytest
import window_with_shades
from output_files import values_of

SHAPE = [(0, 2), (0, 0), (3, 0), (3, 0.8), (1, 0.8), (1, 2)]  # x and z of an L
REFLEX = 4
WALL = [(0, 1.5), (0, 0), (3, 0), (3, 1.5)]
PANEL = [(0.5, 1.8), (0.5, 1.3), (2, 1.3), (2, 1.8)]
HEAD = window_with_shades.HEAD.replace("Variable,Window,", "Variable,Receiver,")
FLOOR = ("BuildingSurface:Detailed,Floor,Floor,Outer Wall,Box,,Adiabatic,,NoSun,NoWind,,4,"
         "0,0,0,0,90,0,90,90,0,90,0,0;\n")


def beginning(reflex):
    """The L in the order in which its reflex corner is the vertex with this index."""
    first = (REFLEX - reflex) % len(SHAPE)
    return SHAPE[first:] + SHAPE[:first]


def vertices(outline, y):
    return f"{len(outline)}," + ",".join(f"{x},{y},{z}" for x, z in outline) + ";\n"


def wall(name, outline, y):
    return f"BuildingSurface:Detailed,{name},Wall,Outer Wall,Box,,Outdoors,,SunExposed,NoWind,," + vertices(outline, y)


def shade(outline, y):
    return "Shading:Building:Detailed,Shade,," + vertices(outline, y)


KINDS = {  # a model, and where EnergyPlus errs if the reflex corner is there
    "shade": (lambda reflex: wall("Receiver", WALL, 0) + shade(beginning(reflex), -0.4), 4),
    "shade that faces the receiver": (
        lambda reflex: wall("Receiver", WALL, 0) + shade(beginning(reflex)[::-1], -0.4), 4),
    "receiver": (lambda reflex: wall("Receiver", beginning(reflex), 0) + shade(PANEL, -0.4), 1),
    "wall": (lambda reflex: wall("Receiver", WALL, 0) + wall("Caster", beginning(reflex)[::-1], -0.4), 4),
}


@pytest.mark.parametrize("kind", KINDS)
def test_any_vertex_can_be_the_first(run, kind):
    write, wrong = KINDS[kind]

    def beginning_at(reflex):
        done = run(HEAD + FLOOR + write(reflex), f"{reflex}")
        said = [line for line in done.our_lines if "reflex corner" in line]
        return values_of(done, "Surface Outside Face Sunlit Fraction")["RECEIVER"], said

    convex, silent = beginning_at(2)
    assert min(value for value in convex if value > 0) < 0.9
    assert silent == []
    reflex, said = beginning_at(wrong)
    assert reflex == pytest.approx(convex, abs=1e-5)
    assert len(said) == 1
    assert said[0].split(": ")[-1].split(";")[0] in ("SHADE", "RECEIVER", "CASTER")
