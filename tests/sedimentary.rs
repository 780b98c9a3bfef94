//! Sedimentary features through the partition kernel: what lies in a channel is proven against its channel, and has the
//! volumes of closed forms.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod shapes;

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use clinothem::features::bends::bends;
use clinothem::features::channel::{ChannelDesign, Origin};
use clinothem::features::conform::{Target, conform};
use clinothem::features::lag::LagDesign;
use clinothem::features::levee::{Bank, LeveeDesign, parts};
use clinothem::features::lobe::LobeDesign;
use clinothem::features::meander::SineGenerated;
use clinothem::features::plug::{Abandoned, PlugDesign};
use clinothem::features::point_bars::{PointBarsDesign, Slope};
use clinothem::features::profile::Profile;
use clinothem::features::reach::Reach;
use clinothem::features::scour::{PitAndWing, ScourDesign, constant_area};
use clinothem::features::shell::Shell;
use clinothem::features::splay::{Breaches, SplayDesign};
use clinothem::features::trajectory::Trajectory;
use clinothem::partition::{Label, Region};
use glam::{DVec2, DVec3};
use shapes::audit::{size, sound, youngest};

/// A channel 50 m wide and 4.4 m deep with its top at −5 m.
fn design(tolerance: f64) -> ChannelDesign {
    ChannelDesign {
        width: Profile::Constant(50.0),
        depth: Profile::Constant(4.4),
        asymmetry: Profile::Constant(0.0),
        left_angle: None,
        right_angle: None,
        top: Profile::Constant(-5.0),
        origin: Origin::Thalweg,
        angle_limit: 15_f64.to_radians(),
        tolerance,
    }
}

/// The share of the channel's section below a level a tenth of the depth above its floor.
const LEVEL_LAG: f64 = 0.04709;
/// The channel's section as a part of width times depth.
const SECTION: f64 = 0.764_563;

fn meander(extent: [f64; 2]) -> Trajectory {
    Trajectory::sine_generated(&SineGenerated {
        amplitude: 100.0,
        wavelength: 475.0,
        azimuth: FRAC_PI_2,
        center: DVec2::ZERO,
        phase: 0.25,
        extent,
    })
    .unwrap()
}

fn channel(design: ChannelDesign, trajectory: Trajectory) -> (Region, Reach) {
    let trough = design.build(&trajectory).unwrap();
    let sheets = trough.sheets().unwrap().into_iter().map(|sheet| sheet.1);
    let region = Region::Shell(sheets.collect());
    (region, Reach::new(design, Arc::new(trajectory), &trough))
}

fn region(shell: &Shell) -> Region {
    Region::Shell(shell.sheets().iter().map(|sheet| sheet.1.clone()).collect())
}

fn block(low: [f64; 3], high: [f64; 3]) -> Region {
    Region::Block {
        low: DVec3::from_array(low),
        high: DVec3::from_array(high),
    }
}

/// Regions: block, channel, lag, then four accretion surfaces for each bend, and a plug last if there are any more.
/// Labels: 0 around, 1 channel, 2 lag, 3 plug, then 10 + 4 bend + package.
fn in_channel(holds: &[bool]) -> Label {
    if !holds[0] {
        return None;
    }
    if !holds[1] {
        return Some(0);
    }
    let inner = &holds[3..];
    let (bars, plug) = inner.split_at(inner.len() / 4 * 4);
    if plug.first() == Some(&true) {
        return Some(3);
    }
    if holds[2] {
        return Some(2);
    }
    for (bend, sheets) in bars.chunks(4).enumerate() {
        // The youngest sheet bounds the bar; a place belongs to the package after the youngest sheet that it is outside of.
        if sheets[3] {
            let package = sheets[..3].iter().rposition(|inside| !inside);
            return Some(10 + 4 * bend + package.map_or(0, |at| at + 1));
        }
    }
    Some(1)
}

fn lag(thickness: f64, sag: f64) -> LagDesign {
    LagDesign {
        thickness: Profile::Constant(thickness),
        sag: Profile::Constant(sag),
        order: 0,
    }
}

const BARS: PointBarsDesign = PointBarsDesign {
    surfaces: 4,
    dip: None,
    reach: 0.35,
    apex: 0.5,
    translation: 0.0,
    slope: Slope::Straight,
    drape: None,
};

