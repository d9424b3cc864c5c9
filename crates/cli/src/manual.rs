//! What other programs need to know of this one: `schema`, `completions`, `man`.

use crate::report::Failure;
use crate::{print, print_json};
use clap::CommandFactory;
use clap_complete::Shell;
use kerrscope::output::file::write_atomically;
use kerrscope::scene::SceneFile;
use std::path::PathBuf;

/// Prints a script for a shell
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Example:\n  kerrscope completions bash > ~/.local/share/bash-completion/completions/kerrscope"
)]
pub struct Completions {
    /// The shell
    shell: Shell,
}

/// Prints the manual page, or writes the pages of all commands to a folder
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples:\n  kerrscope man | man -l -\n  kerrscope man --folder ~/.local/share/man/man1"
)]
pub struct Man {
    /// Folder to write kerrscope.1, kerrscope-render.1 and so on to
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
}

/// The JSON Schema of scene files.
pub fn schema() -> Result<(), Failure> {
    print_json(&SceneFile::schema())
}

pub fn completions(arguments: &Completions) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut crate::Arguments::command(), "kerrscope", &mut script);
    print(String::from_utf8_lossy(&script).trim_end())
}

pub fn man(arguments: &Man) -> Result<(), Failure> {
    let whole = crate::Arguments::command();
    let Some(folder) = &arguments.folder else {
        return print(page(whole)?.trim_end());
    };
    let parts = whole.get_subcommands().map(|command| {
        let name = format!("kerrscope-{}", command.get_name());
        command.clone().name(name.clone()).bin_name(name)
    });
    for command in std::iter::once(whole.clone()).chain(parts) {
        let path = folder.join(format!("{}.1", command.get_name()));
        let text = page(command)?;
        write_atomically(&path, |w| w.write_all(text.as_bytes()))
            .map_err(|e| Failure::Failed(e.to_string()))?;
    }
    Ok(())
}

fn page(command: clap::Command) -> Result<String, Failure> {
    let mut page = Vec::new();
    clap_mangen::Man::new(command).render(&mut page).map_err(|e| Failure::Failed(e.to_string()))?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}
