//! The parts of a run added up: what another machine has scored need not be read again.

use std::collections::{BTreeMap, BTreeSet};

use super::{Gold, Group, Scores};
use crate::record::{Record, Rounded};

/// The descriptions that have a record among these lines.
pub fn only_with_records(gold: Vec<Gold>, lines: &[String]) -> Vec<Gold> {
    let id = |line: &String| Record::parse(line).ok().and_then(|record| record.id());
    let ids: BTreeSet<String> = lines.iter().filter_map(id).collect();
    gold.into_iter().filter(|gold| ids.contains(&gold.id)).collect()
}

/// The scores of the whole from those of its parts, in any order.
pub fn merge_scores(parts: &[Scores]) -> Scores {
    let mut whole = Scores::default();
    for part in parts {
        add_group(&mut whole.all, &part.all);
        add_groups(&mut whole.by_form, &part.by_form);
        add_groups(&mut whole.by_names, &part.by_names);
        for (tag, rates) in &part.by_tag {
            let sum = whole.by_tag.entry(tag.clone()).or_default();
            sum.0 += rates.0;
            sum.1 += rates.1;
        }
        whole.missing.extend(part.missing.iter().cloned());
        whole.doubled.extend(part.doubled.iter().cloned());
        whole.unknown.extend(part.unknown.iter().cloned());
    }
    [&mut whole.missing, &mut whole.doubled, &mut whole.unknown].into_iter().for_each(|ids| ids.sort());
    whole
}

fn add_groups(sum: &mut BTreeMap<String, Group>, part: &BTreeMap<String, Group>) {
    part.iter().for_each(|(name, group)| add_group(sum.entry(name.clone()).or_default(), group));
}

fn add_group(sum: &mut Group, part: &Group) {
    sum.descriptions += part.descriptions;
    sum.collisions += part.collisions;
    // Rounded first: the sum is then the same in any order.
    sum.spl_sum = Rounded(Rounded(sum.spl_sum.value() + part.spl_sum.value()).value());
    sum.bracket_recall += part.bracket_recall;
    sum.bracket_precision += part.bracket_precision;
    sum.exact_trees += part.exact_trees;
    sum.room += part.room;
    sum.object += part.object;
    sum.targets += part.targets;
    sum.pairs += part.pairs;
    sum.command += part.command;
    sum.found += part.found;
    sum.right_first += part.right_first;
    sum.expected_first += part.expected_first;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::{read_gold, run_corpus, score};
    use crate::simulation::{Home, TrialSettings};

    #[test]
    fn parts_add_up_to_the_whole() {
        let gold = read_gold(include_str!("../../corpus/templates.jsonl"), "templates.jsonl").expect("a sound corpus");
        let gold = &gold[..6];
        let lines = run_corpus(gold, &Home::load(None, None).expect("the apartment"), &TrialSettings::default());
        let whole = score(gold, &lines).expect("scored");
        let part = |lines: &[String]| score(&only_with_records(gold.to_vec(), lines), lines).expect("scored");
        let merged = merge_scores(&[part(&lines[4..]), part(&lines[..4])]);
        let text = |scores: &Scores| serde_json::to_string(scores).expect("serializes");
        let read: Scores = serde_json::from_str(&text(&merged)).expect("reads what it writes");
        assert_eq!(text(&read), text(&merged));
        let near = (merged.all.spl_sum.0 - whole.all.spl_sum.0).abs();
        assert!(near < 1e-3 && merged.all.descriptions == 6 && merged.all.command == whole.all.command);
        assert_eq!(serde_json::to_string(&merged.by_tag).ok(), serde_json::to_string(&whole.by_tag).ok());
    }
}
