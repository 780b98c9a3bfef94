//! The case study draws what Table 1 of Jacquemyn, Jackson & Hampson (2019) says.
//!
//! The statistic of Kolmogorov and Smirnov is the greatest distance between the share of draws up to a value and the distribution
//! function; for n draws of it, it exceeds 1.95/√n once in a thousand times. Some 1.4 % of the channels are drawn again because their
//! bends are impossible, which moves the distributions of what is left by as much at most.

use std::collections::BTreeMap;

use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{FeatureKind, Quantity, Stream};

use super::{model, rejections::share_of_folds};

const CASE_STUDY: &str = include_str!("../../models/case-study/case-study.toml");

const DRAWS: usize = 10_000;

/// A distribution of the table: the least, the greatest, and the peak of a triangular one.
#[derive(Clone, Copy)]
struct Row {
    low: f64,
    high: f64,
    peak: Option<f64>,
}

const fn uniform(low: f64, high: f64) -> Row {
    Row {
        low,
        high,
        peak: None,
    }
}

const fn triangular(low: f64, peak: f64, high: f64) -> Row {
    Row {
        low,
        high,
        peak: Some(peak),
    }
}

impl Row {
    /// The distribution function.
    fn share(self, value: f64) -> f64 {
        let Self { low, high, peak } = self;
        let range = high - low;
        match peak {
            None => (value - low) / range,
            Some(peak) if value < peak => (value - low).powi(2) / (range * (peak - low)),
            Some(peak) => 1.0 - (high - value).powi(2) / (range * (high - peak)),
        }
    }

    /// The draws follow it, to what chance lets them and `repeated` of them being drawn again; none lies outside.
    fn assert_followed(self, name: &str, draws: &[f64], repeated: f64) {
        let mut draws = draws.to_vec();
        draws.sort_by(f64::total_cmp);
        let n = draws.len() as f64;
        assert!(draws.len() >= DRAWS, "{name}: {n} draws");
        let (least, greatest) = (draws[0], draws[draws.len() - 1]);
        assert!(
            self.low <= least && greatest <= self.high,
            "{name}: {least} to {greatest}"
        );
        // Both ends are reached: 10 000 draws of a triangular distribution come to within some hundredths of them.
        let near = 0.06 * (self.high - self.low);
        assert!(
            least < self.low + near && greatest > self.high - near,
            "{name}: {least} to {greatest}"
        );
        let distance = draws.iter().enumerate().fold(0.0_f64, |most, (at, value)| {
            let share = self.share(*value);
            most.max(share - at as f64 / n)
                .max((at + 1) as f64 / n - share)
        });
        let bound = 1.95 / n.sqrt() + repeated;
        assert!(distance < bound, "{name}: {distance}, at most {bound}");
    }
}

/// Draws of channels by parameter.
fn draws(realisation: &Realisation) -> BTreeMap<String, Vec<f64>> {
    let mut found: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for (parameter, value) in realisation.instances.iter().flat_map(|one| &one.drawn) {
        found.entry(parameter.clone()).or_default().push(*value);
    }
    found
}

#[test]
fn channels_follow_the_published_distributions_and_are_drawn_again_as_often_as_theory_says() {
    let rows = [
        ("width", triangular(15.0, 50.0, 100.0)),
        ("depth", triangular(2.2, 4.4, 7.0)),
        ("trajectory.azimuth_deg", uniform(10.0, 90.0)),
        ("trajectory.amplitude", triangular(20.0, 100.0, 200.0)),
        ("trajectory.wavelength", triangular(50.0, 475.0, 3000.0)),
    ];
    let count = format!("feature.channel.count={DRAWS}");
    let model = model(
        CASE_STUDY,
        &[&count, "domain.x=[0, 100]", "domain.y=[0, 100]"],
    );
    let selection = Selection {
        without: ["lag", "bar", "transgression", "flooding"]
            .map(str::to_owned)
            .to_vec(),
        max_level: None,
    };
    let realisation = Realisation::new(&model, &selection.found_in(&model).unwrap()).unwrap();
    let found = draws(&realisation);
    let repeated: u32 = realisation.rejections.iter().map(|one| one.count).sum();
    let repeated = f64::from(repeated) / DRAWS as f64;
    for (name, row) in rows {
        row.assert_followed(name, &found[name], repeated);
    }
    // Bends tighter than the channel's half-width; and necks, which overlap somewhat earlier.
    // The thalweg follows the course and is 0.2 of the width from the middle at an apex, so the inner bank is 0.7 of it away.
    let folds = share_of_folds(0.7);
    let necks = realisation
        .rejections
        .iter()
        .filter(|one| one.reason.contains("neck"));
    let necks = necks.map(|one| f64::from(one.count)).sum::<f64>() / DRAWS as f64;
    let miss = (repeated - necks - folds).abs();
    assert!(
        miss < 5.0 * (folds / DRAWS as f64).sqrt(),
        "{repeated} of which {necks} necks, {folds} expected"
    );
    assert!(
        realisation
            .rejections
            .iter()
            .all(|one| one.feature == "channel")
    );
}

