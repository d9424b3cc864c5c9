//! `kerrscope view`: a page in the browser in which one flies around a scene.

use std::net::{IpAddr, Ipv4Addr};
use std::num::NonZeroUsize;
use std::process::{Command, Stdio};

use kerrscope::scene::Draft;
use rayon::ThreadPoolBuilder;

use crate::report::Failure;
use crate::server::{self, Stock};
use crate::source::Source;
use crate::{print, progress};

/// Serves a page and opens it in the browser. Its address is the first line that is printed; Ctrl-C ends it.
///
/// The page is for this machine alone unless --host says otherwise.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  \
    kerrscope view\n  \
    kerrscope view scenes/wormhole.toml --set sky.brightness=1\n  \
    kerrscope view --port 8080 --no-open\n  \
    kerrscope view --host 0.0.0.0 --port 8080 --token correct-horse   # for other machines")]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Port to serve at; 0 for any that is free
    #[arg(long, value_name = "N", default_value_t = 0)]
    port: u16,
    /// Only print the address
    #[arg(long)]
    no_open: bool,
    /// Number of this machine to serve at; other machines may open the page if it is not a loopback address, and
    /// then need --token
    #[arg(long, value_name = "IP", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    host: IpAddr,
    /// Word that opens the page: 8 to 100 letters, digits, - and _. It goes over the network as it is
    #[arg(long, value_name = "WORD", value_parser = parse_token)]
    token: Option<String>,
    /// Threads to draw with; without it, one for each processor
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

fn parse_token(text: &str) -> Result<String, String> {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b == b'-' || b == b'_';
    if (8..=100).contains(&text.len()) && text.bytes().all(plain) {
        Ok(text.to_owned())
    } else {
        Err("give 8 to 100 letters, digits, - and _".to_owned())
    }
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if !arguments.host.is_loopback() && arguments.token.is_none() {
        return Err(Failure::Input(format!(
            "at {} other machines can open the page: give a word that opens it with --token, or leave out --host",
            arguments.host
        )));
    }
    let draft = draft(&arguments.source)?;
    let pool = ThreadPoolBuilder::new()
        .num_threads(arguments.threads.map_or(0, NonZeroUsize::get))
        .build()
        .map_err(|e| Failure::Failed(format!("no threads: {e}; give fewer with --threads")))?;
    let stop = progress::stop_flag();
    let mut printed = Ok(());
    let ready = |address: &str| {
        printed = print(address);
        if !arguments.no_open {
            open(address);
        }
        Ok(())
    };
    let (host, port) = (arguments.host, arguments.port);
    server::serve(host, port, arguments.token.clone(), Stock::new(draft), pool, stop, ready).map_err(
        |e| {
            Failure::Failed(format!(
                "cannot serve at {host}, port {port}: {e}; give another --port, or 0 for any"
            ))
        },
    )?;
    printed?;
    Err(Failure::Interrupted("the page is closed".to_owned()))
}

/// The scene of the command line, to be changed by the page. What is wrong with it is told now.
fn draft(source: &Source) -> Result<Draft, Failure> {
    source.load([])?;
    let mut draft = source.draft()?;
    draft.overrides.clone_from(&source.set);
    Ok(draft)
}

/// Opens an address in the browser, as far as this machine knows how to.
fn open(address: &str) {
    let mut command = if cfg!(target_os = "macos") {
        Command::new("open")
    } else if cfg!(windows) {
        let mut command = Command::new("cmd");
        command.args(["/c", "start", ""]);
        command
    } else {
        Command::new("xdg-open")
    };
    let quiet = command.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if quiet.spawn().is_err() {
        eprintln!("no browser was found: open the address in one");
    }
}
