use std::sync::atomic::{AtomicU64, Ordering};

use super::*;
use crate::evaluation::{Gold, read_gold};
use crate::map::RoomMap;
use crate::simulation::Scene;
use crate::simulation::{Home, TrialSettings};

fn few() -> Vec<Gold> {
    let gold = read_gold(include_str!("../../../corpus/templates.jsonl"), "templates.jsonl").expect("a sound corpus");
    gold.into_iter().step_by(18).collect()
}

fn homes() -> [Home; 2] {
    [Scene::apartment(), Scene::apartment_modified()].map(|scene| Home::new(RoomMap::apartment(), scene))
}

fn once<'g>(gold: &'g [Gold], homes: &'g [Home; 2]) -> Experiments<'g> {
    Experiments { corpus: "few".to_string(), gold, homes, settings: TrialSettings::default(), seeds: 1 }
}

#[test]
fn the_papers_figures_stand_beside_ours_in_all_three_tables() {
    let gold = few();
    let homes = homes();
    let experiments = once(&gold, &homes);
    let trials = AtomicU64::new(0);
    let result = experiments.run(&|| _ = trials.fetch_add(1, Ordering::Relaxed));
    assert_eq!(trials.into_inner(), experiments.trials());
    assert_eq!((result.tables.len(), experiments.cases().len()), (3, 2 * result.unique));
    for table in &result.tables {
        assert!(table.rows.iter().any(|row| row.source == Source::Paper));
        assert!(table.rows.iter().any(|row| row.source == Source::Ours && row.cells.contains_key(&Column::All)));
    }
    let text = paper_text(&result);
    assert!(text.contains("87.9 % 131/149 (81.7–92.2)") && text.contains("90.1 %"), "{text}");
    assert!(text.contains("first pair, as previous system: right first"), "{text}");
}

#[test]
fn every_figure_is_a_line_of_the_csv() {
    let gold = few();
    let homes = homes();
    let result = once(&gold, &homes).run(&|| ());
    let figures: usize = result.tables.iter().flat_map(|table| &table.rows).map(|row| row.cells.len()).sum();
    let csv = paper_csv(&result);
    assert_eq!(csv.lines().count(), figures + 1);
    assert!(csv.contains("\nTable II,paper,robot,,all,81.25,26,32,"), "{csv}");
    let width = |line: &str| line.replace("\"simulation, gold instructions\"", "").matches(',').count();
    assert!(csv.lines().all(|line| width(line) == 10 || line.contains('"')), "{csv}");
}
