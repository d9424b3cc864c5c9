//! The thesis's two tables, read off pictures and from single rays.

use kerrscope::measure::{Fit, Series, Setting};

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

#[test]
fn tables() {
    for series in [Series::Spins, Series::Inclinations] {
        for row in series.table(Setting::default(), false).unwrap() {
            println!(
                "{series:?} {:8.3} {:9.4} {:9.4} {:9.4}  {:.5}  thesis {:.4}",
                row.parameter, row.exact.left, row.exact.right, row.exact.below, row.ratio, row.thesis_ratio
            );
        }
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
