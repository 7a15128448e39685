//! The command line of Swell. Android has none: `android/app` is what begins there.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    // clap itself answers --help with status 0 and a wrong command line with status 2.
    let arguments = cli::Arguments::parse();
    // Only options are looked for in it, and file names need not be Unicode.
    let order: Vec<String> =
        std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    match arguments.run(&order) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("swell: {error}");
            ExitCode::from(error.exit_status())
        }
    }
}
