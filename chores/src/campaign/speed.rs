//! How fast the program is, and how exact.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use kerrscope::display::Display;
use kerrscope::render::{Film, Stage, Watch, draw};
use kerrscope::scene::Scene;
use serde_json::Value;

/// Repetitions of a command, of which the median counts.
const TIMES: usize = 7;

/// The figure of the thesis that whole commands draw.
const SCENE: &str = "scenes/thesis-4.8.toml";

/// Runs `kerrscope bench`, times whole commands, and compares adaptive pictures with those whose every
/// sample is traced. Nothing is required of the speed; interpolated quantities must be within the error asked
/// for.
pub fn run(root: &Path) -> Result<(bool, String), String> {
    let program = super::program(root)?;
    let mut body = "## Rays\n\n`kerrscope bench`: 640,000 rays around a = 0.99, one thread, CPU time, the median of several passes. \
             Errors are against the closed form with 48 nodes: sky angle in radians and relative radius of crossings, outside \
             1 % of the critical curve. The last column is the largest error of a radius anywhere, as a share of \
             max(10⁻⁸, 10⁻¹⁴ r/δ) at the relative distance δ from the critical curve; then the rays whose fate or number of \
             crossings is another.\n\n"
        .to_owned();
    bench(&program, root, &mut body)?;
    body += "\n## Whole commands\n\n";
    let _ = writeln!(
        body,
        "`kerrscope render {SCENE}` with everything from reading the scene to the finished PNG, the median of {TIMES} runs \
         (and the range) of the wall time.\n\n| size | samples | adaptive | wall (s) | rays traced | interpolation error, largest | missed |\n|---|---|---|---|---|---|---|"
    );
    for (width, height, samples, adaptive) in [
        (400, 400, 4, false),
        (400, 400, 4, true),
        (1920, 1080, 4, true),
        (1920, 1080, 16, true),
        (1920, 1080, 16, false),
    ] {
        command(&program, root, [width, height, samples], adaptive, &mut body)?;
    }
    body += "\n## Adaptive pictures\n\n1920 × 1080 pixels of 16 samples, against the same with every sample traced. Errors are the \
             worst of about 10,000 samples picked by chance over the whole picture: of radii relative, of azimuths and directions in \
             radians. Pixels are compared on the screen, in steps of 255.\n\n\
             | scene | error asked for | rays traced | largest error | compared | missed | largest pixel difference | mean | pixels that differ |\n|---|---|---|---|---|---|---|---|---|\n";
    let mut passed = true;
    for scene in [SCENE, "scenes/thesis-4.5.toml"] {
        passed &= pictures(root, scene, &mut body)?;
    }
    Ok((passed, body))
}

fn json(program: &Path, root: &Path, arguments: &[&str]) -> Result<Value, String> {
    let output = Command::new(program)
        .args(arguments)
        .args(["--format", "json"])
        .current_dir(root)
        .output()
        .map_err(|e| format!("{}: {e}", program.display()))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    serde_json::from_slice(&output.stdout).map_err(|e| e.to_string())
}

fn bench(program: &Path, root: &Path, body: &mut String) -> Result<(), String> {
    *body += "| engine | method | tolerance | instructions | rays/s/core | sky median | sky largest | radius median | radius largest | of its bound | mismatched |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    let rows = json(program, root, &["bench"])?;
    for row in rows.as_array().into_iter().flatten() {
        let number = |key: &str| row[key].as_f64().unwrap_or(f64::NAN);
        let word = |key: &str| row[key].as_str().unwrap_or_default();
        let tolerance = row["tolerance"].as_f64().map_or_else(|| "–".to_owned(), |t| format!("{t:.0e}"));
        let _ = writeln!(
            body,
            "| {} | {} | {tolerance} | {} | {:.1} k | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.2} | {} |",
            word("engine"),
            word("method"),
            word("simd"),
            number("rays_per_cpu_s") * 1e-3,
            number("sky_error_median"),
            number("sky_error_max"),
            number("radius_error_median"),
            number("radius_error_max"),
            number("radius_error_share_of_bound"),
            row["mismatched"],
        );
    }
    Ok(())
}

fn command(
    program: &Path,
    root: &Path,
    [width, height, samples]: [u32; 3],
    adaptive: bool,
    body: &mut String,
) -> Result<(), String> {
    let picture = picture_file(root)?;
    let settings = [
        format!("render.width={width}"),
        format!("render.height={height}"),
        format!("render.samples={samples}"),
        format!("render.adaptive={adaptive}"),
    ];
    let mut arguments = vec!["render", SCENE, "-o", &picture];
    arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
    let mut walls = Vec::new();
    let mut last = Value::Null;
    for _ in 0..TIMES {
        // Outside: with the start of the process and its end.
        let start = std::time::Instant::now();
        last = json(program, root, &arguments)?;
        walls.push(start.elapsed().as_secs_f64());
    }
    walls.sort_by(f64::total_cmp);
    let found = &last["interpolation"];
    let error = found["error_max"].as_f64().map_or_else(|| "–".to_owned(), |e| format!("{e:.1e}"));
    let missed = found["missed"].as_u64().map_or_else(|| "–".to_owned(), |n| n.to_string());
    let _ = writeln!(
        body,
        "| {width} × {height} | {samples} | {adaptive} | {:.3} ({:.3}–{:.3}) | {} | {error} | {missed} |",
        walls[TIMES / 2],
        walls[0],
        walls[TIMES - 1],
        last["rays_traced"],
    );
    Ok(())
}

/// A file for pictures that nobody keeps.
fn picture_file(root: &Path) -> Result<String, String> {
    let folder: PathBuf = root.join("target/speed");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    Ok(folder.join("a.png").display().to_string())
}

/// Whether interpolation kept to its error.
fn pictures(root: &Path, name: &str, body: &mut String) -> Result<bool, String> {
    let path = root.join(name);
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut scene = Scene::from_toml(&text, root).map_err(|e| e.to_string())?;
    (scene.render.width, scene.render.height, scene.render.samples) = (1920, 1080, 16);
    scene.render.layers.clear();
    let mut film = |adaptive: Option<f64>| -> Result<Film, String> {
        scene.render.adaptive = adaptive;
        let stage = Stage::new(&scene).map_err(|e| e.to_string())?;
        draw(&stage, &Watch::default()).map_err(|e| e.to_string())
    };
    let traced = shown(&film(None)?);
    let mut passed = true;
    for target in [1e-3, 1e-4, 1e-6] {
        let adaptive = film(Some(target))?;
        let found = adaptive.tally.interpolation;
        let differences: Vec<f32> =
            shown(&adaptive).iter().zip(&traced).map(|(a, b)| 255.0 * (a - b).abs()).collect();
        let mean = differences.iter().map(|d| f64::from(*d)).sum::<f64>() / differences.len() as f64;
        let apart = differences.chunks(3).filter(|pixel| pixel.iter().any(|d| *d > 0.5)).count();
        let _ = writeln!(
            body,
            "| {name} | {target:.0e} | {} ({:.1} %) | {:.1e} | {} | {} | {:.2} | {mean:.1e} | {apart} |",
            adaptive.tally.rays,
            100.0 * adaptive.tally.rays as f64 / (1920.0 * 1080.0 * 16.0),
            found.worst,
            found.compared,
            found.missed,
            differences.iter().copied().fold(0.0, f32::max),
        );
        passed &= found.samples > 0 && found.worst <= target && found.missed * 1000 <= found.compared;
    }
    Ok(passed)
}

/// Values on the screen, 0 to 1.
fn shown(film: &Film) -> Vec<f32> {
    Display::default().develop(film).pixels.into_flattened()
}
