//! Whether a metric is what it should be.

use super::Context;
use super::numbers::show;
use crate::report::Failure;
use crate::{Format, print, print_json};
use kerrscope::spacetime::geometry::{self, Geometry};
use serde_json::json;

/// Exit code 1 if the metric is not finite, symmetric, invertible and of one signature; matter and curvature far away
/// are no faults.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// Random points to look at
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000), default_value_t = 1000)]
    points: u32,
    /// Chooses the points
    #[arg(long, value_name = "K", default_value_t = 1)]
    seed: u64,
}

pub fn run<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    arguments: &Arguments,
    format: Format,
) -> Result<(), Failure> {
    let found = geometry::check(context.geometry, arguments.points as usize, arguments.seed);
    let names = context.names();
    let free: Vec<&str> = (0..N).filter(|i| found.cyclic[*i]).map(|i| names[i]).collect();
    let place = |x: &[f64; N]| x.iter().map(|c| show(*c)).collect::<Vec<_>>().join(",");
    if format == Format::Json {
        let mut about = context.about();
        let signatures: Vec<_> = found
            .signatures
            .iter()
            .map(|(s, at)| json!({ "negative": s.negative, "positive": s.positive, "at": at.to_vec() }))
            .collect();
        for (key, value) in [
            ("good", json!(found.is_good())),
            ("points", json!(found.points)),
            ("singular", json!(found.singular)),
            ("symmetric", json!(found.is_symmetric())),
            ("asymmetry", json!(found.asymmetry)),
            ("signatures", signatures.into()),
            ("inverse_error", json!(found.inverse)),
            ("vacuum", json!(found.is_vacuum())),
            ("ricci", json!(found.matter)),
            ("ricci_at", json!(found.matter_at.to_vec())),
            ("curvature", json!(found.curvature)),
            ("asymptotically_flat", json!(found.is_asymptotically_flat())),
            ("far_curvature", json!(found.far_curvature)),
            ("independent_of", json!(free)),
        ] {
            about.insert(key.to_owned(), value);
        }
        print_json(&about)?;
    } else {
        let yes = |good: bool| if good { "yes" } else { "NO" };
        let signatures: Vec<String> = found
            .signatures
            .iter()
            .map(|(s, at)| {
                let signs = format!("{}{}", "-".repeat(s.negative), "+".repeat(s.positive));
                if found.signatures.len() == 1 { signs } else { format!("{signs} at {}", place(at)) }
            })
            .collect();
        let singular = found.singular_at.map_or_else(String::new, |at| {
            format!("\nsingular            at {} of them, first at {}", found.singular, place(&at))
        });
        let flat = match (found.is_asymptotically_flat(), found.far_curvature) {
            (Some(flat), Some(far)) => format!("{}: curvature × r² is at most {far:.1e}", yes(flat)),
            _ => "no coordinate goes far".to_owned(),
        };
        print(&format!(
            "{} points looked at{singular}\n\
             symmetric           {}: to {:.1e}\n\
             signature           {}\n\
             inverse             to {:.1e}\n\
             vacuum              {}: Ricci tensor at most {:.1e} (at {}), curvature at most {:.1e}\n\
             flat far away       {flat}\n\
             does not depend on  {}",
            found.points,
            yes(found.is_symmetric()),
            found.asymmetry,
            signatures.join("; "),
            found.inverse,
            if found.is_vacuum() { "yes" } else { "no" },
            found.matter,
            place(&found.matter_at),
            found.curvature,
            if free.is_empty() { "(nothing)".to_owned() } else { free.join(", ") },
        ))?;
    }
    if found.is_good() {
        Ok(())
    } else {
        Err(Failure::Failed(format!("the metric of {} failed the check", context.geometry.name())))
    }
}
