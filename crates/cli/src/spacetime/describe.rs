//! What geometries there are, and what one is.

use super::Context;
use super::numbers::show;
use crate::report::Failure;
use crate::{Format, print, print_json};
use kerrscope::scene::known_metrics;
use kerrscope::spacetime::geometry::{Coordinate, Geometry, catalogue};
use serde_json::json;

/// Every geometry that is built in.
pub fn list(format: Format) -> Result<(), Failure> {
    if format == Format::Json {
        let all = catalogue().iter().map(|entry| {
            let parameters = entry.parameters.iter().map(
                |(name, usual, range)| json!({ "name": name, "default": usual, "minimum": range[0], "maximum": range[1] }),
            );
            json!({ "name": entry.name, "about": entry.about, "parameters": parameters.collect::<Vec<_>>() })
        });
        return print_json(&all.collect::<Vec<_>>());
    }
    let lines = catalogue().iter().map(|entry| {
        let parameters: Vec<String> = entry
            .parameters
            .iter()
            .map(|(name, usual, [low, high])| format!("{name} = {usual} ({low} to {high})"))
            .collect();
        let tail = if parameters.is_empty() { String::new() } else { format!("; {}", parameters.join(", ")) };
        format!("{:<20} {}{tail}", entry.name, entry.about)
    });
    let texts = known_metrics().collect::<Vec<_>>().join(", ");
    print(&format!("{}\nas text: {texts}", lines.collect::<Vec<_>>().join("\n")))
}

/// "theta from 0 to 3.14"
pub fn range(coordinate: &Coordinate) -> String {
    let [low, high] = coordinate.range;
    let name = &coordinate.name;
    match (low.is_finite(), high.is_finite()) {
        (true, true) => format!("{name} from {} to {}", show(low), show(high)),
        (true, false) => format!("{name} above {}", show(low)),
        (false, true) => format!("{name} below {}", show(high)),
        (false, false) => format!("any {name}"),
    }
}

/// One geometry's coordinates and parameters.
pub fn one<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    format: Format,
) -> Result<(), Failure> {
    if format == Format::Json {
        let mut about = context.about();
        let finite = |x: f64| x.is_finite().then_some(x);
        let ranges: Vec<_> = context.coordinates.iter().map(|c| c.range.map(finite)).collect();
        about.insert("dimensions".to_owned(), N.into());
        about.insert("ranges".to_owned(), json!(ranges));
        return print_json(&about);
    }
    let ranges: Vec<String> = context.coordinates.iter().map(range).collect();
    let parameters: Vec<String> = context
        .geometry
        .parameters()
        .into_iter()
        .map(|(name, value)| format!("\nparameter    {name} = {}", show(value)))
        .collect();
    print(&format!(
        "{}: {N} dimensions\ncoordinates  {}{}",
        context.geometry.name(),
        ranges.join(", "),
        parameters.concat()
    ))
}
