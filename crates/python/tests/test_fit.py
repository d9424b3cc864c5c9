"""Fits and forward models."""

import numpy as np
import pytest

import kerrscope
from kerrscope import fit, model

RING = {"diameter": 20.0, "width": 4.0, "asymmetry": 0.4, "position_angle": 120.0, "center_x": 1.5, "center_y": -0.5}


@pytest.fixture(scope="session")
def ring():
    """A noisy ring on the sky."""
    picture = model("ring", size=48).predict(**RING, flux=1000.0)
    return picture + np.random.default_rng(5).normal(0, 0.02 * picture.max(), picture.shape)


@pytest.fixture(scope="session")
def found(ring):
    said = []
    found = fit(ring, model="ring", pixel_uas=3.0, rounds=8, progress=said.append)
    assert said
    return found


def test_a_ring_is_found(found):
    for name, truth in RING.items():
        assert abs(found[name]["mean"] - truth) < 4 * found[name]["sd"], (name, found[name])
    assert found.good and found.parameters["flux"]["mean"] == pytest.approx(1000, rel=0.05)
    assert found["diameter_uas"]["mean"] == pytest.approx(3 * found["diameter"]["mean"], rel=1e-9)
    assert found.chain["diameter"].ndim == 2 and len(found.chain["diameter"]) == 4
    assert found.log_density.shape == found.chain["diameter"].shape
    assert found.best.shape == found.data.shape == (48, 48)
    assert np.allclose(found.residual, (found.data - found.best) / found.errors)
    assert 0.8 < found.residual.std() < 1.2
    assert "diameter" in repr(found) and "<table>" in found._repr_html_() and found.corner_svg().startswith("<svg")
    assert {row["name"] for row in found.table()} >= set(RING)


def test_the_program_finds_the_same(tmp_path, program, ring):
    fits = pytest.importorskip("astropy.io.fits")
    fits.writeto(tmp_path / "ring.fits", ring[::-1])
    theirs = program("fit", "ring.fits", "--model", "ring", "--rounds", 3, "--seed", 4, "--format", "json", cwd=tmp_path)
    ours = fit(tmp_path / "ring.fits", model="ring", rounds=3, seed=4).report
    for report in (ours, theirs):
        report.pop("wall_s")

    def same(one, other):
        # Powers may be rounded otherwise in another program.
        if isinstance(one, dict):
            return set(one) == set(other) and all(same(one[name], other[name]) for name in one)
        if isinstance(one, list):
            return len(one) == len(other) and all(map(same, one, other))
        return one == pytest.approx(other, rel=1e-9, abs=1e-9) if isinstance(one, float) else one == other

    assert same(ours, theirs)


def test_arviz_takes_it(tmp_path, found):
    pytest.importorskip("arviz")
    data = found.to_inferencedata()
    posterior = data["posterior"]
    assert np.array_equal(posterior["diameter"], found.chain["diameter"])
    assert posterior["diameter"].attrs["units"] == "px"
    assert np.array_equal(data["sample_stats"]["lp"], found.log_density)
    found.save_chains(tmp_path / "chains.h5")
    xarray = pytest.importorskip("xarray")
    with xarray.open_dataset(tmp_path / "chains.h5", group="posterior", engine="h5netcdf") as file:
        assert np.array_equal(file["diameter"], found.chain["diameter"])


def test_what_is_wrong_is_told(tmp_path, ring):
    with pytest.raises(ValueError, match="no model is called .cat."):
        fit(ring, model="cat")
    with pytest.raises(ValueError) as caught:
        fit(ring, fix={"spun": 0.9, "spin": 3}, prior={"scale": "flat"})
    assert "Did you mean spin?" in str(caught.value) and "spin is 3" in str(caught.value) and "scale" in str(caught.value)
    with pytest.raises(ValueError, match="noise is -1, and has to be above 0"):
        fit(ring, model="ring", noise=-1)
    with pytest.raises(ValueError, match="a ring on the sky has no distance"):
        fit(ring, model="ring", distance=100)
    with pytest.raises(ValueError, match="rounds is 1"):
        fit(ring, model="ring", rounds=1)
    with pytest.raises(ValueError, match="neither a file nor a metric"):
        fit(ring, spacetime="newton")
    with pytest.raises(ValueError, match="8 × 8"):
        fit(np.eye(5), model="ring")
    with pytest.raises(ValueError, match="all pixels"):
        fit(np.ones((20, 20)))
    with pytest.raises(FileNotFoundError):
        fit(tmp_path / "none.fits")
    with pytest.raises(TypeError):
        kerrscope.Fit()


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("ring", {**RING, "blur": 2.0, "flux": 3.0, "background": 0.1}),
        ("page-thorne", {"spin": 0.7, "inclination": 50.0, "scale": 0.6, "distance": 100.0, "blur": 2.0, "position_angle": 30.0}),
        ("thin-power-law", {"spin": 0.7, "inclination": 50.0, "scale": 0.6, "index": 3.0, "blur": 2.0, "outer": 12.0}),
    ],
)
def test_derivatives_are_those_of_the_picture(name, values):
    pictures = model(name, size=(40, 48))
    picture, slopes = pictures.predict(**values, derivatives=True)
    assert picture.shape == (40, 48) and set(slopes) == set(pictures.parameters)
    # Without derivatives nodes are approached by another way.
    assert np.allclose(picture, pictures.predict(**values), rtol=1e-6, atol=1e-9 * picture.max())
    for by in values:
        if by in ("distance", "outer", "index"):
            continue
        step = 1e-3 * max(abs(values[by]), 0.1)
        ends = [pictures.predict(**{**values, by: values[by] + side * step}) for side in (-1, 1)]
        difference = (ends[1] - ends[0]) / (2 * step)
        error = np.sqrt(np.mean((difference - slopes[by]) ** 2) / np.mean(difference**2))
        assert error < 0.02, (by, error)


def test_models_tell_what_they_need():
    disk = model("page-thorne", size=16)
    assert disk.size == (16, 16) and disk.parameters["spin"].default is None
    assert disk.parameters["inclination"].unit == "deg" and disk.parameters["distance"].default == np.inf
    with pytest.raises(TypeError, match="needs inclination, scale too"):
        disk.predict(spin=0.5)
    with pytest.raises(TypeError, match="no parameter spun"):
        disk.predict(spun=0.5)
    with pytest.raises(ValueError, match="spin is 1.5, and has to be from"):
        disk.predict(spin=1.5, inclination=40, scale=1)
    with pytest.raises(ValueError, match="0 × 16 pixels"):
        model("ring", size=(16, 0))
    with pytest.raises(ValueError, match="angular or pinhole"):
        model("ring", projection="round")
    charged = model("page-thorne", size=16, spacetime="kerr-newman")
    assert "charge" in charged.parameters and "page-thorne" in repr(charged)
