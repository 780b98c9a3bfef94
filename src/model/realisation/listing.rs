//! The list of instances, in order of evaluation; and the surfaces through the whole domain, which are decided together
//! before anything is made.

mod blocks;
mod coincidence;
mod rock;
pub(super) mod volumes;

use std::collections::BTreeMap;

use glam::{DVec3, Vec3Swizzles};

use super::{RealisationError, draw_whole};
use crate::features::extent::Extent;
use crate::features::honouring;
use crate::features::horizon::Horizon;
use crate::model::draws::Key;
use crate::model::kinds::made::Bound;
use crate::model::nature::Copies;
use crate::model::references::{self, ByInstance, Host, Hosts, Reference};
use crate::model::selection::Selection;
use crate::model::spec::{Feature, Model};
use crate::model::values::surface::{self, HorizonSurface};
use coincidence::Strata;

/// An instance that is to be made.
pub(super) struct Due {
    pub(super) feature: usize,
    /// Its name, with those of its ancestors.
    pub(super) name: String,
    /// Numbers of the instance and its ancestors, outermost first: the key of its draws.
    pub(super) number: String,
    /// The parent's place in the list; of a companion, that of what it goes along.
    pub(super) parent: Option<usize>,
    /// Of a companion: the place in the list of what it goes along, which comes after it.
    pub(super) along: Option<usize>,
    /// Places in the list of what it refers to, in the order in which its kind does.
    pub(super) referents: Vec<Option<usize>>,
    /// It is made after all of lower rank.
    pub(super) rank: usize,
    /// Whether it takes part; otherwise it is made for what refers to it.
    pub(super) takes_part: bool,
    /// What bounds its unit above, if it asked for that.
    pub(super) top: Option<Horizon>,
    /// Whether that is the domain's top.
    pub(super) is_top_of_domain: bool,
    /// The events that move it, by feature, the oldest first.
    pub(super) events: Vec<usize>,
    /// How far it moves so that contacts which coincide are decided by age (m).
    pub(super) nudge: f64,
}

/// Lists the instances in order of evaluation; before that, all surfaces through the whole domain are drawn and decided.
pub(super) struct Listing<'a> {
    model: &'a Model,
    selection: &'a Selection,
    pub(super) due: Vec<Due>,
    /// The horizons by feature, of those features that are one, whether or not they take part.
    horizons: BTreeMap<usize, DrawnHorizon>,
    /// By feature: the horizon that lies nowhere below this other one.
    above: BTreeMap<usize, usize>,
    /// Features by what they go with.
    guests: BTreeMap<Option<Host>, Vec<usize>>,
    /// By feature: whether it is made even if it takes no part, since another one refers to it.
    is_wanted: Vec<bool>,
    /// By feature.
    ranks: Vec<usize>,
    /// Instances that others may refer to.
    instances: ByInstance<usize>,
    /// Features and numbers of all instances on the way to each.
    ways: Vec<Vec<(usize, usize)>>,
    /// The domain's own base and top.
    bounds: [Option<Horizon>; 2],
    /// What was drawn for them.
    pub(super) drawn: Vec<(String, f64)>,
    /// By how much contacts that coincide are moved apart for each step in age (m).
    step: f64,
    /// Of level horizons that were moved: from where, and to where (m).
    pub(super) levels: Vec<[f64; 2]>,
    /// By kind: instances so far, and features in all.
    kinds: BTreeMap<&'static str, [u32; 2]>,
    /// Draws that were rejected, by feature; those of the domain have none.
    pub(super) rejected: Vec<(Option<usize>, &'static str)>,
    /// What was decided, in words for the report.
    pub(super) decisions: Vec<String>,
}

type DrawnHorizon = (Horizon, Vec<(String, f64)>);

