//! Long checks, each with a dated report that is kept.

mod axis;
mod coverage;
mod page;
mod python;
mod ranks;
mod recovery;
mod resume;
mod shadow;
mod speed;

use std::path::{Path, PathBuf};
use std::time::Instant;
use time::OffsetDateTime;

/// Runs a campaign and writes reports/NAME-DATE.md.
pub fn run(root: &Path, name: &str) -> Result<(), String> {
    let start = Instant::now();
    let (passed, body) = match name {
        "axis" => axis::run()?,
        "coverage" => coverage::run(root)?,
        "page" => page::run(root)?,
        "python" => python::run(root)?,
        "recovery" => recovery::run(root)?,
        "shadow" => shadow::run()?,
        "resume" => resume::run(root)?,
        "speed" => speed::run(root)?,
        "fuzz" => super::fuzz::campaign(root)?,
        _ => {
            return Err(format!(
                "no campaign is called {name:?}; there are: axis, coverage, page, python, recovery, shadow, resume, speed, fuzz"
            ));
        }
    };
    let date = OffsetDateTime::now_utc().date();
    let verdict = if passed { "passed" } else { "FAILED" };
    let report = format!(
        "# Campaign {name}, {date}: {verdict}\n\nkerrscope {}, `cargo xtask campaign {name}`, {:.0} s; {}.\n\n{body}",
        env!("CARGO_PKG_VERSION"),
        start.elapsed().as_secs_f64(),
        machine(),
    );
    let folder = root.join("reports");
    let file = folder.join(format!("{name}-{date}.md"));
    std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(&file, &report))
        .map_err(|e| format!("{}: {e}", file.display()))?;
    println!("{report}\nkept as {}", file.display());
    if passed { Ok(()) } else { Err(format!("campaign {name} failed")) }
}

/// The program as people build it.
fn program(root: &Path) -> Result<PathBuf, String> {
    super::cargo(&["build", "--release", "--locked"])?;
    Ok(root.join("target/release").join(format!("kerrscope{}", std::env::consts::EXE_SUFFIX)))
}

/// How many threads, of which processor, with which instructions.
fn machine() -> String {
    let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model =
        about.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": ")).map(|(_, m)| m);
    let best = kerrscope::spacetime::Level::best().name();
    format!("{} threads, {}, {best}", rayon::current_num_threads(), model.unwrap_or("unknown processor"))
}
