//! The lower tier that is static: look for the references, go where the target can be seen, take the candidates in
//! the order in which the words fit them, and look for the object on each.

use std::f64::consts::PI;

use super::Halt;
use super::executive::{Executive, SWEEP_RAD, Task};
use super::motion::RoomFrame;
use super::names::SAME_THING_M;
use super::regions::lookouts;
use super::relation::Place;
use super::search::{Ranked, Wanted, blame, rank, references};
use super::visits::Care;
use crate::geometry::{Polygon, Pose, Vec2, vec2};
use crate::language::{Class, Vocabulary};
use crate::perception::ObjectSighting;

/// A best candidate below this is a guess: look further before going there.
const PLAUSIBLE: f64 = 0.12;
/// The same for one of which the robot is not sure what it is: it may not have seen what else there is, either.
const PLAUSIBLE_DOUBTFUL: f64 = 0.22;
/// How often the robot moves to tell for sure what it sees.
const MOST_SETTLING: usize = 3;
/// How many pieces are looked at closely before one is chosen.
const MOST_STUDIED: usize = 3;
/// Beyond this no small thing is told for sure, metres.
const TOLD_M: f64 = 1.9;
/// So many pictures more are taken of what was recognised, and all but one must agree: an edge of a headboard passes
/// for a monitor now and then, a monitor does always.
const CONFIRMING_LOOKS: usize = 4;
/// Alternatives named in a reason beside the best two.
const MOST_TOLD: usize = 3;