impl<'a> Listing<'a> {
    pub(super) fn new(
        model: &'a Model,
        selection: &'a Selection,
        step: f64,
    ) -> Result<Self, RealisationError> {
        let mut list = Self {
            rejected: Vec::new(),
            decisions: Vec::new(),
            model,
            selection,
            due: Vec::new(),
            horizons: BTreeMap::new(),
            above: BTreeMap::new(),
            guests: guests(model),
            is_wanted: wanted(model, selection),
            ranks: references::ranks(&waits(model)),
            instances: BTreeMap::new(),
            ways: Vec::new(),
            bounds: [None, None],
            drawn: Vec::new(),
            step,
            kinds: BTreeMap::new(),
            levels: Vec::new(),
        };
        for feature in &model.features {
            list.kinds.entry(feature.kind.name()).or_default()[1] += 1;
        }
        list.bounds = [
            list.bound("base", model.domain.base.as_ref())?,
            list.bound("top", model.domain.top.as_ref())?,
        ];
        list.strata()?;
        if step > 0.0 {
            list.move_horizons_apart();
        }
        Ok(list)
    }

    /// Lowers each horizon by a step for every older one, and the domain's top most. Level bounds of the domain are given by
    /// numbers, and stay; so everything else is stretched from the middle of the domain, by so much that what lies on its top
    /// ends above it, and what lies on its base below.
    fn move_horizons_apart(&mut self) {
        let [low, high] = self.model.domain.z;
        let steps = self.horizons.len() + 1;
        let (middle, reach) = (0.5 * (low + high), steps as f64 * self.step);
        let stretch = reach / (0.5 * (high - low));
        let moved = |horizon: &Horizon, age: usize| {
            horizon
                .stretched(middle, stretch)
                .lowered(age as f64 * self.step)
        };
        for (age, (horizon, _)) in self.horizons.values_mut().enumerate() {
            let apart = moved(horizon, age + 1);
            if let (Some(from), Some(to)) = (horizon.level(), apart.level()) {
                self.levels.push([from, to]);
            }
            *horizon = apart;
        }
        for (bound, age) in self.bounds.iter_mut().zip([0, steps]) {
            if let Some(bound) = bound.as_mut().filter(|bound| bound.level().is_none()) {
                *bound = moved(bound, age);
            }
        }
    }

    /// Draws all horizons; where they coincide over an area it is decided what that means.
    fn strata(&mut self) -> Result<(), RealisationError> {
        let mut drawn = BTreeMap::new();
        let mut parameters = Vec::new();
        for (index, feature) in self.model.features.iter().enumerate() {
            if let Some(base) = feature.kind.base() {
                let draw = |key: Key<'_>| surface::horizon(base.surface, &self.model.domain, key);
                let ((horizon, own), reasons) = draw_whole(self.model, &feature.id, "1", draw)?;
                let rejected = reasons.into_iter().map(|reason| (Some(index), reason));
                self.rejected.extend(rejected);
                let horizon = self.honouring(index, horizon, base.honours)?;
                drawn.insert(index, horizon);
                parameters.push(own);
            }
        }
        let bounds = [self.domain_bound(false)?, self.domain_bound(true)?];
        let strata = Strata::of(self.model, self.selection, drawn, &bounds)?;
        self.decisions.extend(strata.decisions);
        self.above = strata.above;
        for ((index, horizon), own) in strata.horizons.into_iter().zip(parameters) {
            self.horizons.insert(index, (horizon, own));
        }
        Ok(())
    }

