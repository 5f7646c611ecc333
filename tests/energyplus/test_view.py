"""gpu_shading view: pictures of what the sun sees."""

import os
import re
import shutil
import sqlite3
import subprocess
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
import window_with_shades
from PIL import Image
from shading_runs import energyplus

YELLOW, BLUE = (254, 232, 56), (0, 34, 78)  # the ends of cividis
TEXT, MARGIN = 11, 5  # pixels: of captions, at least, and around a picture of up to 300
CIVIDIS = 4  # of 255: the colours are straight lines between 17 of them


@pytest.fixture
def view(patched, tmp_path):
    model = tmp_path / "model.idf"
    model.write_text(window_with_shades.model("south", True, True))

    def call(*arguments):
        return subprocess.run([patched.parent / "gpu_shading", "view", model, *arguments], capture_output=True,
                              text=True, cwd=tmp_path)

    return call


def sunlit_share(path):
    """Of the receiver's pixels."""
    with Image.open(path) as picture:
        colours = {colour: count for count, colour in picture.convert("RGB").getcolors(1 << 24)}
    return colours.get(YELLOW, 0) / (colours.get(YELLOW, 0) + colours.get(BLUE, 0))


def colour(fraction):
    return 255 * np.array(mpl.colormaps["cividis"](fraction)[:3])


def values(run, variable):
    """[(month, day, minutes, value)] of the run's timesteps, in standard time."""
    with sqlite3.connect(f"file:{run.folder / 'eplusout.sql'}?mode=ro", uri=True) as data:
        rows = data.execute(
            "SELECT Month, Day, 60 * Hour + Minute, Value FROM ReportData JOIN ReportDataDictionary "
            "USING (ReportDataDictionaryIndex) JOIN Time USING (TimeIndex) JOIN EnvironmentPeriods "
            "USING (EnvironmentPeriodIndex) WHERE Name = ? AND (WarmupFlag IS NULL OR WarmupFlag = 0) "
            "ORDER BY TimeIndex", (variable,)).fetchall()
    data.close()
    return rows


def times(output):
    """What view prints: {"06-21 15:00": (azimuth, altitude)}."""
    found = re.findall(r"^(\S+ \S+): sun at azimuth (\S+), altitude (\S+) degrees$", output, re.M)
    return {time: (float(azimuth), float(altitude)) for time, azimuth, altitude in found}


def test_the_sunlit_share_of_a_picture_is_the_closed_form(view, tmp_path):
    suns = [(150.0, 30.0), (180.0, 60.0), (215.5, 12.25)]
    lines = [f"{number}.png {azimuth} {altitude} window\n" for number, (azimuth, altitude) in enumerate(suns)]
    (tmp_path / "views.txt").write_text("".join(lines))
    done = view("--list", "views.txt", "-o", "pictures", "--size", "600")
    assert done.returncode == 0, done.stderr
    for number, sun in enumerate(suns):
        exact = window_with_shades.sunlit_area("south", True, True, *sun) / window_with_shades.SIZE**2
        assert 0.05 < exact < 0.95
        # A window of some 400 pixels a side, two edges of shadow, each wrong by half a pixel at most.
        assert sunlit_share(tmp_path / "pictures" / f"{number}.png") == pytest.approx(exact, abs=3e-3)


def test_one_picture(view, tmp_path):
    done = view("--receiver", "Window", "--sun", "180,60", "-o", "sun.png", "--size", "300")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "sun.png") as picture:
        pixels = np.asarray(picture.convert("RGB"))
    # The receiver, its time's fraction and the sun above it, a margin about it, and a scale beside it.
    assert pixels.shape[1] == 300 + 2 * MARGIN + SCALE
    above = (pixels[:, :-SCALE] < 128).all(axis=2).any(axis=1)
    lines = np.flatnonzero(np.diff(above[:60].astype(int)) == 1)
    assert len(lines) >= 3 and lines[2] < 4 * TEXT
    bar = {tuple(pixel) for pixel in pixels[:, -SCALE + TEXT + 2]}
    assert {YELLOW, BLUE} <= bar and len(bar) > 50


