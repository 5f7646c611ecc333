"""The made-up city's file keeps to FlatBuffers' rules, so that GDAL's verifier takes it."""

import struct
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "dev" / "generate_city"
HEADER_SIZE_AT = 8
NODE = 40  # bytes


def follow(buffer, place):
    return place + struct.unpack_from("<I", buffer, place)[0]


def field(buffer, table, number):
    """The place of a table's field; aligned tables, and their lists of fields, are at multiples of 4 and 2."""
    slots = table - struct.unpack_from("<i", buffer, table)[0]
    assert table % 4 == 0 and slots % 2 == 0
    assert struct.unpack_from("<H", buffer, slots)[0] > 4 + 2 * number
    return table + struct.unpack_from("<H", buffer, slots + 4 + 2 * number)[0]


def test_all_of_a_feature_is_aligned():
    city = subprocess.run([sys.executable, SCRIPT, "20"], capture_output=True, check=True).stdout
    header = struct.unpack_from("<I", city, HEADER_SIZE_AT)[0]
    nodes = 20 + 2 + 1
    place = HEADER_SIZE_AT + 4 + header + nodes * NODE
    rings = 0
    while place < len(city):
        size = struct.unpack_from("<I", city, place)[0]
        buffer = city[place + 4:place + 4 + size]
        geometry = follow(buffer, field(buffer, follow(buffer, 0), 0))
        ring = follow(buffer, field(buffer, geometry, 1))
        count = struct.unpack_from("<I", buffer, ring)[0]
        assert (ring + 4) % 8 == 0
        numbers = struct.unpack_from(f"<{count}d", buffer, ring + 4)
        assert count == 10 and numbers[:2] == numbers[-2:]
        assert all(-106 < x < -105 and 39 < y < 40 for x, y in zip(numbers[::2], numbers[1::2], strict=True))
        place += 4 + size
        rings += 1
    assert rings == 20 and place == len(city)
