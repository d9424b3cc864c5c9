//! Charts: the picture's pixels and the legend below them.

use kerrscope::display::chart::{Chart, ChartFault, Scale};
use kerrscope::display::{Colormap, Depth, NO_VALUE, Picture};
use kerrscope::output::{Provenance, png};
use proptest::prelude::*;
use std::f64::consts::TAU;

const NAN: f32 = f32::NAN;
const INF: f32 = f32::INFINITY;

type Pixel = [f32; 3];

fn pixel(color: [f64; 3]) -> Pixel {
    color.map(|c| c as f32)
}

fn chart(scale: Scale, range: Option<[f64; 2]>) -> Chart {
    Chart { range, ..Chart::new("redshift factor g", "", scale) }
}

fn categories() -> Scale {
    Scale::Categories(vec![(0.0, "sky".into()), (1.0, "hole".into()), (4.0, "given up".into())])
}

/// The rows of the legend of a picture that was `height` pixels high.
fn legend(picture: &Picture, height: usize) -> Vec<&[Pixel]> {
    picture.pixels.chunks_exact(picture.width as usize).skip(height).collect()
}

/// Colours that are not grey.
fn coloured(pixel: Pixel) -> bool {
    pixel[0] != pixel[1] || pixel[1] != pixel[2]
}

/// A plane of one row with the given values at its left, and 1 else.
fn row(values: &[f32], width: usize) -> Vec<f32> {
    let mut row = vec![1.0; width];
    row[..values.len()].copy_from_slice(values);
    row
}

/// The legend's bar: the row through its middle, from its left end to its right end.
fn bar<'a>(legend: &[&'a [Pixel]]) -> &'a [Pixel] {
    let rows: Vec<&[Pixel]> = legend.iter().copied().filter(|row| row.iter().any(|p| coloured(*p))).collect();
    let middle = rows[rows.len() / 2];
    let first = middle.iter().position(|p| coloured(*p)).unwrap();
    let last = middle.iter().rposition(|p| coloured(*p)).unwrap();
    &middle[first..=last]
}

#[test]
fn pixels_have_the_colours_of_their_values() {
    let values = [-INF, -0.5, 0.0, 0.1, 0.75, 1.0, 7.0, INF, NAN, 1e-9];
    let planes = [
        (Scale::Linear, [-1.0, 3.0]),
        (Scale::Logarithmic, [1e-3, 10.0]),
        (Scale::Cyclic { period: 2.0 }, [-1.0, 1.0]),
    ];
    for (scale, range) in planes {
        for colormap in [Colormap::Viridis, Colormap::Grey, Colormap::Hue] {
            let chart = Chart { colormap, legend: false, ..chart(scale.clone(), Some(range)) };
            let picture = chart.draw(&values, 5, 2).unwrap();
            assert_eq!((picture.width, picture.height), (5, 2));
            for (value, drawn) in values.iter().zip(&picture.pixels) {
                let t = scale.position(range, f64::from(*value));
                assert_eq!(*drawn, pixel(t.map_or(NO_VALUE, |t| colormap.color(t))), "{scale:?} {value}");
            }
        }
    }
    // A few of them by hand: 0.1 is a quarter and a bit of the way from −1 to 3, 0 is below any ratio.
    let linear = chart(Scale::Linear, Some([-1.0, 3.0])).draw(&values, 10, 1).unwrap();
    assert_eq!(linear.pixels[2], pixel(Colormap::Viridis.color(0.25)));
    assert_eq!(linear.pixels[0], pixel(Colormap::Viridis.color(0.0)));
    assert_eq!(linear.pixels[7], pixel(Colormap::Viridis.color(1.0)));
    let ratio = chart(Scale::Logarithmic, Some([1e-3, 10.0])).draw(&values, 10, 1).unwrap();
    assert_eq!([1, 8].map(|k| ratio.pixels[k]), [pixel(NO_VALUE); 2]);
    assert_eq!([2, 9].map(|k| ratio.pixels[k]), [pixel(Colormap::Viridis.color(0.0)); 2]);
}

