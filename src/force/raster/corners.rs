//! The corners of an image: where the mixed difference of neighbouring cells is not zero.

/// Cells compared at a time when looking for rows that repeat the one before.
const CHUNK: usize = 32;

/// A corner at node (x, y), counted from the lower left, y up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) x: i32,
    pub(super) y: i32,
    pub(super) weight: i32,
}

/// All corners of an image with the given number of columns, rows from the top.
pub(super) fn corners(levels: &[u8], width: usize) -> Vec<Corner> {
    let height = levels.len() / width;
    let blank = vec![0; width];
    let mut found = Vec::new();
    let mut above = blank.as_slice();
    for (row, here) in levels.chunks_exact(width).chain([blank.as_slice()]).enumerate() {
        corners_between(above, here, (height - row) as i32, &mut found);
        above = here;
    }
    found
}

/// The corners on the line between two rows.
fn corners_between(above: &[u8], below: &[u8], y: i32, found: &mut Vec<Corner>) {
    let mut before = 0;
    let mut compare = |start: usize, above: &[u8], below: &[u8], before: &mut i32| {
        for (x, (up, down)) in (start as i32..).zip(above.iter().zip(below)) {
            let difference = i32::from(*up) - i32::from(*down);
            if difference != *before {
                found.push(Corner { x, y, weight: difference - *before });
                *before = difference;
            }
        }
    };
    let ((above_chunks, above_rest), (below_chunks, below_rest)) =
        (above.as_chunks::<CHUNK>(), below.as_chunks::<CHUNK>());
    for (i, (above, below)) in above_chunks.iter().zip(below_chunks).enumerate() {
        // Most of an image repeats the row above.
        if before != 0 || above != below {
            compare(i * CHUNK, above, below, &mut before);
        }
    }
    compare(above.len() - above_rest.len(), above_rest, below_rest, &mut before);
    if before != 0 {
        found.push(Corner { x: above.len() as i32, y, weight: -before });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_has_four_corners_of_alternating_sign() {
        let found = corners(&[0, 0, 0, 1], 2);
        let list: Vec<_> = found.iter().map(|c| (c.x, c.y, c.weight)).collect();
        assert_eq!(list, [(1, 1, -1), (2, 1, 1), (1, 0, 1), (2, 0, -1)]);
    }

    #[test]
    fn repeated_rows_and_columns_add_none() {
        assert_eq!(corners(&[3; 100 * 7], 100).len(), 4);
    }
}