    /// A horizon as it is drawn, or through the tops that were picked of it.
    fn honouring(
        &mut self,
        index: usize,
        horizon: Horizon,
        reach: Option<f64>,
    ) -> Result<Horizon, RealisationError> {
        let Some(reach) = reach else {
            return Ok(horizon);
        };
        let tops = self.model.tops.iter().filter(|top| top.horizon == index);
        let points: Vec<DVec3> = tops.map(|top| top.point).collect();
        let (low, high) = self.model.domain.corners();
        let id = &self.model.features[index].id;
        if points.is_empty() {
            self.decisions.push(format!(
                "{id} is to honour its tops, and the model has none of it"
            ));
            return Ok(horizon);
        }
        let honouring = honouring::honouring(&horizon, &points, reach, [low.xy(), high.xy()]);
        let honouring = honouring.map_err(|error| RealisationError::Impossible {
            volume: id.clone(),
            reason: format!("it cannot honour its tops: {error}"),
        })?;
        let most = points
            .iter()
            .map(|p| (p.z - horizon.height(p.x, p.y)).abs())
            .fold(0.0, f64::max);
        self.decisions.push(format!(
            "{id} passes through {} tops, of which it was {most:.2} m off at most, and is changed within {reach} m of them",
            points.len()
        ));
        Ok(honouring)
    }

    /// Draws the domain's own base or top.
    fn bound(
        &mut self,
        which: &str,
        surface: Option<&HorizonSurface>,
    ) -> Result<Option<Horizon>, RealisationError> {
        let Some(surface) = surface else {
            return Ok(None);
        };
        let draw = |key: Key<'_>| surface::horizon(surface, &self.model.domain, key);
        let ((horizon, drawn), reasons) = draw_whole(self.model, "domain", which, draw)?;
        let rejected = reasons.into_iter().map(|reason| (None, reason));
        self.rejected.extend(rejected);
        // `surface.level` of a horizon is `base.level` here, as in the model file.
        let named = drawn.into_iter().map(|(parameter, value)| {
            let own = parameter.trim_start_matches("surface.");
            (format!("{which}.{own}"), value)
        });
        self.drawn.extend(named);
        Ok(Some(horizon))
    }

    /// Lists all instances, depth first: companions directly before what they go along, children directly after their parent.
    pub(super) fn list(&mut self) -> Result<(), RealisationError> {
        let everything = Around {
            parent: None,
            path: String::new(),
            way: Vec::new(),
            takes_part: true,
        };
        self.guests_of(None, &everything)?;
        self.resolve();
        Ok(())
    }

    /// Lists the instances of all features that go with the same; gives their places in the list.
    fn guests_of(
        &mut self,
        host: Option<Host>,
        around: &Around,
    ) -> Result<Vec<usize>, RealisationError> {
        let mut listed = Vec::new();
        for index in self.guests.get(&host).cloned().unwrap_or_default() {
            let feature = &self.model.features[index];
            let keeps = around.takes_part && self.selection.keeps_feature(feature);
            for number in 1..=feature.count {
                if keeps || self.is_wanted[index] {
                    listed.extend(self.instance(index, number, keeps, around)?);
                }
            }
        }
        Ok(listed)
    }

    /// Lists an instance with its companions and children, unless it is left out and nobody wants it.
    fn instance(
        &mut self,
        index: usize,
        number: usize,
        keeps: bool,
        around: &Around,
    ) -> Result<Option<usize>, RealisationError> {
        let feature = &self.model.features[index];
        let own = if feature.count == 1 {
            feature.id.clone()
        } else {
            format!("{}-{number}", feature.id)
        };
        let name = format!("{}{own}", around.path);
        let takes_part = keeps && self.selection.keeps_volume(&name);
        if !takes_part && !self.is_wanted[index] {
            return Ok(None);
        }
        let mut way = around.way.clone();
        way.push((index, number));
        let mut within = Around {
            parent: around.parent,
            path: format!("{name}/"),
            way: way.clone(),
            takes_part,
        };
        let companions = self.guests_of(Some(Host::Along(index)), &within)?;
        let at = self.due.len();
        for companion in companions {
            self.due[companion].along = Some(at);
        }
        let nature = feature.kind.nature();
        let numbers: Vec<usize> = way.iter().map(|one| one.1).collect();
        // Of what there is only one, the draws are the same wherever it lies.
        let key = match nature.copies {
            Copies::One(_) => number.to_string(),
            Copies::Any | Copies::OneEach(_) | Copies::Members => key(&numbers),
        };
        let events = events(self.model, self.selection, way[0].0);
        let top = feature.kind.top();
        let top = top.map(|top| self.top(feature, top, takes_part, &events));
        let (top, is_top_of_domain) = match top.transpose()? {
            Some((top, is_domain)) => (Some(top), is_domain),
            None => (None, false),
        };
        let due = Due {
            feature: index,
            name,
            number: key,
            parent: around.parent,
            along: None,
            referents: Vec::new(),
            rank: self.ranks[index],
            takes_part,
            top,
            is_top_of_domain,
            events,
            nudge: if takes_part {
                self.nudge(nature.name)
            } else {
                0.0
            },
        };
        self.due.push(due);
        self.ways.push(way);
        if self.is_wanted[index] {
            self.instances.insert((index, numbers), at);
        }
        within.parent = Some(at);
        self.guests_of(Some(Host::In(index)), &within)?;
        Ok(Some(at))
    }

