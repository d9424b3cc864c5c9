"""Rays: against the program, one by one and many at a time."""

import numpy as np
import pytest

from kerrscope import trace

ARGUMENTS = {"spin": 0.9, "inclination": 60.0}


@pytest.mark.parametrize("engine", ["closed-form", "integrator"])
@pytest.mark.parametrize("distance", [1000.0, 30.0, np.inf])
def test_the_program_says_the_same(program, engine, distance):
    rays = [(-11.35, 2.0), (4.5, -3.0), (0.5, 0.25), (-4.9, 1.2), (7.0, 0.0)]
    alpha, beta = np.transpose(rays)
    found = trace(**ARGUMENTS, alpha=alpha, beta=beta, distance=distance, engine=engine, orders=4)
    for k, (a, b) in enumerate(rays):
        flags = ["--spin", 0.9, "--inclination", 60, "--distance", distance, "--engine", engine]
        one = program("trace", *flags, "--alpha", a, "--beta", b, "--format", "json")
        assert found["fate"][k] == one["fate"]
        # Steps count how a convoy of rays goes, too, on lanes.
        assert (found["steps"][k] == 0) == (one["steps"] == 0)
        assert np.isclose(found["lambda"][k], one["conserved"]["lambda"], rtol=1e-14)
        assert np.isclose(found["eta"][k], one["conserved"]["eta"], rtol=1e-12, atol=1e-12)
        if one["direction"]:
            close = {"rtol": 1e-8, "atol": 1e-8} if engine == "integrator" else {"rtol": 1e-10, "atol": 1e-10}
            assert np.isclose(found["theta"][k], one["direction"]["theta"], **close)
            assert np.isclose(found["phi"][k], one["direction"]["phi"], **close)
        else:
            assert np.isnan(found["theta"][k]) and np.isnan(found["phi"][k])
        for name in ("r", "phi", "t", "g"):
            values = found["crossings"][name][k]
            assert values.shape == (4,)
            theirs = [np.nan if c[name] is None else c[name] for c in one["crossings"][:4]]
            theirs += [np.nan] * (4 - len(theirs))
            assert np.allclose(values, theirs, rtol=1e-8, atol=1e-8, equal_nan=True), (name, values, theirs)


def test_shapes_are_broadcast():
    alpha, beta = np.linspace(-8, 8, 5), np.linspace(-6, 6, 3)[:, None]
    found = trace(**ARGUMENTS, alpha=alpha, beta=beta, orders=2)
    assert found["fate"].shape == (3, 5) and found["crossings"]["r"].shape == (3, 5, 2)
    one = trace(**ARGUMENTS, alpha=alpha[3], beta=beta[0, 0], orders=2)
    assert one["fate"].shape == () and one["crossings"]["r"].shape == (2,)
    assert np.allclose(one["crossings"]["r"], found["crossings"]["r"][0, 3], rtol=1e-13, equal_nan=True)
    with pytest.raises(ValueError, match=r"alpha \(2,\), beta \(3,\)"):
        trace(**ARGUMENTS, alpha=[1, 2], beta=[1, 2, 3])


def test_several_holes_and_observers():
    spins, inclinations = np.array([0.0, 0.5, 0.9, 0.5]), np.array([20.0, 60.0, 85.0, 60.0])
    alpha, beta = np.array([1.0, -6.0, 7.0, 2.0]), np.array([6.0, 3.0, 1.0, -5.0])
    together = trace(spin=spins, inclination=inclinations, alpha=alpha, beta=beta, distance=[np.inf, 100, 50, 100])
    for k, distance in enumerate([np.inf, 100, 50, 100]):
        one = trace(spin=spins[k], inclination=inclinations[k], alpha=alpha[k], beta=beta[k], distance=distance)
        assert together["fate"][k] == one["fate"] and np.isclose(together["lambda"][k], one["lambda"])
        for name, values in one["crossings"].items():
            assert np.allclose(together["crossings"][name][k], values, rtol=1e-12, equal_nan=True)


def test_only_what_is_asked_for():
    rays = {"alpha": np.linspace(-10, 10, 50), "beta": 2.0}
    some = trace(**ARGUMENTS, **rays, quantities=("r", "phi", "direction"))
    assert set(some) == {"theta", "phi", "crossings"} and set(some["crossings"]) == {"r", "phi"}
    whole = trace(**ARGUMENTS, **rays)
    assert np.allclose(some["theta"], whole["theta"], rtol=1e-10, equal_nan=True)
    assert np.allclose(some["crossings"]["r"], whole["crossings"]["r"], rtol=1e-9, equal_nan=True)
    fate = trace(**ARGUMENTS, **rays, quantities="fate", orders=0)
    assert set(fate) == {"fate", "crossings"} and fate["crossings"] == {}
    assert set(np.unique(fate["fate"])) == {"captured", "escaped"}
    with pytest.raises(ValueError, match="no quantity is called .colour."):
        trace(**ARGUMENTS, **rays, quantities=("colour",))


def test_many_rays_are_as_few():
    random = np.random.default_rng(1)
    alpha, beta = random.uniform(-12, 12, (2, 25_000))
    many = trace(**ARGUMENTS, alpha=alpha, beta=beta, threads=2)
    picked = random.choice(25_000, 1500, replace=False)
    few = trace(**ARGUMENTS, alpha=alpha[picked], beta=beta[picked])
    assert (few["fate"] == many["fate"][picked]).all()
    for name in ("r", "phi", "t", "g"):
        assert np.array_equal(few["crossings"][name], many["crossings"][name][picked], equal_nan=True), name
    # Both engines agree.
    other = trace(**ARGUMENTS, alpha=alpha[picked], beta=beta[picked], engine="integrator")
    assert (other["fate"] == few["fate"]).mean() > 0.998
    fine = np.isfinite(few["theta"]) & np.isfinite(other["theta"]) & (few["error_estimate"] < 1e-11)
    assert fine.sum() > 500 and np.abs(few["theta"] - other["theta"])[fine].max() < 1e-7


def test_no_rays_and_no_orders():
    none = trace(**ARGUMENTS, alpha=[], beta=[])
    assert none["fate"].shape == (0,) and none["crossings"]["r"].shape == (0, 3)
    none = trace(spin=[], inclination=60, alpha=[], beta=[])
    assert none["theta"].shape == (0,)
    assert trace(**ARGUMENTS, alpha=[9, 8], beta=0.5, orders=0)["crossings"]["r"].shape == (2, 0)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"spin": 1.1}, "between -1 and 1"),
        ({"inclination": -3}, "between 0 and 180"),
        ({"distance": 0}, "positive"),
        ({"distance": 1.5}, "no observer is static"),
        ({"alpha": [1, np.nan]}, "alpha of ray 1 is NaN"),
        ({"beta": np.inf}, "beta of ray 0 is inf"),
        ({"alpha": [1, 2000]}, "ray 1: no photon"),
        ({"engine": "magic"}, "closed-form or integrator"),
        ({"threads": 0, "alpha": np.zeros(5000)}, "threads is 0"),
        ({"alpha": "wide"}, "could not convert"),
    ],
)
def test_what_is_wrong_is_told(change, text):
    with pytest.raises(ValueError, match=text):
        trace(**{**ARGUMENTS, "alpha": [1.0, 2.0], "beta": 3.0, **change})


def test_a_negative_number_of_orders_is_none():
    with pytest.raises(ValueError, match="orders is -1"):
        trace(**ARGUMENTS, alpha=1, beta=1, orders=-1)
