"""The check of include order finds what it is for, in trees made for it."""

import layers
import pytest

LISTS = """
# Lowest first: set(layers nothing) in a comment does not count.
set(layers
  scene       # geometry (of a model)
  backends
  render)
set(layers_in_backends parts open_gl cpu .)
set(layers_in_backends_open_gl gl raster)
set(independent_layers "backends/open_gl backends/cpu")
set(restricted_headers "epoxy/ GL/: backends/open_gl")
"""


@pytest.fixture
def tree(tmp_path):
    folder = tmp_path / "renderer"
    for layer in ("scene", "backends", "backends/parts", "backends/open_gl/gl", "backends/open_gl/raster",
                  "backends/cpu", "render", "include/renderer"):
        (folder / layer).mkdir(parents=True)
        (folder / layer / "own.h").write_text("#pragma once\n")
    (folder / "CMakeLists.txt").write_text(LISTS)
    return folder


def problems(tree, file, text):
    path = tree / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return list(layers.problems_of(tree))


def test_the_order_of_the_project_is_kept():
    assert "energyplus_patch" in [folder.name for folder in layers.layered_folders(layers.ROOT)]
    assert layers.main([]) == 0


@pytest.mark.parametrize("file, text", [
    ("render/a.cpp", '#include "render/own.h"\n#include "backends/cpu/own.h"\n#include "scene/own.h"\n'),
    ("scene/a.cpp", '#include "renderer/own.h"\n#include <vector>\n#include <render/own.h>\n'),
    ("backends/open_gl/raster/a.cpp", '#include <epoxy/gl.h>\n#include "backends/open_gl/gl/own.h"\n'),
    ("backends/a.cpp", '#include "backends/cpu/own.h"\n#include "backends/open_gl/gl/own.h"\n'),
    ("backends/cpu/a.cpp", '#include "backends/parts/own.h"\n'),
    ("scene/inner/a.cpp", '#include "scene/own.h"\n'),
    ("scene/a.cpp", '// #include "render/own.h"\n'),
    ("include/renderer/a.h", '#include "renderer/own.h"\n'),
    ("docs/example/a.cpp", '#include "renderer/own.h"\n'),
])
def test_includes_of_what_stands_below_pass(tree, file, text):
    assert problems(tree, file, text) == []


@pytest.mark.parametrize("file, text, problem", [
    ("scene/a.cpp", '#include <map>\n\n#include "render/own.h"\n',
     'renderer/scene/a.cpp:3: #include "render/own.h": scene stands before render'),
    ("scene/a.h", '#  include "backends/cpu/own.h"\n',
     'renderer/scene/a.h:1: #  include "backends/cpu/own.h": scene stands before backends'),
    ("backends/parts/a.cpp", '#include "backends/cpu/own.h"\n',
     'renderer/backends/parts/a.cpp:1: #include "backends/cpu/own.h": backends/parts stands before backends/cpu'),
    ("backends/cpu/a.cpp", '#include "backends/own.h"\n',
     'renderer/backends/cpu/a.cpp:1: #include "backends/own.h": backends/cpu stands before backends/.'),
    ("backends/open_gl/gl/a.cpp", '#include "backends/open_gl/raster/own.h"\n',
     'renderer/backends/open_gl/gl/a.cpp:1: #include "backends/open_gl/raster/own.h": '
     "backends/open_gl/gl stands before backends/open_gl/raster"),
    ("backends/cpu/a.cpp", '#include "backends/open_gl/gl/own.h"\n',
     'renderer/backends/cpu/a.cpp:1: #include "backends/open_gl/gl/own.h": '
     "backends/cpu and backends/open_gl are independent"),
    ("backends/open_gl/gl/a.cpp", '#include "backends/cpu/own.h"\n',
     'renderer/backends/open_gl/gl/a.cpp:1: #include "backends/cpu/own.h": '
     "backends/open_gl and backends/cpu are independent"),
    ("backends/cpu/a.cpp", "#include <epoxy/gl.h>\n",
     "renderer/backends/cpu/a.cpp:1: #include <epoxy/gl.h>: only backends/open_gl may"),
    ("scene/a.cpp", '#include "../render/own.h"\n',
     'renderer/scene/a.cpp:1: #include "../render/own.h": write it from renderer/, as in "scene/..."'),
    ("backends/cpu/a.cpp", '#include "own.h"\n',
     'renderer/backends/cpu/a.cpp:1: #include "own.h": write it from renderer/, as in "backends/cpu/..."'),
    ("include/renderer/a.h", '#include "scene/own.h"\n',
     'renderer/include/renderer/a.h:1: #include "scene/own.h": a public header includes scene/'),
    ("docs/example/a.cpp", '#include "scene/own.h"\n',
     'renderer/docs/example/a.cpp:1: #include "scene/own.h": an example includes scene/'),
    ("extra/a.cpp", "", "renderer/extra/a.cpp: extra is not among the layers"),
    ("backends/extra/a.cpp", "", "renderer/backends/extra/a.cpp: backends/extra is not among the layers"),
    ("backends/open_gl/a.cpp", "", "renderer/backends/open_gl/a.cpp: backends/open_gl is not among the layers"),
    ("a.cpp", "", "renderer/a.cpp: . is not among the layers"),
])
def test_what_breaks_the_order_is_named(tree, file, text, problem):
    assert problems(tree, file, text) == [problem]


def test_a_name_that_is_no_layer_is_refused(tree):
    lists = LISTS.replace('GL/: backends/open_gl")', 'GL/: backends/egl")').replace("scene ", "scenes ")
    (tree / "CMakeLists.txt").write_text(lists + "set(layers_in_rays .)\n")
    assert list(layers.problems_of(tree)) == [
        "renderer/CMakeLists.txt: layer scenes: there is no such folder",
        "renderer/CMakeLists.txt: backends/egl is not among the layers",
        "renderer/CMakeLists.txt: rays is not among the layers",
        "renderer/scene/own.h: scene is not among the layers",
    ]


def test_a_folder_without_an_order_is_not_checked(tree):
    (tree / "CMakeLists.txt").write_text("add_library(renderer)\n")
    assert list(layers.layered_folders(tree.parent)) == []
    (tree / "CMakeLists.txt").write_text(LISTS)
    assert list(layers.layered_folders(tree.parent)) == [tree]
