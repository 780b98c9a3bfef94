//! What an ensemble says: the same as its realisations say one by one.

use super::{QUICK, Sandbox, assert_same, files, json, table};

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

#[test]
fn realisations_are_those_of_build_and_the_same_for_any_number_of_workers() {
    let sandbox = Sandbox::of(QUICK);
    sandbox.answer("ensemble model.toml --seeds 4..9 --workers 1 -o one --quiet");
    sandbox.answer("ensemble model.toml --seeds 4..9 --workers 5 -o five --quiet");
    let one = files(&sandbox, "one");
    assert_same(&one, &files(&sandbox, "five"));
    sandbox.answer("build model.toml --seed 6 --formats none -o build --quiet");
    let built = files(&sandbox, "build");
    for name in ["report.json", "volumes.csv"] {
        assert!(
            built[name] == one[&format!("realisations/0003/{name}")],
            "{name}"
        );
    }
    // As many as asked, and with more asked those are kept.
    let answer = sandbox.answer("ensemble model.toml --seeds 4..10 -o one");
    assert!(
        answer.contains("7 of 7 realisations") && answer.contains("6 were there from before"),
        "{answer}"
    );
}

#[test]
fn the_table_has_what_the_reports_have_and_quantiles_are_its() {
    let sandbox = Sandbox::of(QUICK);
    sandbox.answer("ensemble model.toml -n 21 --quiet -o out");
    let files = files(&sandbox, "out");
    let rows = table(&files, "realisations.csv");
    assert_eq!(rows.len(), 21);
    let mut sizes = Vec::new();
    for row in &rows {
        let report = json(
            &files,
            &format!("realisations/{}/report.json", row["realisation"]),
        );
        assert_eq!(row["seed"], report["model"]["seed"].to_string());
        let young = &report["volumes"].as_array().unwrap()[2];
        assert_eq!(young["name"], "young-channel");
        assert_eq!(
            number(&row["drawn.young-channel.width"]),
            young["drawn"]["width"].as_f64().unwrap()
        );
        assert_eq!(
            number(&row["feature.young-channel.volume_m3"]),
            young["volume_m3"].as_f64().unwrap()
        );
        let pores = report["totals"]["pore_volume_m3"].as_f64().unwrap();
        assert_eq!(number(&row["pore_volume_m3"]), pores);
        assert_eq!(
            number(&row["net_to_gross"]),
            report["net_to_gross"].as_f64().unwrap()
        );
        sizes.push((pores, row["realisation"].clone()));
    }
    // Of 21 values in order, type 7 has P90 at the third, P50 at the eleventh, P10 at the nineteenth.
    sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let quantiles = table(&files, "quantiles.csv");
    let pores = quantiles
        .iter()
        .find(|row| row["measure"] == "pore_volume_m3")
        .unwrap();
    assert_eq!(pores["n"], "21");
    for (name, at) in [
        ("min", 0),
        ("low_p90", 2),
        ("mid_p50", 10),
        ("high_p10", 18),
        ("max", 20),
    ] {
        assert!(
            (number(&pores[name]) - sizes[at].0).abs() < 1e-9 * sizes[at].0,
            "{name}"
        );
    }
    let summary = json(&files, "summary.json");
    let scenario = &summary["scenarios"][0];
    assert_eq!(scenario["nearest_p50"]["realisation"], sizes[10].1.as_str());
    assert_eq!(summary["warnings"].as_array().unwrap().len(), 0);
    // A channel is the wider the more sand there is, and width is all that is drawn of its size.
    let strongest = &scenario["rank_correlations"][0];
    assert_eq!(strongest["parameter"], "young-channel.width");
    assert!(
        strongest["rank_correlation"].as_f64().unwrap() > 0.8,
        "{strongest}"
    );
    let page = String::from_utf8(files["summary.html"].clone()).unwrap();
    assert!(page.contains("<svg") && !page.contains("src=") && !page.contains("href="));
    assert!(files["tornado.png"].starts_with(b"\x89PNG"));
}

