//! The thesis's two tables, read off pictures and from single rays.

use kerrscope::measure::{Fit, Manner, Part, Series, Setting};

/// Off a picture of 400 × 400 pixels and from rays, the same lengths.
#[test]
fn pictures_agree_with_rays() {
    let base = Setting { size: [400, 400], samples: 64, ..Setting::default() };
    let settings = [Series::Spins.at(0.0, base), Series::Spins.at(0.9, base)];
    let tilted = [0.0, 1.0, 3.0, 6.0].map(|k| Series::Inclinations.at(k * 180.0 / 14.0, base));
    for setting in settings.into_iter().chain(tilted) {
        let (exact, measured) = (setting.exact().unwrap(), setting.measured().unwrap());
        println!("{} {}\n {exact:?}\n {measured:?}", setting.spin, setting.inclination);
        for (exact, measured) in [
            (exact.left, measured.left),
            (exact.right, measured.right),
            (exact.below, measured.below),
            (exact.centre[0], measured.centre[0]),
            (exact.centre[1], measured.centre[1]),
        ] {
            assert!((exact - measured).abs() < 0.05, "{setting:?}: {exact} {measured}");
        }
    }
}

/// The ratio grows with spin, faster than a straight line; h/r+ falls with inclination from above cos i. Edge-on and without spin both sides
/// are alike; face-on all are.
#[test]
fn tables() {
    let spins = Series::Spins.table(Setting::default(), false).unwrap();
    assert!((spins[0].ratio - 0.5).abs() < 1e-8);
    assert!(spins.windows(2).all(|w| w[0].ratio < w[1].ratio));
    let points: Vec<[f64; 2]> = spins.iter().map(|row| [row.parameter, row.ratio]).collect();
    let fit = Fit::of(&points).unwrap();
    assert!(fit.largest_residual > 1e-3, "not a line: {fit:?}");
    let tilts = Series::Inclinations.table(Setting::default(), false).unwrap();
    assert!((tilts[0].ratio - 1.0).abs() < 1e-8);
    for row in &tilts[1..] {
        assert!((row.exact.left - row.exact.right).abs() < 1e-5, "{row:?}");
        assert!(row.ratio > row.parameter.to_radians().cos(), "{row:?}");
    }
}

/// Face-on without spin, the disk's edge is where a photon that starts at r = 6 M with the observer 30 M away crosses the plane after a quarter of a
/// turn: the same from an integrator, and the ratio found back.
#[test]
fn engines_and_inverse() {
    let setting = Series::Spins.at(0.6, Setting::default());
    let exact = setting.exact().unwrap();
    // RK4 with a small step, in other coordinates: it errs by its step to the fourth power.
    let stepped = Setting { step: Some(0.02), ..setting }.exact().unwrap();
    assert!(
        (exact.left - stepped.left).abs() < 1e-3 && (exact.right - stepped.right).abs() < 1e-3,
        "{exact:?} {stepped:?}"
    );
    let [spin, error] = Series::Spins.invert(exact.left_share(), 1e-4, Setting::default()).unwrap();
    assert!((spin - 0.6).abs() < 1e-6 && error > 1e-3 && error < 0.1, "{spin} {error}");
    assert!(Series::Spins.invert(0.6, 0.0, Setting::default()).is_err());
}

/// The thesis's manner without what is inexact in it: in place and velocity, with smaller steps, light comes to the disk's edge in either sheet
/// as it does exactly. The dark's outline is next to the horizon, which ingoing coordinates do not reach: there it is found in the other sheet alone.
#[test]
fn either_sheet_is_exact() {
    let setting = Series::Spins.at(0.6, Setting::default());
    let exact = setting.exact().unwrap();
    for sheet in [false, true] {
        let manner = Some(Manner { sheet, ..Manner::plain(0.2) });
        let found = Setting { manner, ..setting }.exact().unwrap();
        let near = |found: f64, exact: f64, allowed: f64| {
            assert!((found - exact).abs() < allowed, "{sheet}: {found} {exact}");
        };
        near(found.left - found.centre[0], exact.left - exact.centre[0], 0.05);
        near(found.right + found.centre[0], exact.right + exact.centre[0], 0.05);
        near(found.centre[0], exact.centre[0], if sheet { 2.0 } else { 0.05 });
    }
}

/// All of the thesis's manner, without spin: as another program has it (RK4 of the same equations with derivatives by differences, the disk's edge
/// at R = 6 M by bisection), and far from what light does.
#[test]
fn as_the_thesis() {
    let setting = Series::Spins.at(0.0, Setting::default());
    let found = Setting { manner: Some(Manner::of(&Part::ALL)), ..setting }.exact().unwrap();
    assert!((found.left - 169.9617).abs() < 1e-3 && (found.right - 169.9617).abs() < 1e-3, "{found:?}");
    assert!(setting.exact().unwrap().left - found.left > 5.0);
    let spun = Setting { spin: 0.95, manner: Some(Manner::of(&Part::ALL)), ..setting }.exact().unwrap();
    assert!((spun.centre[0] + spun.right - 202.92).abs() < 0.05, "{spun:?}");
}

/// Parts are added one after another, and what each explains is of the same difference in slope.
#[test]
fn repeats() {
    let exact = Series::Spins.table(Setting::default(), false).unwrap();
    let repeats = Series::Spins.repeats(&exact, Setting::default(), &[Part::Step, Part::Chords]);
    let slope = |ratio: &dyn Fn(usize) -> f64| {
        Fit::of(&(0..7).map(|k| [exact[k].parameter, ratio(k)]).collect::<Vec<_>>()).unwrap().slope
    };
    let (here, theirs) = (slope(&|k| exact[k].ratio), slope(&|k| exact[k].thesis_ratio));
    assert_eq!(repeats.iter().map(|r| r.adds).collect::<Vec<_>>(), [Part::Step, Part::Chords]);
    for repeat in &repeats {
        let share = (repeat.fit.unwrap().slope - here) / (theirs - here);
        assert!(
            (repeat.explains.unwrap() - share).abs() < 1e-12 && repeat.ratios.iter().all(Option::is_some)
        );
    }
}

#[test]
fn a_line() {
    let fit = Fit::of(&[[0.0, 1.0], [1.0, 3.0], [2.0, 5.0], [3.0, 7.0]]).unwrap();
    assert!(
        (fit.slope - 2.0).abs() < 1e-14
            && (fit.intercept - 1.0).abs() < 1e-14
            && fit.largest_residual < 1e-14
    );
    assert_eq!(Fit::of(&[[0.0, 1.0], [0.0, 3.0], [0.0, 5.0]]), None);
}
