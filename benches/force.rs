//! What the histogram of forces costs. Run on a quiet core: `cargo bench --bench force`; the fastest sample counts.
//!
//! The first group are the scenes for which the published implementation was timed (docs/force.md); the others show
//! how the cost grows with vertices, cells and directions.

use std::f64::consts::TAU;

use divan::{Bencher, black_box};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use spatial_fetch::force::raster::{Fuzzy, Raster, RasterPair};
use spatial_fetch::force::{Force, RelativePosition, Shape, degree_of_truth, polygon};

const BOTH: [Force; 2] = [Force::Power(0.0), Force::Power(2.0)];

fn main() {
    divan::main();
}

/// A regular polygon.
fn convex(corners: usize, x: f64, y: f64, radius: f64) -> Shape {
    let corner = |i: usize| {
        let angle = TAU * i as f64 / corners as f64;
        [x + radius * angle.cos(), y + radius * angle.sin()]
    };
    Shape::from_ring((0..corners).map(corner).collect())
}

/// A star-shaped polygon whose radius varies by up to 40 %.
fn star(corners: usize, x: f64, y: f64, radius: f64, seed: u64) -> Shape {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let corner = |i: usize| {
        let angle = TAU * i as f64 / corners as f64;
        let radius = radius * (1.0 - 0.4 * f64::from(random.next_u32()) / f64::from(u32::MAX));
        [x + radius * angle.cos(), y + radius * angle.sin()]
    };
    Shape::from_ring((0..corners).map(corner).collect())
}

fn rectangles() -> (Shape, Shape) {
    let rectangle =
        |x: f64, y: f64, w: f64, h: f64| Shape::from_ring(vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]);
    (rectangle(2.0, 1.5, 1.2, 0.6), rectangle(0.0, 0.0, 2.0, 0.9))
}

mod polygons {
    use super::*;

    #[divan::bench(args = [16, 180, 360])]
    fn convex_of_100(bencher: Bencher, directions: usize) {
        let (a, b) = (convex(100, 250.0, 60.0, 100.0), convex(100, 0.0, 0.0, 100.0));
        bencher.bench(|| polygon::histograms(black_box(&a), black_box(&b), &BOTH, directions));
    }

    #[divan::bench(args = [16, 180, 360])]
    fn stars_of_1000(bencher: Bencher, directions: usize) {
        let (a, b) = (star(1000, 250.0, 60.0, 100.0, 1), star(1000, 0.0, 0.0, 100.0, 2));
        bencher.bench(|| polygon::histograms(black_box(&a), black_box(&b), &BOTH, directions));
    }

    #[divan::bench]
    fn rectangles_16_directions_and_degrees(bencher: Bencher) {
        let (a, b) = rectangles();
        bencher.bench(|| {
            let histograms = polygon::histograms(black_box(&a), black_box(&b), &BOTH, 16);
            let of = |histogram| [0.0, 0.25, 0.5, 0.75].map(|turn| degree_of_truth(histogram, turn * TAU));
            (histograms[0].as_ref().map(of).ok(), histograms[1].as_ref().map(of).ok())
        });
    }

    #[divan::bench]
    fn rectangles_as_a_relation(bencher: Bencher) {
        let (a, b) = rectangles();
        bencher.bench(|| RelativePosition::between(black_box(&a), black_box(&b)).degrees([0.0, 1.0, 2.0, 3.0]));
    }

    #[divan::bench]
    fn main_direction_of_360(bencher: Bencher) {
        let (a, b) = rectangles();
        let histogram = polygon::histogram(&a, &b, Force::Power(2.0), 360).expect("apart");
        bencher.bench(|| spatial_fetch::force::main_direction(black_box(&histogram)));
    }

    #[divan::bench(args = [4, 10, 30, 100, 300, 1000, 3000])]
    fn convex_by_corners(bencher: Bencher, corners: usize) {
        let (a, b) = (convex(corners, 250.0, 60.0, 100.0), convex(corners, 0.0, 0.0, 100.0));
        bencher.bench(|| polygon::histograms(black_box(&a), black_box(&b), &BOTH, 180));
    }

