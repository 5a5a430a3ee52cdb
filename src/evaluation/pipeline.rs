//! One description through all stages, with gold put in place of a stage where that is asked for.

use super::Gold;
use crate::behavior::Run;
use crate::behavior::Silent;
use crate::grounding::{Grounder, Method};
use crate::language::chunk_text;
use crate::planning::Planner;
use crate::record::{Chunk, Grounding, Plan, Record, Token};
use crate::simulation::{Home, TrialSettings, run, stream_of};

/// The stages, in one home.
pub struct Pipeline<'h> {
    /// Where the robot drives.
    pub home: &'h Home,
    /// How it drives.
    pub settings: TrialSettings,
    grounder: Grounder,
    planner: Planner,
}

/// What was read and planned of one description.
#[derive(Clone, Debug, Default)]
pub struct Understood {
    /// Words with parts of speech.
    pub tokens: Vec<Token>,
    /// The chunk tree.
    pub chunks: Vec<Chunk>,
    /// What it means.
    pub grounding: Grounding,
    /// What the robot shall do.
    pub plan: Plan,
}

impl<'h> Pipeline<'h> {
    /// The stages with their default methods.
    pub fn new(home: &'h Home, settings: TrialSettings) -> Self {
        let grounder = Grounder::new(Method::Composed, true);
        Self { home, settings, grounder, planner: Planner::new(home.map.clone()) }
    }

    /// Reads and plans a text.
    pub fn understand(&self, text: &str) -> Understood {
        let (tokens, chunks) = chunk_text(text);
        self.from_tree(text, tokens, chunks)
    }

    /// Grounds and plans a tree.
    pub fn from_tree(&self, text: &str, tokens: Vec<Token>, chunks: Vec<Chunk>) -> Understood {
        let grounding = self.grounder.ground(text, &tokens, &chunks);
        let plan = self.planner.plan(&grounding);
        Understood { tokens, chunks, grounding, plan }
    }

    /// The plan for a meaning.
    pub fn plan(&self, meaning: &Grounding) -> Plan {
        self.planner.plan(meaning)
    }

    /// Drives a plan; `id` picks the record's random numbers.
    pub fn drive(&self, id: &str, plan: &Plan) -> Run {
        run(self.home, plan, &self.settings, stream_of(id), &mut Silent)
    }

    /// The whole line for one gold description, as a record.
    pub fn record(&self, gold: &Gold) -> String {
        let understood = self.understand(&gold.text);
        let trial = self.drive(&gold.id, &understood.plan).trial;
        let mut record = Record::from_text(&gold.id, &gold.text);
        record.put(&understood.tokens);
        record.put(&understood.chunks);
        record.put(&understood.grounding);
        record.put(&understood.plan);
        record.put(&trial);
        // A record of our own types always serializes.
        serde_json::to_string(&record).unwrap_or_default()
    }
}
