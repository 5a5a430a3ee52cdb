//! What a line said to the robot is for: an errand, or talk about one.

/// What a line is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Utterance {
    /// Something to be understood and driven.
    Errand,
    /// "Stop."
    Stop,
    /// "No, the other one."
    OtherOne,
    /// "Come back."
    ComeBack,
    /// "Where are you?"
    WhereAreYou,
    /// "What do you see?"
    WhatDoYouSee,
    /// "Why?"
    Why,
}

/// Longer lines tell where to go: "stop at the table by the window" is an errand.
const MOST_WORDS: usize = 5;

impl Utterance {
    /// What `text` is for; an errand where it is nothing else.
    pub fn of(text: &str) -> Self {
        let lower = text.to_lowercase();
        let words: Vec<&str> = lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let polite = ["please", "robot", "ok", "okay", "hey", "now", "and", "then"];
        let words: Vec<&str> = words.into_iter().filter(|word| !polite.contains(word)).collect();
        let said = words.join(" ");
        let begins =
            |starts: &[&str]| starts.iter().any(|start| said == *start || said.starts_with(&format!("{start} ")));
        let is = |wholes: &[&str]| wholes.contains(&said.as_str());
        if begins(&["why", "how come"]) {
            Self::Why
        } else if begins(&["where are you", "where re you"]) {
            Self::WhereAreYou
        } else if begins(&["what do you see", "what can you see", "what did you see", "what have you seen"]) {
            Self::WhatDoYouSee
        } else if words.len() > MOST_WORDS {
            Self::Errand
        } else if is(&["stop", "halt", "freeze", "cancel", "never mind", "nevermind", "stop it", "stop there"]) {
            Self::Stop
        } else if words.ends_with(&["other", "one"]) || is(&["not that one", "another one", "no another one"]) {
            Self::OtherOne
        } else if is(&["come back", "come here", "come back here", "come back to me", "go back", "return"]) {
            Self::ComeBack
        } else {
            Self::Errand
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn talk_about_errands_is_told_from_errands() {
        for (said, what) in [
            ("Stop!", Utterance::Stop),
            ("No, the other one.", Utterance::OtherOne),
            ("please come back", Utterance::ComeBack),
            ("Where are you?", Utterance::WhereAreYou),
            ("what do you see", Utterance::WhatDoYouSee),
            ("Why did you go there?", Utterance::Why),
            ("find my mug", Utterance::Errand),
            ("stop at the table by the window", Utterance::Errand),
            ("", Utterance::Errand),
        ] {
            assert_eq!(Utterance::of(said), what, "{said}");
        }
    }
}
