"""Pictures: as arrays, in files, and as other libraries read them."""

import importlib.util
import json
import subprocess
import sys

import numpy as np
import pytest

import kerrscope
from kerrscope import Scene


def test_numpy_takes_it(small):
    image = small.render()
    light = np.asarray(image)
    assert light.shape == image.shape == (27, 48, 3) and light.dtype == np.float32 and len(image) == 27
    assert np.isfinite(light).all() and (light >= 0).all() and light.max() > 0.1
    assert np.asarray(image, np.float64).dtype == np.float64
    with pytest.raises(ValueError, match="read-only"):
        light[0, 0, 0] = 1.0
    own = np.array(image)
    own[0, 0, 0] = 7.0
    assert np.asarray(image)[0, 0, 0] != 7.0
    assert np.mean(image) == light.mean() and image.radiance is None


def test_threads_make_no_difference(small):
    one, two = (np.asarray(small.render(threads=n)) for n in (1, 2))
    assert (one == two).all()
    with pytest.raises(ValueError, match="threads is 0"):
        small.render(threads=0)
    with pytest.raises(ValueError, match="baseline"):
        small.render(level="mmx")


def test_progress_is_told_and_can_stop(small):
    seen = []
    small.render(progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (48 * 27, 48 * 27)
    large = small.replace(**{"render.width": 1500, "render.height": 1500, "render.engine": "integrator", "adaptive": False})

    def stop(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        large.render(progress=stop)


def test_layers_radiance_and_what_is_known(shining):
    assert set(shining.layers) == {"fate", "r", "g", "sky_theta", "depth"}
    assert shining.layers["g"].shape == (3, 30, 40) and shining.layers["fate"].shape == (30, 40)
    assert shining.units["r"] == "M" and shining.units["radiance"] == "JY/PIXEL"
    assert shining.radiance.shape == (30, 40)
    about = shining.about
    assert np.isclose(shining.radiance.sum(), about["total_flux_jy"], rtol=1e-12)
    assert np.isclose(about["pixel_uas"], about["pixel_m"] * about["theta_g_uas"])
    made = shining.provenance
    assert made["version"] == kerrscope.__version__ and made["seed"] == 1
    assert Scene.from_toml(made["record"]) == shining.scene
    assert "radiance [JY/PIXEL]" in repr(shining)


@pytest.mark.parametrize("ending", ["fits", "h5"])
def test_what_is_written_is_read_again(tmp_path, shining, small, ending):
    path = tmp_path / f"image.{ending}"
    shining.save(path)
    again = kerrscope.open(path)
    assert (again.light == shining.light).all() and again.scene == shining.scene
    assert np.allclose(again.radiance, shining.radiance, rtol=1e-15, atol=0)
    for name, values in shining.layers.items():
        assert np.array_equal(again.layers[name], values, equal_nan=True), name
    assert again.provenance == shining.provenance and again.units == shining.units
    drawn = small.render()
    drawn.save(path)
    again = kerrscope.open(path)
    assert (again.light == drawn.light).all() and again.radiance is None
    again.save(tmp_path / f"again.{ending}")
    assert (tmp_path / f"again.{ending}").read_bytes() == path.read_bytes()


def test_the_program_writes_the_same_bytes(tmp_path, program, shining):
    (tmp_path / "scene.toml").write_text(shining.scene.to_toml())
    words = [word for end in ("png", "exr", "fits", "h5") for word in ("-o", f"theirs.{end}")]
    found = program("render", "scene.toml", *words, "--format", "json", cwd=tmp_path)
    for end in ("png", "exr", "fits", "h5"):
        shining.save(tmp_path / f"ours.{end}")
        assert (tmp_path / f"ours.{end}").read_bytes() == (tmp_path / f"theirs.{end}").read_bytes(), end
    about = shining.about
    for name in ("total_flux_jy", "centroid", "size", "length_unit", "error_estimate", "rays_traced"):
        theirs = tuple(found[name]) if isinstance(found[name], list) else found[name]
        ours = tuple(about[name]) if isinstance(about[name], list) else about[name]
        assert ours == theirs, name


def test_astropy_reads_it(tmp_path, shining):
    fits = pytest.importorskip("astropy.io.fits")
    shining.save(tmp_path / "image.fits")
    with fits.open(tmp_path / "image.fits", checksum=True) as file:
        assert np.array_equal(file[0].data[::-1], shining.radiance)
        assert file[0].header["BUNIT"] == "JY/PIXEL"
        assert np.isclose(file[0].header["CDELT2"] * 3.6e9, shining.about["pixel_uas"])
        assert np.array_equal(file["N0.G"].data[::-1].astype("f4"), shining.layers["g"][0], equal_nan=True)


EHTIM = """
import json, sys
import numpy as np
import ehtim
image = ehtim.image.load_fits(sys.argv[1])
values = image.imarr()
print(json.dumps([image.total_flux(), image.psize, image.xdim, image.ydim, image.rf, image.source, image.mjd]))
print(json.dumps([int(k) for k in np.unravel_index(values.argmax(), values.shape)]))
np.save(sys.argv[2], values)
"""


def test_ehtim_reads_it(tmp_path, shining):
    """A program of its own: it is under the GPL."""
    if importlib.util.find_spec("ehtim") is None:
        pytest.skip("ehtim is not installed")
    shining.save(tmp_path / "image.fits")
    command = [sys.executable, "-c", EHTIM, tmp_path / "image.fits", tmp_path / "values.npy"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    # It has more to say on the lines before.
    about, brightest = (json.loads(line) for line in done.stdout.splitlines()[-2:])
    flux, pixel, width, height, frequency, name, day = about
    assert np.isclose(flux, shining.about["total_flux_jy"], rtol=1e-12)
    assert np.isclose(np.degrees(pixel) * 3.6e9, shining.about["pixel_uas"], rtol=1e-12)
    assert (height, width) == shining.radiance.shape
    assert (frequency, name, day) == (230e9, "kerrscope", 51544)
    assert np.allclose(np.load(tmp_path / "values.npy"), shining.radiance, rtol=1e-14, atol=0)
    assert tuple(brightest) == np.unravel_index(shining.radiance.argmax(), shining.radiance.shape)


def test_xarray_takes_and_reads_it(tmp_path, shining, small):
    xarray = pytest.importorskip("xarray")
    data = shining.to_xarray()
    assert data.light.dims == ("y", "x", "channel") and data.g.dims == ("order", "y", "x")
    assert data.radiance.attrs["units"] == "Jy/pixel" and data.x.attrs["units"] == "M"
    step = float(data.x[1] - data.x[0])
    assert np.isclose(step, shining.about["pixel_m"]) and float(data.y[0]) > 0
    assert np.isclose(float(data.x_uas[1] - data.x_uas[0]), shining.about["pixel_uas"])
    assert data.attrs["version"] == kerrscope.__version__
    assert Scene.from_toml(data.attrs["record"]) == shining.scene
    # The brightest place by labels is that by numbers.
    place = data.radiance.argmax(...)
    row, column = np.unravel_index(shining.radiance.argmax(), shining.radiance.shape)
    assert int(place["y"]) == row and int(place["x"]) == column
    data.to_netcdf(tmp_path / "data.nc", engine="h5netcdf")
    with xarray.open_dataset(tmp_path / "data.nc", engine="h5netcdf") as again:
        assert np.array_equal(again.light, data.light) and again.attrs["record"] == data.attrs["record"]
    shining.save(tmp_path / "image.h5")
    with xarray.open_dataset(tmp_path / "image.h5", engine="h5netcdf", phony_dims="sort") as file:
        assert np.array_equal(file["intensity"], shining.radiance) and file.attrs["object"]
    assert "radiance" not in small.render().to_xarray()


def test_files_that_cannot_be(tmp_path, small):
    image = small.render()
    with pytest.raises(ValueError, match=r"\.png, \.exr, \.fits or \.h5"):
        image.save(tmp_path / "image.bmp")
    with pytest.raises(FileNotFoundError, match="the folder does not exist"):
        image.save(tmp_path / "none" / "image.png")
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(IsADirectoryError):
        image.save(tmp_path / "folder.png")
    with pytest.raises(FileNotFoundError):
        kerrscope.open(tmp_path / "none.h5")
    image.save(tmp_path / "image.png")
    with pytest.raises(ValueError, match="FITS and HDF5"):
        kerrscope.open(tmp_path / "image.png")
    (tmp_path / "other.fits").write_bytes(b"SIMPLE  = nonsense")
    with pytest.raises(ValueError, match="FITS"):
        kerrscope.open(tmp_path / "other.fits")
    with pytest.raises(TypeError):
        kerrscope.Image()


def test_pictures_of_scenes_that_are_missing(small):
    with pytest.raises((ValueError, OSError), match="none.png"):
        small.replace(**{"sky.kind": "panorama", "sky.image": "none.png"}).render()
