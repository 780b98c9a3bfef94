//! Control nets of one's own.

use clinothem::model::Format;

use super::{Edit, check_edits};

const NETS: &str = include_str!("nets.toml");

/// The same for sheets and bodies from control nets.
#[rustfmt::skip]
const NET_EDITS: &[Edit] = &[
    ("kind = \"sheet\"", "kind = ▸\"sheets\"", &["no kind of feature \"sheets\"", "did you mean \"sheet\"?"]),
    ("at = [0, 0, 1]", "at = ▸[0, 1]", &["expected a list of three for the at of feature \"fold\", found a list of 2"]),
    ("azimuth_deg = 0", "azimuth_deg = ▸500", &["the azimuth_deg of feature \"fold\" is 500"]),
    ("azimuth_deg = 0", "azimuth_deg = 0\n▸net = 3", &["unknown key `net` in feature \"fold\"", "did you mean `nets`?"]),
    ("degree = [1, 2]", "degree = ▸0", &["the degree of net 1 of feature \"fold\" is 0; it must lie between 1 and 7"]),
    ("degree = [1, 2]", "degree = [1, ▸8]", &["the degree of net 1 of feature \"fold\" is 8"]),
    ("degree = [1, 2]", "degree = ▸[1]", &["expected a degree, or two, for net 1 of feature \"fold\", found a list of 1"]),
    ("degree = [1, 2]", "degree = [2, 2]", &["from row to row", "2 control points are too few for degree 2"]),
    ("degree = [1, 2]", "▸degrees = [1, 2]", &["unknown key `degrees` in net 1 of feature \"fold\"", "did you mean `degree`?"]),
    ("[[50, -5, -10], [50, 50, -12], [50, 105, -10]]", "▸[[50, -5, -10], [50, 50, -12]]", &["row 2 of net 1 of feature \"fold\" has 2 points, the first row 3", "as many points"]),
    ("[-5, 50, -20]", "▸[-5, 50]", &["expected a list of 3 numbers, found 2"]),
    ("[-5, 50, -20]", "[-5, 50, ▸nan]", &["NaN is not a finite number"]),
    ("points = [[[-5, -5, -10], [-5, 50, -20], [-5, 105, -10]], [[50, -5, -10], [50, 50, -12], [50, 105, -10]]]", "points = ▸[[[-5, -5, -10], [-5, 50, -20]]]", &["expected a list of two rows or more for the points of net 1", "found a list of 1"]),
    ("points = [[[-5, -5, -10], [-5, 50, -20], [-5, 105, -10]], [[50, -5, -10], [50, 50, -12], [50, 105, -10]]]\n", "", &["net 1 of feature \"fold\" has no `points`"]),
    ("weights = [[1, 2, 1], [1, 1, 1]]", "weights = [[1, 0, 1], [1, 1, 1]]", &["the weight of point 2 in row 1 is 0; weights must be above 0"]),
    ("weights = [[1, 2, 1], [1, 1, 1]]", "weights = [[1, 2, 1], [1, 1]]", &["row 2 of its weights has 2 entries, the first row 3"]),
    ("weights = [[1, 2, 1], [1, 1, 1]]", "weights = [[1, 2, 1]]", &["has 2 rows of points, but 1 of weights"]),
    ("weights = [[1, 2, 1], [1, 1, 1]]", "weights = ▸3", &["expected a list of rows for the weights of net 1"]),
    ("knots = [[], [0, 0, 0, 1, 1, 1]]", "knots = [[], [0, 0, 0, 1, 1]]", &["along the rows it has 3 points and degree 2, so 6 knots, but 5 are given"]),
    ("knots = [[], [0, 0, 0, 1, 1, 1]]", "knots = [[], [0, 0, 0, 1, 0.5, 1]]", &["along the rows", "below the previous knot"]),
    ("knots = [[], [0, 0, 0, 1, 1, 1]]", "knots = ▸[[]]", &["expected two lists for the knots of net 1", "[] stands for even ones"]),
    ("name = \"east\"", "name = ▸\"west\"", &["net 2 of feature \"fold\" has the name \"west\" of an earlier one"]),
    ("name = \"east\"", "name = ▸\"the east\"", &["is no name", "letters, digits"]),
    ("to = \"west\"", "to = ▸\"wets\"", &["net 2 of feature \"fold\" is joined to \"wets\", which is no net before it", "did you mean \"west\"?"]),
    ("to = \"west\", ", "", &["the `joins` of net 2 of feature \"fold\" has no `to`"]),
    ("own = \"first-row\"", "own = ▸\"left\"", &["\"left\" is no side of a net", "\"first-row\""]),
    ("side = \"last-row\"", "side = ▸\"row\"", &["\"row\" is no side of a net"]),
    ("smooth = true", "smooth = ▸\"yes\"", &["expected true or false"]),
    ("smooth = true", "smooth = true, ▸angle = 3", &["unknown key `angle` in the `joins` of net 2"]),
];

#[test]
fn broken_nets_are_refused() {
    check_edits(NET_EDITS, NETS, "nets.toml", Format::Toml);
    let body = NETS.replace("kind = \"sheet\"", "kind = \"body\"");
    check_edits(&NET_EDITS[1..], &body, "nets.toml", Format::Toml);
}

#[test]
fn a_feature_has_nets() {
    let none = "name = \"None\"\n[domain]\nx = [0, 1]\ny = [0, 1]\nz = [0, 1]\nfacies = \"mud\"\n[facies.mud]\n[[feature]]\nid = \"lens\"\nkind = \"body\"\nfacies = \"mud\"\nnets = ▸[]\n";
    let edits: &[Edit] = &[
        (
            "nets = ▸[]",
            "nets = ▸[]",
            &[
                "expected a net, or a list of nets, for the nets of feature \"lens\", found an empty list",
            ],
        ),
        ("nets = ▸[]\n", "", &["feature \"lens\" has no `nets`"]),
    ];
    check_edits(edits, none, "none.toml", Format::Toml);
}