#[test]
fn without_a_range_that_of_the_values_is_taken() {
    let values = [0.31, 0.5, 1.13, NAN];
    let automatic = chart(Scale::Linear, None).draw(&values, 4, 1);
    assert_eq!(automatic, chart(Scale::Linear, Some([0.3, 1.15])).draw(&values, 4, 1));
    // A constant plane is in the middle of the map.
    let constant = chart(Scale::Linear, None).draw(&[3.0; 6], 3, 2).unwrap();
    assert!(
        constant
            .pixels
            .iter()
            .flatten()
            .zip(Colormap::Viridis.color(0.5).iter().cycle())
            .all(|(drawn, middle)| (f64::from(*drawn) - middle).abs() < 1e-6)
    );
}

#[test]
fn a_legend_leaves_the_picture_as_it_is() {
    let values: Vec<f32> = (0..300 * 20).map(|k| k as f32).collect();
    let with = chart(Scale::Linear, None);
    let without = Chart { legend: false, ..with.clone() };
    let (with, without) = (with.draw(&values, 300, 20).unwrap(), without.draw(&values, 300, 20).unwrap());
    assert_eq!((without.width, without.height), (300, 20));
    assert!(with.width == 300 && with.height > 40, "{}", with.height);
    assert_eq!(with.pixels[..300 * 20], without.pixels);
    assert_eq!(with.pixels.len(), 300 * with.height as usize);
}

#[test]
fn the_bar_shows_the_map_from_end_to_end() {
    for width in [16, 64, 300, 960, 4000, 16384] {
        for colormap in [Colormap::Viridis, Colormap::Plasma, Colormap::Hue] {
            let chart = Chart { colormap, ..chart(Scale::Linear, Some([0.0, 2.0])) };
            let picture = chart.draw(&row(&[], width), width as u32, 1).unwrap();
            let rows = legend(&picture, 1);
            let bar = bar(&rows);
            assert!(bar.len() > width * 3 / 5, "{width} {}", bar.len());
            for (k, drawn) in bar.iter().enumerate() {
                let t = k as f64 / (bar.len() - 1) as f64;
                assert_eq!(*drawn, pixel(colormap.color(t)), "{width} {t}");
            }
        }
    }
}

#[test]
fn a_bar_is_pointed_where_values_lie_beyond_it() {
    let ends = |values: &[f32], scale: Scale, range: [f64; 2]| {
        let picture = chart(scale, Some(range)).draw(&row(values, 500), 500, 1).unwrap();
        let rows = legend(&picture, 1);
        // Without a point the end's colour stands in one column.
        let columns =
            |t| bar(&rows).iter().filter(|drawn| **drawn == pixel(Colormap::Viridis.color(t))).count();
        [columns(0.0) > 1, columns(1.0) > 1]
    };
    let linear = |values: &[f32]| ends(values, Scale::Linear, [0.3, 1.7]);
    assert_eq!(linear(&[]), [false, false]);
    // 1.7 and 0.3 in 32 bits are 1.70000005 and 0.30000001.
    assert_eq!(linear(&[0.3, 1.7]), [false, false]);
    assert_eq!(linear(&[0.29, 1.7]), [true, false]);
    assert_eq!(linear(&[1.71]), [false, true]);
    assert_eq!(linear(&[INF, -INF, NAN]), [true, true]);
    let ratio = |values: &[f32]| ends(values, Scale::Logarithmic, [0.1, 10.0]);
    assert_eq!(ratio(&[0.1, 10.0]), [false, false]);
    assert_eq!(ratio(&[0.0]), [true, false]);
    // It has no logarithm and is no value, not a small one.
    assert_eq!(ratio(&[-3.0]), [false, false]);
    assert_eq!(ratio(&[INF]), [false, true]);
}

