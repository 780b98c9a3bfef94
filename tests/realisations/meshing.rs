//! What is told of meshing.

use clinothem::model::meshing;
use clinothem::model::realisation::Instance;

use super::realise;

#[test]
fn what_is_hard_to_mesh_is_told_with_what_to_set() {
    const COASTAL: &str = include_str!("../../models/coastal/coastal.toml");
    let advice = |overrides: &[&str]| meshing::advice(&realise(COASTAL, overrides));
    let told = advice(&[]);
    let realisation = realise(COASTAL, &[]);
    let width = |one: &Instance| one.drawn.iter().find(|(name, _)| name == "width").cloned();
    let narrowest = realisation
        .instances
        .iter()
        .filter_map(|one| Some((width(one)?.1, realisation.volumes[one.volume].name.as_str())))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap();
    let size = format!(
        "`Mesh.MeshSizeMax = {:.1}` (half the width of the narrowest one, {})",
        0.5 * narrowest.0,
        narrowest.1
    );
    assert!(told.len() == 2 && told[0].contains(&size), "{told:?}");
    // A width that is not drawn counts, too.
    let given = advice(&["feature.channel.width=12"]);
    assert!(
        given[0].contains("`Mesh.MeshSizeMax = 6.0` (half"),
        "{given:?}"
    );
    assert!(told[1].starts_with("lower, upper: ") && told[1].contains("`toe = 0.3`"));
    // What it says to set is what makes it silent.
    let lower = advice(&["feature.lower.toe=0.3"]);
    assert!(lower[1].starts_with("upper: "), "{lower:?}");
    let both = advice(&["feature.lower.toe=0.3", "feature.upper.toe=0.1"]);
    assert_eq!(both.len(), 1, "{both:?}");
}
