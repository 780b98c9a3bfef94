//! Horizons that bound and divide a domain, and parasequences between undulating ones, made by the partition and proven in
//! full.
//!
//! The oracles are sums over columns of the horizons' heights, truth tables by hand, and sums over a lattice of points that
//! the point evaluator is asked for.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod assembled;

use std::collections::BTreeMap;

use assembled::{checked, source, without};
use clinothem::assembly::Engine;
use clinothem::features::horizon::Horizon;
use clinothem::model::owner::Owners;
use clinothem::model::plan::AssemblyPlan;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{FeatureKind, HorizonSurface, Model, Quantity};
use glam::{DVec2, DVec3};

fn model(name: &str, overrides: &[&str]) -> Model {
    let mut source = source(&format!("strata/{name}"));
    for one in overrides {
        source.set((*one).to_owned());
    }
    checked(&source)
}

fn build(name: &str, overrides: &[&str], ids: &[&str]) -> Built {
    let model = model(name, overrides);
    Built(assembled::Built::new(model, &without(ids), Engine::Partition).unwrap())
}

/// With what is asked of strata.
struct Built(assembled::Built);

impl std::ops::Deref for Built {
    type Target = assembled::Built;

    fn deref(&self) -> &assembled::Built {
        &self.0
    }
}

impl Built {
    /// All volumes whose names begin so.
    fn sum(&self, start: &str) -> f64 {
        let names = self.realisation.volumes.iter().map(|one| one.name.as_str());
        names
            .filter(|name| name.starts_with(start))
            .map(|name| self.size(name))
            .sum()
    }

    /// What the plan decided.
    fn decided(&self) -> String {
        AssemblyPlan::new(&self.realisation)
            .unwrap()
            .decisions
            .join("\n")
    }

    fn owner(&self, x: f64, y: f64, z: f64) -> Option<&str> {
        let owner = self.owners.at(DVec3::new(x, y, z))?;
        Some(self.realisation.volumes[owner].name.as_str())
    }

    /// The integral over the plan of a height, by the middles of columns.
    fn over_plan(&self, height: impl Fn(f64, f64) -> f64) -> f64 {
        const COLUMNS: u32 = 1000;
        let [x, y] = [self.model.domain.x, self.model.domain.y];
        let step = DVec2::new(x[1] - x[0], y[1] - y[0]) / f64::from(COLUMNS);
        let mut sum = 0.0;
        for i in 0..COLUMNS {
            for j in 0..COLUMNS {
                let at = |k: u32, step: f64| step * (f64::from(k) + 0.5);
                sum += height(x[0] + at(i, step.x), y[0] + at(j, step.y));
            }
        }
        sum * step.x * step.y
    }
}

fn assert_near(a: f64, b: f64, part: f64) {
    assert!((a - b).abs() < part * b.abs(), "{a} is not {b}");
}

/// The surface of a grid, as the model has it.
fn grid(surface: &HorizonSurface) -> Horizon {
    match surface {
        HorizonSurface::Grid { x, y, heights } => Horizon::grid(*x, *y, heights).unwrap(),
        _ => panic!("no grid"),
    }
}

fn surface<'a>(model: &'a Model, id: &str) -> &'a HorizonSurface {
    let feature = model.features.iter().find(|one| one.id == id).unwrap();
    match &feature.kind {
        FeatureKind::Horizon(spec) => &spec.surface,
        _ => panic!("{id} is no horizon"),
    }
}

/// The dipping planes of the model `bounds`, by hand: 1° to the east, and 2° to the south.
fn base(x: f64, _: f64) -> f64 {
    -36.0 - (x - 200.0) * 1.0_f64.to_radians().tan()
}

fn lapping(_: f64, y: f64) -> f64 {
    -21.0 + (y - 300.0) * 2.0_f64.to_radians().tan()
}

#[test]
fn volumes_between_horizons_are_sums_of_columns() {
    let built = build("bounds", &[], &["channel"]);
    let top = grid(built.model.domain.top.as_ref().unwrap());
    let incised = grid(surface(&built.model, "incised"));
    let domain = built.over_plan(|x, y| top.height(x, y) - base(x, y));
    assert_near(built.realisation.extent.volume(), domain, 1e-6);
    let background = built.over_plan(|x, y| incised.height(x, y) - base(x, y));
    assert_near(built.size("background"), background, 1e-6);
    let between = built.over_plan(|x, y| (lapping(x, y) - incised.height(x, y)).max(0.0));
    assert_near(built.size("incised"), between, 1e-5);
    let above = built.over_plan(|x, y| top.height(x, y) - lapping(x, y).max(incised.height(x, y)));
    assert_near(built.size("onlapping"), above, 1e-5);
}

