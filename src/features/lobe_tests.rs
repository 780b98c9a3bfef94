#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::PI;

use super::*;
use crate::nurbs::quadrature;

/// 600 m long, 240 m wide, up to 4 m thick, downstream towards N 50° E.
const LOBE: LobeDesign = LobeDesign {
    center: DVec3::new(431.0, -652.0, -20.0),
    length: 600.0,
    width: 240.0,
    thickness: 4.0,
    azimuth: 50.0 * PI / 180.0,
    taper: 0.6,
    skew: 0.7,
};

const LINES: [LobeLines; 5] = [
    LobeLines {
        pole: DVec2::ZERO,
        turn: 0.0,
    },
    LobeLines {
        pole: DVec2::new(-0.86, 0.0),
        turn: 0.0,
    },
    LobeLines {
        pole: DVec2::new(0.6, 0.0),
        turn: 1.3,
    },
    LobeLines {
        pole: DVec2::new(-0.3, -0.7),
        turn: 0.0,
    },
    LobeLines::ASIDE,
];

/// (X, Y) of a place, by its angle from the axis.
fn disc(design: &LobeDesign, p: DVec3) -> DVec2 {
    let d = p - design.center;
    let (sin, cos) = design.azimuth.sin_cos();
    let x = (d.x * sin + d.y * cos) / (0.5 * design.length);
    let y = (d.y * sin - d.x * cos) / (0.5 * design.width) / (1.0 + design.taper * x);
    DVec2::new(x, y)
}

#[test]
fn every_point_of_the_cap_satisfies_the_equation() {
    let lobe = LOBE.build().unwrap();
    let shell = lobe.shell().unwrap();
    let top = shell.sheet(Role::Top).unwrap();
    for i in 0..=40 {
        for j in 0..=97 {
            let (u, v) = (f64::from(i) / 40.0, f64::from(j) / 97.0);
            let p = top.point(u, v);
            let at = disc(&LOBE, p);
            let r = at.length_squared();
            assert!((r - u * u).abs() < 1e-12, "{u} {v}: {r}");
            let height = lobe.height * (1.0 - r) * (1.0 - 0.7 * at.x);
            assert!((p.z + 20.0 - height).abs() < 1e-11, "{u} {v}");
            let thickness = lobe.thickness_at(p.truncate());
            assert!((thickness - height).abs() < 1e-9, "{thickness} {height}");
        }
    }
    assert!((top.weights().iter().fold(1.0_f64, |a, b| a.min(*b)) - 2.0 / 3.0).abs() < 1e-15);
}

#[test]
fn cap_and_base_share_the_rim_to_the_last_bit_and_both_have_a_pole() {
    let lobe = LOBE.build().unwrap();
    for lines in LINES {
        let shell = lobe.along(lines).unwrap();
        let [top, base] = [Role::Top, Role::Base].map(|role| shell.sheet(role).unwrap());
        assert_eq!(top.net()[3 * 17..], base.net()[3 * 17..]);
        assert!(top.net()[3 * 17..].iter().all(|p| p.z == -20.0));
        for net in [top.net(), base.net()] {
            assert!(net[..17].iter().all(|p| *p == net[0]));
        }
    }
    for pole in [DVec2::X, DVec2::new(0.8, -0.7), DVec2::new(0.0, f64::NAN)] {
        assert!(lobe.along(LobeLines { pole, turn: 0.0 }).is_err());
    }
}

#[test]
fn wherever_the_pole_and_the_seam_are_the_cap_is_the_same() {
    let lobe = LOBE.build().unwrap();
    for lines in LINES {
        let shell = lobe.along(lines).unwrap();
        let top = shell.sheet(Role::Top).unwrap();
        for i in 0..=40 {
            for j in 0..=97 {
                let (u, v) = (f64::from(i) / 40.0, f64::from(j) / 97.0);
                let p = top.point(u, v);
                let at = disc(&LOBE, p);
                let height = lobe.height * (1.0 - at.length_squared()) * (1.0 - 0.7 * at.x);
                assert!((p.z + 20.0 - height).abs() < 1e-11, "{u} {v} {lines:?}");
                // Straight in the disc, from the pole to the circle.
                let rim = disc(&LOBE, top.point(1.0, v));
                assert!((rim.length() - 1.0).abs() < 1e-12);
                if j == 0 {
                    let seam = DVec2::from_angle(lines.turn);
                    assert!((rim - seam).length() < 1e-12, "{rim} {lines:?}");
                }
                let wanted = lines.pole.lerp(rim, u);
                assert!((at - wanted).length() < 1e-11, "{u} {v} {lines:?}");
            }
        }
    }
}

/// ∬ (z − base) dA and the area in plan, by quadrature of the cap.
fn measured(lobe: &Lobe) -> [f64; 2] {
    let shell = lobe.shell().unwrap();
    let top = shell.sheet(Role::Top).unwrap();
    let mut sums = [0.0; 2];
    for quarter in 0..4 {
        let ends = [f64::from(quarter) / 4.0, f64::from(quarter + 1) / 4.0];
        for (u, wu) in quadrature::between(quadrature::TEN, 0.0, 1.0) {
            for (v, wv) in quadrature::between(quadrature::TEN, ends[0], ends[1]) {
                let d = top.derivatives(u, v, 1);
                let area = d[1][0].truncate().perp_dot(d[0][1].truncate()).abs();
                sums[0] += wu * wv * area * (d[0][0].z - lobe.design.center.z);
                sums[1] += wu * wv * area;
            }
        }
    }
    sums
}

