//! Beds, channels and nodules that faults part and folds bend: conjugate pairs, planes and listric faults, with what is younger and seals
//! them; and the same in round numbers.
#![allow(clippy::cast_possible_wrap, reason = "counts are small")]

use toml::{Table, Value};

use super::bodies::{channel, ellipsoid};
use super::draws::{Draws, rounded};
use super::generic::block;
use super::strata::horizon;
use super::tables::{Block, FACIES, feature, model as whole, set, table};

/// A conjugate pair of faults through beds and bodies, in any order, with nothing equal by design.
pub(super) fn model(draws: &mut Draws) -> Table {
    let block = block(draws);
    let height = block.size()[2];
    let mut features = Vec::new();
    let beds = draws.count(1, 4);
    for at in 0..beds {
        let part = 0.1 + 0.6 * (at as f64 + draws.within(0.2, 0.8)) / beds as f64;
        let relief = 0.2 * height / beds as f64;
        let id = format!("bed-{at}");
        features.push(horizon(draws, &block, &id, block.elevation(part), relief));
    }
    for at in 0..draws.count(0, 3) {
        let id = format!("body-{at}");
        let body = if draws.chance(0.6) {
            channel(draws, &block, &id)
        } else {
            ellipsoid(draws, &block, &id, None)
        };
        let place = draws.count(0, features.len());
        features.insert(place, body);
    }
    let strike = draws.within(0.0, 360.0);
    let middle = [draws.within(0.3, 0.7), draws.within(0.3, 0.7)];
    for (at, turn) in [0.0, 180.0].into_iter().enumerate() {
        let azimuth = strike + turn + draws.within(-15.0, 15.0);
        let id = format!("fault-{at}");
        features.push(fault(draws, &block, &id, azimuth, middle));
    }
    if draws.chance(0.25) {
        let fault = features.len() - 1;
        let side = draws.pick(&["hanging-wall", "footwall"]);
        set(
            &mut features[fault],
            "ends_on",
            table([("fault", "fault-0".into()), ("side", side.into())]),
        );
    }
    if draws.chance(0.4) {
        let seal = block.elevation(draws.within(0.75, 0.9));
        features.push(horizon(draws, &block, "seal", seal, 0.05 * height));
    }
    if draws.chance(0.4) {
        features.push(channel(draws, &block, "youngest"));
    }
    whole(block.table("mud"), features)
}

fn fault(draws: &mut Draws, block: &Block, id: &str, azimuth: f64, middle: [f64; 2]) -> Table {
    let [_, _, height] = block.size();
    let aside = 0.3 * block.narrow().min(3.0 * height);
    let [x, y] = block.at(middle[0], middle[1]);
    let through = [
        x + aside * draws.within(-1.0, 1.0),
        y + aside * draws.within(-1.0, 1.0),
        block.elevation(draws.within(0.2, 0.9)),
    ];
    let through = through.map(|number| rounded(number, 7)).to_vec();
    let dip = draws.within(40.0, 80.0);
    let throw = height * draws.magnitude(0.01, 0.3);
    let azimuth = rounded(azimuth.rem_euclid(360.0), 5);
    let mut fault = table([("id", id.into()), ("kind", "fault".into())]);
    let plane = [
        ("through", through.into()),
        ("dip_deg", rounded(dip, 5).into()),
        ("azimuth_deg", azimuth.into()),
    ];
    if draws.chance(0.3) {
        let mut listric = table(plane);
        set(
            &mut listric,
            "depth",
            rounded(height * draws.within(0.6, 4.0), 5),
        );
        if draws.chance(0.4) {
            set(&mut listric, "form", "exponential");
        }
        set(&mut fault, "surface", table([("listric", listric.into())]));
        set(
            &mut fault,
            "heave",
            rounded(throw / dip.to_radians().tan(), 4),
        );
        if draws.chance(0.3) {
            set(&mut fault, "shear_deg", rounded(draws.within(0.0, 25.0), 3));
        }
        return fault;
    }
    set(
        &mut fault,
        "surface",
        table([("dipping", table(plane).into())]),
    );
    if draws.chance(0.2) {
        // Along strike, as far from the fault's ends as it takes.
        let along: Vec<Value> = [0.0, 0.5, 1.0]
            .into_iter()
            .map(|part| Value::from(vec![part, rounded(throw * draws.within(0.5, 1.5), 4)]))
            .collect();
        set(&mut fault, "throw", along);
    } else {
        set(&mut fault, "throw", rounded(throw, 4));
    }
    if draws.chance(0.2) {
        set(
            &mut fault,
            "rake_deg",
            draws.pick(&[90.0, -60.0, -110.0, 70.0]),
        );
    }
    fault
}

