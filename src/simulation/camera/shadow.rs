//! The shadow of the Kinect's projector, which stands a baseline to the right of the camera.

use multiversion::multiversion;

use super::raster::LANES;

/// Marks the pixels of a row that the projector does not reach.
///
/// `reach` is focal length times baseline, pixels × metres; `rays` takes the columns of the projector's rays.
pub(super) fn cast_shadow(inverse: &[f32], reach: f32, rays: &mut [f32], shadowed: &mut [bool]) {
    for (column, (ray, inverse)) in (0..).zip(rays.iter_mut().zip(inverse)) {
        *ray = column as f32 - reach * inverse;
    }
    hide_row(rays, shadowed);
}

/// Marks those of a row's rays that lie beyond any to their right.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2", "x86_64+sse4.1"))]
fn hide_row(rays: &[f32], shadowed: &mut [bool]) {
    let mut edge = f32::INFINITY;
    let (first_rays, groups) = rays.as_rchunks::<LANES>();
    let (first_shadowed, groups_shadowed) = shadowed.as_rchunks_mut::<LANES>();
    for (rays, shadowed) in groups.iter().zip(groups_shadowed).rev() {
        // Mostly the rays of a group lie in order, and none is hidden: many are compared at once.
        let mut ordered = rays[LANES - 1] <= edge;
        for lane in 1..LANES {
            ordered &= rays[lane - 1] <= rays[lane];
        }
        if ordered {
            *shadowed = [false; LANES];
            edge = rays[0];
        } else {
            edge = hide(rays, shadowed, edge);
        }
    }
    hide(first_rays, first_shadowed, edge);
}

/// The same of a few rays; `edge` is the least to their right, and what is returned the least with them.
#[inline(always)]
fn hide(rays: &[f32], shadowed: &mut [bool], mut edge: f32) -> f32 {
    for (&ray, shadowed) in rays.iter().zip(shadowed).rev() {
        *shadowed = ray > edge;
        edge = if ray < edge { ray } else { edge };
    }
    edge
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_of_pixels_lie_in_the_shadow_that_single_ones_do() {
        // Surfaces and edges in both directions, at all places within a group.
        let inverse: Vec<f32> =
            (0..331).map(|i| 0.3 + 0.2 * (i % 37 / 20) as f32 + 0.4 * (i % 83 / 70) as f32 + 1e-4 * i as f32).collect();
        for width in [331, 330, 16, 5] {
            let (mut rays, mut shadowed, mut plain) = (vec![0.0; width], vec![true; width], vec![true; width]);
            cast_shadow(&inverse, 43.5, &mut rays, &mut shadowed);
            hide(&rays, &mut plain, f32::INFINITY);
            assert_eq!(shadowed, plain);
            assert!(width < 100 || (plain.iter().any(|&hidden| hidden) && plain.iter().any(|&hidden| !hidden)));
        }
    }
}
