"""Images as the program beside energyplus decodes them, against Pillow, picture by picture."""

import ctypes
import errno
import os
import socket
import struct
import subprocess

import numpy as np
import pytest
from PIL import Image, ImageOps

WIDTH, HEIGHT = 23, 17
FULL = 65535
ANSWER = 0x31445347
SECONDS, BYTES = 60, 4 << 30


class Decoder:
    """A decoding program that waits for requests, as energyplus_patch/files/decoding/decoder.h has them."""

    def __init__(self, program):
        self.link, other = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.link.settimeout(300)
        with other:
            self.server = subprocess.Popen([program], stdin=other)

    def ask(self, *words, file):
        """The exit status of the process that decodes, and what it answered."""
        reading, writing = os.pipe()
        with open(reading, "rb") as answer:
            with open(writing, "wb"):
                packet = b"".join(os.fsencode(str(word)) + b"\0" for word in words)
                socket.send_fds(self.link, [packet], [file.fileno(), writing])
                process = int.from_bytes(self.link.recv(4), "little", signed=True)
            assert process > 0
            found = answer.read()
        return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), found

    def close(self):
        self.link.close()
        assert self.server.wait(timeout=60) == 0


@pytest.fixture
def decoder(patched):
    started = Decoder(patched.parent / "gpu_shading_image_decoder")
    yield started
    started.close()


def ask(decoder, path, operation="image", assets="restricted", seconds=SECONDS, memory=BYTES):
    """The bytes of an answer. Fails the test if the program refuses the file."""
    with open(path, "rb") as file:
        exit_status, answer = decoder.ask(os.getpid(), seconds, memory, operation, assets, path, file=file)
    assert exit_status == 0
    mark, status = struct.unpack_from("<II", answer)
    assert mark == ANSWER
    if status:
        raise RuntimeError(answer[12:].decode())
    return answer[8:]


def decoded(decoder, path, assets="restricted"):
    """Opacity, 0 to 1, rows from the top; and whether it is alpha."""
    answer = ask(decoder, path, assets=assets)
    width, height, _, alpha = struct.unpack_from("<4i", answer)
    assert struct.unpack_from("<Q", answer, 16)[0] == width * height
    texels = np.frombuffer(answer, "<u2", offset=24).reshape(height, width)
    return texels[::-1] / FULL, bool(alpha)


def picture(mode, seed=1):
    """A picture without symmetry, with texels of every kind."""
    random = np.random.default_rng(seed)
    noise = random.integers(0, 256, (HEIGHT, WIDTH, 4), dtype=np.uint8)
    rgba = Image.fromarray(noise, "RGBA")
    if mode == "1":
        return Image.fromarray(noise[..., 0] < 60).convert("1")
    if mode == "P":
        return rgba.convert("RGB").quantize(16)
    if mode == "P4":
        return rgba.convert("RGB").quantize(4)
    if mode == "I;16":
        return Image.fromarray(random.integers(0, FULL + 1, (HEIGHT, WIDTH), dtype=np.uint16))
    if mode == "F":
        return Image.fromarray(random.random((HEIGHT, WIDTH), dtype=np.float32))
    if mode == "LA":
        return Image.merge("LA", (rgba.getchannel("R"), rgba.getchannel("A")))
    if mode == "soft":  # what JPEG keeps
        y, x = np.mgrid[0:96, 0:128]
        return Image.fromarray(np.stack([x * 2, y * 2, 255 - x], -1).astype(np.uint8), "RGB")
    return rgba.convert(mode)


def expected(path):
    """What Pillow sees: alpha, else luminance as stored."""
    with Image.open(path) as image:
        image.load()
        image = ImageOps.exif_transpose(image)
        if image.mode in ("I;16", "I;16B", "I"):
            return np.asarray(image) / FULL, False
        if image.mode == "F":
            return np.asarray(image), False
        if "A" in image.getbands() or "transparency" in image.info:
            return np.asarray(image.convert("RGBA").getchannel("A")) / 255, True
        return np.asarray(image.convert("RGB")) / 255 @ [0.2126, 0.7152, 0.0722], False


CASES = [
    *(("png", mode, {}) for mode in ("1", "L", "LA", "RGB", "RGBA", "P", "P4", "I;16")),
    ("png", "P", {"bits": 4}), ("png", "P4", {"bits": 2}), ("png", "P", {"transparency": 3}),
    ("png", "L", {"transparency": 7}),
    ("jpg", "soft", {"quality": 95}), ("jpg", "soft", {"quality": 90, "progressive": True}),
    ("jpg", "soft", {"quality": 95, "subsampling": 2}), ("jpg", "soft-L", {}), ("jpg", "soft-CMYK", {"quality": 95}),
    *(("tif", mode, {"compression": compression})
      for mode in ("1", "L", "LA", "RGB", "RGBA", "P", "P4", "I;16", "F", "CMYK")
      for compression in (None, "tiff_lzw", "tiff_adobe_deflate", "packbits")),
    ("tif", "1", {"compression": "group4"}), ("tif", "1", {"compression": "group3"}),
    ("tif", "soft", {"compression": "jpeg", "quality": 95}),
    *(("bmp", mode, {}) for mode in ("1", "L", "RGB", "RGBA", "P", "P4")),
    *(("tga", mode, {"compression": compression, "orientation": orientation})
      for mode in ("L", "LA", "RGB", "RGBA", "P") for compression in (None, "tga_rle") for orientation in (1, -1)),
]


