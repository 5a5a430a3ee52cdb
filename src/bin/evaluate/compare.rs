//! `evaluate compare`: two result files, record by record.

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure};
use spatial_fetch::evaluation::{Comparison, Measure, compare, comparison_text};

use crate::Subcommand;

#[derive(Args)]
#[command(override_usage = "evaluate compare [OPTIONS] A B")]
pub struct Arguments {
    /// What counts as a success
    #[arg(long, value_enum, value_name = "WHAT", default_value_t)]
    measure: Measure,
    /// End with 1 when a record that succeeded in A fails in B or is missing
    #[arg(long)]
    fail_on_regression: bool,
    /// Count reasons, scores and measurements as changes too
    #[arg(long)]
    every_field: bool,
}

impl Subcommand for Arguments {
    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let [first, second] = common.files.as_slice() else {
            return Err(Failure::Usage("compare takes two result files: evaluate compare A B".to_string()));
        };
        let read = |path| cli::read_lines(std::slice::from_ref(path));
        let (a, b) = (read(first)?, read(second)?);
        let (a_name, b_name) = (first.display().to_string(), second.display().to_string());
        let comparison = compare((&a_name, &a), (&b_name, &b), self.measure, self.every_field)
            .map_err(|error| Failure::Failed(error.to_string()))?;
        self.report(common, &comparison)
    }
}

impl Arguments {
    fn report(&self, common: &Common, comparison: &Comparison) -> Result<Exit, Failure> {
        cli::write_report(common, comparison, || comparison_text(comparison))?;
        if self.fail_on_regression && comparison.regressed() {
            let (broken, missing) = (comparison.broken.len(), comparison.missing.len());
            return Err(Failure::Failed(format!("{broken} records broken, {missing} missing")));
        }
        let lossless = comparison.missing.is_empty() && comparison.extra.is_empty() && comparison.doubled.is_empty();
        Ok(if lossless { Exit::Done } else { Exit::Lost })
    }
}