    /// Finds what instances refer to.
    fn resolve(&mut self) {
        let features = &self.model.features;
        let hosts = Hosts {
            host: &|at| features[at].host().map(Host::feature),
            count: &|at| features[at].count,
        };
        for (due, way) in self.due.iter_mut().zip(&self.ways) {
            // All that anybody refers to is listed, and a checked model names nothing of which there is no such number.
            let find = |reference: &Reference| {
                let numbers = hosts.instance(way, reference)?;
                self.instances.get(&(reference.feature, numbers)).copied()
            };
            let refers = features[due.feature].refers();
            due.referents = refers.into_iter().map(find).collect();
        }
    }

    /// How far the next instance of a kind moves so that contacts which coincide are decided by age. The oldest one moves
    /// farthest: each younger one lies basinward of where it would lie by the one before.
    fn nudge(&mut self, kind: &'static str) -> f64 {
        let [so_far, all] = self.kinds.entry(kind).or_default();
        *so_far += 1;
        (f64::from(*so_far) - f64::from(*all) - 1.0) * self.step
    }

    /// What bounds a unit above: the base that a feature names, or, if that takes no part, the next one that does, or the
    /// domain's top. So it is for a feature that names none, too. With whether it is the domain's top.
    fn top(
        &mut self,
        feature: &Feature,
        top: Bound,
        takes_part: bool,
        events: &[usize],
    ) -> Result<(Horizon, bool), RealisationError> {
        let Bound::Horizon(own) = top else {
            return Ok((self.domain_bound(true)?, true));
        };
        let features = &self.model.features;
        let stands = |at: &usize| {
            let base = &features[*at];
            base.kind.base().is_some() && self.selection.keeps_feature(base)
        };
        let top = (own..features.len()).find(stands);
        if top != Some(own) && takes_part {
            let above = top.map_or("the domain's top", |top| features[top].id.as_str());
            self.decisions.push(format!(
                "{} reaches up to {above}: {}, its top, takes no part",
                feature.id, features[own].id
            ));
        }
        let between = events
            .iter()
            .find(|event| top.is_some_and(|top| **event < top));
        if let (Some(event), Some(top), true) = (between, top, takes_part) {
            let [event, top] = [*event, top].map(|at| features[at].id.as_str());
            return Err(RealisationError::Impossible {
                volume: feature.id.clone(),
                reason: format!(
                    "its unit reaches up to {top}, which is younger than {event}, which moves the unit; give it a top that is older than {event}"
                ),
            });
        }
        match top.and_then(|top| self.horizons.get(&top)) {
            Some((horizon, _)) => Ok((horizon.clone(), false)),
            None => Ok((self.domain_bound(true)?, true)),
        }
    }

    /// The surface of a feature that is a base, with what was drawn for it.
    pub(super) fn surface(&self, feature: usize) -> Option<(&Horizon, &[(String, f64)])> {
        let (horizon, drawn) = self.horizons.get(&feature)?;
        Some((horizon, drawn))
    }

