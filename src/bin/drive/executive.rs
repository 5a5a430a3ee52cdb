//! What the executive may do.

use clap::Args;
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{TIME_LIMIT_S, within};

#[derive(Args)]
#[group(skip)]
#[command(next_help_heading = "Executive")]
pub struct Arguments {
    /// Room and object only, nearest table first: the yardstick for what the words are worth
    #[arg(long)]
    pub blind: bool,
    /// Read each relation in its likeliest frame of reference only
    #[arg(long)]
    pub one_frame: bool,
    /// Use the first reference-direction pair only
    #[arg(long)]
    pub first_pair_only: bool,
    /// Do not try furniture the words do not fit
    #[arg(long)]
    pub no_fallback: bool,
    /// Do not go straight to an object recognised in passing: let the words alone choose
    #[arg(long)]
    pub no_glance: bool,
    /// Believe the odometry alone: no correction by walls and compass
    #[arg(long)]
    pub no_localization: bool,
    /// Seconds of robot time a trial may take
    #[arg(long, value_name = "SECONDS", default_value_t = 900.0, value_parser = within(TIME_LIMIT_S))]
    pub time_limit: f64,
}

impl Arguments {
    pub fn options(&self) -> Options {
        Options {
            blind: self.blind,
            one_frame: self.one_frame,
            first_pair_only: self.first_pair_only,
            no_fallback: self.no_fallback,
            no_glance: self.no_glance,
            no_localization: self.no_localization,
            describe: true,
            time_limit_s: self.time_limit,
            ..Options::default()
        }
    }
}
