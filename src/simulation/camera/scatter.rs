//! Random bits by the hundred thousand a frame: xorshift64* (Vigna 2016), eight numbers at a time.
//!
//! Each state of the generator hangs on the one before it, so one stream is a
//! chain that no processor can widen. But a step is linear over the state's
//! bits: a jump of many steps is a matrix of bits. So eight lanes, each a block
//! of steps ahead of the last, run side by side and together give the very
//! numbers of the plain stream.

use std::sync::OnceLock;

use multiversion::multiversion;

const LANES: usize = 8;
/// Numbers that each lane makes at a time.
const BLOCK: usize = 512;

/// A fast stream of bits, seeded from the trial's own stream.
pub(super) struct Scatter {
    /// Where each lane's next block begins; a block apart.
    states: [u64; LANES],
    /// The numbers made last: of each step, one of each lane.
    made: Vec<[u32; LANES]>,
    /// How many of them are used up, lane after lane.
    used: usize,
}

impl Scatter {
    pub fn new(seed: u64) -> Self {
        Self { states: lanes_from(seed | 1), made: vec![[0; LANES]; BLOCK], used: LANES * BLOCK }
    }

    /// Fills a list with the next 32 bits for each of its places.
    pub fn fill(&mut self, mut places: &mut [u32]) {
        while !places.is_empty() {
            if self.used == LANES * BLOCK {
                make(&mut self.states, &mut self.made);
                // The last lane has come to where the first goes on.
                self.states = lanes_from(self.states[LANES - 1]);
                self.used = 0;
            }
            let (lane, step) = (self.used / BLOCK, self.used % BLOCK);
            let (now, later) = places.split_at_mut(places.len().min(BLOCK - step));
            for (place, made) in now.iter_mut().zip(&self.made[step..]) {
                *place = made[lane % LANES];
            }
            self.used += now.len();
            places = later;
        }
    }
}

#[inline(always)]
fn next(state: u64) -> u64 {
    let state = state ^ (state >> 12);
    let state = state ^ (state << 25);
    state ^ (state >> 27)
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn make(states: &mut [u64; LANES], made: &mut [[u32; LANES]]) {
    for numbers in made {
        for (state, number) in states.iter_mut().zip(numbers) {
            *state = next(*state);
            *number = (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 32) as u32;
        }
    }
}

fn lanes_from(state: u64) -> [u64; LANES] {
    let mut states = [state; LANES];
    for lane in 1..LANES {
        states[lane] = a_block_on(states[lane - 1]);
    }
    states
}

/// The state [`BLOCK`] steps later: the sum, bit by bit, of where each of its bits alone would lead.
fn a_block_on(state: u64) -> u64 {
    static JUMPS: OnceLock<[u64; 64]> = OnceLock::new();
    let jumps = JUMPS.get_or_init(|| std::array::from_fn(|bit| (0..BLOCK).fold(1 << bit, |state, _| next(state))));
    jumps.iter().enumerate().fold(0, |sum, (bit, jump)| sum ^ (jump & (state >> bit & 1).wrapping_neg()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_give_the_numbers_of_the_plain_stream_however_they_are_asked_for() {
        for seed in [0, 1, 0x5EED, u64::MAX] {
            let mut numbers = vec![0; 3 * LANES * BLOCK + 17];
            let mut scatter = Scatter::new(seed);
            let (first, rest) = numbers.split_at_mut(1000);
            scatter.fill(first);
            rest.chunks_mut(639).for_each(|places| scatter.fill(places));
            let mut state = seed | 1;
            for number in numbers {
                state = next(state);
                assert_eq!(number, (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 32) as u32);
            }
        }
    }
}
