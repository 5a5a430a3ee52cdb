//! How agreement with gold is counted (`docs/annotation.md`, last section).

use std::collections::BTreeMap;

use serde::Serialize;

use super::super::gold::Rules;
use super::super::treebank::side_of_room;
use super::super::{Gold, Rate};
use crate::language::{Class, Lexicon};
use crate::record::{Direction, Grounding, Rounded};

/// Nouns that count as one.
const SAME: [(&str, &str); 9] = [
    ("sofa", "couch"),
    ("carkeys", "keys"),
    ("car_keys", "keys"),
    ("key", "keys"),
    ("glass_case", "glasses_case"),
    ("cell_phone", "cellphone"),
    ("phone", "cellphone"),
    ("chairs", "chair"),
    ("keys", "keys"),
];

type Pairs = BTreeMap<(String, Direction), usize>;

/// How often each part of a description is understood.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct MeaningRates {
    /// The side that picks the room, where gold gives one.
    pub side: Rate,
    /// The room's name, where gold gives one.
    pub room_name: Rate,
    /// The object.
    pub object: Rate,
    /// The last target furniture, by class.
    pub target: Rate,
    /// Whether any target furniture is named.
    pub target_named: Rate,
    /// All pairs.
    pub pairs: Rate,
    /// Pairs, of those in gold.
    pub pairs_recall: Rate,
    /// Pairs, of those said.
    pub pairs_precision: Rate,
    /// F1 of pairs.
    pub pairs_f1: Rounded,
    /// Everything: side, object, target and pairs.
    pub command: Rate,
    /// The same, an extra (room, back) for "the back table" counted as right.
    pub command_back_table: Rate,
}

/// Descriptions whose reading has a score within a bin.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Bin {
    /// Lowest score of the bin.
    pub from: Rounded,
    /// Mean score.
    pub mean_score: Rounded,
    /// How many were right.
    pub right: Rate,
    #[serde(skip)]
    sum: f64,
}

/// Where a reading differs from gold.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Disagreement {
    /// The description.
    pub id: String,
    /// The parts that differ.
    pub parts: Vec<&'static str>,
    /// Pairs said that gold does not have.
    pub extra: Vec<String>,
    /// Pairs of gold that were not said.
    pub missing: Vec<String>,
    /// Object and target of gold.
    pub gold: String,
    /// Object and target as read.
    pub read: String,
}

/// One reading held against gold.
#[derive(Clone, Debug)]
pub struct Verdict {
    side: Option<bool>,
    room_name: Option<bool>,
    object: bool,
    target: bool,
    target_named: bool,
    wanted: Pairs,
    said: Pairs,
    back_table: bool,
    rules: Rules,
}

/// The side that a reading gives the room; in the authors' apartment a name gives it as well.
pub fn said_side(grounding: &Grounding) -> Option<Direction> {
    let room = grounding.room.as_ref()?;
    room.side.or_else(|| side_of_room(room.name.as_deref()))
}

/// Rates of readings in the order of gold.
pub(super) fn rates(gold: &[&Gold], readings: &[Grounding]) -> MeaningRates {
    let mut rates = MeaningRates::default();
    gold.iter().zip(readings).for_each(|(gold, grounding)| rates.add(&judge(gold, grounding)));
    rates
}

/// Holds a reading against gold.
pub fn judge(gold: &Gold, grounding: &Grounding) -> Verdict {
    let by_guide = gold.rules == Rules::Guide;
    let name = |noun: &str| if by_guide { same(noun) } else { noun.to_string() };
    let nodes = || grounding.nodes.iter();
    let mut said = Pairs::new();
    for pair in nodes().flat_map(|node| &node.pairs) {
        *said.entry((name(pair.reference.name()), pair.direction)).or_default() += 1;
    }
    let mut wanted = Pairs::new();
    for (reference, direction) in &gold.pairs {
        *wanted.entry((name(reference), *direction)).or_default() += 1;
    }
    if by_guide {
        let ahead = ("move".to_string(), Direction::Front);
        wanted.remove(&ahead);
        for pair in gold.optional.iter().chain([&ahead]) {
            said.remove(pair);
        }
    }
    let object = grounding.object.as_ref().map(|object| name(&object.name));
    let wanted_object = gold.object.as_deref().map(name);
    let target = nodes().rev().find_map(|node| node.target.as_deref());
    let room = grounding.room.as_ref().and_then(|room| room.name.as_deref());
    Verdict {
        side: gold.side.filter(|_| !gold.side_in_doubt).map(|side| said_side(grounding) == Some(side)),
        room_name: gold.room.as_deref().map(|name| room == Some(name)),
        object: object == wanted_object || !by_guide && wanted_object.is_none(),
        target: target.map(kind) == gold.target.as_deref().map(kind),
        target_named: target.is_some() == gold.has_target,
        back_table: gold.text.contains("back table"),
        wanted,
        said,
        rules: gold.rules,
    }
}

/// The canonical form of a noun for counting.
fn same(noun: &str) -> String {
    let known = SAME.iter().find(|(variant, _)| *variant == noun);
    known.map_or(noun, |(_, name)| name).to_string()
}