    /// The horizon that bounds the domain: its own, or the block's.
    pub(super) fn domain_bound(&self, top: bool) -> Result<Horizon, RealisationError> {
        let at = usize::from(top);
        match &self.bounds[at] {
            Some(horizon) => Ok(horizon.clone()),
            None => {
                Horizon::flat(self.model.domain.z[at]).map_err(|error| impossible_domain(&error))
            }
        }
    }

    /// The domain's block between its own base and top.
    pub(super) fn extent(&self) -> Result<Extent, RealisationError> {
        let (low, high) = self.model.domain.corners();
        let [base, top] = self.bounds.each_ref().map(Option::as_ref);
        Extent::new(low, high, base, top).map_err(|error| impossible_domain(&error))
    }
}

/// Where instances are listed.
struct Around {
    /// The place in the list of what they lie in.
    parent: Option<usize>,
    /// What stands before their names.
    path: String,
    /// Features and numbers of what they go with, the outermost first.
    way: Vec<(usize, usize)>,
    takes_part: bool,
}

/// The key of draws: numbers of an instance and its hosts.
fn key(numbers: &[usize]) -> String {
    let words: Vec<String> = numbers.iter().map(ToString::to_string).collect();
    words.join(".")
}

/// Features by what they go with, in the order of the list.
fn guests(model: &Model) -> BTreeMap<Option<Host>, Vec<usize>> {
    let mut guests: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (index, feature) in model.features.iter().enumerate() {
        guests.entry(feature.host()).or_default().push(index);
    }
    guests
}

/// By feature, what is made before it: what moves it, too, since it must reach as far as that asks for.
fn waits(model: &Model) -> references::Waits {
    let is_event = |at: &usize| model.features[*at].kind.nature().is_event();
    let waits = |at: usize| {
        let feature = &model.features[at];
        let host = feature.host().map(Host::feature);
        let referents = feature.refers().into_iter().map(|one| one.feature);
        let younger = (outermost(model, at) + 1..model.features.len()).filter(is_event);
        let events = younger.filter(|_| !is_event(&at));
        host.into_iter().chain(referents).chain(events).collect()
    };
    (0..model.features.len()).map(waits).collect()
}

/// The feature by whose place in the list it is known how old another one is: the outermost of what that goes with.
fn outermost(model: &Model, feature: usize) -> usize {
    let mut at = feature;
    while let Some(host) = model.features[at].host() {
        at = host.feature();
    }
    at
}

/// The events after a feature in the list that take part.
fn events(model: &Model, selection: &Selection, feature: usize) -> Vec<usize> {
    let moves = |at: &usize| {
        let event = &model.features[*at];
        event.kind.nature().is_event() && selection.keeps_feature(event)
    };
    (feature + 1..model.features.len()).filter(moves).collect()
}

/// By feature: whether what takes part, or what that is made by, refers to it or to something that goes with it.
fn wanted(model: &Model, selection: &Selection) -> Vec<bool> {
    let features = &model.features;
    let mut is_wanted = vec![false; features.len()];
    let takes_part = |index: &usize| {
        let mut at = Some(*index);
        while let Some(index) = at {
            if !selection.keeps_feature(&features[index]) {
                return false;
            }
            at = features[index].host().map(Host::feature);
        }
        true
    };
    let mut open: Vec<usize> = (0..features.len()).filter(takes_part).collect();
    while let Some(index) = open.pop() {
        let feature = &features[index];
        let referents = feature.refers().into_iter().map(|one| one.feature);
        // What is wanted needs what it goes with.
        let host = feature.host().map(Host::feature);
        let host = host.filter(|_| is_wanted[index]);
        for other in referents.chain(host) {
            if !is_wanted[other] {
                is_wanted[other] = true;
                open.push(other);
            }
        }
    }
    is_wanted
}

fn impossible_domain(error: &impl ToString) -> RealisationError {
    RealisationError::Impossible {
        volume: "domain".to_owned(),
        reason: error.to_string(),
    }
}
