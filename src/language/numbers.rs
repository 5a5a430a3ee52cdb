//! One reader of numbers: digits, decimals with a point or a comma, and words up to the hundreds.

/// The value of a word that is a number by itself.
pub fn value(word: &str) -> Option<f64> {
    let is_digit = |at: usize| word.as_bytes().get(at).is_some_and(u8::is_ascii_digit);
    if is_digit(0) || word.starts_with('.') && is_digit(1) {
        let number = word.strip_suffix("th").or_else(|| word.strip_suffix('°')).unwrap_or(word);
        // Nobody says "1e308".
        if !number.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b',')) {
            return None;
        }
        let plain = if is_grouped(number) { number.replace(',', "") } else { number.replace(',', ".") };
        return plain.parse().ok().filter(|value: &f64| value.is_finite());
    }
    let small = [
        "zero",
        "one",
        "two",
        "three",
        "four",
        "five",
        "six",
        "seven",
        "eight",
        "nine",
        "ten",
        "eleven",
        "twelve",
        "thirteen",
        "fourteen",
        "fifteen",
        "sixteen",
        "seventeen",
        "eighteen",
        "nineteen",
    ];
    if let Some(at) = small.iter().position(|name| *name == word) {
        return Some(at as f64);
    }
    let tens = [
        ("twenty", 20.0),
        ("thirty", 30.0),
        ("forty", 40.0),
        ("fourty", 40.0),
        ("fifty", 50.0),
        ("sixty", 60.0),
        ("seventy", 70.0),
        ("eighty", 80.0),
        ("ninety", 90.0),
        ("ninty", 90.0),
        ("hundred", 100.0),
    ];
    let ten = |word: &str| tens.iter().find(|(name, _)| *name == word).map(|(_, value)| *value);
    ten(word).or_else(|| {
        let (high, low) = word.split_once('-')?;
        let low = small.iter().position(|name| *name == low).filter(|low| (1..10).contains(low))?;
        Some(ten(high)? + low as f64)
    })
}

/// "1,000" and "12,500,000": commas that part thousands. "0,125" is a decimal number, for nobody groups from zero.
fn is_grouped(number: &str) -> bool {
    let mut groups = number.split(',');
    let first = groups.next().unwrap_or_default();
    let is_first = (1..=3).contains(&first.len()) && !first.starts_with('0');
    let rest: Vec<&str> = groups.collect();
    let is_group = |group: &&str| group.len() == 3 && group.bytes().all(|byte| byte.is_ascii_digit());
    is_first && !rest.is_empty() && rest.iter().all(is_group)
}

/// The value of number words said in a row: "forty five", "one hundred eighty".
pub fn joined(before: f64, next: f64) -> Option<f64> {
    let tens = (20.0..100.0).contains(&before) && before % 10.0 == 0.0;
    if next == 100.0 && (1.0..10.0).contains(&before) {
        return Some(before * 100.0);
    }
    let hundreds = before >= 100.0 && before % 100.0 == 0.0;
    ((tens && (1.0..10.0).contains(&next)) || (hundreds && next < 100.0)).then_some(before + next)
}

/// Words that stand for a number: "a", "a couple", "a few".
pub fn loose(word: &str) -> Option<f64> {
    match word {
        "a" | "an" | "another" => Some(1.0),
        "couple" => Some(2.0),
        "few" | "some" | "several" => Some(3.0),
        "half" => Some(0.5),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_decimals_and_words_are_one_reader() {
        assert_eq!([value("45"), value("0,5"), value("1.5")], [Some(45.0), Some(0.5), Some(1.5)]);
        assert_eq!([value("forty"), value("forty-five"), value("table")], [Some(40.0), Some(45.0), None]);
        assert_eq!([joined(40.0, 5.0), joined(100.0, 80.0), joined(2.0, 3.0)], [Some(45.0), Some(180.0), None]);
    }

    #[test]
    fn a_comma_before_three_digits_parts_thousands_and_any_other_is_a_decimal_mark() {
        assert_eq!([value("1,000"), value("12,500,000")], [Some(1000.0), Some(12_500_000.0)]);
        assert_eq!([value(".5"), value("1e308"), value("15th")], [Some(0.5), None, Some(15.0)]);
        assert_eq!([value("0,125"), value("2,50"), value("1.000")], [Some(0.125), Some(2.5), Some(1.0)]);
    }
}
