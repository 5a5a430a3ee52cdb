//! One fetch in the simulated apartment, from the sentence to the object: `cargo run --example simulated_fetch`.

use spatial_fetch::evaluation::Pipeline;
use spatial_fetch::simulation::{Home, TrialSettings};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let home = Home::load(None, None)?;
    let pipeline = Pipeline::new(&home, TrialSettings::default());
    let understood = pipeline.understand("my mug is on the table by the chairs in the bedroom");
    let trial = pipeline.drive("1", &understood.plan).trial;
    println!("{:?}: {}", trial.outcome, trial.why);
    println!("approached: {}", trial.approached.join(", "));
    println!("{} collisions", trial.collisions);
    Ok(())
}