#[test]
fn an_erosive_horizon_takes_from_all_below_it_and_an_onlapping_one_only_from_the_open_unit() {
    let lap = build("bounds", &[], &["channel"]);
    let cut = build(
        "bounds",
        &["feature.onlapping.relation=erosive"],
        &["channel"],
    );
    let incised = grid(surface(&lap.model, "incised"));
    let lower = |x: f64, y: f64| lapping(x, y).min(incised.height(x, y));
    let left = cut.over_plan(|x, y| lower(x, y) - base(x, y));
    assert_near(cut.size("background"), left, 1e-5);
    assert!(cut.size("background") < 0.9 * lap.size("background"));
    // South: the plane is below the incised surface. North: above it.
    let (south, north) = ((200.0, 30.0), (200.0, 500.0));
    let at = |(x, y): (f64, f64)| [base(x, y), lapping(x, y), incised.height(x, y)];
    let [floor, plane, incision] = at(south);
    assert!(floor < plane && plane < incision);
    let table = [
        (south, floor - 0.01, [None, None]),
        (south, floor + 0.01, [Some("background"); 2]),
        (south, plane - 0.01, [Some("background"); 2]),
        (south, plane + 0.01, [Some("background"), Some("onlapping")]),
        (
            south,
            incision - 0.01,
            [Some("background"), Some("onlapping")],
        ),
        (south, incision + 0.01, [Some("onlapping"); 2]),
        (north, at(north)[0] + 0.01, [Some("background"); 2]),
        (north, at(north)[2] - 0.01, [Some("background"); 2]),
        (north, at(north)[2] + 0.01, [Some("incised"); 2]),
        (north, at(north)[1] - 0.01, [Some("incised"); 2]),
        (north, at(north)[1] + 0.01, [Some("onlapping"); 2]),
    ];
    for ((x, y), z, expected) in table {
        assert_eq!(
            [&lap, &cut].map(|one| one.owner(x, y, z)),
            expected,
            "{y} {z}"
        );
    }
    let top = grid(lap.model.domain.top.as_ref().unwrap());
    let roof = top.height(200.0, 500.0);
    assert_eq!(lap.owner(200.0, 500.0, roof - 0.01), Some("onlapping"));
    assert_eq!(lap.owner(200.0, 500.0, roof + 0.01), None);
}

#[test]
fn a_channel_in_a_bounded_domain_is_whole_where_nothing_cuts_it() {
    let all = build("bounds", &[], &[]);
    let alone = build("bounds", &[], &["incised", "onlapping"]);
    assert_near(all.size("channel"), alone.size("channel"), 1e-8);
    let names = ["background", "incised", "onlapping", "channel"];
    assert_eq!(names.map(|name| all.pieces(name)), [1; 4]);
    assert!(all.assembly.failed.is_empty());
    // Where the domain's top cuts it, it ends there.
    let high = build("bounds", &["feature.channel.top=-1"], &[]);
    let whole = build(
        "bounds",
        &["feature.channel.top=-1", "domain.top={ level = -0.5 }"],
        &[],
    );
    assert!(high.size("channel") < 0.95 * whole.size("channel"));
    assert_near(whole.size("channel"), all.size("channel"), 1e-8);
}

#[test]
fn a_level_base_and_top_are_the_blocks_own() {
    let bounded = build(
        "bounds",
        &["domain.base={ level = -42 }", "domain.top={ level = -2 }"],
        &[],
    );
    let mut lower = model("bounds", &["domain.z=[-42, -2]"]);
    (lower.domain.base, lower.domain.top) = (None, None);
    let realisation = Realisation::new(&lower, &Selection::default()).unwrap();
    assert_eq!(bounded.realisation.extent, realisation.extent);
    let total: f64 = bounded
        .assembly
        .measured
        .pieces
        .iter()
        .map(|piece| piece.size)
        .sum();
    assert_near(total, 400.0 * 600.0 * 40.0, 1e-9);
}

