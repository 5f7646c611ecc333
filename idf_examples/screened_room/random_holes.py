"""An image of a sheet with holes at random places, denser towards its top, as a PNG. Black is open.

Holes may overlap. With a share f of the sheet open, holes of mean area a stand -ln(1 - f) / a to the
area; f grows evenly from the bottom to the top. Of such a sheet what is solid still hangs together below
about 67 % open.
"""

import math
import random
import struct
import zlib

DIAMETERS = (0.006, 0.030)  # m, all alike often between these
OPEN = (0.35, 0.65)  # at the bottom and at the top
SEED = 1


def holes(width, height):
    """(x, y above the bottom, radius) of each hole, in metres."""
    chance = random.Random(SEED)
    small, large = DIAMETERS
    area = math.pi / 4 * (large**3 - small**3) / (3 * (large - small))
    low, high = OPEN
    # Centres beyond the edges too, whose holes reach over them.
    rim = large / 2
    most = -math.log(1 - high) / area
    for _ in range(round(most * (width + 2 * rim) * (height + 2 * rim))):
        x, y = chance.uniform(-rim, width + rim), chance.uniform(-rim, height + rim)
        share = low + (high - low) * min(1, max(0, y / height))
        if chance.random() * most < -math.log(1 - share) / area:
            yield x, y, chance.uniform(small, large) / 2


def opacity(width, height, texel):
    """The image's rows from the top, a byte a texel; a texel that a hole's edge crosses is grey."""
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
    """An image of one channel, as the bytes of a file."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", len(image[0]), len(image), 8, 0, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + line for line in image))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
