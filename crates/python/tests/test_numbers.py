"""Orbits, critical curves, and numbers read off pictures: as the program prints them."""

import numpy as np
import pytest

import kerrscope
from kerrscope import measure, orbits, shadow


@pytest.mark.parametrize("spin", [-0.7, 0.0, 0.9, 1.0])
def test_orbits(program, spin):
    assert orbits(spin) == program("orbits", "--spin", spin, "--format", "json")


def test_orbits_without_spin():
    known = orbits(0)
    assert known["isco"] == pytest.approx(6, rel=1e-14) and known["horizon"] == 2
    assert known["impact_prograde"] == pytest.approx(27**0.5, rel=1e-14)


def test_shadow(program):
    ours = shadow(0.9, 60, points=8)
    theirs = program("shadow", "--spin", 0.9, "--inclination", 60, "--points", 8, "--format", "json")
    assert np.array_equal(ours.pop("curve"), theirs.pop("curve")) and ours == theirs
    assert shadow(0, 30)["area"] == pytest.approx(27 * np.pi, rel=1e-10)
    assert shadow(0, 30)["curve"].shape == (360, 2)


@pytest.mark.parametrize("call", [lambda: orbits(2), lambda: shadow(0.5, 181), lambda: orbits(float("nan"))])
def test_out_of_range(call):
    with pytest.raises(ValueError, match="lies between"):
        call()


def test_measure(tmp_path, program, shining):
    scene = shining.scene.replace(**{"render.width": 160, "render.height": 120, "render.samples": 16, "render.layers": []})
    image = scene.render()
    image.save(tmp_path / "image.fits")
    theirs = program("measure", "image.fits", "--format", "json", cwd=tmp_path)
    assert measure(tmp_path / "image.fits") == theirs
    ours = measure(image)
    assert ours["size"] == [160, 120] and "found" in ours["shadow"]
    diameter = ours["shadow"]["found"]["diameter"]
    assert diameter["value"] == pytest.approx(theirs["shadow"]["found"]["diameter"]["value"], rel=1e-9)
    pixels = measure(image.radiance, pixel_uas=image.about["pixel_uas"])
    assert pixels["shadow"]["found"]["diameter"]["value"] == pytest.approx(diameter["value"], rel=1e-9)
    assert pixels["pixel"]["microarcseconds"] == image.about["pixel_uas"]


def test_what_cannot_be_measured(tmp_path, shining):
    assert "not_found" in measure(np.random.default_rng(2).normal(size=(20, 20)))["shadow"]
    colours = np.random.default_rng(2).random((20, 30, 3))
    assert measure(colours)["size"] == [30, 20]
    with pytest.raises(FileNotFoundError):
        measure(tmp_path / "none.png")
    (tmp_path / "text.png").write_text("a text, and no picture at all, for certain")
    with pytest.raises(ValueError, match="convert it"):
        measure(tmp_path / "text.png")
    with pytest.raises(ValueError, match="all pixels have the value 1"):
        measure(np.ones((9, 9)))
    with pytest.raises(ValueError, match="no finite number, the first in column 2, row 1"):
        measure(np.where(np.arange(81).reshape(9, 9) == 11, np.nan, np.arange(81).reshape(9, 9)))
    with pytest.raises(ValueError, match="no picture"):
        measure(np.ones(7))
    with pytest.raises(ValueError, match="leave pixel_uas"):
        measure(shining, pixel_uas=3.0)
    with pytest.raises(ValueError, match="pixel_m is -1"):
        measure(np.eye(9), pixel_m=-1.0)
    assert kerrscope.measure is measure