#[test]
fn bounds_that_cannot_be_are_refused_with_the_place() {
    let refused = |overrides: &[&str]| {
        let model = model("bounds", overrides);
        Realisation::new(&model, &Selection::default())
            .unwrap_err()
            .to_string()
    };
    let words = refused(&["domain.z=[-38, 0]"]);
    assert!(
        words.contains("the base of the domain reaches down to -39.4"),
        "{words}"
    );
    let words = refused(&["domain.z=[-45, -3]"]);
    assert!(
        words.contains("the top of the domain reaches up to -1."),
        "{words}"
    );
    let words = refused(&["domain.base.dipping.through=[200, 300, -6]"]);
    assert!(words.contains("not above its base"), "{words}");
}

#[test]
fn scattered_points_lie_on_their_horizon_within_the_tolerance() {
    let built = build("points", &[], &[]);
    let HorizonSurface::Points { points, tolerance } = surface(&built.model, "picked") else {
        panic!("no points");
    };
    let (mut inside, mut least) = (0, f64::INFINITY);
    for &[x, y, z] in points {
        let sides = [-1.0, 1.0].map(|sign| built.owner(x, y, z + 1.001 * sign * tolerance));
        if sides != [None; 2] {
            assert_eq!(sides, [Some("background"), Some("picked")], "{x} {y} {z}");
            inside += 1;
            least = least.min(z);
        }
    }
    assert!(inside > 25 && least < -24.0, "{inside} {least}");
    let points: Vec<DVec3> = points.iter().map(|p| DVec3::from_array(*p)).collect();
    let horizon = Horizon::points(&points, *tolerance).unwrap();
    let above = built.over_plan(|x, y| -horizon.height(x, y));
    assert_near(built.size("picked"), above, 1e-6);
    assert_eq!(built.assembly.measured.pieces.len(), 2);
}

#[test]
fn parasequences_fill_the_units_between_undulating_horizons() {
    for (seed, solids) in [(1, 13), (3, 13)] {
        let built = build("undulating", &[&format!("seed={seed}")], &[]);
        // Curves of sheets that are nearly parallel meet in their common points, without a remedy.
        assert!(built.assembly.failed.is_empty());
        let domain = &built.model.domain;
        let [base, top] = [&domain.base, &domain.top].map(|one| grid(one.as_ref().unwrap()));
        let flooding = grid(surface(&built.model, "flooding"));
        let lower = built.over_plan(|x, y| flooding.height(x, y) - base.height(x, y));
        assert_near(built.sum("lower"), lower, 1e-6);
        let upper = built.over_plan(|x, y| top.height(x, y) - flooding.height(x, y));
        assert_near(built.sum("flooding/upper"), upper, 1e-6);
        // Nothing is left of what the sets divide.
        assert_eq!(
            ["background", "flooding"].map(|name| built.pieces(name)),
            [0; 2]
        );
        // Every volume against the points of a lattice that it owns.
        let counts = [48, 88, 80].map(f64::from);
        let (low, high) = (built.owners.extent().low(), built.owners.extent().high());
        let cell = (high - low) / DVec3::from_array(counts);
        let mut owned: BTreeMap<usize, f64> = BTreeMap::new();
        for i in 0..48 {
            for j in 0..88 {
                for k in 0..80 {
                    let at = DVec3::new(f64::from(i), f64::from(j), f64::from(k)) + 0.5;
                    if let Some(owner) = built.owners.at(low + cell * at) {
                        *owned.entry(owner).or_default() += cell.element_product();
                    }
                }
            }
        }
        for (volume, rules) in built.realisation.volumes.iter().enumerate() {
            let (measured, counted) = (
                built.assembly.measured.size_of(volume),
                owned.get(&volume).copied().unwrap_or(0.0),
            );
            let bound = 0.01 * measured + 40.0 * cell.element_product();
            let name = &rules.name;
            assert!(
                (measured - counted).abs() < bound,
                "{name}: {measured} {counted}"
            );
            assert!(built.pieces(name) <= 1, "{name}");
        }
        assert_eq!(built.assembly.measured.pieces.len(), solids);
        let large = owned.values().filter(|size| **size > 5000.0).count();
        let solids = &built.assembly.measured.pieces;
        assert_eq!(solids.iter().filter(|one| one.size > 5000.0).count(), large);
        assert!(large >= 10, "{large}");
    }
}

