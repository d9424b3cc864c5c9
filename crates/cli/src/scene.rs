//! `kerrscope scene`: a scene with every default written out.

use crate::report::Failure;
use crate::source::Source;
use crate::{Format, print, print_json};

/// Checks a scene and prints it whole, as TOML.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  \
    kerrscope scene --print > my-scene.toml\n  \
    kerrscope scene scenes/thesis-4.8.toml --print --set spacetime.spin=0.5\n  \
    kerrscope scene my-scene.toml            # only checks it\n  \
    kerrscope scene hole.png --print         # what a picture was made of")]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Print the scene with every default
    #[arg(long)]
    print: bool,
    /// How to print it: as TOML, or as JSON
    #[arg(long, value_enum, default_value_t, requires = "print")]
    format: Format,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = arguments.source.load([])?;
    match (arguments.print, arguments.format) {
        (false, _) => Ok(()),
        (true, Format::Text) => print(scene.to_toml().trim_end()),
        (true, Format::Json) => print_json(&scene.file().to_json()),
    }
}
