//! The experiments as one HTML file: tables, and every trial with its way, its last picture and its tree.
//!
//! The file needs nothing beside it: style, script and pictures stand in it,
//! and a content policy forbids it to fetch anything.

mod html;
mod shown;
mod tables;
mod told;
mod trial;

use std::path::{Path, PathBuf};

use rayon::prelude::*;

pub use told::write_trials;

use super::{Case, Paper};
use crate::files::{FileError, write_file};
use crate::simulation::Home;

/// Writes `index.html` into a folder and returns its path.
///
/// # Errors
/// When the folder or the file cannot be written.
pub fn write_report(
    folder: &Path,
    paper: &Paper,
    cases: &[Case],
    homes: &[Home; 2],
    force: bool,
) -> Result<PathBuf, FileError> {
    std::fs::create_dir_all(folder).map_err(|error| FileError::System(folder.display().to_string(), error))?;
    let path = folder.join("index.html");
    write_file(&path, page(paper, cases, homes).as_bytes(), force)?;
    Ok(path)
}

/// What the trials of a corpus can be narrowed by.
const CHOICES: &[html::Choice] = &[
    html::RESULTS,
    ("home", "Furniture", &[("original", "as it was"), ("moved", "moved")]),
    ("form", "Form", &[("how", "how"), ("where", "where")]),
    ("names", "Furniture named", &[("none", "none"), ("table-only", "table only"), ("other", "other as well")]),
];
const NOTE: &str = "Each is read from its text and driven with the first seed; failures come first. Open one to see its way, \
    what the camera showed at the end, and how its words were read.";

/// The page; the same experiments give the same bytes.
fn page(paper: &Paper, cases: &[Case], homes: &[Home; 2]) -> String {
    let mut order: Vec<&Case> = cases.iter().collect();
    // Failures first; a stable sort keeps the corpus's order within.
    order.sort_by_key(|case| trial::rank(case));
    let trials: Vec<String> = order.par_iter().map(|case| trial::section(case, &homes[case.arrangement])).collect();
    let mut page = html::head(&format!("{}: {} trials", paper.corpus, cases.len()));
    page.push_str(&tables::section(paper));
    page.push_str(&html::filter(cases.len(), CHOICES, NOTE));
    page.push_str(&trials.concat());
    page.push_str(html::FOOT);
    page
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::{Experiments, read_gold};
    use crate::map::RoomMap;
    use crate::simulation::Scene;
    use crate::simulation::TrialSettings;

    #[test]
    fn the_page_is_whole_fetches_nothing_and_cannot_be_broken_by_words() {
        let text = include_str!("../../../corpus/templates.jsonl").lines().next().unwrap_or_default();
        let gold = read_gold(&text.replace("bear right", "bear<right"), "t.jsonl").expect("gold");
        let homes =
            [Scene::apartment(), Scene::apartment_modified()].map(|scene| Home::new(RoomMap::apartment(), scene));
        let (corpus, settings) = ("<corpus>".to_string(), TrialSettings::default());
        let experiments = Experiments { corpus, gold: &gold, homes: &homes, settings, seeds: 1 };
        let page = page(&experiments.run(&|| ()), &experiments.cases(), &homes);
        assert_eq!(page.matches("<details class=\"trial\"").count(), 2);
        assert!(page.contains("bear&lt;right") && !page.contains("bear<right") && !page.contains("<corpus>"));
        assert_eq!(page.matches("http://").count(), page.matches("http://www.w3.org/2000/svg").count());
        assert!(!page.contains("https:"));
        assert!(page.contains("default-src 'none'") && page.ends_with("</html>\n"));
    }
}