#[test]
fn a_lag_along_a_bend_has_its_share_of_the_section_times_the_bends_length() {
    // An arc of 1.2 rad, radius 150 m, that passes through the block from side to side.
    let arc = |t: f64| 150.0 * DVec2::from_angle(t);
    let trajectory = Trajectory::parametric(&arc, [-0.6, 0.6]).unwrap();
    let (of_channel, reach) = channel(design(1e-4), trajectory);
    let lag = lag(0.1, 0.0).build(&reach).unwrap();
    let all = [
        block([50.0, -150.0, -20.0], [250.0, 150.0, 0.0]),
        of_channel,
        region(&lag),
    ];
    let made = sound(&all, in_channel);
    // Pappus: symmetrical sections count along the trajectory.
    let whole = SECTION * 50.0 * 4.4 * 150.0 * 1.2;
    assert!((size(&made, 2) / whole - LEVEL_LAG).abs() < 1e-5);
    assert!(((size(&made, 1) + size(&made, 2)) / whole - 1.0).abs() < 1e-5);
}

#[test]
fn the_packages_of_a_bend_have_the_shares_of_its_channel_that_strips_of_sections_tell() {
    let (of_channel, reach) = channel(design(1e-3), meander([-50.0, 620.0]));
    let bend = bends(reach.trajectory(), 50.0, 0.3)
        .into_iter()
        .find(|bend| bend.turn > 0.0)
        .unwrap();
    let bar = BARS.build(&reach, &bend).unwrap();
    let lag = lag(0.1, 0.0).build(&reach).unwrap();
    let mut all = vec![
        block([-20.0, -250.0, -20.0], [600.0, 250.0, 0.0]),
        of_channel,
        region(&lag),
    ];
    all.extend(bar.packages.iter().map(region));
    let made = sound(&all, in_channel);
    let whole = SECTION * 50.0 * 4.4 * (bend.to - bend.from);
    let mut sum = 0.0;
    for (package, wanted) in [0.1079, 0.1563, 0.2103, 0.2676].into_iter().enumerate() {
        sum += size(&made, 10 + package);
        // Four digits, and the level of a lag is a hair above or below 7.5° sheets' toes.
        assert!((sum / whole - wanted).abs() < 2e-4, "{}", sum / whole);
    }
}

#[test]
fn base_lag_and_four_accretion_surfaces_at_each_inner_bend_and_a_plug_are_proven() {
    let (of_channel, reach) = channel(design(0.01), meander([-150.0, 1100.0]));
    let mut all = vec![
        block([0.0, -200.0, -20.0], [900.0, 200.0, 0.0]),
        of_channel,
        region(&lag(0.15, 0.5).build(&reach).unwrap()),
    ];
    let bends = bends(reach.trajectory(), 50.0, 0.3);
    let bars = PointBarsDesign {
        slope: Slope::Sigmoidal,
        ..BARS
    };
    for bend in &bends {
        let bar = bars.build(&reach, bend).unwrap();
        all.extend(bar.packages.iter().map(region));
    }
    let plug = PlugDesign {
        depth: 0.4,
        width: 0.6,
        offset: 0.1,
        part: Abandoned::Bend(bends[2]),
    };
    all.push(region(&plug.build(&reach).unwrap()));
    let made = sound(&all, in_channel);
    let inner = (0..bends.len()).filter(|bend| size(&made, 10 + 4 * bend) > 0.0);
    assert!(inner.count() >= 3, "{}", bends.len());
    assert!(size(&made, 2) > 0.0 && size(&made, 3) > 0.0);
}

fn solids(shells: &[&Shell]) -> Vec<Region> {
    shells.iter().map(|shell| region(shell)).collect()
}

#[test]
fn a_scour_has_the_volume_of_its_closed_form() {
    let width = Profile::Along(vec![(0.0, 20.0), (1.0, 60.0)]);
    let scour = ScourDesign {
        depth: constant_area(&width, 3.0),
        width,
        section: PitAndWing {
            pit: 0.35,
            wing_depth: 0.25,
        },
        head: 0.15,
        tail: 0.4,
        top: -2.0,
        angle_limit: 0.2,
        tolerance: 1e-3,
    };
    let line = Trajectory::line(DVec2::new(10.0, 20.0), DVec2::new(130.0, 180.0)).unwrap();
    let scour = scour.build(&line).unwrap();
    let mut all = vec![block([-40.0, -10.0, -20.0], [200.0, 220.0, 0.0])];
    all.extend(solids(&[&scour]));
    let made = sound(&all, youngest);
    assert!(
        (size(&made, 1) / 3978.006 - 1.0).abs() < 1e-4,
        "{}",
        size(&made, 1)
    );
}

