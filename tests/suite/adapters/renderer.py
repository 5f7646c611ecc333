#!/usr/bin/env python3
"""This renderer, by its Python package.

    renderer.py [--device DEVICE] [--error E] SCENE
"""

import argparse

import adapter

import gpu_shading


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--error", type=float, default=1e-3)
    parser.add_argument("scene")
    arguments = parser.parse_args()
    surfaces, suns = adapter.read(arguments.scene)
    scene = gpu_shading.Scene(error=arguments.error)
    for surface in surfaces:
        scene.add(surface.rings[0], name=surface.name, holes=surface.rings[1:], receives=surface.receives,
                  casts="always" if surface.casts else "never", transmittance=surface.transmittance or None)
    names = [surface.name for surface in surfaces if surface.receives]
    found = scene.sunlit([[sun["azimuth"], sun["altitude"]] for sun in suns], device=arguments.device)
    adapter.answer(dict(zip(names, row, strict=True)) for row in found)


if __name__ == "__main__":
    main()
