//! What a geometry is like at a point.

use super::Context;
use super::numbers::{Numbers, show};
use crate::report::Failure;
use crate::{Format, print, print_json};
use kerrscope::spacetime::geometry::{self, Curvature, Geometry, invert};
use serde_json::json;
use std::fmt::Write;

/// What is smaller, against the largest of its kind, is rounding and counts as zero.
const ROUNDING: f64 = 1e-15;

fn matrix<const N: usize>(title: &str, names: &[&str; N], m: &[[f64; N]; N]) -> String {
    let mut text = format!("{title}\n{:>8}", "");
    for name in names {
        let _ = write!(text, "{name:>20}");
    }
    for (name, row) in names.iter().zip(m) {
        let _ = write!(text, "\n{name:>8}");
        for entry in row {
            let _ = write!(text, "{:>20}", show(*entry));
        }
    }
    text
}

pub fn metric<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    at: &Numbers,
    format: Format,
) -> Result<(), Failure> {
    let x = context.regular_point("--at", at)?;
    let g = context.geometry.metric(&x);
    let inverse = invert(&g);
    if format == Format::Json {
        let mut about = context.about();
        about.insert("at".to_owned(), x.to_vec().into());
        about.insert("metric".to_owned(), json!(g.map(|row| row.to_vec()).to_vec()));
        about.insert("inverse".to_owned(), json!(inverse.map(|row| row.to_vec()).to_vec()));
        return print_json(&about);
    }
    let names = context.names();
    print(&format!(
        "{}\n\n{}",
        matrix("metric, indices down", &names, &g),
        matrix("inverse, indices up", &names, &inverse)
    ))
}

/// (indices, value) of the coefficients Γ^μ_{στ}, σ ≤ τ, that are not zero.
fn coefficients<G: Geometry<N>, const N: usize>(geometry: &G, x: &[f64; N]) -> Vec<([usize; 3], f64)> {
    let gamma = geometry::connection(geometry, x);
    let all: Vec<([usize; 3], f64)> = (0..N)
        .flat_map(|m| (0..N).flat_map(move |s| (s..N).map(move |t| [m, s, t])))
        .map(|[m, s, t]| ([m, s, t], gamma[m][s][t]))
        .collect();
    kept(all)
}

fn kept<I>(all: Vec<(I, f64)>) -> Vec<(I, f64)> {
    let largest = all.iter().fold(0.0_f64, |a, (_, b)| a.max(b.abs()));
    all.into_iter().filter(|(_, value)| !(value.abs() <= ROUNDING * largest)).collect()
}

pub fn connection<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    at: &Numbers,
    format: Format,
) -> Result<(), Failure> {
    let x = context.regular_point("--at", at)?;
    let names = context.names();
    let all = coefficients(context.geometry, &x);
    if format == Format::Json {
        let mut about = context.about();
        let list: Vec<_> = all
            .iter()
            .map(|([m, s, t], value)| json!({ "upper": names[*m], "lower": [names[*s], names[*t]], "value": value }))
            .collect();
        about.insert("at".to_owned(), x.to_vec().into());
        about.insert("connection".to_owned(), list.into());
        return print_json(&about);
    }
    if all.is_empty() {
        return print("every connection coefficient is zero");
    }
    let lines: Vec<String> = all
        .iter()
        .map(|([m, s, t], value)| {
            let left = format!("Γ^{}_{{{} {}}}", names[*m], names[*s], names[*t]);
            let same = if s == t {
                String::new()
            } else {
                format!(" = Γ^{}_{{{} {}}}", names[*m], names[*t], names[*s])
            };
            format!("{left}{same} = {}", show(*value))
        })
        .collect();
    print(&lines.join("\n"))
}

