//! McNemar's test, exact (McNemar, Psychometrika 12, 1947): the discordant pairs as tosses of a fair coin.

/// Two-sided p of a split of `fixed` and `broken` at least this uneven; 1 when nothing changed.
pub fn mcnemar_exact(fixed: usize, broken: usize) -> f64 {
    let (n, least) = (fixed + broken, fixed.min(broken));
    // Logarithms: 2⁻ⁿ alone underflows beyond a thousand pairs.
    let mut log_term = -(n as f64) * std::f64::consts::LN_2;
    let mut tail = log_term.exp();
    for k in 1..=least {
        log_term += ((n - k + 1) as f64 / k as f64).ln();
        tail += log_term.exp();
    }
    (2.0 * tail).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_p_is_that_of_the_binomial_tables() {
        // R: binom.test(1, 9)$p.value, binom.test(0, 5)$p.value, binom.test(12, 40)$p.value
        for (fixed, broken, p) in [(8, 1, 0.0390625), (0, 5, 0.0625), (12, 28, 0.016_589_003)] {
            assert!((mcnemar_exact(fixed, broken) - p).abs() < 1e-6, "{fixed} {broken}");
        }
    }

    #[test]
    fn an_even_split_or_none_says_nothing() {
        assert_eq!((mcnemar_exact(0, 0), mcnemar_exact(7, 7)), (1.0, 1.0));
    }

    #[test]
    fn a_large_split_does_not_underflow() {
        assert!((mcnemar_exact(2000, 2001) - 1.0).abs() < 1e-9);
    }
}