impl Executive<'_> {
    /// The static tier. `Ok` says at what the object was found, `Err` why it was not.
    pub(super) fn search(&mut self, task: &Task, room: &RoomFrame, care: Care) -> Result<Result<String, String>, Halt> {
        self.pilot.begin("search");
        self.pilot.be_bold(false);
        let arrived = self.pilot.pose();
        if let Some(found) = self.look_for(task, room, arrived, care)? {
            return Ok(Ok(found));
        }
        let object = task.object.unwrap_or("any portable object").replace('_', " ");
        let place = Place { room, arrived };
        let blame = blame(&self.pilot.beliefs, &task.wanted, place, self.lexicon)
            .unwrap_or_else(|| "what fits every pair was looked at in vain".to_string());
        // In both rounds of a search, and from several sides, a piece is still one.
        let looked_at = self.pilot.beliefs.furniture.iter().filter(|piece| !piece.looked_from.is_empty()).count();
        let where_looked = match looked_at {
            0 => "seen, and no piece of furniture could be looked at".to_string(),
            1 => "on the one piece of furniture looked at".to_string(),
            count => format!("on any of {count} pieces of furniture looked at"),
        };
        let why = format!("no {object} {where_looked}; {blame}");
        self.pilot.end(&why);
        Ok(Err(why))
    }

    fn look_for(&mut self, task: &Task, room: &RoomFrame, arrived: Pose, care: Care) -> Result<Option<String>, Halt> {
        let mut found = None;
        if care != Care::Again {
            self.pilot.sweep(SWEEP_RAD)?;
            self.look_further(task, room, arrived)?;
            self.study_rivals(task, room, arrived)?;
            found = self.round(task, room, arrived)?;
        }
        if found.is_none() && care != Care::Once && !self.options.no_fallback {
            found = self.look_elsewhere(task, room)?;
        }
        if found.is_none() && care != Care::Once {
            self.pilot.because(
                "a look may have missed it; looking at everything once more, from other sides and through narrower gaps",
            );
            self.pilot.be_bold(true);
            self.pilot.beliefs.search_anew();
            found = self.round(task, room, arrived)?;
        }
        Ok(found)
    }

    /// Everything known, then what was glimpsed.
    fn round(&mut self, task: &Task, room: &RoomFrame, arrived: Pose) -> Result<Option<String>, Halt> {
        let found = self.try_all(task, room, arrived)?;
        if found.is_some() { Ok(found) } else { self.follow_glimpses(task) }
    }

    /// From one place of the room after the other, all that shows itself from there.
    fn look_elsewhere(&mut self, task: &Task, room: &RoomFrame) -> Result<Option<String>, Halt> {
        for lookout in lookouts(self.pilot.grid(), room, self.pilot.pose().position(), self.pilot.ways().to_turn) {
            self.look_round_at(lookout)?;
            let found = self.try_candidates(task, room, self.pilot.pose(), &task.wanted.anything())?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// What the words fit, best first, then all other table-like furniture.
    fn try_all(&mut self, task: &Task, room: &RoomFrame, arrived: Pose) -> Result<Option<String>, Halt> {
        let found = self.try_candidates(task, room, arrived, &task.wanted)?;
        if found.is_some() || self.options.no_fallback {
            return Ok(found);
        }
        self.pilot.because("nothing the words fit holds it; trying all other table-like furniture, nearest first");
        self.try_candidates(task, room, self.pilot.pose(), &task.wanted.anything())
    }

    /// Goes where something like the object was seen, though never so that it could be told for sure.
    fn follow_glimpses(&mut self, task: &Task) -> Result<Option<String>, Halt> {
        let Some(name) = task.object.filter(|_| !self.options.no_glance) else { return Ok(None) };
        while let Some(at) = self.pilot.beliefs.glimpses.follow(name) {
            let Some(pose) = self.pilot.ways().better_view(at) else { continue };
            let spoken = name.replace('_', " ");
            let seen = format!("something like a {spoken} was seen");
            let told = format!("{seen} at ({:.1}, {:.1}); going there", at.x, at.y);
            self.pilot.because_plainly(told, &format!("{seen}: going there"));
            if !unless_blocked(self.pilot.go_to_pose(pose))? {
                continue;
            }
            self.approached.push(at);
            let spot = Polygon::rectangle(Pose::new(at.x, at.y, 0.0), 0.2, 0.2);
            if let Some(sighting) = self.settle_on(&spot, task.object)? {
                self.found_at = Some(vec2(sighting.x, sighting.y));
                let is = Vocabulary::embedded().copula(name);
                return Ok(Some(format!("the {spoken} {is} at ({:.1}, {:.1})", sighting.x, sighting.y)));
            }
        }
        Ok(None)
    }

    /// While the best candidate is a guess, or a landmark that was named has not been seen, looks from elsewhere.
    fn look_further(&mut self, task: &Task, room: &RoomFrame, arrived: Pose) -> Result<(), Halt> {
        for lookout in lookouts(self.pilot.grid(), room, arrived.position(), self.pilot.ways().to_turn) {
            let place = Place { room, arrived };
            let ranked = rank(&self.pilot.beliefs, &task.wanted, place, self.lexicon);
            let is_plausible =
                |best: &Ranked| best.score >= if best.is_doubtful() { PLAUSIBLE_DOUBTFUL } else { PLAUSIBLE };
            let missing = self.missing_reference(&task.wanted);
            if ranked.first().is_some_and(is_plausible) && missing.is_none() {
                return Ok(());
            }
            let reason =
                missing.map_or("nothing here fits the words well".to_string(), |noun| format!("no {noun} seen yet"));
            let told = format!("{reason}; looking from ({:.1}, {:.1})", lookout.x, lookout.y);
            self.pilot.because_plainly(told, &format!("{reason}: looking round from elsewhere"));
            self.look_round_at(lookout)?;
        }
        Ok(())
    }

    /// While a piece would fit better than the best if only it were surely what the words say, looks at it more closely.
    fn study_rivals(&mut self, task: &Task, room: &RoomFrame, arrived: Pose) -> Result<(), Halt> {
        for _ in 0..MOST_STUDIED {
            let ranked = rank(&self.pilot.beliefs, &task.wanted, Place { room, arrived }, self.lexicon);
            let furniture = &self.pilot.beliefs.furniture;
            let inside = |r: &&Ranked| room.outline.contains(furniture[r.index].centre());
            let Some(best) = ranked.iter().find(inside) else { return Ok(()) };
            let likelier = |r: &&Ranked| r.at_best > best.at_best && !furniture[r.index].studied;
            let rivals = ranked.iter().filter(inside).filter(likelier);
            let Some(rival) = rivals.max_by(|a, b| a.at_best.total_cmp(&b.at_best)) else { return Ok(()) };
            let (index, label) = (rival.index, furniture[rival.index].label());
            self.pilot.beliefs.furniture[index].studied = true;
            let piece = &self.pilot.beliefs.furniture[index];
            let Some(pose) = self.pilot.ways().vantage(piece) else { continue };
            self.pilot.because(format!("{label} would fit better, if it is what the words say; looking at it closely"));
            if !unless_blocked(self.pilot.go_to_pose(pose))? {
                continue;
            }
            self.pilot.look();
        }
        Ok(())
    }

    fn missing_reference(&self, wanted: &Wanted) -> Option<String> {
        let unseen = |noun: &str| {
            let is_furniture = self.lexicon.class_of(noun).is_some_and(|class| class != Class::Object);
            is_furniture && references(&self.pilot.beliefs, noun, self.lexicon).is_empty()
        };
        let nouns = wanted.pairs.iter().filter_map(|pair| pair.pair.reference.thing());
        nouns.into_iter().find(|noun| unseen(noun)).map(|noun| noun.replace('_', " "))
    }

    fn look_round_at(&mut self, lookout: Vec2) -> Result<(), Halt> {
        if unless_blocked(self.pilot.go_to(lookout))? { self.pilot.sweep(PI) } else { Ok(()) }
    }

    fn try_candidates(
        &mut self,
        task: &Task,
        room: &RoomFrame,
        arrived: Pose,
        wanted: &Wanted,
    ) -> Result<Option<String>, Halt> {
        loop {
            let here = if self.options.blind { self.pilot.pose() } else { arrived };
            let ranked = rank(&self.pilot.beliefs, wanted, Place { room, arrived: here }, self.lexicon);
            let inside = |r: &&Ranked| room.outline.contains(self.pilot.beliefs.furniture[r.index].centre());
            let ranked: Vec<&Ranked> = ranked.iter().filter(inside).collect();
            let Some(choice) = self.choose(task, &ranked, wanted) else { return Ok(None) };
            if let Some(found) = self.check(choice, task.object)? {
                return Ok(Some(found));
            }
        }
    }

    /// The furniture on which the object was seen in passing, else the best ranked.
    fn choose(&mut self, task: &Task, ranked: &[&Ranked], wanted: &Wanted) -> Option<usize> {
        let glances = !self.options.blind && !self.options.no_glance;
        let seen = task.object.filter(|_| glances).and_then(|name| self.pilot.beliefs.sighting(Some(name)));
        if let Some(index) = seen.and_then(|sighting| self.pilot.beliefs.under(vec2(sighting.x, sighting.y)))
            && !self.pilot.beliefs.furniture[index].searched
        {
            let label = self.pilot.beliefs.furniture[index].label();
            self.pilot.because(format!("{label}: the object was seen on it in passing, whatever the words prefer"));
            return Some(index);
        }
        let best = ranked.first()?;
        let describe =
            |r: &Ranked| format!("{} {:.2} ({})", self.pilot.beliefs.furniture[r.index].label(), r.score, r.reading);
        let mut reason = describe(best);
        if let Some(next) = ranked.get(1) {
            reason = format!("{reason} by {:.2} before {}", best.score - next.score, describe(next));
        }
        for other in ranked.iter().skip(2).take(MOST_TOLD) {
            reason = format!("{reason}, {} {:.2}", self.pilot.beliefs.furniture[other.index].label(), other.score);
        }
        let plain = self.plain_choice(ranked, wanted);
        self.pilot.because_plainly(reason, &plain);
        Some(best.index)
    }

    /// A choice in words: "going to table 2, the best fit for “next to the chair”; table 1 is next".
    fn plain_choice(&self, ranked: &[&Ranked], wanted: &Wanted) -> String {
        let mut labels = ranked.iter().map(|r| self.pilot.beliefs.furniture[r.index].label());
        let best = labels.next().unwrap_or_default();
        let said: Vec<String> = wanted.pairs.iter().map(|pair| pair.pair.phrase()).collect();
        let why = if said.is_empty() {
            "which is nearest".to_string()
        } else {
            format!("the best fit for \"{}\"", said.join(", "))
        };
        let next = labels.next().map(|next| format!("; {next} would be next")).unwrap_or_default();
        format!("going to {best}, {why}{next}")
    }

    /// Goes where the furniture's top can be seen, and looks for the object.
    fn check(&mut self, index: usize, object: Option<&str>) -> Result<Option<String>, Halt> {
        let furniture = self.pilot.beliefs.furniture[index].clone();
        self.pilot.beliefs.furniture[index].searched = true;
        let mut poses = self.pilot.ways().viewpoints(&furniture);
        // What lies at its edge may lie on something else, not known yet.
        let seen = object.and_then(|name| self.pilot.beliefs.sighting(Some(name))).map(|s| vec2(s.x, s.y));
        let there = seen.filter(|&point| self.pilot.beliefs.under(point) == Some(index));
        poses.extend(there.and_then(|at| self.pilot.ways().better_view(at)));
        let mut reached = false;
        for pose in poses {
            if !unless_blocked(self.pilot.go_to_pose(pose))? {
                continue;
            }
            if !reached {
                self.approached.push(furniture.centre());
                reached = true;
            }
            let here = self.pilot.pose().position();
            self.pilot.beliefs.furniture[index].looked_from.push(here);
            if let Some(sighting) = self.settle_on(furniture.footprint(), object)? {
                self.found_at = Some(vec2(sighting.x, sighting.y));
                let is = Vocabulary::embedded().copula(&sighting.name);
                return Ok(Some(format!("the {} {is} on {}", sighting.name.replace('_', " "), furniture.label())));
            }
        }
        let object = object.unwrap_or("portable object").replace('_', " ");
        self.pilot.because(if reached {
            format!("no {object} on {}", furniture.label())
        } else {
            format!("no place from which {} can be looked at", furniture.label())
        });
        Ok(None)
    }

    /// Faces the object; when it is in the picture but cannot be told for sure, looks from a better place.
    fn settle_on(&mut self, footprint: &Polygon, object: Option<&str>) -> Result<Option<ObjectSighting>, Halt> {
        if self.sighted(footprint, object).is_none() {
            // Noise hides a small thing in one picture and not in the next.
            self.pilot.look();
        }
        for _ in 0..MOST_SETTLING {
            let Some(sighting) = self.sighted(footprint, object) else { return Ok(None) };
            self.pilot.turn_to(bearing(self.pilot.pose(), &sighting))?;
            self.pilot.look();
            if let Some(facing) = self.sighted(footprint, object).filter(|facing| facing.recognisable)
                && self.is_confirmed(&facing)
            {
                return Ok(Some(facing));
            }
            let Some(better) = self.pilot.ways().better_view(vec2(sighting.x, sighting.y)) else {
                return Ok(None);
            };
            self.pilot.because("something is there that cannot be told from here; looking from a better place");
            if !unless_blocked(self.pilot.go_to_pose(better))? {
                return Ok(None);
            }
        }
        let last = self.sighted(footprint, object).filter(|sighting| sighting.recognisable);
        Ok(last.filter(|sighting| self.is_confirmed(sighting)))
    }

    /// Whether a thing is near enough to be told, and more pictures name it so than name it otherwise.
    fn is_confirmed(&mut self, sighting: &ObjectSighting) -> bool {
        let (mut so, mut otherwise) = (0, 0);
        for look in 0..=CONFIRMING_LOOKS {
            if look > 0 {
                self.pilot.look();
            }
            let there = |s: &&ObjectSighting| s.recognisable && s.distance_to(sighting) < SAME_THING_M;
            let seen = self.pilot.view().objects.iter().filter(there);
            let (same, other): (Vec<_>, Vec<_>) = seen.partition(|s| s.name == sighting.name);
            so += usize::from(!same.is_empty());
            otherwise += usize::from(!other.is_empty());
        }
        let away = self.pilot.pose().distance_to(vec2(sighting.x, sighting.y));
        let steadiest = self.pilot.beliefs.glimpses.is_steadiest(sighting);
        steadiest && away < TOLD_M && so >= CONFIRMING_LOOKS && so > otherwise
    }

    /// The object in the present picture: the named one, or any on the furniture when none is named.
    fn sighted(&self, footprint: &Polygon, object: Option<&str>) -> Option<ObjectSighting> {
        let on_it = |s: &&ObjectSighting| object.is_some() || footprint.distance_to(vec2(s.x, s.y)) < 0.1;
        let named = |s: &&ObjectSighting| object.is_none_or(|name| s.name == name);
        let seen = || self.pilot.view().objects.iter().filter(named).filter(on_it);
        seen().find(|s| s.recognisable).or_else(|| seen().next()).cloned()
    }
}

/// Whether the robot got there; that there was no way is no reason to end.
fn unless_blocked(gone: Result<(), Halt>) -> Result<bool, Halt> {
    match gone {
        Ok(()) => Ok(true),
        Err(Halt::Blocked(_)) => Ok(false),
        Err(halt) => Err(halt),
    }
}

fn bearing(pose: Pose, sighting: &ObjectSighting) -> f64 {
    let away = vec2(sighting.x, sighting.y) - pose.position();
    away.y.atan2(away.x)
}