/// Beds ten metres apart, throws of five, ten and twenty, faults through corners of the domain, or that cross on a horizon.
pub(super) fn round(draws: &mut Draws) -> Table {
    let block = Block {
        x: [0.0, 400.0],
        y: [0.0, 300.0],
        z: [-60.0, 0.0],
    };
    let mut features = Vec::new();
    for (at, level) in [-50.0, -40.0, -30.0, -20.0].into_iter().enumerate() {
        let mut bed = feature(&format!("bed-{at}"), "horizon", draws.pick(&FACIES));
        set(&mut bed, "surface", table([("level", Value::from(level))]));
        features.push(bed);
    }
    if draws.chance(0.4) {
        let mut nodule = feature("nodule", "ellipsoid", "gravel");
        set(
            &mut nodule,
            "center",
            vec![200.0, 150.0, draws.pick(&[-40.0, -30.0, -25.0])],
        );
        set(&mut nodule, "semi_axes", vec![40.0, 30.0, 10.0]);
        features.push(nodule);
    }
    if draws.chance(0.4) {
        let mut river = feature("river", "channel", "sand");
        set(&mut river, "width", 60.0);
        set(&mut river, "depth", 10.0);
        set(&mut river, "top", draws.pick(&[0.0, -10.0, -20.0]));
        let trajectory = [
            ("kind", "line".into()),
            ("azimuth_deg", draws.pick(&[0.0, 45.0, 90.0]).into()),
            ("center", vec![200.0, 150.0].into()),
        ];
        set(&mut river, "trajectory", table(trajectory));
        features.push(river);
    }
    let faults = draws.count(1, 2);
    for at in 0..faults {
        let azimuth = match at {
            0 => draws.pick(&[0.0, 90.0, 45.0]),
            _ => draws.pick(&[180.0, 270.0, 225.0]),
        };
        let through = draws.pick(&[
            [200.0, 150.0, -30.0],
            [200.0, 150.0, 0.0],
            [0.0, 0.0, -60.0],
            [400.0, 0.0, 0.0],
            [100.0, 150.0, -60.0],
        ]);
        let plane = [
            ("through", through.to_vec().into()),
            ("dip_deg", draws.pick(&[90.0, 60.0, 45.0]).into()),
            ("azimuth_deg", azimuth.into()),
        ];
        let mut fault = table([
            ("id", format!("fault-{at}").into()),
            ("kind", "fault".into()),
        ]);
        set(
            &mut fault,
            "surface",
            table([("dipping", table(plane).into())]),
        );
        set(&mut fault, "throw", draws.pick(&[5.0, 10.0, 20.0]));
        if draws.chance(0.2) {
            set(&mut fault, "rake_deg", 90.0);
        }
        features.push(fault);
    }
    if draws.chance(0.3) {
        let mut seal = feature("seal", "horizon", "mud");
        set(&mut seal, "surface", table([("level", Value::from(-10.0))]));
        features.push(seal);
    }
    whole(block.table("mud"), features)
}

/// Beds and bodies that one fold bends, as far as an overhang.
pub(super) fn folded(draws: &mut Draws) -> Table {
    let block = block(draws);
    let [east, north, height] = block.size();
    let mut features = Vec::new();
    let beds = draws.count(1, 3);
    for at in 0..beds {
        let part = 0.2 + 0.5 * (at as f64 + draws.within(0.2, 0.8)) / beds as f64;
        let mut bed = feature(&format!("bed-{at}"), "horizon", draws.pick(&FACIES));
        set(
            &mut bed,
            "surface",
            table([("level", rounded(block.elevation(part), 7).into())]),
        );
        features.push(bed);
    }
    if draws.chance(0.5) {
        let place = draws.count(0, features.len());
        let body = if draws.chance(0.5) {
            channel(draws, &block, "body")
        } else {
            ellipsoid(draws, &block, "body", None)
        };
        features.insert(place, body);
    }
    let mut fold = table([("id", "fold".into()), ("kind", "fold".into())]);
    set(
        &mut fold,
        "azimuth_deg",
        rounded(draws.within(0.0, 360.0), 5),
    );
    if draws.chance(0.6) {
        let axial = draws.within(8.0, 35.0);
        let overhangs = 1.0 / (axial.to_radians().sin() * axial.to_radians().cos());
        let pair = [
            ("height", rounded(height * draws.within(0.2, 0.5), 4).into()),
            (
                "tightness",
                rounded(overhangs * draws.within(1.3, 3.0), 4).into(),
            ),
        ];
        set(&mut fold, "axial_dip_deg", rounded(axial, 4));
        set(&mut fold, "pair", table(pair));
    } else {
        let train = [
            (
                "amplitude",
                rounded(height * draws.within(0.05, 0.3), 4).into(),
            ),
            (
                "wavelength",
                rounded(east.max(north) * draws.within(0.3, 1.0), 4).into(),
            ),
        ];
        set(
            &mut fold,
            "axial_dip_deg",
            rounded(draws.within(60.0, 90.0), 4),
        );
        set(&mut fold, "train", table(train));
    }
    features.push(fold);
    if draws.chance(0.4) {
        let azimuth = draws.within(0.0, 360.0);
        features.push(fault(draws, &block, "fault", azimuth, [0.5, 0.5]));
    }
    whole(block.table("mud"), features)
}