#[test]
fn no_value_is_listed_where_it_occurs() {
    let listed = |scale: Scale, values: &[f32]| {
        let picture = chart(scale, None).draw(&row(values, 400), 400, 1).unwrap();
        legend(&picture, 1).concat().contains(&pixel(NO_VALUE))
    };
    for scale in [Scale::Linear, Scale::Logarithmic, Scale::Cyclic { period: TAU }, categories()] {
        assert!(listed(scale.clone(), &[NAN]), "{scale:?}");
        assert!(!listed(scale.clone(), &[1.0]), "{scale:?}");
    }
    assert!(!listed(Scale::Linear, &[INF]));
    assert!(listed(Scale::Logarithmic, &[-1.0]));
    assert!(listed(Scale::Cyclic { period: TAU }, &[INF]));
    assert!(listed(categories(), &[0.5]));
}

#[test]
fn a_plane_without_values_has_no_bar() {
    for scale in [Scale::Linear, Scale::Logarithmic, Scale::Cyclic { period: TAU }] {
        let picture = chart(scale, None).draw(&[NAN; 800], 400, 2).unwrap();
        assert!(picture.pixels[..800].iter().all(|drawn| *drawn == pixel(NO_VALUE)));
        assert!(picture.height > 20);
        assert!(!picture.pixels.iter().any(|drawn| coloured(*drawn)));
        assert!(legend(&picture, 2).concat().contains(&pixel(NO_VALUE)));
    }
}

#[test]
fn categories_have_boxes_in_their_colours() {
    let values = row(&[0.0, 4.0, 2.0, INF, NAN], 200);
    let picture = chart(categories(), None).draw(&values, 200, 1).unwrap();
    let colors = [0.5, 1.5, 2.5].map(|k| pixel(Colormap::Viridis.color(k / 3.0)));
    let none = pixel(NO_VALUE);
    assert_eq!(picture.pixels[..6], [colors[0], colors[2], none, none, none, colors[1]]);
    let below = legend(&picture, 1).concat();
    for color in colors.into_iter().chain([none]) {
        // An area, not the edge of a letter.
        assert!(below.iter().filter(|drawn| **drawn == color).count() > 30);
    }
    // Nothing else has a colour.
    assert!(below.iter().all(|drawn| !coloured(*drawn) || colors.contains(drawn)));
}

#[test]
fn words_are_not_cut_at_the_edges() {
    let scales = [
        (Scale::Linear, [-12345.0, 98765.0]),
        (Scale::Linear, [-1e-7, 3e-7]),
        (Scale::Logarithmic, [1e-12, 1e-3]),
        (Scale::Cyclic { period: TAU }, [0.0, TAU]),
    ];
    for width in [64, 100, 128, 200, 256, 320, 480, 512, 640, 800, 960, 1280, 1920, 2560, 4000] {
        for (scale, range) in &scales {
            let chart = Chart {
                title: "error of the ray's direction".into(),
                unit: "rad".into(),
                ..chart(scale.clone(), Some(*range))
            };
            let picture = chart.draw(&row(&[NAN, INF, -INF], width), width as u32, 1).unwrap();
            let rows = legend(&picture, 1);
            let ground = rows[0][0];
            let empty = |row: &[Pixel]| row.iter().all(|drawn| *drawn == ground);
            assert!(empty(rows[0]) && empty(rows[rows.len() - 1]), "{width} {scale:?}");
            assert!(rows.iter().all(|row| row[0] == ground && row[width - 1] == ground), "{width} {scale:?}");
            // Something is written, in the colour of words.
            assert!(rows.iter().any(|row| row.iter().any(|drawn| drawn[0] > 0.8 && !coloured(*drawn))));
        }
    }
}

#[test]
fn very_small_and_very_large_pictures() {
    for (width, height) in [(1, 1), (2, 1), (3, 7), (7, 1), (1, 16384), (16384, 1), (16384, 40)] {
        for scale in [Scale::Linear, Scale::Logarithmic, Scale::Cyclic { period: TAU }, categories()] {
            let values: Vec<f32> = (0..width * height).map(|k| k as f32).collect();
            let picture = chart(scale, None).draw(&values, width, height).unwrap();
            assert_eq!(picture.pixels.len(), picture.width as usize * picture.height as usize);
            assert_eq!(picture.width, width);
            // Nothing fits below a few columns.
            assert_eq!(picture.height > height, width > 8, "{width}");
        }
    }
}