#[test]
fn a_design_sets_what_its_table_says_and_nothing_else_is_drawn() {
    let sandbox = Sandbox::of(QUICK);
    let design = "feature.old-channel.width,feature.young-channel.width\n50,40\n60,40\n70,41\n";
    std::fs::write(sandbox.path("design.csv"), design).unwrap();
    let output = sandbox.run("ensemble model.toml --design design.csv -o out");
    assert!(output.status.success());
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(
        errors.contains("3 realisation(s) are too few for P90 and P10"),
        "{errors}"
    );
    let rows = table(&files(&sandbox, "out"), "realisations.csv");
    let widths: Vec<&str> = rows
        .iter()
        .map(|row| row["design.feature.old-channel.width"].as_str())
        .collect();
    assert_eq!(widths, ["50", "60", "70"]);
    assert!(rows.iter().all(|row| row["seed"] == "1"));
    // The older channel is straight and at its full depth: its section is in proportion to its width.
    let young = |row: usize| number(&rows[row]["feature.young-channel.volume_m3"]);
    // What the older one is does not matter to it, but for where faces are cut for the integral.
    assert!((young(0) - young(1)).abs() < 1e-6);
    assert!(young(2) > young(1));
    let old = |row: usize| number(&rows[row]["feature.old-channel.volume_m3"]);
    assert!(old(0) < old(1) && old(1) < old(2));
}

#[test]
fn a_hypercube_has_a_draw_in_every_stratum_and_each_can_be_made_alone() {
    let sandbox = Sandbox::of(QUICK);
    sandbox.answer("ensemble model.toml -n 20 --latin-hypercube --quiet -o out");
    let files = super::files(&sandbox, "out");
    let rows = table(&files, "realisations.csv");
    // The distribution function of the triangular distribution from 40 to 60 about 50.
    let share = |width: f64| {
        if width < 50.0 {
            (width - 40.0).powi(2) / 200.0
        } else {
            1.0 - (60.0 - width).powi(2) / 200.0
        }
    };
    let mut strata: Vec<i64> = rows
        .iter()
        .map(|row| (share(number(&row["drawn.young-channel.width"])) * 20.0).floor() as i64)
        .collect();
    strata.sort_unstable();
    assert_eq!(strata, (0..20).collect::<Vec<_>>());
    sandbox.answer("build model.toml --seed 7 --stratum 7/20 --formats none -o build --quiet");
    let built = super::files(&sandbox, "build");
    assert!(built["report.json"] == files["realisations/0007/report.json"]);
}

#[test]
fn scenarios_differ_by_what_they_change_and_by_no_draw() {
    let sandbox = Sandbox::of(QUICK);
    let scenarios = [
        "--scenario",
        "all:",
        "--scenario",
        "young: --without old-channel",
        "--scenario",
        "deep: --set feature.young-channel.depth=8",
    ];
    let output = sandbox
        .command()
        .args("ensemble model.toml -n 5 --quiet -o out".split(' '))
        .args(scenarios)
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let files = files(&sandbox, "out");
    let rows = table(&files, "realisations.csv");
    assert_eq!(rows.len(), 15);
    for at in 0..5 {
        let of = |scenario: usize| &rows[5 * scenario + at];
        let names: Vec<&str> = (0..3).map(|one| of(one)["scenario"].as_str()).collect();
        assert_eq!(names, ["all", "young", "deep"]);
        for name in ["seed", "drawn.young-channel.width"] {
            assert!((1..3).all(|scenario| of(scenario)[name] == of(0)[name]));
        }
        // The younger channel takes from the older one, so it has the same volume without that.
        let young = |scenario| number(&of(scenario)["feature.young-channel.volume_m3"]);
        assert!((young(1) - young(0)).abs() < 1e-8 * young(0));
        assert!(young(2) > 1.5 * young(0));
        assert_eq!(of(1)["feature.old-channel.volume_m3"], "");
    }
    assert!(files.contains_key("scenarios.svg") && files.contains_key("tornado-deep.png"));
}

#[test]
fn parts_that_were_made_apart_are_one_ensemble_once_they_are_put_together() {
    let sandbox = Sandbox::of(QUICK);
    for (seeds, folder) in [("1..6", "whole"), ("1..3", "first"), ("4..6", "second")] {
        sandbox.answer(&format!(
            "ensemble model.toml --seeds {seeds} --quiet -o {folder}"
        ));
    }
    // Those of the second part are numbered from 1, too.
    for (from, to) in [("0001", "0004"), ("0002", "0005"), ("0003", "0006")] {
        let from = sandbox.path(&format!("second/realisations/{from}"));
        std::fs::rename(from, sandbox.path(&format!("first/realisations/{to}"))).unwrap();
    }
    sandbox.answer("ensemble model.toml --seeds 1..6 --quiet -o first");
    let run = std::fs::read_to_string(sandbox.path("first/run.json")).unwrap();
    let run: serde_json::Value = serde_json::from_str(&run).unwrap();
    assert_eq!((&run["made_now"], &run["kept"]), (&0.into(), &6.into()));
    assert_same(&files(&sandbox, "whole"), &files(&sandbox, "first"));
}
