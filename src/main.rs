//! The command line of Swell.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    // clap itself answers --help with status 0 and a wrong command line with status 2.
    match cli::Arguments::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("swell: {error}");
            ExitCode::from(error.exit_status())
        }
    }
}
