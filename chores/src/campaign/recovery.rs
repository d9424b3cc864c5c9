//! Whether fits find what pictures were drawn with: pictures of the renderer, fitted by the program as one without flags does.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use kerrscope::output::file::write_atomically;
use serde_json::Value;

/// A picture, how it is fitted, and what has to be found.
struct Case {
    name: &'static str,
    /// What is set in the scene of `scenes/validation/gyoto.toml`.
    set: &'static [&'static str],
    /// Means over the pixels of this many rays, or one ray through the middle of each.
    samples: u32,
    /// Arguments of the fit.
    arguments: &'static [&'static str],
    /// True values, and how far off the most probable value may be.
    truth: &'static [(&'static str, f64, f64)],
    /// Parameters that the 95 % interval has to hold, to this much.
    held: Option<(&'static str, f64)>,
    /// What warnings have to say.
    said: &'static [&'static str],
}

const PLAIN: Case =
    Case { name: "", set: &[], samples: 256, arguments: &[], truth: &[], held: None, said: &[] };

/// A case of a spin, an inclination, a distance, a roll and a field of view, without noise.
macro_rules! clean {
    ($name:literal, $spin:literal, $inclination:literal, $distance:literal, $roll:literal, $field:literal) => {
        Case {
            name: $name,
            set: &[
                concat!("spacetime.spin=", $spin),
                concat!("observer.inclination=", $inclination),
                concat!("observer.distance=", $distance),
                concat!("screen.roll=", $roll),
                concat!("screen.field_of_view=", $field),
            ],
            truth: &[("spin", $spin, 1e-3), ("inclination", $inclination as f64, 0.05)],
            ..PLAIN
        }
    };
}

/// The same of one ray through the middle of each pixel.
macro_rules! sampled {
    ($name:literal, $spin:literal, $inclination:literal, $distance:literal, $roll:literal, $field:literal, $most:expr, $arguments:expr) => {
        Case {
            samples: 1,
            arguments: $arguments,
            truth: &[("spin", $spin, $most[0]), ("inclination", $inclination as f64, $most[1])],
            held: Some(("spin", 0.01)),
            ..clean!($name, $spin, $inclination, $distance, $roll, $field)
        }
    };
}

const THEORY: &[&str] = &["--spacetime", "johannsen", "--prior", "a13=uniform(-3, 3)", "--distance", "1000"];

const CASES: [Case; 15] = [
    clean!("without noise", 0.35, 25, 1000, 40, 1.8),
    clean!("without noise", 0.7, 20, 1000, 120, 1.8),
    clean!("without noise", 0.5, 45, 400, 200, 4.5),
    clean!("without noise", 0.9, 60, 1000, 0, 1.8),
    clean!("without noise", 0.31, 70, 1000, 0, 1.8),
    clean!("without noise", 0.95, 80, 1000, -70, 1.8),
    clean!("without noise", 0.998, 85, 1000, 10, 1.8),
    sampled!("one ray a pixel", 0.9, 60, 100, 0, 18, [0.02, 0.5], &["--distance", "100"]),
    sampled!("one ray a pixel", 0.9, 60, 100, 0, 18, [0.03, 0.7], &[]),
    sampled!("one ray a pixel", 0.6, 40, 150, 130, 12, [0.02, 0.5], &["--distance", "150"]),
    sampled!("one ray a pixel", 0.4, 70, 300, 250, 6, [0.03, 0.7], &[]),
    Case {
        truth: &[("spin", 0.6, 0.01)],
        said: &["position angle cannot be told"],
        ..clean!("face-on", 0.6, 0.001, 1000, 0, 1.8)
    },
    Case {
        truth: &[("spin", 0.0, 5e-3), ("inclination", 50.0, 0.05)],
        said: &["sign of the spin cannot be told"],
        ..clean!("no spin", 0.0, 50, 1000, 0, 1.8)
    },
    Case {
        name: "a deviation of Johannsen's kind",
        set: &[
            "spacetime={name=\"johannsen\",parameters={spin=0.6,a13=1.5}}",
            "observer.inclination=50",
            "observer.distance=1000",
            "screen.field_of_view=1.8",
            // Beyond the picture.
            "disk.outer=60",
        ],
        arguments: THEORY,
        truth: &[("a13", 1.5, 0.1), ("spin", 0.6, 0.02), ("inclination", 50.0, 0.5)],
        ..PLAIN
    },
    Case {
        arguments: THEORY,
        truth: &[("a13", 0.0, 0.1), ("spin", 0.6, 0.02), ("inclination", 50.0, 0.5)],
        held: Some(("a13", 0.0)),
        ..clean!("Kerr's, for such a deviation", 0.6, 50, 1000, 0, 1.8)
    },
];