pub fn equations<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    at: &Numbers,
    format: Format,
) -> Result<(), Failure> {
    let x = context.regular_point("--at", at)?;
    let names = context.names();
    let all = coefficients(context.geometry, &x);
    // ẍ^μ = −Γ^μ_{σσ} ẋ^σẋ^σ − 2Γ^μ_{στ} ẋ^σẋ^τ, σ < τ
    let terms = |m: usize| {
        let of = all.iter().filter(move |([upper, ..], _)| *upper == m);
        of.map(|([_, s, t], value)| ([*s, *t], if s == t { -value } else { -2.0 * value }))
    };
    if format == Format::Json {
        let list: Vec<_> = (0..N)
            .map(|m| {
                let terms: Vec<_> = terms(m)
                    .map(|([s, t], factor)| json!({ "factor": factor, "velocities": [names[s], names[t]] }))
                    .collect();
                json!({ "coordinate": names[m], "second_derivative": terms })
            })
            .collect();
        let mut about = context.about();
        about.insert("at".to_owned(), x.to_vec().into());
        about.insert("equations".to_owned(), list.into());
        return print_json(&about);
    }
    let lines: Vec<String> = (0..N)
        .map(|m| {
            let mut right = String::new();
            for ([s, t], factor) in terms(m) {
                let sign = match (factor < 0.0, right.is_empty()) {
                    (true, true) => "-",
                    (false, true) => "",
                    (true, false) => " - ",
                    (false, false) => " + ",
                };
                let what =
                    if s == t { format!("{}'²", names[s]) } else { format!("{}' {}'", names[s], names[t]) };
                let _ = write!(right, "{sign}{} {what}", show(factor.abs()));
            }
            format!("{}'' = {}", names[m], if right.is_empty() { "0" } else { &right })
        })
        .collect();
    print(&format!("{}\n(' is the derivative with respect to an affine parameter)", lines.join("\n")))
}

/// The independent components R_{ρσμν}, ρ < σ, μ < ν, ρσ ≤ μν, that are not zero.
fn riemann<const N: usize>(curvature: &Curvature<N>) -> Vec<([usize; 4], f64)> {
    let pairs: Vec<[usize; 2]> = (0..N).flat_map(|a| (a + 1..N).map(move |b| [a, b])).collect();
    let mut all = Vec::new();
    for (i, [r, s]) in pairs.iter().enumerate() {
        for [m, n] in &pairs[i..] {
            all.push(([*r, *s, *m, *n], curvature.riemann[*r][*s][*m][*n]));
        }
    }
    kept(all)
}

pub fn curvature<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    at: &Numbers,
    format: Format,
) -> Result<(), Failure> {
    let x = context.regular_point("--at", at)?;
    let names = context.names();
    let found = Curvature::of(context.geometry, &x);
    let components = riemann(&found);
    if format == Format::Json {
        let rows = |m: &[[f64; N]; N]| json!(m.map(|row| row.to_vec()).to_vec());
        let list: Vec<_> = components
            .iter()
            .map(|(i, value)| json!({ "lower": i.map(|k| names[k]), "value": value }))
            .collect();
        let mut about = context.about();
        about.insert("at".to_owned(), x.to_vec().into());
        about.insert("riemann".to_owned(), list.into());
        about.insert("ricci".to_owned(), rows(&found.ricci));
        about.insert("einstein".to_owned(), rows(&found.einstein));
        about.insert("ricci_scalar".to_owned(), found.scalar.into());
        about.insert("kretschmann".to_owned(), found.kretschmann.into());
        return print_json(&about);
    }
    let mut text = String::new();
    for (i, value) in &components {
        let [r, s, m, n] = i.map(|k| names[k]);
        let _ = writeln!(text, "R_{{{r} {s} {m} {n}}} = {}", show(*value));
    }
    if components.is_empty() {
        text.push_str("every component of the Riemann tensor is zero\n");
    }
    print(&format!(
        "{text}\n{}\n\n{}\n\nRicci scalar  {}\nKretschmann   {}",
        matrix("Ricci tensor, indices down", &names, &found.ricci),
        matrix("Einstein tensor, indices down", &names, &found.einstein),
        show(found.scalar),
        show(found.kretschmann)
    ))
}