#[test]
fn lobes_have_the_volume_of_their_closed_form_and_younger_ones_cut_older_ones() {
    let lobe = |x: f64, azimuth: f64, base: f64| LobeDesign {
        center: DVec3::new(x, 30.0, base),
        length: 300.0,
        width: 180.0,
        thickness: 8.0,
        azimuth,
        taper: 0.5,
        skew: 0.3,
    };
    let [one, other] =
        [lobe(0.0, 0.4, -15.0), lobe(110.0, 1.3, -13.0)].map(|design| design.build().unwrap());
    let shells = [one, other].map(|lobe| lobe.shell().unwrap());
    let around = block([-300.0, -250.0, -30.0], [400.0, 300.0, 0.0]);
    let mut all = vec![around];
    all.extend(solids(&[&shells[0], &shells[1]]));
    let made = sound(&all, youngest);
    assert!((size(&made, 2) / other.volume() - 1.0).abs() < 1e-8);
    let left = size(&made, 1) / one.volume();
    assert!(left > 0.3 && left < 0.95, "{left}");
    all.pop();
    let alone = sound(&all, youngest);
    assert!((size(&alone, 1) / one.volume() - 1.0).abs() < 1e-8);
}

#[test]
fn levees_of_all_bends_a_splay_and_a_mouth_bar_are_proven_against_their_channel() {
    let trajectory = meander([-150.0, 800.0]);
    let (of_channel, reach) = channel(design(0.01), trajectory);
    let levee = LeveeDesign {
        width: Profile::Constant(50.0),
        height: Profile::Constant(0.44),
        depth: Profile::Constant(1.32),
        taper: 2,
        toe: 0.3,
        bend_asymmetry: 0.3,
        thinning: 0.3,
    };
    let mut shells = Vec::new();
    for bank in [Bank::Left, Bank::Right] {
        for part in parts(&reach, bank, 0.3) {
            shells.push(levee.build(&reach, &part).unwrap().unwrap());
        }
    }
    let splay = SplayDesign {
        at: 0.5,
        bank: Breaches::of(&reach, &|_| true).unwrap().at(0.5).1,
        angle: 60_f64.to_radians(),
        length: 250.0,
        width: 125.0,
        thickness: 2.2,
        erosion: 0.1,
        taper: 0.4,
        skew: 0.7,
    };
    shells.push(splay.shell(&reach).unwrap());
    let end = reach.trajectory().at(reach.trajectory().length());
    let bar = LobeDesign::mouth_bar(&end, 50.0, 4.4, -5.0)
        .build()
        .unwrap();
    shells.insert(0, bar.shell().unwrap());
    let mut all = vec![block([-120.0, -300.0, -20.0], [1150.0, 300.0, 0.0])];
    all.extend(shells.iter().map(region));
    all.push(of_channel);
    let made = sound(&all, youngest);
    for label in 1..all.len() {
        assert!(size(&made, label) > 0.0, "{label} of {}", all.len());
    }
}

#[test]
fn a_straight_channels_levee_is_its_section_times_its_length() {
    let line = Trajectory::line(DVec2::new(-50.0, 7.0), DVec2::new(450.0, 7.0)).unwrap();
    let (of_channel, reach) = channel(design(0.01), line);
    let levee = LeveeDesign {
        width: Profile::Constant(50.0),
        height: Profile::Constant(0.44),
        depth: Profile::Constant(1.32),
        taper: 2,
        toe: 0.3,
        bend_asymmetry: 0.3,
        thinning: 0.0,
    };
    let part = parts(&reach, Bank::Right, 0.3)[0];
    let shell = levee.build(&reach, &part).unwrap().unwrap();
    let all = [
        block([0.0, -120.0, -20.0], [400.0, 120.0, 0.0]),
        region(&shell),
        of_channel,
    ];
    let made = sound(&all, youngest);
    // Inwards of the crest: 1 m above the top and above the base, less than the bank's 30°.
    // w [h_a ((1 − t)/3 + t/2) + h_b/2]
    let least = 50.0 * (0.44 * (0.7 / 3.0 + 0.15) + 0.66) * 400.0;
    let most = least + 400.0 * (0.44 * 2.0 + 1.4 * (1.0 + 1.4 * 50.0 / 6.5 / 4.4));
    let found = size(&made, 1);
    assert!(
        found > 0.995 * least && found < most,
        "{least} {found} {most}"
    );
}