/// Pictures that show no such disk.
const WRONG: [&str; 5] = ["two holes", "a cat", "black", "pixels that are no numbers", "no picture"];

/// Draws, fits and compares; passed if all is found as near as has to be, and nothing is claimed of what shows no disk.
pub fn run(root: &Path) -> Result<(bool, String), String> {
    let program = super::program(root)?;
    let folder = root.join("target/recovery");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let bench = Bench { program, folder, root: root.to_path_buf() };
    let mut body = "Pictures of 128² pixels of a Page–Thorne disk without an outer edge, drawn by `kerrscope render` from \
                    `scenes/validation/gyoto.toml`: means over the pixels of 256 rays, or one ray through the middle of each. Fitted by \
                    `kerrscope fit` without flags but those that are named. Found are the most probable values, and standard deviations.\n\n\
                    | picture | flags | true | found | R̂ < 1.01, 400 draws | fit (s) | passed |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    let mut passed = true;
    let mut warnings = String::new();
    for (number, case) in CASES.iter().enumerate() {
        let line = bench.case(number, case)?;
        eprintln!("{}", line.row);
        passed &= line.passed;
        body += &line.row;
        let _ = writeln!(warnings, "{}. {}", number + 1, line.warnings.join("; "));
    }
    let _ = write!(body, "\nWarnings, in the same order:\n\n{warnings}\n## Pictures of something else\n\n");
    for what in WRONG {
        let (fine, said) = bench.wrong(what)?;
        passed &= fine;
        let _ = writeln!(body, "- {what}: {said}");
    }
    Ok((passed, body))
}

struct Bench {
    program: PathBuf,
    folder: PathBuf,
    root: PathBuf,
}

struct Line {
    row: String,
    warnings: Vec<String>,
    passed: bool,
}

impl Bench {
    fn say(&self, words: &[&str]) -> Result<Output, String> {
        Command::new(&self.program).args(words).current_dir(&self.root).output().map_err(|e| e.to_string())
    }

    fn render(
        &self,
        scene: &str,
        set: &[&str],
        samples: u32,
        size: u32,
        name: &str,
    ) -> Result<String, String> {
        let file = self.folder.join(name).to_string_lossy().into_owned();
        let more = [
            format!("render.samples={samples}"),
            format!("render.jitter={}", samples > 1),
            format!("render.width={size}"),
            format!("render.height={size}"),
        ];
        let mut words = vec!["render", scene, "-o", &file];
        words.extend(set.iter().copied().chain(more.iter().map(String::as_str)).flat_map(|s| ["--set", s]));
        let done = self.say(&words)?;
        if done.status.success() { Ok(file) } else { Err(String::from_utf8_lossy(&done.stderr).into_owned()) }
    }

    fn case(&self, number: usize, case: &Case) -> Result<Line, String> {
        let name = format!("{}.fits", number + 1);
        let file = self.render("scenes/validation/gyoto.toml", case.set, case.samples, 128, &name)?;
        let mut words = vec!["fit", &file, "--format", "json", "--quiet"];
        words.extend(case.arguments);
        let done = self.say(&words)?;
        let fit: Value = serde_json::from_slice(&done.stdout)
            .map_err(|e| format!("{name}: {e}\n{}", String::from_utf8_lossy(&done.stderr)))?;
        let number = |name: &str, key: &str| {
            let all = fit["parameters"].as_array().into_iter().flatten();
            all.into_iter().find(|p| p["name"] == name).and_then(|p| p[key].as_f64()).unwrap_or(f64::NAN)
        };
        let mut passed = fit["good"] == true && fit["converged"] == true;
        let (mut truth, mut found) = (Vec::new(), Vec::new());
        for (name, value, most) in case.truth {
            let mode = number(name, "mode");
            passed &= (mode - value).abs() <= *most;
            truth.push(format!("{name} {value}"));
            found.push(format!("{mode:.5} ± {:.5} (within {most})", number(name, "sd")));
        }
        if let Some((name, margin)) = case.held
            && let Some((_, value, _)) = case.truth.iter().find(|(known, ..)| *known == name)
        {
            let [low, high] = ["q025", "q975"].map(|key| number(name, key));
            passed &= low - margin <= *value && *value <= high + margin;
            found.push(format!("95 %: {name} {low:.4} to {high:.4}"));
        }
        let warnings: Vec<String> = fit["warnings"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|w| w.as_str().map(str::to_owned))
            .collect();
        passed &= case.said.iter().all(|word| warnings.iter().any(|warning| warning.contains(word)));
        let row = format!(
            "| {} {} | {} | {} | {} | {} | {:.0} | {passed} |\n",
            name.trim_end_matches(".fits"),
            case.name,
            case.arguments.join(" "),
            truth.join(", "),
            found.join(", "),
            fit["converged"],
            fit["wall_s"].as_f64().unwrap_or(f64::NAN),
        );
        Ok(Line { row, warnings, passed })
    }

