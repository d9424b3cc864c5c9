"""Scenes: what is typed, changed, pickled and wrong."""

import copy
import pickle

import numpy as np
import pytest

import kerrscope
from kerrscope import Scene, _toml


def test_texts_are_scenes():
    scene = Scene.from_toml("[spacetime]\nspin = 0.5\n[render]\nwidth = 320\nheight = 200")
    assert scene["spacetime.spin"] == 0.5 and scene["spin"] == 0.5
    assert scene.size == (320, 200)
    assert Scene.from_toml(scene.to_toml()) == scene
    assert Scene() == Scene.from_toml("") and hash(Scene()) == hash(Scene(""))
    assert Scene() != scene and Scene() != "a scene"
    assert "spin=0.5" in repr(scene) and "320x200" in repr(scene)
    assert scene.to_dict()["observer"]["distance"] == 30.4


def test_any_key_is_replaced():
    scene = Scene().replace(
        spin=np.float64(-0.25),
        inclination=17,
        **{"observer.distance": np.inf, "screen.kind": "impact", "screen.field_of_view": 30},
        model="none",
        jitter=False,
        layers=["g", "r"],
        **{"sky": {"kind": "uniform", "color": np.array([0.25, 0.5, 1.0])}},
    )
    assert scene["spin"] == -0.25 and scene["observer.distance"] == "inf"
    assert scene["sky.color"] == [0.25, 0.5, 1.0] and scene["render.layers"] == ["g", "r"]
    assert scene["render.jitter"] is False and scene["disk.model"] == "none"


def test_defaults_go_with_changes():
    # The spin that is usual for Kerr does not stand in the way of another spacetime.
    assert Scene().replace(**{"spacetime.name": "schwarzschild"})["spin"] == 0.0
    assert Scene().replace(position=[3.0, 4.0, 12.0])["position"] == [3.0, 4.0, 12.0]
    scene = Scene.from_toml("observer.distance = 50 # far\nspacetime.spin = 0.1").replace(spin=0.2)
    moved = scene.replace(position=[30, 0, 1], **{"observer.distance": None})
    assert moved["spin"] == 0.2 and moved["position"] == [30.0, 0.0, 1.0]
    assert scene.replace(spin=None)["spin"] == 0.99


def test_a_thousand_changes_are_one():
    scene = Scene()
    for k in range(1000):
        scene = scene.replace(spin=k / 1000)
    assert scene._inner.state()[3] == ["spacetime.spin=0.999"]


def test_names_that_are_no_keys():
    with pytest.raises(ValueError, match=r"`distance` may be observer\.distance or units\.distance"):
        Scene().replace(distance=10)
    with pytest.raises(TypeError, match=r"no key `inclinaton`: did you mean `observer\.inclination`\?"):
        Scene().replace(inclinaton=10)
    with pytest.raises(TypeError, match="no set"):
        Scene().replace(spin={1, 2})
    with pytest.raises(KeyError, match="spacetime.file"):
        Scene()["spacetime.file"]


def test_everything_that_is_wrong_is_told():
    with pytest.raises(ValueError) as caught:
        Scene.from_toml("[spacetime]\nspin = 1.5\n[render]\nwdth = 3")
    text = str(caught.value)
    assert "scene:2:8: 1.5 is too large for `spacetime.spin`" in text and "wdth" in text and "help: " in text
    with pytest.raises(ValueError) as caught:
        Scene().replace(spin=2.0, **{"render.width": "wide"})
    text = str(caught.value)
    assert "spacetime.spin=2.0: " in text and "--set" not in text and "render.width" in text
    with pytest.raises(ValueError, match="nan"):
        Scene().replace(spin=float("nan"))


@pytest.mark.parametrize("text", ["a\"b\\c", "tab\there", "line\nend", "émigré 黑洞", "\x7f"])
def test_any_text_is_a_value(text):
    tomllib = pytest.importorskip("tomllib")
    typed = _toml.value({"of": [text, True, 3, -0.5, float("inf"), np.arange(2)], text: np.float32(2)}, "name")
    assert "\n" not in typed
    of = tomllib.loads(f"a = {typed}")["a"]
    assert of == {"of": [text, True, 3, -0.5, float("inf"), [0, 1]], text: 2.0}


def test_pickles_and_copies(tmp_path, monkeypatch):
    (tmp_path / "metric.toml").write_text(
        'coordinates = ["t", "x", "y", "z"]\nmetric = { tt = "-1", xx = "1", yy = "1", zz = "1" }'
    )
    text = 'spacetime = { name = "text", file = "metric.toml" }\ndisk.model = "none"\nrender.engine = "integrator"'
    monkeypatch.chdir(tmp_path)
    scene = Scene.from_toml(text).replace(**{"render.width": 10})
    assert scene == Scene.from_toml(text, tmp_path).replace(**{"render.width": 10})
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    for other in (pickle.loads(pickle.dumps(scene)), copy.deepcopy(scene)):
        assert other == scene and hash(other) == hash(scene)
        assert other.replace(**{"render.height": 4}).size == (10, 4)


def test_files(tmp_path, small):
    path = tmp_path / "scene.toml"
    path.write_text("spacetime.spin = 0.3\nrender.width = 20")
    scene = Scene.from_file(path)
    assert scene["spin"] == 0.3
    small.render().save(tmp_path / "made.png")
    assert Scene.from_file(tmp_path / "made.png") == small
    with pytest.raises(FileNotFoundError, match="there is no such file"):
        Scene.from_file(tmp_path / "none.toml")
    with pytest.raises(FileNotFoundError, match="none.fits"):
        Scene.from_file(tmp_path / "none.fits")
    with pytest.raises(IsADirectoryError):
        Scene.from_file(tmp_path)
    path.write_text("spin = ")
    with pytest.raises(ValueError, match=r"scene\.toml:1:"):
        Scene.from_file(path)


def test_a_notebook_shows_a_scene():
    large = Scene().replace(**{"render.width": 4000, "render.height": 2000, "render.samples": 64, "render.layers": ["g"]})
    preview = large.preview()
    height, width, _ = preview.shape
    assert width * height <= 480 * 270 and abs(width / height - 2) < 0.02 and not preview.layers
    assert large._repr_png_().startswith(b"\x89PNG\r\n\x1a\n")


def test_scenes_of_the_program(program, tmp_path):
    scene = Scene().replace(spin=0.7, **{"render.width": 64})
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert program("scene", "scene.toml", "--print", "--format", "json", cwd=tmp_path) == scene.to_dict()
    assert kerrscope.__version__
