//! What is asked wrongly is told before anything is made, and leaves nothing.

use super::{QUICK, Sandbox};

#[test]
fn wrong_arguments_are_told_with_what_to_write() {
    let sandbox = Sandbox::of(QUICK);
    for (arguments, told) in [
        ("ensemble model.toml", "how many realisations? write -n 100"),
        ("ensemble model.toml -n 0", "-n"),
        ("ensemble model.toml --seeds 5..1", "`5..1` are no seeds"),
        ("ensemble model.toml --seeds 1-5", "`1-5` are no seeds"),
        ("ensemble model.toml -n 2 --workers 0", "--workers"),
        ("ensemble model.toml -n 2 --time-limit 0", "`0` is no time"),
        (
            "ensemble model.toml -n 2 --memory-limit 0",
            "--memory-limit",
        ),
        ("ensemble model.toml -n 2 --scenario a", "`a` has no name"),
        (
            "ensemble model.toml -n 2 --scenario a: --scenario a:",
            "two scenarios are called `a`",
        ),
        ("ensemble model.toml -n 2 --without nothing", "nothing"),
        ("ensemble model.toml -n 2 --write tables,dwg", "dwg"),
        (
            "ensemble model.toml -n 2 --stratum 1/2",
            "--latin-hypercube",
        ),
        (
            "ensemble model.toml -n 2 --set feature.old-chanel.width=5",
            "old-channel",
        ),
        ("ensemble - -n 2", "save it as a file"),
        ("ensemble none.toml -n 2", "none.toml"),
        (
            "ensemble model.toml -n 2 -o model.toml",
            "model.toml is a file",
        ),
        (
            "ensemble model.toml --design none.csv",
            "none.csv: the design table cannot be read",
        ),
    ] {
        let errors = sandbox.refusal(arguments, 1);
        assert!(errors.contains(told), "{arguments}: {errors}");
    }
    let scenario = [
        "ensemble",
        "model.toml",
        "-n",
        "2",
        "--scenario",
        "a: --without what",
    ];
    let output = sandbox.command().args(scenario).output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        errors.contains("scenario `a`") && errors.contains("what"),
        "{errors}"
    );
}

#[test]
fn a_wrong_row_of_a_design_is_told_by_row_and_column_and_nothing_is_made() {
    let sandbox = Sandbox::of(QUICK);
    for (design, told) in [
        (
            "seed,feature.old-channel.width\n1,30\n2,-30\n",
            "design.csv, row 2 (line 3), column `feature.old-channel.width`:",
        ),
        (
            "feature.old-chanel.width\n30\n",
            "row 1 (line 2), column `feature.old-chanel.width`: the model has no feature `old-chanel`; did you mean \"old-channel\"?",
        ),
        (
            "feature.old-channel.width\n30\n\"\"\n",
            "row 2 (line 3), column `feature.old-channel.width`: the cell is empty",
        ),
        ("seed,domain.z\n1,2,3\n", "line 2"),
    ] {
        std::fs::write(sandbox.path("design.csv"), design).unwrap();
        let errors = sandbox.refusal("ensemble model.toml --design design.csv", 1);
        assert!(errors.contains(told), "{errors}");
    }
}

#[test]
fn a_folder_of_something_else_or_of_another_ensemble_is_left_alone() {
    let sandbox = Sandbox::of(QUICK);
    std::fs::create_dir(sandbox.path("thesis")).unwrap();
    std::fs::write(sandbox.path("thesis/text"), "ten years of work").unwrap();
    let errors = sandbox.refusal("ensemble model.toml -n 1 -o thesis", 1);
    assert!(
        errors.contains("holds things that are no ensemble"),
        "{errors}"
    );
    sandbox.answer("ensemble model.toml -n 1 --quiet -o out");
    let errors = sandbox.refusal("ensemble model.toml -n 1 -o out --set domain.z=[-30,0]", 1);
    assert!(errors.contains("an ensemble with another set"), "{errors}");
    let text = std::fs::read_to_string(sandbox.path("model.toml")).unwrap();
    std::fs::write(sandbox.path("model.toml"), text + "\n# changed\n").unwrap();
    let errors = sandbox.refusal("ensemble model.toml -n 1 -o out", 1);
    assert!(
        errors.contains("an ensemble with another model"),
        "{errors}"
    );
    sandbox.answer("ensemble model.toml -n 1 --quiet -o out --force");
}