    /// Whether a picture of something else is refused, or called poorly described, and what is said.
    fn wrong(&self, what: &str) -> Result<(bool, String), String> {
        let file = if what == "two holes" {
            self.render("scenes/two-holes.toml", &[], 1, 64, "two.fits")?
        } else {
            picture(what, &self.folder.join(what.replace(' ', "-") + ".fits"), |x, y| match what {
                "black" => 0.0,
                "pixels that are no numbers" if x > 0.5 => f64::NAN,
                _ => cat(x, y),
            })?
        };
        let done = self.say(&["fit", &file, "--format", "json", "--quiet"])?;
        if !done.status.success() {
            let said =
                String::from_utf8_lossy(&done.stderr).replace(&format!("{}/", self.folder.display()), "");
            return Ok((true, format!("refused: {}", said.trim())));
        }
        let fit: Value = serde_json::from_slice(&done.stdout).map_err(|e| format!("{what}: {e}"))?;
        let seconds = fit["wall_s"].as_f64().unwrap_or(f64::NAN);
        let first = fit["warnings"][0].as_str().unwrap_or("nothing").to_owned();
        Ok((fit["good"] == false, format!("{seconds:.0} s: {first}")))
    }
}

/// Writes a picture of 64² pixels as FITS; of what is no picture, a text.
fn picture(what: &str, file: &Path, pixel: impl Fn(f64, f64) -> f64) -> Result<String, String> {
    const SIZE: usize = 64;
    let mut bytes = Vec::new();
    if what == "no picture" {
        bytes.extend(b"a text");
    } else {
        let size = SIZE.to_string();
        for (key, value) in
            [("SIMPLE", "T"), ("BITPIX", "-64"), ("NAXIS", "2"), ("NAXIS1", &size), ("NAXIS2", &size)]
        {
            bytes.extend(format!("{:<80}", format!("{key:<8}= {value:>20}")).into_bytes());
        }
        bytes.extend(format!("{:<80}", "END").into_bytes());
        bytes.resize(bytes.len().next_multiple_of(2880), b' ');
        let place = |k: usize| (k as f64 + 0.5) / (SIZE as f64 / 2.0) - 1.0;
        for y in 0..SIZE {
            for x in 0..SIZE {
                bytes.extend(pixel(place(x), place(y)).to_be_bytes());
            }
        }
        bytes.resize(bytes.len().next_multiple_of(2880), 0);
    }
    write_atomically(file, |out| out.write_all(&bytes)).map_err(|e| e.to_string())?;
    Ok(file.to_string_lossy().into_owned())
}

/// A cat's face, x to the right and y up from −1 to 1: head, ears, eyes with slit pupils, a nose and whiskers.
fn cat(x: f64, y: f64) -> f64 {
    let oval = |at: [f64; 2], radii: [f64; 2]| {
        ((x - at[0]) / radii[0]).powi(2) + ((y - at[1]) / radii[1]).powi(2) < 1.0
    };
    let side = x.abs();
    let ear = side > 0.15 && y > 0.2 && y < 0.85 && (side - 0.45).abs() < 0.3 * (0.85 - y) / 0.4;
    let whisker =
        side > 0.2 && side < 0.75 && [0.0, 0.35].iter().any(|s| (y + 0.25 + s * (side - 0.2)).abs() < 0.02);
    if oval([0.25 * x.signum(), 0.1], [0.04, 0.12]) || oval([0.0, -0.2], [0.08, 0.05]) || whisker {
        0.05
    } else if oval([0.25 * x.signum(), 0.1], [0.13, 0.13]) {
        0.9
    } else if oval([0.0, -0.05], [0.7, 0.6]) || ear {
        0.5
    } else {
        0.02
    }
}
