//! What furniture one RGB-D frame shows: `cargo run --example furniture_of_a_frame`.

use spatial_fetch::perception::Detector;
use spatial_fetch::simulation::Home;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let home = Home::load(None, None)?;
    let door = home.map.entry_pose("living_room").ok_or("no living room")?;
    // A real frame has the same type: colours, depths in metres, camera and pose.
    let frame = home.take_picture(door);
    for piece in Detector::default().detect(&frame, Some(&home.map)).furniture {
        println!("{} at ({:.1}, {:.1}) m, {:.2} sure", piece.category, piece.x, piece.y, piece.confidence);
    }
    Ok(())
}