/// The model `bounds` with other surfaces for its horizons.
fn with_surfaces(surfaces: &[(&str, HorizonSurface)]) -> Built {
    let mut model = model("bounds", &[]);
    for (id, surface) in surfaces {
        let feature = model.features.iter_mut().find(|one| one.id == *id).unwrap();
        match &mut feature.kind {
            FeatureKind::Horizon(spec) => spec.surface = surface.clone(),
            _ => panic!("{id} is no horizon"),
        }
    }
    Built(assembled::Built::new(model, &Selection::default(), Engine::Partition).unwrap())
}

#[test]
fn a_horizon_on_the_domains_own_base_has_all_above_it_and_one_on_its_top_nothing() {
    let whole = build("bounds", &[], &[]);
    let [floor, roof] =
        [&whole.model.domain.base, &whole.model.domain.top].map(|surface| surface.clone().unwrap());
    // The same plane through another of its points.
    let HorizonSurface::Dipping {
        dip_deg,
        azimuth_deg,
        ..
    } = floor.clone()
    else {
        panic!("no plane");
    };
    let elsewhere = HorizonSurface::Dipping {
        through: [350.0, 17.0, base(350.0, 17.0)].map(Quantity::Constant),
        dip_deg,
        azimuth_deg,
    };
    for on_floor in [floor, elsewhere] {
        let made = with_surfaces(&[("incised", on_floor)]);
        assert!(made.assembly.failed.is_empty());
        assert_eq!(made.pieces("background"), 0);
        let top = grid(&roof);
        let above = made.over_plan(|x, y| top.height(x, y) - lapping(x, y).max(base(x, y)));
        let channel = made.size("channel");
        let held = made.size("incised") + made.size("onlapping") + channel;
        assert_near(held, made.realisation.extent.volume(), 1e-9);
        assert!(made.size("onlapping") > above - channel - 1.0);
        assert!(made.size("onlapping") < above);
        let told = made.decided();
        assert!(told.contains("incised lies on the domain's base"), "{told}");
    }
    let made = with_surfaces(&[("onlapping", roof)]);
    assert!(made.assembly.failed.is_empty());
    assert_eq!(made.pieces("onlapping"), 0);
    let without = build("bounds", &[], &["onlapping"]);
    for name in ["background", "incised", "channel"] {
        assert_near(made.size(name), without.size(name), 1e-12);
    }
    let told = made.decided();
    assert!(
        told.contains("onlapping lies on the domain's top"),
        "{told}"
    );
}

#[test]
fn a_level_horizon_on_a_level_base_or_top_of_the_domain_is_decided_too() {
    let made = build(
        "bounds",
        &[
            "domain.base={ level = -42 }",
            "domain.top={ level = -2 }",
            "feature.incised.surface={ level = -42 }",
            "feature.onlapping.surface={ level = -2 }",
        ],
        &["channel"],
    );
    assert_near(made.size("incised"), 400.0 * 600.0 * 40.0, 1e-12);
    assert_eq!(
        ["background", "onlapping"].map(|name| made.pieces(name)),
        [0; 2]
    );
}

#[test]
fn what_is_drawn_for_the_domains_base_and_top_is_told_and_is_what_bounds_it() {
    let overrides = [
        "domain.base.dipping.dip_deg={ uniform = [0.5, 1.5] }",
        "domain.base.dipping.through=[200, 300, { uniform = [-40, -36] }]",
        "domain.top={ level = { uniform = [-9, -3] } }",
    ];
    let mut seen = Vec::new();
    for seed in [1, 2] {
        let mut model = model("bounds", &overrides);
        model.seed = seed;
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let names: Vec<&str> = realisation.drawn.iter().map(|one| one.0.as_str()).collect();
        assert_eq!(
            names,
            [
                "base.dipping.through.z",
                "base.dipping.dip_deg",
                "top.level"
            ]
        );
        let [z, dip, top] = [0, 1, 2].map(|at| realisation.drawn[at].1);
        assert!((0.5..1.5).contains(&dip) && (-40.0..-36.0).contains(&z));
        // The plane goes through the middle of the plan.
        assert_near(
            realisation.extent.volume(),
            400.0 * 600.0 * (top - z),
            1e-12,
        );
        let owners = Owners::new(&realisation).unwrap();
        let floor = z - 190.0 * dip.to_radians().tan();
        let at = |z: f64| owners.at(DVec3::new(390.0, 100.0, z));
        assert!(at(floor - 1e-6).is_none() && at(floor + 1e-6).is_some());
        seen.push([z, dip, top]);
    }
    assert!(seen[0].iter().zip(seen[1]).all(|(a, b)| *a != b));
}
