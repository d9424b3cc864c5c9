//! Long checks, each with a dated report that is kept.

mod axis;
mod coverage;
mod ranks;
mod resume;
mod shadow;
mod speed;

use std::path::Path;
use std::time::Instant;
use time::OffsetDateTime;

/// Runs a campaign and writes reports/NAME-DATE.md.
pub fn run(root: &Path, name: &str) -> Result<(), String> {
    let start = Instant::now();
    let (passed, body) = match name {
        "axis" => axis::run()?,
        "coverage" => coverage::run(root)?,
        "shadow" => shadow::run()?,
        "resume" => resume::run(root)?,
        "speed" => speed::run(root)?,
        "fuzz" => super::fuzz::campaign(root)?,
        _ => {
            return Err(format!(
                "no campaign is called {name:?}; there are: axis, coverage, shadow, resume, speed, fuzz"
            ));
        }
    };
    let date = OffsetDateTime::now_utc().date();
    let verdict = if passed { "passed" } else { "FAILED" };
    let report = format!(
        "# Campaign {name}, {date}: {verdict}\n\nkerrscope {}, `cargo xtask campaign {name}`, {:.0} s with {} threads.\n\n{body}",
        env!("CARGO_PKG_VERSION"),
        start.elapsed().as_secs_f64(),
        rayon::current_num_threads(),
    );
    let folder = root.join("reports");
    let file = folder.join(format!("{name}-{date}.md"));
    std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(&file, &report))
        .map_err(|e| format!("{}: {e}", file.display()))?;
    println!("{report}\nkept as {}", file.display());
    if passed { Ok(()) } else { Err(format!("campaign {name} failed")) }
}
