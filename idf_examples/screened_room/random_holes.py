"""A PNG image of a sheet with holes at random positions, denser towards the top. Black is open.

Holes may overlap. For an open fraction f, holes of mean area a have a density of -ln(1 - f) / a per area; f grows
linearly from the bottom to the top. The solid part of such a sheet is connected below about 67 % open.
"""

import math
import random
import struct
import zlib

DIAMETERS = (0.006, 0.030)  # m, uniformly distributed between these
OPEN = (0.35, 0.65)  # at the bottom and at the top
SEED = 1


def holes(width, height):
    """(x, y above the bottom, radius) of each hole, in metres."""
    chance = random.Random(SEED)
    small, large = DIAMETERS
    area = math.pi / 4 * (large**3 - small**3) / (3 * (large - small))
    low, high = OPEN
    # Includes centres beyond the edges, whose holes cross them.
    rim = large / 2
    most = -math.log(1 - high) / area
    for _ in range(round(most * (width + 2 * rim) * (height + 2 * rim))):
        x, y = chance.uniform(-rim, width + rim), chance.uniform(-rim, height + rim)
        share = low + (high - low) * min(1, max(0, y / height))
        if chance.random() * most < -math.log(1 - share) / area:
            yield x, y, chance.uniform(small, large) / 2


def opacity(width, height, texel):
    """The rows of the image from the top, one byte per texel; texels at the edge of a hole are grey."""
    columns, rows = round(width / texel), round(height / texel)
    image = [bytearray(b"\xff" * columns) for _ in range(rows)]
    for x, y, radius in holes(width, height):
        x, y, radius = x / texel, (height - y) / texel, radius / texel
        for row in range(max(0, math.floor(y - radius)), min(rows, math.ceil(y + radius))):
            half = radius**2 - (row + 0.5 - y) ** 2
            if half <= 0:
                continue
            left, right = max(0, x - math.sqrt(half)), min(columns, x + math.sqrt(half))
            first, last = math.ceil(left), math.floor(right)
            line = image[row]
            if first < last:
                line[first:last] = bytes(last - first)
            if 0 < first <= columns:
                line[first - 1] = min(line[first - 1], int(255 * (1 - first + left)))
            if 0 <= last < columns:
                line[last] = min(line[last], int(255 * (1 - right + last)))
    return image


def png(image):
    """A single-channel image as the bytes of a PNG file."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", len(image[0]), len(image), 8, 0, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + line for line in image))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
