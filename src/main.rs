//! The command line of Swell.
fn main() {}
