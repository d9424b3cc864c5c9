"""Pictures with matplotlib."""

import numpy as np
import pytest

import kerrscope

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


def test_an_image_with_its_critical_curve(shining):
    axes = kerrscope.plot.image(shining, layer="radiance", cmap="inferno")
    assert axes.get_xlabel() == "right [µas]"
    half = 0.5 * 40 * shining.about["pixel_uas"]
    assert np.allclose(axes.get_xlim(), (-half, half))
    assert any("µas" in text.get_text() for text in axes.texts)
    line = kerrscope.plot.critical_curve(axes, shining)
    known = kerrscope.shadow(0.9, 60)
    theta = shining.about["theta_g_uas"]
    assert np.isclose(line.get_xdata().min(), known["alpha_min"] * theta, rtol=1e-6)
    assert np.isclose(line.get_ydata().max(), known["beta_max"] * theta, rtol=1e-4)
    axes.figure.canvas.draw()


def test_the_curve_lies_on_the_edge_of_the_shadow():
    scene = kerrscope.Scene.from_toml(
        'spacetime.spin = 0.9\nobserver = { distance = inf, inclination = 60 }\n'
        'screen = { kind = "impact", field_of_view = 16, roll = 40 }\ndisk.model = "none"\n'
        'render = { width = 160, height = 160, samples = 1, layers = ["fate"] }'
    )
    image = scene.render()
    axes = kerrscope.plot.image(image, unit="M", layer="fate", scale_bar=False)
    x, y = kerrscope.plot.critical_curve(axes, image, unit="M").get_data()
    assert axes.get_xlabel() == "right [M]"
    pixel, middle = image.about["pixel_m"], np.array([np.mean(x), np.mean(y)])
    for scale, fate in ((0.97, 1), (1.03, 0)):
        places = middle + scale * (np.transpose([x, y]) - middle)
        columns = np.floor(places[:, 0] / pixel + 80).astype(int)
        rows = np.floor(80 - places[:, 1] / pixel).astype(int)
        assert (image.layers["fate"][rows, columns] == fate).mean() > 0.97, scale


def test_units_and_layers_that_are_not_there(small, shining):
    image = small.render()
    assert kerrscope.plot.image(image).get_xlabel() == "right [M]"
    with pytest.raises(ValueError, match="units.mass"):
        kerrscope.plot.image(image, unit="uas")
    with pytest.raises(ValueError, match="uas, M or pixel"):
        kerrscope.plot.image(image, unit="inch")
    with pytest.raises(ValueError, match="no layer 'heat'"):
        kerrscope.plot.image(shining, layer="heat")
    with pytest.raises(ValueError, match="needs spin and inclination"):
        kerrscope.plot.critical_curve(kerrscope.plot.image(image))


def test_a_corner():
    picture = kerrscope.model("ring", size=32).predict(diameter=14, width=4, asymmetry=0.3, position_angle=350)
    found = kerrscope.fit(picture, model="ring", rounds=3)
    figure = kerrscope.plot.corner(found, ["diameter", "width", "position_angle"])
    assert len(figure.axes) == 9
    figure.canvas.draw()
    with pytest.raises(ValueError, match="free parameters are"):
        kerrscope.plot.corner(found, ["spin"])