/// What a target counts as: people put small objects on table-like furniture.
fn kind(noun: &str) -> String {
    let table_like = noun.ends_with("table") || Lexicon::embedded().class_of(noun) == Some(Class::TableLike);
    if table_like { "table_like".to_string() } else { same(noun) }
}

/// Of `a`, what `b` does not have.
fn beyond(a: &Pairs, b: &Pairs) -> Pairs {
    let left = a.iter().map(|(pair, n)| (pair.clone(), n.saturating_sub(b.get(pair).copied().unwrap_or(0))));
    left.filter(|(_, n)| *n > 0).collect()
}

impl Verdict {
    /// Whether all is right. Chunk labels say only whether there is a target: theirs are all tables.
    pub fn command(&self) -> bool {
        self.without_pairs() && self.said == self.wanted
    }

    /// The room, the object and the pairs, each.
    pub fn parts(&self) -> [bool; 3] {
        [self.side != Some(false) && self.room_name != Some(false), self.object, self.said == self.wanted]
    }

    /// The target: its class by the guide, whether any is named by chunk labels.
    pub fn target(&self) -> bool {
        if self.rules == Rules::Guide { self.target } else { self.target_named }
    }

    fn without_pairs(&self) -> bool {
        self.side != Some(false) && self.object && self.target()
    }

    fn command_back_table(&self) -> bool {
        let back = Pairs::from([(("room".to_string(), Direction::Back), 1)]);
        let extra = beyond(&self.said, &self.wanted);
        let allowed = extra.is_empty() || self.back_table && extra == back;
        self.without_pairs() && allowed && beyond(&self.wanted, &self.said).is_empty()
    }

    /// What differs, when anything does.
    pub fn disagreement(&self, gold: &Gold, grounding: &Grounding) -> Option<Disagreement> {
        let pairs = |pairs: Pairs| pairs.into_iter().map(|((r, d), n)| format!("{r}/{} ×{n}", d.name())).collect();
        let wrong = [
            ("side", self.side == Some(false)),
            ("room name", self.room_name == Some(false)),
            ("object", !self.object),
            ("target", !self.target()),
            ("pairs", self.said != self.wanted),
        ];
        let parts: Vec<_> = wrong.into_iter().filter(|(_, wrong)| *wrong).map(|(part, _)| part).collect();
        let about = |side: Option<Direction>, object: Option<&str>, target: Option<&str>| {
            format!("{} | {} | {}", side.map_or("-", Direction::name), object.unwrap_or("-"), target.unwrap_or("-"))
        };
        let object = grounding.object.as_ref().map(|object| object.name.as_str());
        let read_target = grounding.nodes.iter().rev().find_map(|node| node.target.as_deref());
        (!parts.is_empty()).then(|| Disagreement {
            id: gold.id.clone(),
            parts,
            extra: pairs(beyond(&self.said, &self.wanted)),
            missing: pairs(beyond(&self.wanted, &self.said)),
            gold: about(gold.side, gold.object.as_deref(), gold.target.as_deref()),
            read: about(said_side(grounding), object, read_target),
        })
    }
}

impl MeaningRates {
    pub(super) fn add(&mut self, verdict: &Verdict) {
        if let Some(side) = verdict.side {
            self.side.count(side);
        }
        if let Some(name) = verdict.room_name {
            self.room_name.count(name);
        }
        self.object.count(verdict.object);
        self.target.count(verdict.target);
        self.target_named.count(verdict.target_named);
        self.pairs.count(verdict.said == verdict.wanted);
        let size = |pairs: &Pairs| pairs.values().sum::<usize>();
        let (said, wanted) = (size(&verdict.said), size(&verdict.wanted));
        let both = said - size(&beyond(&verdict.said, &verdict.wanted));
        self.pairs_recall = Rate { hit: self.pairs_recall.hit + both, of: self.pairs_recall.of + wanted };
        self.pairs_precision = Rate { hit: self.pairs_precision.hit + both, of: self.pairs_precision.of + said };
        let all = self.pairs_recall.of + self.pairs_precision.of;
        self.pairs_f1 = Rounded(2.0 * self.pairs_recall.hit as f64 / all.max(1) as f64);
        self.command.count(verdict.command());
        self.command_back_table.count(verdict.command_back_table());
    }
}

/// Ten bins from 0 to 1; only those that are met are there, lowest first.
pub(super) fn add_to_bins(bins: &mut Vec<Bin>, score: f64, right: bool) {
    let from = (score * 10.0).floor().clamp(0.0, 9.0) / 10.0;
    let at = bins.partition_point(|bin| bin.from.0 < from - 1e-9);
    if bins.get(at).is_none_or(|bin| (bin.from.0 - from).abs() > 1e-9) {
        bins.insert(at, Bin { from: Rounded(from), ..Bin::default() });
    }
    let bin = &mut bins[at];
    bin.right.count(right);
    bin.sum += score;
    bin.mean_score = Rounded(bin.sum / bin.right.of as f64);
}
