//! The data of the built-in sky, from the unpacked npm package `d3-celestial`.

use std::f64::consts::PI;
use std::path::Path;

use kerrscope::sky::{Glow, Star};
use rayon::prelude::*;
use serde_json::Value;

/// Pixels in a degree of the map of brightness levels, before it is smoothed.
const FINENESS: usize = 4;

/// Pixels around the sky.
const AROUND: i64 = 1440;

const WIDTH: usize = AROUND as usize;
const HEIGHT: usize = 180 * FINENESS;

/// What each isophote adds to the brightness inside it, from the outermost inwards, and how far it
/// is smoothed: the standard deviation in degrees.
const LEVELS: [(f64, f64); 5] = [(0.28, 4.0), (0.22, 2.5), (0.20, 1.8), (0.16, 1.3), (0.14, 1.0)];

/// Writes `crates/kerrscope/data/` again from a folder that contains the package.
pub fn write(root: &Path, package: &Path) -> Result<(), String> {
    let data = root.join("crates/kerrscope/data");
    let read = |name: &str| -> Result<Value, String> {
        let path = package.join("data").join(name);
        let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
    };
    let keep = |name: &str, bytes: &[u8]| {
        let path = data.join(name);
        std::fs::write(&path, bytes).map_err(|e| format!("{}: {e}", path.display()))?;
        eprintln!("{}: {} bytes", path.display(), bytes.len());
        Ok::<(), String>(())
    };
    keep("stars.bin", &stars(&read("stars.8.json")?).ok_or("stars.8.json is not as expected")?)?;
    keep("milky-way.bin", &milky_way(&read("mw.json")?).ok_or("mw.json is not as expected")?)
}

/// The stars' codes, the brightest first, otherwise as in the file.
fn stars(file: &Value) -> Option<Vec<u8>> {
    let mut stars = Vec::new();
    for feature in file["features"].as_array()? {
        let (place, about) = (point(&feature["geometry"]["coordinates"])?, &feature["properties"]);
        let index = about["bv"].as_str()?;
        stars.push(Star {
            right_ascension: place[0].rem_euclid(360.0),
            declination: place[1],
            magnitude: about["mag"].as_f64()?,
            color_index: if index.is_empty() { None } else { Some(index.parse().ok()?) },
        });
    }
    stars.sort_by(|a, b| a.magnitude.total_cmp(&b.magnitude));
    Some(stars.into_iter().flat_map(|star| star.code().to_le_bytes()).collect())
}

/// Brightness of the Milky Way at the samples of [`Glow`], 255 where all isophotes overlap.
fn milky_way(file: &Value) -> Option<Vec<u8>> {
    let features = file["features"].as_array()?;
    let levels: Vec<_> = LEVELS
        .iter()
        .zip(features)
        .map(|(&(height, blur), feature)| Some((height, blur, inside(&feature["geometry"]["coordinates"])?)))
        .collect::<Option<_>>()?;
    let directions: Vec<_> = Glow::directions().collect();
    let map = directions.par_iter().map(|&n| {
        let sum: f64 = levels.iter().map(|(height, blur, level)| height * smoothed(level, n, *blur)).sum();
        (255.0 * sum).round() as u8
    });
    (levels.len() == LEVELS.len()).then(|| map.collect())
}

fn point(json: &Value) -> Option<[f64; 2]> {
    Some([json.get(0)?.as_f64()?, json.get(1)?.as_f64()?])
}

/// Which pixels of an equirectangular map, from declination −90° up, lie inside polygons.
///
/// Those from which an odd number of edges lies to the south: the south celestial pole is outside.
/// The edges are short; right ascension is taken the short way around.
fn inside(polygons: &Value) -> Option<Vec<bool>> {
    let mut edges = vec![Vec::new(); WIDTH];
    for ring in polygons.as_array()?.iter().filter_map(Value::as_array).flatten() {
        let points: Vec<_> = ring.as_array()?.iter().map(point).collect::<Option<_>>()?;
        for (from, to) in points.iter().zip(points.iter().cycle().skip(1)) {
            let turn = (to[0] - from[0] + 180.0).rem_euclid(360.0) - 180.0;
            let column = |x: f64| (x * FINENESS as f64 - 0.5).ceil() as i64;
            let (first, last) = (from[0].min(from[0] + turn), from[0].max(from[0] + turn));
            for i in column(first)..column(last) {
                let x = (i as f64 + 0.5) / FINENESS as f64;
                edges[i.rem_euclid(AROUND) as usize].push(from[1] + (to[1] - from[1]) * (x - from[0]) / turn);
            }
        }
    }
    let mut map = vec![false; WIDTH * HEIGHT];
    for (x, column) in edges.iter_mut().enumerate() {
        column.sort_by(f64::total_cmp);
        for y in 0..HEIGHT {
            let declination = (y as f64 + 0.5) / FINENESS as f64 - 90.0;
            map[y * WIDTH + x] = column.partition_point(|&edge| edge < declination) % 2 == 1;
        }
    }
    Some(map)
}

/// The mean of a map around a direction, with Gaussian weights.
fn smoothed(map: &[bool], n: [f64; 3], blur: f64) -> f64 {
    let (blur, reach) = (blur.to_radians(), 3.0 * blur);
    let [ascension, declination] = [n[1].atan2(n[0]), n[2].clamp(-1.0, 1.0).asin()].map(f64::to_degrees);
    let row = |declination: f64| ((declination + 90.0) * FINENESS as f64).clamp(0.0, HEIGHT as f64) as usize;
    // As far to the sides as the cap reaches; everywhere near a pole.
    let widest = reach.to_radians().sin() / declination.to_radians().cos().max(1e-9);
    let half = if widest < 1.0 { widest.asin().to_degrees() } else { 180.0 };
    let middle = (ascension * FINENESS as f64).floor() as i64;
    let side = ((half * FINENESS as f64).ceil() as i64).min(AROUND / 2 - 1);
    let (mut sum, mut total) = (0.0, 0.0);
    for y in row(declination - reach)..row(declination + reach) {
        let (sin, cos) = (PI * ((y as f64 + 0.5) / HEIGHT as f64 - 0.5)).sin_cos();
        for x in middle - side..=middle + side {
            let angle = ((x as f64 + 0.5) / FINENESS as f64).to_radians();
            let chord = 2.0 - 2.0 * (cos * (angle.cos() * n[0] + angle.sin() * n[1]) + sin * n[2]);
            let weight = cos * (-0.5 * chord / (blur * blur)).exp();
            total += weight;
            if map[y * WIDTH + x.rem_euclid(AROUND) as usize] {
                sum += weight;
            }
        }
    }
    sum / total
}
