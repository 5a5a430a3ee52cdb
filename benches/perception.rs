//! Perception of one 640 × 480 frame, from decoded pictures to detections, on one core.

use divan::Bencher;
use spatial_fetch::perception::Detector;
use spatial_fetch::simulation::training;

fn main() {
    divan::main();
}

#[divan::bench(args = [0, 1, 2, 3, 4, 5])]
fn detect(bencher: Bencher, index: u64) {
    let (detector, frame) = (Detector::default(), training::frame(1_000_003, index).rgbd);
    bencher.bench(|| detector.detect(divan::black_box(&frame), None));
}