#[test]
fn the_same_chart_is_the_same_picture() {
    let values: Vec<f32> = (0..50_000).map(|k| (k as f32 * 0.37).sin()).collect();
    let draw = || chart(Scale::Linear, None).draw(&values, 500, 100).unwrap();
    let threads = |count| rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
    assert_eq!(threads(1).install(draw), threads(4).install(draw));
}

#[test]
fn a_saved_chart_has_the_colours_of_the_map() {
    let values: Vec<f32> = (0..256).map(|k| k as f32).collect();
    let picture = chart(Scale::Linear, Some([0.0, 255.0])).draw(&values, 256, 1).unwrap();
    let made = Provenance {
        version: "0".into(),
        seed: 0,
        instruction_level: String::new(),
        interpolation: None,
        scene_toml: String::new(),
    };
    let mut file = Vec::new();
    png::encode(&mut file, &picture, Depth::Eight, &made).unwrap();
    let read = image::load_from_memory(&file).unwrap().to_rgb8();
    assert_eq!(read.height(), picture.height);
    for (k, (saved, drawn)) in read.pixels().zip(&picture.pixels).enumerate() {
        assert_eq!(saved.0, drawn.map(|c| (c * 255.0).round() as u8), "{k}");
    }
}

#[test]
fn faults_say_what_to_do() {
    let fault = |chart: Chart, values: usize, width, height| {
        chart.draw(&vec![1.0; values], width, height).unwrap_err()
    };
    let linear = |range| fault(chart(Scale::Linear, Some(range)), 4, 2, 2);
    assert_eq!(
        fault(chart(Scale::Linear, None), 0, 0, 5).fault,
        ChartFault::Size { width: 0, height: 5, values: 0 }
    );
    assert_eq!(
        linear([2.0, 1.0]).to_string(),
        "cannot draw a chart: the range from 2 to 1 cannot be shown; give two numbers below 1e40, the second \
         larger by at least a millionth of their amount"
    );
    let unusable = [[1.0, 1.0], [1.0, 1.0 + 1e-8], [f64::NAN, 1.0], [0.0, f64::INFINITY], [0.0, 1e41]];
    for range in unusable {
        assert!(matches!(linear(range).fault, ChartFault::Range { .. }), "{range:?}");
    }
    assert_eq!(
        fault(chart(Scale::Logarithmic, Some([0.0, 1.0])), 1, 1, 1).to_string(),
        "cannot draw a chart: the logarithmic range from 0 to 1 does not lie above 0; give a lower end \
         above 0, or use a linear scale"
    );
    let cyclic = |period, range| fault(chart(Scale::Cyclic { period }, range), 1, 1, 1).fault;
    assert_eq!(cyclic(-1.0, None), ChartFault::Period { period: -1.0 });
    assert!(matches!(cyclic(f64::NAN, None), ChartFault::Period { .. }));
    assert_eq!(cyclic(2.0, Some([0.0, 1.0])), ChartFault::NotPeriod { low: 0.0, high: 1.0, period: 2.0 });
    assert_eq!(fault(chart(categories(), Some([0.0, 1.0])), 1, 1, 1).fault, ChartFault::RangeOfCategories);
}

proptest! {
    #[test]
    fn anything_can_be_drawn(
        bits in prop::collection::vec(any::<u32>(), 1..400),
        height in 1_usize..4,
        title in ".{0,40}",
        names in prop::collection::vec((any::<f32>(), ".{0,12}"), 0..9),
        kind in 0..4,
        period in 1e-30..1e30,
    ) {
        let width = bits.len() / height;
        prop_assume!(width > 0);
        let values: Vec<f32> = bits.into_iter().map(f32::from_bits).take(width * height).collect();
        let scale = [Scale::Linear, Scale::Logarithmic, Scale::Cyclic { period }, Scale::Categories(names)];
        let chart = Chart::new(title, "M", scale[kind as usize].clone());
        let picture = chart.draw(&values, width as u32, height as u32).unwrap();
        prop_assert_eq!(picture.pixels.len(), width * picture.height as usize);
        prop_assert!(picture.pixels.iter().flatten().all(|c| (0.0..=1.0).contains(c)));
    }
}