    #[divan::bench(args = [4, 10, 30, 100, 300, 1000, 3000])]
    fn stars_by_corners(bencher: Bencher, corners: usize) {
        let (a, b) = (star(corners, 250.0, 60.0, 100.0, 1), star(corners, 0.0, 0.0, 100.0, 2));
        bencher.bench(|| polygon::histograms(black_box(&a), black_box(&b), &BOTH, 180));
    }
}

/// A disk on the left of the image; with the U its correlation has as many nodes as the image has cells.
fn disk(size: usize) -> Raster {
    let (radius, x, y) = (size as f64 * 0.17, size as f64 * 0.2, size as f64 * 0.5);
    raster(size, |column, row| (column - x).hypot(row - y) <= radius)
}

/// A U, open at the top, right of the disk.
fn open_box(size: usize) -> Raster {
    let s = size as f64;
    raster(size, |x, y| {
        let within = x >= 0.38 * s && x < 0.98 * s && y >= 0.1 * s && y < 0.9 * s;
        within && !(x >= 0.55 * s && x < 0.8 * s && y < 0.7 * s)
    })
}

/// Half an image of checkers, each a 32nd of its side.
fn checkers(size: usize, left: f64) -> Raster {
    let (s, period) = (size as f64, size as f64 / 32.0);
    raster(size, |x, y| {
        let within = x >= left * s && x < (left + 0.45) * s && y >= 0.05 * s && y < 0.95 * s;
        within && ((x / period) as usize + (y / period) as usize).is_multiple_of(2)
    })
}

fn raster(size: usize, inside: impl Fn(f64, f64) -> bool) -> Raster {
    let cell = |i: usize| u8::from(inside((i % size) as f64 + 0.5, (i / size) as f64 + 0.5));
    Raster::from_levels(size, size, (0..size * size).map(cell).collect(), 1, 1.0).expect("a raster")
}

mod rasters {
    use super::*;

    fn both(a: &Raster, b: &Raster, directions: usize) -> usize {
        let pair = RasterPair::new(black_box(a), black_box(b), Fuzzy::Product).expect("one grid");
        pair.histograms(&BOTH, directions).len()
    }

    #[divan::bench(args = [16, 180, 360])]
    fn disk_and_u_of_256(bencher: Bencher, directions: usize) {
        let (a, b) = (disk(256), open_box(256));
        bencher.bench(|| both(&a, &b, directions));
    }

    #[divan::bench(args = [16, 180, 360])]
    fn checkers_of_512(bencher: Bencher, directions: usize) {
        let (a, b) = (checkers(512, 0.03), checkers(512, 0.52));
        bencher.bench(|| both(&a, &b, directions));
    }

    #[divan::bench(args = [64, 128, 256, 512, 1024, 2048])]
    fn disk_and_u_by_side(bencher: Bencher, size: usize) {
        let (a, b) = (disk(size), open_box(size));
        bencher.bench(|| both(&a, &b, 180));
    }

    #[divan::bench(args = [128, 256, 512])]
    fn noise_by_side(bencher: Bencher, size: usize) {
        let noise = |seed: u64, left: f64| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let limit = left * size as f64;
            let mut level = |i: usize| {
                let x = (i % size) as f64;
                if x >= limit && x < limit + 0.45 * size as f64 { (random.next_u32() >> 24) as u8 } else { 0 }
            };
            Raster::from_levels(size, size, (0..size * size).map(&mut level).collect(), 255, 1.0).expect("a raster")
        };
        let (a, b) = (noise(1, 0.0), noise(2, 0.5));
        bencher.bench(|| both(&a, &b, 180));
    }

    #[divan::bench(args = [16, 45, 90, 180, 360, 720, 1440])]
    fn disk_and_u_by_directions(bencher: Bencher, directions: usize) {
        let (a, b) = (disk(256), open_box(256));
        bencher.bench(|| both(&a, &b, directions));
    }
}