/// What a parameter of a feature of the case study is with so many seeds, each in its own stream.
fn drawn(quantity: &Quantity, feature: &str, parameter: &str) -> Vec<f64> {
    let draw = |seed| {
        let mut stream = Stream::new(seed, feature, "1", parameter, 0);
        quantity.sample(&mut stream).unwrap()
    };
    (0..DRAWS as u64).map(draw).collect()
}

#[test]
fn both_parasequences_follow_the_published_distributions_and_are_no_copies() {
    let model = model(CASE_STUDY, &[]);
    let set = |id: &str| {
        let feature = model.features.iter().find(|feature| feature.id == id);
        match &feature.unwrap().kind {
            FeatureKind::Clinoforms(set) => set,
            other => panic!("{other:?}"),
        }
    };
    let constant = |quantity: &Quantity| match quantity {
        Quantity::Constant(value) => *value,
        Quantity::Random(other) => panic!("{other:?}"),
    };
    let belts = [
        ("usf", uniform(80.0, 210.0), Some(uniform(8.0, 60.0))),
        ("plsf", uniform(140.0, 290.0), Some(uniform(20.0, 80.0))),
        ("dlsf", uniform(120.0, 270.0), Some(uniform(20.0, 100.0))),
        ("os", uniform(240.0, 690.0), None),
    ];
    for id in ["lower", "upper"] {
        let spec = set(id);
        assert_eq!(constant(&spec.azimuth_deg), 320.0);
        assert_eq!(
            [0, 1].map(|at: usize| constant(&spec.shoreline[at])),
            [3000.0, 6000.0]
        );
        assert_eq!(constant(&spec.exponent), 2.0);
        for (quantity, parameter, row) in [
            (&spec.first, "first", uniform(50.0, 60.0)),
            (&spec.spacing, "spacing-2", uniform(105.0, 390.0)),
            (&spec.length, "length-3", uniform(150.0, 900.0)),
        ] {
            row.assert_followed(parameter, &drawn(quantity, id, parameter), 0.0);
        }
        for (belt, (name, width, interfingering)) in spec.belts.iter().zip(belts) {
            assert_eq!(belt.name, name);
            let parameter = format!("{name}-1.width");
            let draws = drawn(belt.width.as_ref().unwrap(), id, &parameter);
            width.assert_followed(&parameter, &draws, 0.0);
            if let Some(row) = interfingering {
                let parameter = format!("{name}-1.interfingering");
                let draws = drawn(belt.interfingering.as_ref().unwrap(), id, &parameter);
                row.assert_followed(&parameter, &draws, 0.0);
            }
        }
    }
    // These draws are those of realisations, and each parasequence has its own.
    let realisation = Realisation::new(&model, &Selection::default()).unwrap();
    let mut firsts = Vec::new();
    for id in ["lower", "upper"] {
        let parts = realisation.instances.iter();
        let mut parts = parts.filter(|one| realisation.volumes[one.volume].feature == id);
        let found = parts.find_map(|one| one.drawn.iter().find(|(name, _)| name == "first"));
        let mut stream = Stream::new(model.seed, id, "1", "first", 0);
        let first = found.unwrap().1;
        assert_eq!(first, set(id).first.sample(&mut stream).unwrap());
        firsts.push(first);
    }
    assert_ne!(firsts[0], firsts[1]);
}