#[test]
fn volume_and_area_are_those_of_the_closed_forms() {
    for (taper, skew) in [(0.6, 0.7), (0.0, 0.0), (0.9, 0.0), (-0.5, 0.3), (0.0, -0.9)] {
        let lobe = LobeDesign {
            taper,
            skew,
            ..LOBE
        }
        .build()
        .unwrap();
        let [volume, area] = measured(&lobe);
        // (π/2) a b H (1 − λτ/6), with H from the greatest thickness.
        let wanted = PI / 2.0 * 300.0 * 120.0 * lobe.height * (1.0 - skew * taper / 6.0);
        assert!((volume / wanted - 1.0).abs() < 1e-8, "{volume} {wanted}");
        assert!((lobe.volume() / wanted - 1.0).abs() < 1e-12);
        assert!((area / (PI * 300.0 * 120.0) - 1.0).abs() < 1e-8);
    }
}

#[test]
fn the_greatest_thickness_is_as_asked_and_upstream_if_skewed() {
    for skew in [-0.9, -0.3, 0.0, 1e-10, 0.3, 0.9] {
        let design = LobeDesign {
            skew,
            azimuth: PI / 2.0,
            ..LOBE
        };
        let lobe = design.build().unwrap();
        let along = (-2000..=2000).map(|k| {
            let x = f64::from(k) * 0.15;
            (lobe.thickness_at(DVec2::new(431.0 + x, -652.0)), x)
        });
        let most = along.fold((0.0, 0.0), |a: (f64, f64), b| if b.0 > a.0 { b } else { a });
        assert!((most.0 - 4.0).abs() < 1e-5, "{skew}: {most:?}");
        assert!((most.1 / 300.0 - thickest(skew)).abs() < 1e-3, "{most:?}");
        assert!(most.1 * skew <= 0.0);
    }
}

#[test]
fn a_tapered_lobe_is_widest_downstream_where_the_formula_says() {
    for taper in [0.3, 0.6, 0.9_f64] {
        let design = LobeDesign {
            taper,
            azimuth: PI / 2.0,
            ..LOBE
        };
        let shell = design.build().unwrap().shell().unwrap();
        let rim = shell.sheet(Role::Base).unwrap();
        let all = (0..=20_000).map(|k| rim.point(1.0, f64::from(k) / 2e4));
        let widest = all.fold(DVec3::NEG_INFINITY, |a, b| if b.y > a.y { b } else { a });
        let wanted = (-1.0 + (1.0 + 8.0 * taper * taper).sqrt()) / (4.0 * taper);
        assert!(((widest.x - 431.0) / 300.0 - wanted).abs() < 1e-2);
    }
}

#[test]
fn the_shell_holds_what_is_between_base_and_cap() {
    let lobe = LOBE.build().unwrap();
    let shell = lobe.shell().unwrap();
    let (low, high) = shell.bounds();
    let mut held = 0;
    for k in 1..20_000 {
        let part = |ratio: f64| (f64::from(k) * ratio).fract();
        let at =
            low + (high - low) * DVec3::new(part(0.819_17), part(0.671_04), part(0.549_700_478));
        let thickness = lobe.thickness_at(at.truncate());
        let wanted = at.z > -20.0 && at.z < -20.0 + thickness;
        assert_eq!(shell.contains(at), wanted, "{at}");
        held += usize::from(wanted);
    }
    assert!(held > 2000);
}

#[test]
fn a_mouth_bar_begins_a_little_inside_of_its_channel_and_comes_up_to_its_top() {
    let end = Place {
        s: 900.0,
        point: DVec2::new(100.0, 200.0),
        direction: 0.4,
        curvature: 0.0,
    };
    let bar = LobeDesign::mouth_bar(&end, 50.0, 4.4, -5.0)
        .build()
        .unwrap();
    let tangent = DVec2::from_angle(0.4);
    // A tenth of the channel's width.
    assert!(bar.thickness_at(end.point - 5.5 * tangent) == 0.0);
    assert!(bar.thickness_at(end.point - 4.5 * tangent) > 0.0);
    assert!(bar.thickness_at(end.point + 244.0 * tangent) > 0.0);
    assert!(bar.thickness_at(end.point + 246.0 * tangent) == 0.0);
    let (low, high) = bar.shell().unwrap().bounds();
    // The net's top is above the cap's.
    assert!((low.z - (-5.0 - 1.02 * 4.4)).abs() < 1e-9 && high.z > -5.0 - 0.03 * 4.4);
}

#[test]
fn lobes_that_cannot_be_are_refused() {
    for bad in [
        LobeDesign {
            length: 0.0,
            ..LOBE
        },
        LobeDesign {
            thickness: f64::NAN,
            ..LOBE
        },
        LobeDesign {
            taper: 0.95,
            ..LOBE
        },
        LobeDesign {
            skew: f64::NAN,
            ..LOBE
        },
        LobeDesign {
            azimuth: f64::INFINITY,
            ..LOBE
        },
    ] {
        assert!(bad.build().is_err(), "{bad:?}");
    }
}
