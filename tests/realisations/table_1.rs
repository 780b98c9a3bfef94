//! The case study draws what Table 1 of Jacquemyn, Jackson & Hampson (2019) says.
//!
//! The statistic of Kolmogorov and Smirnov is the greatest distance between the share of draws up to a value and the distribution
//! function; for n draws of it, it exceeds 1.95/√n once in a thousand times. Some 0.3 % of the channels are drawn again because their
//! bends are impossible, which moves the distributions of what is left by as much.

use std::collections::{BTreeMap, BTreeSet};

use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

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

/// Draws by parameter, without the number of what they belong to: `length` of `length-3`, `usf.width` of `usf-3.width`. What several
/// volumes tell of one draw counts once.
fn draws(realisation: &Realisation, found: &mut BTreeMap<String, Vec<f64>>) {
    let mut seen = BTreeSet::new();
    for instance in &realisation.instances {
        let volume = &realisation.volumes[instance.volume];
        let own = if volume.kind == "channel" {
            volume.name.as_str()
        } else {
            &volume.feature
        };
        for (parameter, value) in &instance.drawn {
            if seen.insert((own.to_owned(), parameter.clone())) {
                let name: String = parameter.chars().filter(|c| !c.is_ascii_digit()).collect();
                let name = name.replace("-.", ".");
                found
                    .entry(name.trim_end_matches('-').to_owned())
                    .or_default()
                    .push(*value);
            }
        }
    }
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
    let mut found = BTreeMap::new();
    draws(&realisation, &mut found);
    let repeated: u32 = realisation.rejections.iter().map(|one| one.count).sum();
    let repeated = f64::from(repeated) / DRAWS as f64;
    for (name, row) in rows {
        row.assert_followed(name, &found[name], repeated);
    }
    // Bends tighter than the channel's half-width; and necks, which overlap somewhat earlier.
    let folds = share_of_folds();
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

#[test]
fn both_parasequences_follow_the_published_distributions_and_are_no_copies() {
    let rows = [
        ("first", uniform(50.0, 60.0)),
        ("spacing", uniform(105.0, 390.0)),
        ("length", uniform(150.0, 900.0)),
        ("usf.width", uniform(80.0, 210.0)),
        ("plsf.width", uniform(140.0, 290.0)),
        ("dlsf.width", uniform(120.0, 270.0)),
        ("os.width", uniform(240.0, 690.0)),
        ("usf.interfingering", uniform(8.0, 60.0)),
        ("plsf.interfingering", uniform(20.0, 80.0)),
        ("dlsf.interfingering", uniform(20.0, 100.0)),
    ];
    let selection = Selection {
        without: vec!["channel".to_owned()],
        max_level: None,
    };
    let mut found = BTreeMap::new();
    let mut firsts = BTreeSet::new();
    for seed in 0..5000 {
        let seed = format!("seed={seed}");
        // Long along the progradation: more clinoforms of each set.
        let model = model(CASE_STUDY, &[&seed, "domain.y=[0, 1500]"]);
        let realisation = Realisation::new(&model, &selection.found_in(&model).unwrap()).unwrap();
        let mut these = BTreeMap::new();
        draws(&realisation, &mut these);
        // Two sets, each with a first clinoform of its own.
        let first: &Vec<f64> = &these["first"];
        assert_eq!(first.len(), 2, "seed {seed}");
        firsts.extend(first.iter().map(|value| value.to_bits()));
        for (name, values) in these {
            found.entry(name).or_insert_with(Vec::new).extend(values);
        }
    }
    assert_eq!(firsts.len(), DRAWS, "every first clinoform is another one");
    for (name, row) in rows {
        row.assert_followed(name, &found[name], 0.0);
    }
}
