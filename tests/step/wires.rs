//! Wells as curves that are split where they pass from one volume to another, as `OpenCASCADE` reads them.

use clinothem::export::step::{Protocol, write_wells};
use clinothem::export::wells::entries::{WellEntry, Wells};
use clinothem::model::Model;
use clinothem::model::owner::Owners;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::wells::log::Logger;
use occt_bridge::{ShapeKind, bounds};

use super::Written;
use super::assembled::{checked, source};
use super::entities::Entities;

fn written(model: &Model) -> (Written, Vec<WellEntry>) {
    let realisation = Realisation::new(model, &Selection::default()).unwrap();
    let owners = Owners::new(&realisation).unwrap();
    let logger = Logger::new(&realisation, &owners).unwrap();
    let wells = Wells {
        model,
        realisation: &realisation,
    };
    let entries = wells.all(&logger);
    let pairs: Vec<_> = model.wells.iter().zip(&entries).collect();
    let file =
        Written::save(|path| write_wells(path, model, &realisation, &pairs, Protocol::Ap214));
    (file, entries)
}

#[test]
fn each_interval_of_a_well_is_a_wire_with_its_name_colour_and_layer() {
    let model = checked(&source("fig02-wells/fig02-wells"));
    let (file, entries) = written(&model);
    Entities::of(&file.text()).check();
    let parts = file.read();
    let mut expected = Vec::new();
    for well in &entries {
        for (number, one) in well.intervals.iter().enumerate() {
            let volume = one.volume.as_deref().unwrap_or("outside");
            expected.push((
                format!("{} {}: {volume}", well.name, number + 1),
                one.clone(),
            ));
        }
    }
    assert!(expected.len() > 40, "{}", expected.len());
    assert_eq!(parts.len(), expected.len());
    for (part, (name, interval)) in parts.iter().zip(&expected) {
        assert_eq!(&part.name, name);
        assert_eq!(part.shape.count(ShapeKind::Edge).unwrap(), 1, "{name}");
        assert_eq!(part.shape.count(ShapeKind::Face).unwrap(), 0, "{name}");
        let facies = interval.facies.as_deref();
        assert_eq!(part.layer.as_deref(), facies, "{name}");
        let facies = model.facies.iter().find(|one| Some(&*one.name) == facies);
        let color = facies.map(|one| [one.color.r, one.color.g, one.color.b]);
        assert_eq!(part.color, color, "{name}");
        // A well that goes down is as high as its depths say.
        let found = bounds(&part.shape).unwrap();
        let [upper, lower] = interval.tvdss_m;
        let sea = -model.origin[2];
        let slack = 1e-4 + 0.2 * f64::from(u8::from(name.starts_with("A-3")));
        assert!((found.max[2] - (sea - upper)).abs() < slack, "{name}");
        assert!((found.min[2] - (sea - lower)).abs() < slack, "{name}");
    }
    // Paths are in a tree: the well, then its intervals.
    assert!(
        parts[0].path.contains("/A-1/A-1 1: outside"),
        "{}",
        parts[0].path
    );
}

#[test]
fn a_lateral_of_a_lateral_begins_where_it_leaves_that_and_a_model_without_wells_has_no_file() {
    let text = r#"
name = "Laterals"
[domain]
x = [0, 1000]
y = [0, 1000]
z = [-1000, 0]
facies = "mud"
[facies.mud]
[[well]]
id = "A"
head = [500, 500]
survey = [{ md = 0, inc_deg = 0, azi_deg = 0 }, { md = 900, inc_deg = 0, azi_deg = 0 }]
laterals = [{ id = "north", at_md = 400, survey = [{ md = 460, inc_deg = 20, azi_deg = 0 }, { md = 700, inc_deg = 70, azi_deg = 0 }], laterals = [
  { id = "deep", at_md = 600, survey = [{ md = 660, inc_deg = 40, azi_deg = 20 }, { md = 800, inc_deg = 40, azi_deg = 60 }], completions = [[700, 750]] },
] }]
"#;
    let model = super::assembled::from_text(text, &[]);
    let names: Vec<&str> = model.wells.iter().map(|well| well.name.as_str()).collect();
    assert_eq!(names, ["A", "A/north", "A/north/deep"]);
    let mothers: Vec<Option<usize>> = model.wells.iter().map(|well| well.mother).collect();
    assert_eq!(mothers, [None, Some(0), Some(1)]);
    let (mother, own) = (&model.wells[1].well, &model.wells[2].well);
    assert_eq!(own.range().0, 600.0);
    let first = own.curve().points()[0];
    // A control point of both, bit for bit, and the same direction.
    assert!(mother.curve().points().contains(&first));
    assert!(mother.point(600.0).distance(first) < 1e-9);
    assert!(mother.tangent(600.0).distance(own.tangent(600.0)) < 1e-6);
    assert_eq!(model.wells[2].completions, [[700.0, 750.0]]);
    let (file, _) = written(&model);
    assert_eq!(file.read().len(), 3);
    let silent = super::assembled::from_text(&text[..text.find("[[well]]").unwrap()], &[]);
    let realisation = Realisation::new(&silent, &Selection::default()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.step");
    let refused = write_wells(&path, &silent, &realisation, &[], Protocol::Ap214).unwrap_err();
    assert!(refused.to_string().contains("no wells"), "{refused}");
    assert!(!path.exists());
}
