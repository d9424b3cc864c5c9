"""The package as a whole: what it says of itself, its types, and what it needs."""

import importlib
import importlib.util
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import kerrscope

FOLDER = pathlib.Path(kerrscope.__file__).parent


def public():
    """Every public name, and the methods of public classes."""
    for name in kerrscope.__all__:
        of = getattr(kerrscope, name)
        yield name, of
        if inspect.isclass(of):
            for member, value in vars(of).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                    yield f"{name}.{member}", value
        if inspect.ismodule(of):
            for member in of.__all__:
                yield f"{name}.{member}", getattr(of, member)


@pytest.mark.parametrize(("name", "of"), list(public()), ids=lambda of: of if isinstance(of, str) else "")
def test_everything_public_is_described(name, of):
    assert inspect.getdoc(of), name


def test_everything_compiled_has_a_stub():
    from kerrscope import _core

    stubs = (FOLDER / "_core.pyi").read_text()
    for name, of in vars(_core).items():
        if name.startswith("__"):
            continue
        assert f"def {name}(" in stubs or f"class {name}:" in stubs, name
        if inspect.isclass(of):
            body = stubs.split(f"class {name}:")[1].split("\nclass ")[0]
            for member in vars(of):
                if not member.startswith("_"):
                    assert f"def {member}(" in body, f"{name}.{member}"
        else:
            # The same arguments in the same order.
            arguments = stubs.split(f"def {name}(")[1].split(") ->")[0]
            stubbed = [part.split(":")[0].strip() for part in arguments.split(",") if ":" in part]
            stubbed = [word for word in stubbed if word.isidentifier()]
            assert stubbed == list(inspect.signature(of).parameters), name
    assert (FOLDER / "py.typed").is_file()


def test_types_are_right(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("no mypy here")
    program = (
        "import kerrscope\n"
        "image: kerrscope.Image = kerrscope.Scene().replace(spin=0.5).render(threads=2)\n"
        "height: int = image.shape[0]\n"
        "isco: float = kerrscope.orbits(0.5)['isco']\n"
    )
    (tmp_path / "uses.py").write_text(program)
    words = ["-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", tmp_path / "cache"]
    environment = dict(os.environ)
    if "site-packages" not in str(FOLDER):
        environment["MYPYPATH"] = str(FOLDER.parent)
    for what in (["-p", "kerrscope"], [tmp_path / "uses.py"]):
        command = [sys.executable, *words, *what]
        done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=environment)
        assert done.returncode == 0, done.stdout


def test_examples_in_the_documentation():
    import doctest

    tried = 0
    for path in FOLDER.glob("*.py"):
        name = "kerrscope" if path.stem == "__init__" else f"kerrscope.{path.stem}"
        module = importlib.import_module(name)
        done = doctest.testmod(module, extraglobs={"kerrscope": kerrscope})
        assert done.failed == 0, path
        tried += done.attempted
    assert tried >= 8


def test_numpy_is_all_that_is_needed(tmp_path):
    """In an environment with numpy alone, the README's lines work, and what needs more says what to install."""
    import numpy

    for package in (FOLDER, pathlib.Path(numpy.__file__).parent, *pathlib.Path(numpy.__file__).parent.parent.glob("numpy.libs")):
        (tmp_path / package.name).symlink_to(package)
    program = f"""
import sys
sys.path.insert(0, {str(tmp_path)!r})
import kerrscope
scene = kerrscope.Scene().replace(spin=0.9, inclination=70, **{{"render.width": 48, "render.height": 27}})
image = scene.render()
image.save("hole.png")
assert image._repr_png_()[:4] == b"\\x89PNG"
kerrscope.trace(spin=0.9, inclination=60, alpha=[1, 2], beta=3)
kerrscope.measure(image)
kerrscope.model("ring", size=16).predict(diameter=8, width=2)
for package, use in (("xarray", image.to_xarray), ("matplotlib", lambda: kerrscope.plot.image(image))):
    try:
        use()
    except ImportError as error:
        assert f"pip install {{package}}" in str(error), error
    else:
        raise AssertionError(package)
for heavy in ("matplotlib", "xarray", "astropy", "arviz", "dask"):
    assert heavy not in sys.modules
"""
    # Isolated, and without the folders of installed packages.
    done = subprocess.run([sys.executable, "-I", "-S", "-c", program], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "hole.png").stat().st_size > 1000


def test_no_name_of_a_machine_is_in_it():
    for path in FOLDER.glob("*.py*"):
        if path.suffix in (".py", ".pyi"):
            assert os.path.expanduser("~") + os.sep not in path.read_text()