def test_what_passes_a_screen_has_no_moire(view, tmp_path):
    """Holes of a pixel and a half show as their mean; the fraction is that of the run's own shading."""
    model = tmp_path / "model.idf"
    model.write_text(model.read_text() + "GPUShading:PerforatedScreen,Mesh,Screen,Round,,Straight,0.006,,0.008,,0;\n"
                     "Shading:Building:Detailed,Screen,,4,-9,-1,-9,9,-1,-9,9,-1,9,-9,-1,9;\n")
    (tmp_path / "views.txt").write_text("sun.png 180 20 Window\n")
    done = view("--list", "views.txt", "-o", ".", "--size", "300")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "sun.png") as picture:
        pixels = np.asarray(picture.convert("RGB"), float)
    middle = pixels[pixels.shape[0] * 2 // 5:pixels.shape[0] * 3 // 5, 120:180]
    assert middle.std(axis=(0, 1)).max() < 8.0
    shape = np.pi / 4 * (6 / 8) ** 2  # open share of a sheet without thickness
    assert np.abs(middle.mean(axis=(0, 1)) - colour(shape)).max() < 2 * CIVIDIS


def test_a_day_uses_its_canvas(view, tmp_path):
    """Rows are as high as their highest picture: by day, wide pictures of a low sun take little."""
    done = view("--day", "06-21", "-o", "day.png", "--size", "300")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "day.png") as picture:
        pixels = np.asarray(picture.convert("RGB"))[:, :-SCALE]
    cells = np.split(np.arange(pixels.shape[1] - pixels.shape[1] % 4), 4)
    blank = (pixels == 255).all(axis=2)
    for columns in cells[:1]:
        runs = np.diff(np.flatnonzero(np.diff(blank[:, columns].all(axis=1).astype(int))))
        assert runs.max() <= 300
    assert pixels.shape[0] < 4 * (300 + 5 * TEXT)


@pytest.mark.parametrize("arguments, words", [
    (("--receiver", "Door", "--sun", "180,60"), ("receiver Door", "no such surface")),
    (("--receiver", "Windwo", "--sun", "180,60"), ("receiver Windwo", "did you mean WINDOW?")),
    (("--receiver", "Window", "--sun", "180,-1"), ("sun altitude -1", "above 0")),
    (("--receiver", "Window"), ("--sun AZIMUTH,ALTITUDE", "--at", "--day")),
    (("--at", "noon"), ('--at "noon": expected month, day and time, as in "06-21 15:00"',)),
    (("--at", "02-30 12:00"), ('--at "02-30 12:00": 2017 has no such day',)),
    (("--at", "06-21 12:75"), ("expected a time from 00:00 to 24:00",)),
    (("--at", "06-21 23:00"), ("the sun is down", "below the horizon")),
    (("--at", "06-21 12:00", "-w", "none.epw"), ("-w none.epw: no such file",)),
    (("--day", "June"), ('--day "June": expected month and day, as in 06-21',)),
    (("--list", "views.txt"), ("views.txt, line 2", "nonsense")),
    (("--list", "missing.txt"), ("missing.txt", "no such file")),
])
def test_what_is_wrong(view, tmp_path, arguments, words):
    (tmp_path / "views.txt").write_text("a.png 180 60 Window\nnonsense\n")
    done = view(*arguments, "-o", "sun.png")
    assert done.returncode == 1
    assert done.stderr.startswith("gpu_shading: error: ")
    assert len(done.stderr.splitlines()) == 1
    for word in words:
        assert word in done.stderr
    assert not (tmp_path / "sun.png").exists()


def test_a_whole_scene_has_receivers_by_their_sunlit_fraction(view, tmp_path):
    sun = (150.0, 30.0)
    (tmp_path / "views.txt").write_text("scene.png {} {}\n".format(*sun))
    done = view("--list", "views.txt", "-o", ".", "--size", "600")
    assert done.returncode == 0, done.stderr
    exact = window_with_shades.sunlit_area("south", True, True, *sun) / window_with_shades.SIZE**2
    assert 0.2 < exact < 0.8
    with Image.open(tmp_path / "scene.png") as picture:
        pixels = np.asarray(picture.convert("RGB"), float)
    close = np.abs(pixels - colour(exact)).max(axis=2) < CIVIDIS
    # The window fills a good part of the picture; nothing else of it is as much in the sun.
    assert close.mean() > 0.02
    assert len({tuple(pixel) for pixel in pixels[close]}) == 1


