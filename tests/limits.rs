//! `docs/limits.md` is made from the list of limits.
//!
//! `UPDATE=1 cargo test --test limits` writes it anew.

use std::fmt::Write;

use spatial_fetch::limits::ALL;

const INTRODUCTION: &str = "# Limits

What comes from outside – a line, a file, a log, a command of one's own – is measured before memory is taken or a \
robot moves for it. What is beyond a limit is refused by name, with exit code 1 or, for one record or one chunk among \
others, 3; nothing else happens.

| of | no more than | because | lifted by |
|---|---|---|---|
";

/// 1 234 567 with thin gaps; bytes also in MiB or KiB.
fn amount(value: u64, unit: &str) -> String {
    let whole = |size: u64| value.is_multiple_of(size) && value >= size;
    match unit {
        "bytes" if whole(1 << 20) => format!("{} MiB", value >> 20),
        "bytes" if whole(1 << 10) => format!("{} KiB", value >> 10),
        _ => format!("{} {unit}", grouped(value)),
    }
}

fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let groups: Vec<&[u8]> = digits.as_bytes().rchunks(3).rev().collect();
    groups.iter().map(|group| String::from_utf8_lossy(group)).collect::<Vec<_>>().join(",")
}

#[test]
fn the_page_of_limits_is_up_to_date() {
    let mut page = INTRODUCTION.to_string();
    for limit in ALL {
        let lifted = limit.lifted_by.map_or(String::new(), |option| format!("`{option}`"));
        writeln!(page, "| {} | {} | {} | {lifted} |", limit.name, amount(limit.value, limit.unit), limit.reason)
            .expect("a string takes all");
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/limits.md");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, &page).expect("written");
    }
    let stored = std::fs::read_to_string(path).unwrap_or_default();
    assert!(stored == page, "docs/limits.md differs from src/limits.rs: run UPDATE=1 cargo test --test limits");
}
