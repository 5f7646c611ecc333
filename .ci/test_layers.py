"""The check of include order finds what it is for, in trees made for it."""

import layers
import pytest

LISTS = """
# Lowest first: set(layers nothing) in a comment does not count.
set(layers
  scene       # geometry (of a model)
  gl
  raster_gl raster_cpu
  render)
set(independent_layers "raster_gl raster_cpu")
set(restricted_headers "epoxy/ GL/: gl raster_gl")
"""


@pytest.fixture
def tree(tmp_path):
    folder = tmp_path / "renderer"
    for layer in ("scene", "gl", "raster_gl", "raster_cpu", "render", "include/renderer"):
        (folder / layer).mkdir(parents=True)
        (folder / layer / "own.h").write_text("#pragma once\n")
    (folder / "CMakeLists.txt").write_text(LISTS)
    return folder


def problems(tree, file, text):
    path = tree / file
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)
    return list(layers.problems_of(tree))


def test_the_order_of_the_project_is_kept():
    assert "energyplus_patch" in [folder.name for folder in layers.layered_folders(layers.ROOT)]
    assert layers.main([]) == 0


@pytest.mark.parametrize("file, text", [
    ("render/a.cpp", '#include "render/own.h"\n#include "raster_cpu/own.h"\n#include "scene/own.h"\n'),
    ("scene/a.cpp", '#include "renderer/own.h"\n#include <vector>\n#include <render/own.h>\n'),
    ("raster_gl/a.cpp", '#include <epoxy/gl.h>\n#include "gl/own.h"\n'),
    ("scene/a.cpp", '// #include "render/own.h"\n'),
    ("include/renderer/a.h", '#include "renderer/own.h"\n'),
    ("example/a.cpp", '#include "renderer/own.h"\n'),
])
def test_includes_of_what_stands_below_pass(tree, file, text):
    assert problems(tree, file, text) == []


@pytest.mark.parametrize("file, text, problem", [
    ("scene/a.cpp", '#include <map>\n\n#include "render/own.h"\n',
     'renderer/scene/a.cpp:3: #include "render/own.h": scene stands before render'),
    ("scene/a.h", '#  include "gl/own.h"\n',
     'renderer/scene/a.h:1: #  include "gl/own.h": scene stands before gl'),
    ("raster_cpu/a.cpp", '#include "raster_gl/own.h"\n',
     'renderer/raster_cpu/a.cpp:1: #include "raster_gl/own.h": raster_cpu and raster_gl are independent'),
    ("raster_gl/a.cpp", '#include "raster_cpu/own.h"\n',
     'renderer/raster_gl/a.cpp:1: #include "raster_cpu/own.h": raster_gl and raster_cpu are independent'),
    ("render/a.cpp", "#include <epoxy/gl.h>\n",
     "renderer/render/a.cpp:1: #include <epoxy/gl.h>: only gl, raster_gl may"),
    ("scene/a.cpp", '#include "../render/own.h"\n',
     'renderer/scene/a.cpp:1: #include "../render/own.h": write it from renderer/, as in "scene/..."'),
    ("scene/a.cpp", '#include "own.h"\n',
     'renderer/scene/a.cpp:1: #include "own.h": write it from renderer/, as in "scene/..."'),
    ("include/renderer/a.h", '#include "scene/own.h"\n',
     'renderer/include/renderer/a.h:1: #include "scene/own.h": a public header includes scene/'),
    ("example/a.cpp", '#include "scene/own.h"\n',
     'renderer/example/a.cpp:1: #include "scene/own.h": an example includes scene/'),
    ("extra/a.cpp", "", "renderer/extra/a.cpp: extra is not among the layers"),
    ("a.cpp", "", "renderer/a.cpp: . is not among the layers"),
])
def test_what_breaks_the_order_is_named(tree, file, text, problem):
    assert problems(tree, file, text) == [problem]


def test_a_name_that_is_no_layer_is_refused(tree):
    lists = LISTS.replace('gl raster_gl")', 'egl raster_gl")').replace("scene ", "scenes ")
    (tree / "CMakeLists.txt").write_text(lists)
    assert list(layers.problems_of(tree)) == [
        "renderer/CMakeLists.txt: layer scenes: there is no such folder",
        "renderer/CMakeLists.txt: egl is not among the layers",
        "renderer/scene/own.h: scene is not among the layers",
    ]


def test_a_folder_without_an_order_is_not_checked(tree):
    (tree / "CMakeLists.txt").write_text("add_library(renderer)\n")
    assert list(layers.layered_folders(tree.parent)) == []
    (tree / "CMakeLists.txt").write_text(LISTS)
    assert list(layers.layered_folders(tree.parent)) == [tree]