SCALE = 7 * 11  # pixels beside pictures of up to 300: seven times the least height of text


def test_a_day_shows_what_energyplus_calculates_hour_by_hour(view, official, weather, tmp_path):
    """The window's colour in each hour's picture against polygon clipping, the sun against EnergyPlus's own."""
    run = energyplus.run(official, tmp_path / "model.idf", weather, tmp_path / "official", ["-D"])
    assert run.completed, run.why()
    fractions, azimuths, altitudes = ({minutes: value for _, _, minutes, value in values(run, name)} for name in (
        "Surface Outside Face Sunlit Fraction", "Site Solar Azimuth Angle", "Site Solar Altitude Angle"))
    done = view("--day", "08-21", "-o", "day.png", "--size", "300")
    assert done.returncode == 0, done.stderr
    shown = times(done.stdout)
    hours = [hour for hour in range(24) if altitudes.get(60 * hour, -1) > 0]
    assert list(shown) == [f"08-21 {hour:02}:00" for hour in hours] and len(hours) > 10
    with Image.open(tmp_path / "day.png") as picture:
        pixels = np.asarray(picture.convert("RGB"), float)[:, :-SCALE]
    rows = -(-len(hours) // 4)
    looked_at = 0
    for number, hour in enumerate(hours):
        assert shown[f"08-21 {hour:02}:00"] == pytest.approx((azimuths[60 * hour], altitudes[60 * hour]), abs=0.02)
        fraction = fractions[60 * hour]
        # Half sunlit is grey, as shades are.
        if not 0.2 < fraction < 0.9 or 0.4 < fraction < 0.6:
            continue
        looked_at += 1
        row, column = divmod(number, 4)
        high, wide = pixels.shape[0] / rows, pixels.shape[1] / 4
        cell = pixels[round(row * high):round((row + 1) * high), round(column * wide):round((column + 1) * wide)]
        # No wall is as much in the sun; the sun sees the sunlit part of the window.
        assert (np.abs(cell - colour(fraction)).max(axis=2) < CIVIDIS).mean() > 0.001, f"{hour}:00, {fraction}"
    assert looked_at >= 2


def test_an_animation_has_a_quarter_of_an_hour_a_picture(view, tmp_path):
    done = view("--day", "12-21", "--receiver", "Window", "-o", "day.gif", "--size", "100")
    assert done.returncode == 0, done.stderr
    shown = list(times(done.stdout))
    assert shown[0][-2:] in {"00", "15", "30", "45"} and len(shown) > 30
    with Image.open(tmp_path / "day.gif") as picture:
        assert picture.n_frames == len(shown)
        frames = set()
        for number in range(picture.n_frames):
            picture.seek(number)
            frames.add(picture.convert("RGB").tobytes())
    assert len(frames) == len(shown)


def test_daylight_saving_is_energyplus_s(view, official, weather, tmp_path):
    """By a run over the day when it begins: the clock is ahead of the run's standard time from then on."""
    model = (tmp_path / "model.idf").read_text()
    model = model.replace("SimulationControl,No,No,No,Yes,No", "SimulationControl,No,No,No,No,Yes")
    model = model.replace("Atlanta,33.65,-84.42,-5,315", "Golden,39.74,-105.18,-7,1829")
    model += ("RunPeriodControl:DaylightSavingTime,2nd Sunday in March,1st Sunday in November;\n"
              "RunPeriod,March,3,11,,3,12,,,Yes,No,No,Yes,Yes;\n"
              "Output:Variable,*,Site Daylight Saving Time Status,Timestep;\n")
    (tmp_path / "model.idf").write_text(model)
    run = energyplus.run(official, tmp_path / "model.idf", weather, tmp_path / "official", [])
    assert run.completed, run.why()
    ahead, azimuths, altitudes = ({(day, minutes): value for _, day, minutes, value in values(run, name)} for name in (
        "Site Daylight Saving Time Status", "Site Solar Azimuth Angle", "Site Solar Altitude Angle"))
    assert {round(value) for value in ahead.values()} == {0, 1}
    for day in (11, 12):
        standard = (day, 15 * 60)
        clock = f"03-{day} {15 + round(ahead[standard])}:00"
        done = view("--at", clock, "-o", "sun.png", "--size", "100")
        assert done.returncode == 0, done.stderr
        assert times(done.stdout)[clock] == pytest.approx((azimuths[standard], altitudes[standard]), abs=0.02)


def without_fonts(*kept):
    """The beginning of a command that runs where there are no fonts but those."""
    hide = "mount -t tmpfs none /usr/share/fonts; mkdir -p /usr/local/share/fonts && "
    hide += "mount -t tmpfs none /usr/local/share/fonts; "
    hide += "".join(f"cp {font} /usr/share/fonts/another.ttf; " for font in kept)
    user = [] if os.geteuid() == 0 else ["--map-root-user"]
    command = ["unshare", *user, "--mount", "sh", "-c", hide + 'exec "$@"', "sh"]
    tried = subprocess.run([*command, "true"], capture_output=True, text=True)
    if tried.returncode != 0:
        pytest.skip(f"no own mounts: {tried.stderr.strip()}")
    return command


@pytest.mark.parametrize("kept", [0, 1])
def test_a_missing_font_is_replaced_or_left_out(kept, patched, tmp_path):
    model, picture = tmp_path / "model.idf", tmp_path / "sun.png"
    model.write_text(window_with_shades.model("south", True, True))
    fonts = tmp_path / "mine.ttf"
    shutil.copy(next(Path("/usr/share/fonts").rglob("DejaVuSans.ttf")), fonts)
    done = subprocess.run([*without_fonts(*[fonts][:kept]), patched.parent / "gpu_shading", "view", model, "--at",
                           "06-21 15:00", "-o", picture], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert ("no font was found" in done.stderr) == (kept == 0) and done.stderr.count("no font") <= 1
    with Image.open(picture) as written:
        text = written.convert("RGB").crop((0, 0, written.width, 60))
        assert (len(text.getcolors()) > 1) == (kept == 1)


def dark_share(path, fraction):
    """The share of a receiver that is in shadow, of a fraction's colour and of the darker one."""
    with Image.open(path) as picture:
        pixels = np.asarray(picture.convert("RGB"), float)
    lit, dark = (np.abs(pixels - share * colour(fraction)).max(axis=2) < CIVIDIS for share in (1, 0.6))
    assert lit.mean() > 0.02
    return dark.sum() / (lit.sum() + dark.sum())


def test_a_camera_shows_shadows(view, tmp_path):
    """The shadow that is drawn on a window is as large as its sunlit fraction says."""
    sun = (150.0, 30.0)
    done = view("--sun", "{},{}".format(*sun), "--camera", "180,1", "-o", "camera.png", "--size", "300")
    assert done.returncode == 0, done.stderr
    exact = window_with_shades.sunlit_area("south", True, True, *sun) / window_with_shades.SIZE**2
    assert dark_share(tmp_path / "camera.png", exact) == pytest.approx(1 - exact, abs=0.02)


def test_the_camera_of_an_animation_stands_still(view, tmp_path):
    """On a short day in the north, which has few pictures."""
    model = tmp_path / "model.idf"
    model.write_text(model.read_text().replace("Atlanta,33.65,", "North,64.0,"))
    done = view("--day", "12-21", "--camera", "160,30", "-o", "day.gif", "--size", "160")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "day.gif") as picture:
        assert 10 < picture.n_frames < 20
        frames = []
        for number in (0, picture.n_frames // 2, picture.n_frames - 1):
            picture.seek(number)
            frames.append(np.asarray(picture.convert("RGB"), int))
    # The arrow and the scale bar are where they were, but for the colours of an animation; shadows are not.
    assert len({frame.shape for frame in frames}) == 1
    marks = [frame[-40:, :100].max(axis=2) < 90 for frame in frames]
    assert marks[0].sum() > 40
    assert all((mark & marks[0]).sum() > 0.9 * marks[0].sum() for mark in marks)
    assert (frames[0] != frames[1]).any()


@pytest.mark.parametrize("arguments, words", [
    (("--receiver", "Window", "--camera", "180,30"), "--camera: draws the whole model"),
    (("--camera", "180,0"), "--camera 180,0: expected an azimuth"),
    (("--camera", "nan,30"), "--camera nan,30: expected an azimuth"),
])
def test_cameras_that_are_wrong(view, arguments, words):
    done = view(*arguments, "--sun", "180,60", "-o", "camera.png")
    assert done.returncode == 1 and words in done.stderr, done.stderr
