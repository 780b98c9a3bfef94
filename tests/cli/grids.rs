//! Grids: what is refused with a reason, and what is left in the folder.

use crate::sandbox::{STRAIGHT, Sandbox};

#[test]
fn wrong_grids_are_refused_with_1_and_leave_nothing() {
    let sandbox = Sandbox::new(STRAIGHT);
    for (arguments, reason) in [
        ("grid", "MODEL"),
        ("grid model.toml --cells 0x10x10", "0 cells along x"),
        ("grid model.toml --cells 10x10x0", "0 cells along z"),
        ("grid model.toml --cells -1x10x10", "-1x10x10"),
        ("grid model.toml --cells 10x10", "along 2 axes"),
        ("grid model.toml --cells 10", "whole numbers"),
        ("grid model.toml --cells 10x10x10x10", "whole numbers"),
        ("grid model.toml --cells nanx1x1", "whole numbers"),
        ("grid model.toml --cells 1.5x1x1", "whole numbers"),
        (
            "grid model.toml --cells 99999999999999999999x1x1",
            "whole numbers",
        ),
        ("grid model.toml --cells 5000000x1x1", "along x"),
        ("grid model.toml --cells 100000x100000x1000", "--most-gb"),
        ("grid model.toml --cell 0x1x1", "size along x is 0"),
        ("grid model.toml --cell 1x-2x1", "size along y is -2"),
        ("grid model.toml --cell 1x1xnan", "nan"),
        ("grid model.toml --cell 1x1xinf", "inf"),
        ("grid model.toml --cell 1e-9x1x1", "larger cells"),
        ("grid model.toml --cell 0.01x0.01x0.01", "GB"),
        (
            "grid model.toml --cell 1x1x1 --cells 1x1x1",
            "cannot be used with",
        ),
        ("grid model.toml --formats vtu", "vtu"),
        (
            "grid model.toml --layers 3 --formats vti",
            "vti holds boxes",
        ),
        (
            "grid model.toml --layers 3 --cells 10x10x10",
            "with --layers",
        ),
        ("grid model.toml --layers 0", "0 layers in background"),
        ("grid model.toml --layers -1", "-1"),
        (
            "grid model.toml --layers 1,2",
            "2 numbers of layers and 1 intervals",
        ),
        ("grid model.toml --layers 18446744073709551615", "--most-gb"),
        ("grid model.toml --samples 0", "cube"),
        ("grid model.toml --samples 9", "cube"),
        ("grid model.toml --samples -8", "cube"),
        ("grid model.toml --most-gb 0", "0 GB"),
        ("grid model.toml --most-gb nan", "nan"),
        ("grid model.toml -o model.toml", "is a file"),
        ("grid model.toml --without nobody", "nobody"),
        ("grid no-such.toml", "no such file"),
    ] {
        let errors = sandbox.refusal(arguments, 1);
        assert!(
            errors.to_lowercase().contains(&reason.to_lowercase()),
            "`{arguments}` should speak of `{reason}`: {errors}"
        );
    }
}

#[test]
fn a_place_that_cannot_be_written_to_is_refused_with_3() {
    let sandbox = Sandbox::new(STRAIGHT);
    let errors = sandbox.refusal("grid model.toml --cells 2x2x2 -o model.toml/out", 3);
    assert!(errors.contains("model.toml/out"), "{errors}");
    // Where a folder stands in the place of a result, what could be written stays away as well.
    std::fs::create_dir_all(sandbox.path("out/model.vti/in")).unwrap();
    let errors = sandbox.refusal("grid model.toml --cells 2x2x2 -o out", 3);
    assert!(errors.contains("model.vti"), "{errors}");
}

#[test]
fn a_grid_leaves_its_files_and_nothing_else_beside_what_was_there() {
    let sandbox = Sandbox::new(STRAIGHT);
    std::fs::create_dir(sandbox.path("out")).unwrap();
    std::fs::write(sandbox.path("out/thesis.txt"), "mine").unwrap();
    let formats = "vti,npy,gslib,sgems,grdecl,vti";
    let said = sandbox.answer(&format!(
        "grid model.toml --cells 6x4x5 --formats {formats} -o out"
    ));
    assert!(
        said.contains("6 × 4 × 5 cells of 100 m × 100 m × 4 m"),
        "{said}"
    );
    let names: Vec<String> = sandbox
        .files()
        .iter()
        .map(|(path, _)| path.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(
        names,
        [
            "model.toml",
            "out",
            "model.facies.npy",
            "model.grdecl",
            "model.grid.csv",
            "model.grid.json",
            "model.gslib",
            "model.sgems",
            "model.volume.npy",
            "model.vti",
            "thesis.txt",
        ]
    );
    sandbox.assert_no_temporaries();
    let key = sandbox.json("grid model.toml --cells 60x40x20 -o again --json");
    // The ditch is 0.728487 of 60 m × 8 m; cells of 10 m × 1 m make it to some percent.
    let share = key["facies"][1]["fraction"].as_f64().unwrap();
    let exact = 0.728_487 * 60.0 * 8.0 / (400.0 * 20.0);
    assert!((share / exact - 1.0).abs() < 0.1, "{share} {exact}");
    assert_eq!(key["volumes"][1]["volume"], "ditch");
}
