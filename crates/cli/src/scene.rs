//! `kerrscope scene`: a scene with every default written out.

use crate::print;
use crate::report::Failure;
use kerrscope::scene::Scene;
use std::path::PathBuf;

/// Checks a scene and prints it whole, as TOML.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  \
    kerrscope scene --print > my-scene.toml\n  \
    kerrscope scene scenes/thesis-4.8.toml --print --set spacetime.spin=0.5\n  \
    kerrscope scene my-scene.toml            # only checks it")]
pub struct Arguments {
    /// Scene file (TOML); without one, the built-in scene
    scene: Option<PathBuf>,
    /// Print the scene with every default
    #[arg(long)]
    print: bool,
    /// Override a key of the scene; may be given several times
    #[arg(long, value_name = "PATH=VALUE", allow_hyphen_values = true)]
    set: Vec<String>,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = Scene::load(arguments.scene.as_deref(), &arguments.set)?;
    if arguments.print { print(scene.to_toml().trim_end()) } else { Ok(()) }
}