@pytest.mark.parametrize(("ending", "mode", "options"), CASES, ids=str)
def test_every_format_is_read_as_pillow_reads_it(decoder, tmp_path, ending, mode, options):
    path = tmp_path / f"picture.{ending}"
    mode, _, turned_into = mode.partition("-")
    image = picture(mode)
    (image.convert(turned_into) if turned_into else image).save(path, **options)
    wanted, alpha = expected(path)
    got, is_alpha = decoded(decoder, path)
    assert is_alpha == alpha
    lossy = ending == "jpg" or options.get("compression") == "jpeg"
    assert got.shape == wanted.shape
    # A TIFF's palette is of 16 bits, which round to either of two levels of 8.
    level = "CMYK" in mode or (ending == "tif" and "P" in mode)
    assert np.abs(got - wanted).max() <= (0.02 if lossy else 0.004 if level else 2e-5)


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize("ending", ["png", "jpg", "tif"])
def test_exif_orientation_turns_the_picture(decoder, tmp_path, ending, orientation):
    path = tmp_path / f"turned.{ending}"
    exif = Image.Exif()
    exif[0x0112] = orientation
    picture("soft").save(path, exif=exif)
    wanted, _ = expected(path)
    got, _ = decoded(decoder, path)
    assert wanted.shape == ((128, 96) if orientation > 4 else (96, 128))
    assert got.shape == wanted.shape
    assert np.abs(got - wanted).max() <= 0.02


@pytest.mark.parametrize("orientation", [1, 6])
def test_one_bit_tiff_turns_too(decoder, tmp_path, orientation):
    path = tmp_path / "bits.tif"
    picture("1").save(path, compression=None, tiffinfo={0x0112: orientation})
    wanted, _ = expected(path)
    got, _ = decoded(decoder, path)
    assert got.shape == wanted.shape and np.abs(got - wanted).max() < 1e-4


@pytest.mark.parametrize("transparent", [False, True])
def test_gif_is_read_with_the_flag_alone(decoder, tmp_path, transparent):
    path = tmp_path / "picture.gif"
    picture("P").save(path, **({"transparency": 3} if transparent else {}))
    with pytest.raises(RuntimeError, match=r"ends in \.gif, expected a PNG, JPEG.*--gpu-shading-assets=any"):
        decoded(decoder, path)
    got, is_alpha = decoded(decoder, path, assets="any")
    assert is_alpha
    with Image.open(path) as image:
        wanted = np.asarray(image.convert("RGBA").getchannel("A")) / 255
    assert np.array_equal(got, wanted)
    assert (wanted.min() == 0) == transparent


def test_the_ending_does_not_hide_the_content(decoder, tmp_path):
    hidden = tmp_path / "hidden.png"
    picture("P").save(hidden, format="GIF")
    with pytest.raises(RuntimeError, match="its content is of no such format"):
        decoded(decoder, hidden)
    swapped = tmp_path / "swapped.png"
    picture("RGB").save(swapped, format="BMP")
    wanted, _ = expected(swapped)
    assert np.abs(decoded(decoder, swapped)[0] - wanted).max() < 2e-5


def test_question_marks_in_the_path(decoder, tmp_path):
    folder = tmp_path / "what?size=2&a=1"
    folder.mkdir()
    for name in ("leaf?.png", "leaf.png"):
        picture("RGB").save(folder / name, format="PNG")
        wanted, _ = expected(folder / name)
        assert np.abs(decoded(decoder, folder / name)[0] - wanted).max() < 2e-5


USUAL = (0xFF0000, 0xFF00, 0xFF, 0xFF000000)


@pytest.mark.parametrize(("header", "masks", "is_alpha"), [
    (40, None, False), (108, None, False), (124, None, False), (124, USUAL, True), (108, USUAL, True),
    (56, USUAL, True), (124, (*USUAL[:3], 0), False), (40, USUAL[:3], False)])
def test_the_fourth_byte_of_a_bmp_is_alpha_if_it_says_so(decoder, tmp_path, header, masks, is_alpha):
    path = tmp_path / "fourth.bmp"
    path.write_bytes(bmp(picture("RGBA"), header, masks))
    got, found = decoded(decoder, path)
    wanted, alpha = expected(path)
    assert found == is_alpha
    if header != 56:  # which Pillow takes for one without alpha
        assert alpha == is_alpha
        assert np.abs(got - wanted).max() < 2e-5


def test_other_bit_fields_of_a_bmp_are_refused(decoder, tmp_path):
    path = tmp_path / "fields.bmp"
    path.write_bytes(bmp(picture("RGBA"), 124, (0xFF, 0xFF00, 0xFF0000, 0xFF000000)))
    with pytest.raises(RuntimeError, match="bit fields are not 8 bits each"):
        decoded(decoder, path)


