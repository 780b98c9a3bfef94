//! Sections of channels.

use clinothem::model::Format;

use super::{Edit, check_edits};

const SECTION: &str = include_str!("section.toml");

/// The same for sections.
#[rustfmt::skip]
const SECTION_EDITS: &[Edit] = &[
    ("points = [[-0.5, 0], [-0.25, -1], [0, -1], [0.25, -1], [0.5, 0]]", "", &["no `points`"]),
    ("points = [[-0.5, 0], [-0.25, -1], [0, -1], [0.25, -1], [0.5, 0]]", "points = ▸5", &["expected a list of points for the section of feature \"channel\""]),
    ("[-0.25, -1]", "▸[-0.25]", &["expected a point [x, y] of the section of feature \"channel\""]),
    ("[-0.25, -1]", "[-0.25, ▸\"deep\"]", &["number"]),
    ("[-0.25, -1]", "▸[-25, -1]", &["point 2 is [-25, -1]", "x counts in widths"]),
    ("[-0.5, 0]", "▸[-0.4, 0]", &["point 1, a rim, is [-0.4, 0]", "the first point must be [-0.5, 0]"]),
    ("[0.5, 0]]", "▸[0.5, 0.1]]", &["point 5, a rim, is [0.5, 0.1]"]),
    ("[0, -1], [0.25, -1]", "[0, -1], ▸[0, -1]", &["points 3 and 4 are the same"]),
    ("points = [[-0.5, 0], [-0.25, -1], [0, -1], [0.25, -1], [0.5, 0]]", "points = [[-0.5, 0], [-0.25, -1], [0, -1], [0.25, -1], [0.5, 0]]\n▸width_of = 1", &["unknown key `width_of`"]),
    ("[0, -1], [0.25, -1]", "[0.4, -0.2], [-0.6, -0.2]", &["meets itself near point", "must not cross or touch itself"]),
    ("[0, -1], [0.25, -1]", "[0, 1], [0.25, -1]", &["meets its own top near point"]),
    ("[-0.25, -1], [0, -1], [0.25, -1]", "[-0.25, 1], [0, 1], [0.25, 1]", &["rises above its rims near point"]),
    ("degree = 1", "degree = ▸0", &["degree is 0", "1 (straight pieces) to 7"]),
    ("degree = 1", "degree = ▸5", &["5 points, but degree 5 needs 6"]),
    ("degree = 1", "degree = 1\nweights = ▸[1, 1]", &["2 weights for 5 points"]),
    ("degree = 1", "degree = 1\nweights = ▸[1, 0, 1, 1, 1]", &["weight 2 is 0", "above 0"]),
    ("degree = 1", "degree = 1\nweights = ▸1", &["expected a list of numbers for the weights"]),
    ("degree = 1", "degree = 1\nknots = ▸[0, 0, 1, 1]", &["4 knots, but 5 points of degree 1 have 7"]),
    ("degree = 1", "degree = 1\nknots = ▸[0, 0, 0.5, 0.4, 0.6, 1, 1]", &["its knots are wrong"]),
    ("degree = 1", "degree = 1\nclose = ▸\"open\"", &["\"open\"", "horizons and clinoforms do"]),
    ("degree = 1", "degree = 1\nclose = \"closed\"", &["point 5, the last one, is [0.5, 0]", "ends where it begins"]),
    ("degree = 1", "degree = 1\ndepth_is = ▸\"greatest\"", &["\"greatest\"", "\"scale\" or \"deepest\""]),
    ("width = 20", "width = 20\nasymmetry = 0.1", &["has both a section of its own and `asymmetry`", "leave out `asymmetry`"]),
    ("width = 20", "width = 20\nleft_angle_deg = 40", &["has both a section of its own and `left_angle_deg`"]),
];

#[test]
fn broken_sections_are_refused() {
    check_edits(SECTION_EDITS, SECTION, "section.toml", Format::Toml);
}
