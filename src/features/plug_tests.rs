#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use glam::DVec3;

use super::*;
use crate::features::bends::bends;
use crate::features::reach::tests::{along, design, meander};
use crate::features::trajectory::Trajectory;

const PLUG: PlugDesign = PlugDesign {
    depth: 0.5,
    width: 0.7,
    offset: 0.1,
    part: Abandoned::Between(0.0, 1.0),
};

#[test]
fn a_plug_has_its_fractions_of_the_channels_section() {
    let line = Trajectory::line(DVec2::ZERO, DVec2::new(400.0, 0.0)).unwrap();
    let (channel, reach) = along(design(), line);
    let plug = PLUG.build(&reach).unwrap();
    let base = plug.sheet(Role::Base).unwrap();
    // The area below the top by x and y along u: the same section, so width · depth fraction of it.
    let area = |base: &crate::nurbs::Surface, [from, to]: [f64; 2]| {
        let at = |k: u32| base.point(from + (to - from) * f64::from(k) / 2e4, 0.4);
        let strip = |k: u32| {
            let (a, b) = (at(k), at(k + 1));
            0.5 * (-10.0 - a.z - b.z) * (a.y - b.y)
        };
        (0..20_000).map(strip).sum::<f64>()
    };
    let whole = area(channel.base(), [0.0, 1.0]);
    assert!((whole - 0.764_563 * 50.0 * 4.4).abs() < 1e-3);
    assert!((area(base, [0.0, 1.0]) - 0.35 * whole).abs() < 1e-6);
    let rims = [0.0, 1.0].map(|u| base.point(u, 0.3));
    assert!((rims[0] - DVec3::new(rims[0].x, 17.5, -5.0)).length() < 1e-9);
    // The banks go on above the channel's top.
    let (low, high) = base.knots_u().domain();
    assert!(low < -0.01 && high > 1.01);
    assert!([low, high].iter().all(|u| base.point(*u, 0.3).z > -4.8));
    // Ends are beyond the channel's.
    let (low, high) = plug.bounds();
    assert!(low.x < -4.3 && high.x > 404.3);
}

#[test]
fn a_plug_is_nearer_to_outer_banks() {
    let (_, reach) = along(design(), meander());
    let plug = PLUG.build(&reach).unwrap();
    let base = plug.sheet(Role::Base).unwrap();
    for (fraction, side) in [(0.125, -1.0), (0.375, 1.0), (0.25, 0.0)] {
        let place = reach
            .trajectory()
            .at(fraction * reach.trajectory().length());
        let off = (base.point(0.5, fraction).truncate() - place.point).dot(place.right());
        assert!((off - side * 5.0).abs() < 0.06, "{off} at {fraction}");
    }
}

#[test]
fn a_cut_off_bends_plug_is_deepest_at_its_apex_and_ends_within_the_bend() {
    let (_, reach) = along(design(), meander());
    let bend = bends(reach.trajectory(), 50.0, 0.3)[1];
    let plug = PlugDesign {
        part: Abandoned::Bend(bend),
        ..PLUG
    };
    let made = plug.build(&reach).unwrap();
    let base = made.sheet(Role::Base).unwrap();
    let deepest = |v: f64| base.point(0.5, v).z + 5.0;
    assert!((deepest(0.5) + 2.2).abs() < 1e-3);
    assert!(deepest(0.0) > 0.1 && deepest(1.0) > 0.1);
    for k in 1..10 {
        let v = f64::from(k) / 10.0;
        let wanted = -2.2 * (1.05 * (std::f64::consts::PI * v).sin() - 0.05);
        assert!((deepest(v) - wanted).abs() < 0.06, "{v}");
    }
}

#[test]
fn a_part_of_a_channel_is_plugged_from_section_to_section() {
    let line = Trajectory::line(DVec2::ZERO, DVec2::new(400.0, 0.0)).unwrap();
    let (_, reach) = along(design(), line);
    let plug = PlugDesign {
        part: Abandoned::Between(0.25, 0.7),
        ..PLUG
    };
    let (low, high) = plug.build(&reach).unwrap().bounds();
    assert!((low.x - 100.0).abs() < 1e-9 && (high.x - 280.0).abs() < 1e-9);
}

#[test]
fn plugs_that_cannot_be_are_refused() {
    let (_, reach) = along(design(), meander());
    for plug in [
        PlugDesign { depth: 1.0, ..PLUG },
        PlugDesign { depth: 0.0, ..PLUG },
        PlugDesign { width: 1.2, ..PLUG },
        PlugDesign {
            width: f64::NAN,
            ..PLUG
        },
        PlugDesign {
            offset: -0.1,
            ..PLUG
        },
        PlugDesign {
            part: Abandoned::Between(0.5, 0.5),
            ..PLUG
        },
    ] {
        assert!(plug.build(&reach).is_err(), "{plug:?}");
    }
}