#[test]
fn a_scour_down_a_slope_and_a_lobe_on_it_are_proven() {
    let slope = |at: DVec2| Some(-8.0 - 4.0 * (at.x / 150.0).tanh() + 0.5 * (at.y / 80.0).sin());
    let width = Profile::Along(vec![(0.0, 20.0), (1.0, 60.0)]);
    let scour = ScourDesign {
        depth: constant_area(&width, 3.0),
        width,
        section: PitAndWing {
            pit: 0.35,
            wing_depth: 0.25,
        },
        head: 0.15,
        tail: 0.4,
        top: 0.0,
        angle_limit: 0.2,
        tolerance: 0.01,
    };
    let line = Trajectory::line(DVec2::new(-100.0, 10.0), DVec2::new(100.0, -20.0)).unwrap();
    let lobe = LobeDesign {
        center: DVec3::new(60.0, 40.0, 0.0),
        length: 150.0,
        width: 90.0,
        thickness: 4.0,
        azimuth: 1.0,
        taper: 0.5,
        skew: 0.3,
    };
    let lobe = lobe.build().unwrap();
    // At two depths: on one surface the scour's top and the lobe's base would coincide.
    let target = |depth: f64| Target {
        height: &slope,
        reference: 0.0,
        depth,
    };
    let made = [
        (scour.build(&line).unwrap(), 0.5),
        (lobe.shell().unwrap(), 1.1),
    ]
    .map(|(shell, depth)| conform(&shell, &target(depth), 0.02).unwrap());
    let mut all = vec![block([-150.0, -150.0, -30.0], [200.0, 150.0, 0.0])];
    all.extend(solids(&[&made[0].shell, &made[1].shell]));
    let parts = sound(&all, youngest);
    // The map keeps volumes, but for the deviation over the plan.
    let plan = std::f64::consts::PI / 4.0 * 150.0 * 90.0;
    let off = (size(&parts, 2) - lobe.volume()).abs();
    assert!(off <= 2.0 * made[1].deviation * plan, "{off}");
    assert!(size(&parts, 1) > 0.5 * 3978.0);
}

/// Regions: block, channel, then four accretion surfaces and the four drapes on them.
/// Labels: 0 around, 1 channel, 10 + package, 20 + drape.
fn draped(holds: &[bool]) -> Label {
    if !holds[0] {
        return None;
    }
    if !holds[1] {
        return Some(0);
    }
    let (sheets, drapes) = holds[2..].split_at(4);
    let package = if sheets[3] {
        sheets[..3]
            .iter()
            .rposition(|inside| !inside)
            .map_or(0, |at| at + 1)
    } else {
        4
    };
    // The drape on the surface that the package lies on takes from it.
    match package.checked_sub(1) {
        Some(below) if drapes[below] => Some(20 + below),
        _ if package == 4 => Some(1),
        _ => Some(10 + package),
    }
}

#[test]
fn drapes_on_accretion_surfaces_are_proven_and_as_thick_as_asked() {
    let (of_channel, reach) = channel(design(0.01), meander([-50.0, 620.0]));
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    let bars = PointBarsDesign {
        drape: Some(0.15),
        ..BARS
    };
    let bar = bars.build(&reach, &bend).unwrap();
    let mut all = vec![
        block([-20.0, -250.0, -20.0], [600.0, 250.0, 0.0]),
        of_channel,
    ];
    all.extend(bar.packages.iter().chain(&bar.drapes).map(region));
    let made = sound(&all, draped);
    for drape in 0..4 {
        // Its face on the surface below is as large as that, and the drape that much times its thickness, but at its edges.
        let volume = size(&made, 20 + drape);
        let between = |labels: [Option<usize>; 2]| {
            let [a, b] = [20 + drape, 10 + drape].map(Some);
            labels == [a, b] || labels == [b, a]
        };
        let faces = made.topology.faces.iter();
        let area: f64 = faces
            .filter(|face| between(face.labels))
            .map(|face| face.integral.area)
            .sum();
        let thickness = volume / area;
        assert!((thickness / 0.15 - 1.0).abs() < 0.03, "{thickness}");
    }
}

#[test]
fn a_part_of_a_channel_that_ends_in_the_block_holds_two_lags() {
    let line = Trajectory::line(DVec2::new(40.0, 3.0), DVec2::new(300.0, 30.0)).unwrap();
    let mut asymmetric = design(0.01);
    asymmetric.asymmetry = Profile::Constant(0.15);
    let (of_channel, reach) = channel(asymmetric, line);
    let lags = [(0.1, 0), (0.25, 1)].map(|(thickness, order)| {
        let lag = LagDesign {
            order,
            ..lag(thickness, 0.5)
        };
        lag.build(&reach).unwrap()
    });
    let mut all = vec![block([0.0, -100.0, -20.0], [400.0, 100.0, 0.0]), of_channel];
    all.extend(lags.iter().map(region));
    // The lower one takes from the upper one, both from the channel only.
    let two_lags = |holds: &[bool]| -> Label {
        holds[0].then(|| match (holds[1], holds[2], holds[3]) {
            (false, ..) => 0,
            (true, true, _) => 2,
            (true, false, true) => 3,
            _ => 1,
        })
    };
    let made = sound(&all, two_lags);
    assert!(size(&made, 2) > 0.0 && size(&made, 3) > size(&made, 2));
}
