//! The frame of the page.

pub(super) use crate::escape::for_markup as escaped;

/// Everything before the tables.
pub(super) fn head(title: &str) -> String {
    let title = escaped(title);
    let style = include_str!("report.css");
    format!(
        r##"<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
<a class="skip" href="#trials">Skip to the trials</a>
<main>
<h1>{title}</h1>
"##
    )
}

/// A choice that narrows the trials: its key in their data, what it is called, and its values with their names.
pub(super) type Choice = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

/// By how they ended.
pub(super) const RESULTS: Choice = (
    "result",
    "Result",
    &[("failed", "failed"), ("wrong-first", "not right first"), ("good", "right first and found")],
);

/// The heading of the trials, with the choices that narrow them, and what has to be known to read them.
pub(super) fn filter(count: usize, choices: &[Choice], note: &str) -> String {
    let selects: String = choices
        .iter()
        .map(|(name, label, options)| {
            let options: String =
                options.iter().map(|(value, text)| format!(r#"<option value="{value}">{text}</option>"#)).collect();
            format!(r#"<label>{label}<select name="{name}"><option value="">all</option>{options}</select></label>"#)
        })
        .collect();
    format!(
        r#"<h2 id="trials">Trials</h2>
<p>{note}</p>
<form id="filter" aria-label="Which trials to show">
<label>Words<input type="search" name="words" autocomplete="off"></label>{selects}
<p id="shown" role="status">{count} trials</p>
</form>
"#
    )
}

/// Everything after the trials.
pub(super) const FOOT: &str =
    concat!("</main>\n<script>\n", include_str!("report.js"), "</script>\n</body>\n</html>\n");
