//! `kerrscope bench`: rays per second, and how exact they are.

mod contender;
mod course;
mod fits;
mod score;

use contender::Contender;
use course::Course;
use score::Row;

use crate::report::Failure;
use crate::{Format, print, print_json};
use kerrscope::spacetime::Level;

/// Rays per second of every engine, and their errors: sky angle in radians and relative crossing radius.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "640,000 rays around a = 0.99: a camera of zero angular momentum at r = 30, θ = 80°, tangents\n\
    within ±0.62, 400 × 400 pixels of 2 × 2 samples. Each ray is followed to its end, with up to three\n\
    equatorial crossings (r and φ) and its direction. Errors are against the closed form with 48 nodes on\n\
    the same rays, outside 1 % of the critical curve. Rates are the median of several passes. RK4, which is\n\
    slow, follows one ray in 61 unless there is --thin.\n\n\
    --fit times what `kerrscope fit` does instead: the likelihood of 128 × 128 pixels with its gradients in\n\
    all parameters, and a whole fit, with their errors.\n\n\
    Examples:\n  \
    kerrscope bench --engine closed-form\n  \
    kerrscope bench --simd baseline --format json\n  \
    kerrscope bench --fit --threads 2"
)]
pub struct Arguments {
    /// Only this engine: closed-form, integrator, components or text
    #[arg(long, value_name = "ENGINE", value_parser = contender::ENGINES)]
    engine: Option<String>,
    /// Only these vector instructions: baseline, avx2 or avx512
    #[arg(long, value_name = "LEVEL", value_parser = crate::parse_level)]
    simd: Option<Level>,
    /// Time a likelihood and a whole fit instead
    #[arg(long, conflicts_with_all = ["engine", "simd", "thin"])]
    fit: bool,
    /// Threads to use
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    /// Use only every N-th ray in each direction
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100))]
    thin: u32,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.fit {
        let found = fits::measure(arguments.threads)?;
        return if arguments.format == Format::Json { print_json(&found) } else { print(&found.to_string()) };
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(arguments.threads as usize)
        .build()
        .map_err(|e| Failure::Failed(format!("no threads: {e}; give fewer with --threads")))?;
    let course = Course::new(arguments.thin)?;
    let contenders: Vec<Contender> = Contender::all()
        .into_iter()
        .map(|c| if arguments.thin > 1 { Contender { one_in: 1, ..c } } else { c })
        .filter(|c| arguments.engine.as_ref().is_none_or(|engine| engine == c.engine))
        .filter(|c| arguments.simd.is_none_or(|level| level == c.level))
        .collect();
    if contenders.is_empty() {
        return Err(Failure::Input(
            "this processor does not have these instructions; leave out --simd".into(),
        ));
    }
    let text = arguments.format == Format::Text;
    if text {
        print(Row::HEADING)?;
    }
    let exact = pool.install(|| course.answers(contender::exact().as_ref(), true));
    let mut rows = Vec::new();
    for contender in &contenders {
        let row = pool.install(|| Row::of(contender, &course, &exact, arguments.threads));
        if text {
            print(&row.to_string())?;
        }
        rows.push(row);
    }
    if text { Ok(()) } else { print_json(&rows) }
}