def bmp(image, header, masks):
    """A BMP of 32 bits with a header of so many bytes; bit fields where there are masks."""
    texels = np.asarray(image)[::-1, :, [2, 1, 0, 3]].tobytes()
    fields = struct.pack("<IiiHHIIiiII", header, *image.size, 1, 32, 3 if masks else 0, len(texels), 0, 0, 0, 0)
    fields = (fields + struct.pack(f"<{len(masks or ())}I", *(masks or ()))).ljust(header, b"\0")
    start = 14 + len(fields)
    return b"BM" + struct.pack("<IHHI", start + len(texels), 0, 0, start) + fields + texels


def write_exr(path, values, data, display):
    """One channel of floats, not compressed. Windows: left, top, right, bottom, all included."""
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    header = b"".join([
        attribute("channels", "chlist", b"Y\0" + struct.pack("<iB3xii", 2, 0, 1, 1) + b"\0"),
        attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", struct.pack("<4i", *data)),
        attribute("displayWindow", "box2i", struct.pack("<4i", *display)),
        attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)),
    ]) + b"\0"
    rows = [struct.pack("<ii", data[1] + number, row.nbytes) + row.tobytes()
            for number, row in enumerate(values.astype("<f4"))]
    start = 8 + len(header) + 8 * len(rows)
    offsets = [start + sum(map(len, rows[:number])) for number in range(len(rows))]
    path.write_bytes(struct.pack("<ii", 20000630, 2) + header + struct.pack(f"<{len(rows)}q", *offsets)
                     + b"".join(rows))


@pytest.mark.parametrize("display", [(0, 0, 22, 16), (-3, -2, 25, 20), (4, 3, 15, 12), (4, -1, 30, 12)])
def test_the_display_window_of_an_exr_counts(decoder, tmp_path, display):
    values = np.random.default_rng(3).random((HEIGHT, WIDTH), dtype=np.float32)
    path = tmp_path / "window.exr"
    write_exr(path, values, (0, 0, WIDTH - 1, HEIGHT - 1), display)
    left, top, right, bottom = display
    wanted = np.zeros((bottom - top + 1, right - left + 1))
    for y in range(wanted.shape[0]):
        for x in range(wanted.shape[1]):
            if 0 <= y + top < HEIGHT and 0 <= x + left < WIDTH:
                wanted[y, x] = values[y + top, x + left]
    got, _ = decoded(decoder, path)
    assert got.shape == wanted.shape and np.abs(got - wanted).max() < 1e-5


@pytest.mark.parametrize("size", ["-Y 17 +X 23", "+Y 17 +X 23"])
def test_radiance(decoder, tmp_path, size):
    """Flat RGBE."""
    noise = np.random.default_rng(5).integers(1, 255, (HEIGHT, WIDTH, 3), dtype=np.uint8)
    path = tmp_path / "picture.hdr"
    texels = np.concatenate([noise, np.full((HEIGHT, WIDTH, 1), 128, np.uint8)], -1)
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size.encode() + b"\n" + texels.tobytes())
    wanted = noise / 256 @ [0.2126, 0.7152, 0.0722]
    got, _ = decoded(decoder, path)
    # Readers add half a step or not.
    assert np.abs(got - (wanted if size[0] == "-" else wanted[::-1])).max() < 3e-3


def refuse_landlock(error):
    """What old profiles of containers do, for this process and its children: landlock_create_ruleset fails."""
    seccomp = ctypes.CDLL("libseccomp.so.2")
    seccomp.seccomp_init.restype = ctypes.c_void_p
    allow, fail = 0x7FFF0000, 0x00050000 | error
    filtering = ctypes.c_void_p(seccomp.seccomp_init(allow))
    call = seccomp.seccomp_syscall_resolve_name(b"landlock_create_ruleset")
    assert seccomp.seccomp_rule_add(filtering, fail, call, 0) == 0
    assert seccomp.seccomp_load(filtering) == 0


@pytest.mark.parametrize("error", [errno.ENOSYS, errno.EPERM, errno.EOPNOTSUPP])
def test_a_run_and_check_warn_where_landlock_is_refused(patched, box, weather, tmp_path, error):
    picture("L").save(tmp_path / "tile.png")
    model = tmp_path / "model.idf"
    model.write_text(box + "GPUShading:PerforatedScreen,Image,Louvre*,Texture,tile.png,,,,,,0.001;\n")
    warning = "images, meshes and GeoTIFF are decoded without landlock"

    def said(*command, refused=True):
        done = subprocess.run(command, capture_output=True, text=True, check=True,
                              preexec_fn=(lambda: refuse_landlock(error)) if refused else None)
        return done.stdout + done.stderr

    run = (patched, "--gpu-shading", "-D", "-w", weather, "-d", tmp_path / "out", model)
    assert said(*run).count(warning) == 1
    assert (tmp_path / "out" / "eplusout.err").read_text().count(warning) == 1
    check = (patched.parent / "gpu_shading", "check", model)
    assert said(*check).count(warning) == 1
    assert warning not in said(*check, refused=False)
    model.write_text(box)
    assert warning not in said(*check)
