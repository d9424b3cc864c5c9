//! Renders killed at random moments and gone on with.

use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The picture: fig. 4.8 of the thesis, larger, every sample traced, with data layers.
const ARGUMENTS: [&str; 13] = [
    "render",
    "scenes/thesis-4.8.toml",
    "--set",
    "render.width=800",
    "--set",
    "render.height=450",
    "--set",
    "render.samples=64",
    "--set",
    "render.adaptive=false",
    "--set",
    "render.layers=[\"g\", \"sky_phi\"]",
    "--resume",
];

/// Kills a render 20 times, each at a random moment and each time from the start, and goes on with it;
/// every file must have the bytes of the uninterrupted one.
pub fn run(root: &Path) -> Result<(bool, String), String> {
    let program = super::program(root)?;
    let folder = root.join("target/resume");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let [whole, file] = ["whole.exr", "killed.exr"].map(|name| folder.join(name));
    let kept = folder.join("killed.exr.checkpoint");
    let start = |output: &Path| {
        let mut command = Command::new(&program);
        command.args(ARGUMENTS).arg("-o").arg(output).current_dir(root);
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().map_err(|e| e.to_string())
    };
    let finish = |output: &Path| {
        let begin = Instant::now();
        let status = start(output)?.wait().map_err(|e| e.to_string())?;
        let seconds = begin.elapsed().as_secs_f64();
        if status.success() { Ok(seconds) } else { Err("the render failed".to_owned()) }
    };
    let read = |path: &Path| std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()));
    let seconds = finish(&whole)?;
    let expected = read(&whole)?;
    let mut body = format!(
        "Uninterrupted: {seconds:.1} s. Killed (SIGKILL) after a random share of that, then gone on with.\n\n\
         | killed after (s) | kept (bytes) | rest (s) | same bytes |\n|---|---|---|---|\n"
    );
    let mut passed = true;
    // The golden ratio's multiples: spread over the whole time, and the same in every campaign.
    for k in 0..20 {
        let share = (0.5 * (5f64.sqrt() - 1.0) * f64::from(k) + 0.1).fract();
        for path in [&file, &kept] {
            let _ = std::fs::remove_file(path);
        }
        let mut child = start(&file)?;
        std::thread::sleep(Duration::from_secs_f64(0.97 * share * seconds));
        child.kill().and_then(|()| child.wait()).map_err(|e| e.to_string())?;
        if file.exists() {
            // It was faster this time: nothing was interrupted.
            let _ = writeln!(body, "| {:.2} | finished before | | |", share * seconds);
            continue;
        }
        let bytes = kept.metadata().map_or(0, |about| about.len());
        let rest = finish(&file)?;
        let same = read(&file)? == expected && !kept.exists();
        passed &= same;
        let _ = writeln!(body, "| {:.2} | {bytes} | {rest:.2} | {same} |", 0.97 * share * seconds);
    }
    Ok((passed, body))
}
