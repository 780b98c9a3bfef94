//! Files written by hand: what each format says is read as it says it, and what is broken is told with its line.
//!
//! The grid is the same in all formats: 4 columns from x = 100, 10 apart, 3 rows from y = 200, 5 apart, heights −(100 i + j), and no height
//! at (2, 1). No axis and no sign can be swapped without showing.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use glam::{DVec2, DVec3};

use super::*;

const IRAP: &str = "-996 3 10.0 5.0\n100.0 130.0 200.0 210.0\n4 0.0 100.0 200.0\n0 0 0 0 0 0 0\n\
    0 -100 -200 -300 -1 -101\n9999900.0 -301 -2 -102 -202 -302\n";
const ZMAP: &str = "! by hand\n@heights HEADER, GRID, 2\n15, -99999.0, , 4, 1\n3, 4, 100.0, 130.0, 200.0, 210.0\n0.0, 0.0, 0.0\n@\n\
    \x20       -2.0000        -1.0000\n         0.0000\n      -102.0000      -101.0000\n      -100.0000\n\
    \x20     -202.0000    -99999.0000\n      -200.0000\n      -302.0000      -301.0000\n      -300.0000\n";
const CPS3: &str = "FSASCI 0 1 \"Computed\" 0 0.1E+31\nFSATTR 0 0\nFSLIMI 100.0 130.0 200.0 210.0 -302.0 0.0\nFSNROW 3 4\n\
    FSXINC 10.0 5.0\n->heights\n-2 -1 0 -102 -101\n-100 -202 0.1E+31 -200 -302\n-301 -300\n";
const ESRI: &str = "ncols 4\nnrows 3\nxllcenter 100\nyllcenter 200\ndx 10\ndy 5\nNODATA_value -9999\n\
    -2 -102 -202 -302\n-1 -101 -9999 -301\n0 -100 -200 -300\n";
const XYZ: &str = "# x y z\n100 200 0\n110 200 -100\n120 200 -200\n130 200 -300\n100 205 -1\n110 205 -101\n120 205 -999.25\n\
    130 205 -301\n100 210 -2\n110 210 -102\n120 210 -202\n130 210 -302\n";
const CSV: &str = "Name;Northing;Easting;Depth\na;200;100;0\nb;200;110;-100\nc;200;120;-200\nd;200;130;-300\ne;205;100;-1\n\
    f;205;110;-101\ng;205;120;\nh;205;130;-301\ni;210;100;-2\nj;210;110;-102\nk;210;120;-202\nl;210;130;-302,0\n";
const TSURF: &str = "GOCAD TSurf 1\nHEADER {\nname:heights\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Depth\n\
    END_ORIGINAL_COORDINATE_SYSTEM\nTFACE\nVRTX 0 100 200 5\nPVRTX 1 110 200 6 0.3\nVRTX 2 110 205 7\nVRTX 9 0 0 0\nTFACE\nATOM 3 0\n\
    TRGL 0 1 2\nTRGL 3 2 1\nEND\n";

fn heights(text: &str) -> Heights {
    read(text.as_bytes(), &Reading::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Places and heights, from west to east and from south to north.
fn sorted(heights: &Heights) -> Vec<[f64; 3]> {
    let mut all: Vec<[f64; 3]> = heights.samples().map(|s| s.at.to_array()).collect();
    all.sort_by(|a, b| a.partial_cmp(b).unwrap());
    all
}

fn expected() -> Vec<[f64; 3]> {
    let nodes = (0..4).flat_map(|i| (0..3).map(move |j| (i, j)));
    nodes
        .filter(|node| *node != (2, 1))
        .map(|(i, j)| {
            let (i, j) = (f64::from(i), f64::from(j));
            [100.0 + 10.0 * i, 200.0 + 5.0 * j, -(100.0 * i + j)]
        })
        .collect()
}

#[test]
fn every_format_has_the_same_heights_at_the_same_places() {
    for (format, text) in [
        (Format::Irap, IRAP),
        (Format::Zmap, ZMAP),
        (Format::Cps3, CPS3),
        (Format::Esri, ESRI),
        (Format::Csv, CSV),
    ] {
        let heights = heights(text);
        assert_eq!(heights.format, format);
        assert_eq!(sorted(&heights), expected(), "{format:?}");
        assert_eq!(heights.nulls(), 1, "{format:?}");
    }
    let reading = Reading {
        nulls: vec![-999.25],
        ..Reading::default()
    };
    let xyz = read(XYZ.as_bytes(), &reading).unwrap();
    assert_eq!((xyz.format, xyz.nulls()), (Format::Xyz, 1));
    assert_eq!(sorted(&xyz), expected());
}

#[test]
fn line_ends_comments_and_blanks_of_other_systems_change_nothing() {
    for text in [IRAP, ZMAP, CPS3, ESRI, CSV, XYZ, TSURF] {
        let own = heights(text);
        let windows = format!("\u{feff}\r\n{}\r\n\r\n", text.replace('\n', "\r\n"));
        assert_eq!(sorted(&heights(&windows)), sorted(&own), "{text}");
        let tabs = text
            .replace(' ', "\t")
            .replace("GOCAD\tTSurf", "GOCAD TSurf");
        if !text.starts_with('!') {
            assert_eq!(sorted(&heights(&tabs)), sorted(&own), "{text}");
        }
    }
    // Exponents as Fortran writes them, and one height a line.
    let fortran = CPS3
        .replace("0.1E+31", "0.1D+31")
        .replace("-302\n", "-0.302D+03\n");
    assert_eq!(sorted(&heights(&fortran)), expected());
    assert_eq!(sorted(&heights(&IRAP.replace(' ', "\n"))), expected());
    assert_eq!(sorted(&heights(&XYZ.replace(' ', ", "))).len(), 12);
}

#[test]
fn fields_that_touch_or_are_blank_are_read_by_their_width() {
    let touching = "@h, GRID, 3\n8, -999.25, , 2, 1\n2, 3, 0, 20, 0, 5\n0,0,0\n@\n\
        -1234.56-2345.67\n        -1111.11\n-3333.33 -999.25\n";
    assert_eq!(
        sorted(&heights(touching)),
        [
            [0.0, 0.0, -2345.67],
            [0.0, 5.0, -1234.56],
            [10.0, 0.0, -1111.11],
            [20.0, 5.0, -3333.33],
        ]
    );
}

#[test]
fn a_turned_grid_turns_counter_clockwise_about_its_own_point() {
    // By 90° about the first node: columns run north, rows west.
    let turned = IRAP.replace("4 0.0 100.0 200.0", "4 90.0 100.0 200.0");
    let Layout::Grid(grid) = heights(&turned).layout else {
        panic!("no grid");
    };
    assert!(grid.place(0, 0).distance(DVec2::new(100.0, 200.0)) < 1e-9);
    assert!(grid.place(3, 1).distance(DVec2::new(95.0, 230.0)) < 1e-9);
    // By 30° about another point: every node keeps its distance from that.
    let about = IRAP.replace("4 0.0 100.0 200.0", "4 30.0 90.0 190.0");
    let (Layout::Grid(grid), Layout::Grid(straight)) =
        (heights(&about).layout, heights(IRAP).layout)
    else {
        panic!("no grid");
    };
    let centre = DVec2::new(90.0, 190.0);
    let (from, to) = (straight.place(2, 1) - centre, grid.place(2, 1) - centre);
    assert!((from.length() - to.length()).abs() < 1e-9);
    assert!((from.angle_to(to).to_degrees() - 30.0).abs() < 1e-9);
}

#[test]
fn corners_of_cells_are_half_a_cell_from_the_first_node() {
    let corner = ESRI
        .replace("xllcenter 100", "XLLCORNER 95")
        .replace("yllcenter 200", "yllcorner 197.5");
    assert_eq!(sorted(&heights(&corner)), expected());
}

#[test]
fn vertices_of_triangles_are_those_that_have_one_and_depths_are_told() {
    let surface = heights(TSURF);
    assert_eq!(surface.positive, Some(Positive::Down));
    // The vertex 9 has no triangle, and 3 is a copy of 0.
    let places: Vec<DVec3> = surface.samples().map(|sample| sample.at).collect();
    assert_eq!(
        places,
        [
            DVec3::new(100.0, 200.0, 5.0),
            DVec3::new(110.0, 200.0, 6.0),
            DVec3::new(110.0, 205.0, 7.0),
            DVec3::new(100.0, 200.0, 5.0),
        ]
    );
    assert_eq!(surface.samples().nth(2).unwrap().origin, Origin::Line(11));
    let up = heights(&TSURF.replace("Depth", "Elevation"));
    assert_eq!(up.positive, Some(Positive::Up));
}

#[test]
fn columns_are_taken_by_name_by_number_or_by_what_they_are_usually_called() {
    let table = "id,X (m),up,Y (m),TWT\n1,10,5,20,7\n2,11,6,21,8\n3,12,7,22,9\n";
    let by = |columns: [&str; 3]| Reading {
        columns: Some(columns.map(str::to_owned)),
        ..Reading::default()
    };
    for columns in [["X (m)", "y (m)", "TWT"], ["2", "4", "5"]] {
        let heights = read(table.as_bytes(), &by(columns)).unwrap();
        assert_eq!(sorted(&heights)[0], [10.0, 20.0, 7.0]);
    }
    let missing = read(table.as_bytes(), &Reading::default()).unwrap_err();
    let DataError::Column {
        line: 1,
        column,
        found,
    } = &missing
    else {
        panic!("{missing}");
    };
    assert_eq!(
        (column.as_str(), found.as_str()),
        ("z", "id, X (m), up, Y (m), TWT")
    );
    let numbers = read(b"1 10 5 20\n2 11 6 21\n3 12 7 22\n", &by(["2", "4", "3"])).unwrap();
    assert_eq!(sorted(&numbers)[2], [12.0, 22.0, 7.0]);
    let header = "# Petrel Points with attributes\nVERSION 1\nBEGIN HEADER\nX\nY\nZ\nEND HEADER\n1 2 3\n4 5 6\n";
    assert_eq!(sorted(&heights(header)).len(), 2);
    // Between blanks a name of two words is two columns.
    assert_eq!(
        sorted(&heights("X Y Depth\n1 2 3\n4 5 6\n7 8 nan\n")).len(),
        2
    );
}

/// A format's text, what is replaced in it, by what, and what the error says.
type Broken = (&'static str, &'static str, &'static str, &'static str);

#[rustfmt::skip]
const BROKEN: &[Broken] = &[
    (IRAP, "-202 -302\n", "", "ends at line 6 with 10 of 12 heights (4 columns, 3 rows)"),
    (IRAP, "-302\n", "-302 -303\n", "line 6: after 12 heights there is more: \"-303\""),
    (IRAP, "-101\n", "-1O1\n", "line 5: \"-1O1\" is no number"),
    (IRAP, "-996 3 10.0", "-996 1 10.0", "line 1: the number of rows is 1; a grid has at least 2"),
    (IRAP, "\n4 0.0", "\n4.5 0.0", "line 3: the number of columns is 4.5"),
    (IRAP, "-996 3 10.0", "-996 3 0.0", "line 1: from one column to the next it is 0"),
    (IRAP, "100.0 130.0", "100.0 east", "line 2: expected the greatest x, found \"east\""),
    (ZMAP, "      -300.0000\n", "", "ends at line 13 with 11 of 12 heights"),
    (ZMAP, "3, 4, 100.0, 130.0, 200.0, 210.0", "3, 4, 100.0, 130.0", "line 4: expected NROW, NCOL, XMIN"),
    (ZMAP, "GRID", "POLYGON", "line 2: expected @name, GRID"),
    (ZMAP, "\n@\n", "\n", "the @ that ends the header is missing"),
    (ZMAP, "15, -99", "wide, -99", "line 3: expected the width of a field"),
    (ZMAP, "-301.0000", "  unknown", "line 13: \"unknown\" is no number"),
    (ZMAP, "200.0, 210.0", "210.0, 200.0", "line 4: from one row to the next it is -5"),
    (CPS3, "-301 -300\n", "-301\n", "ends at line 9 with 11 of 12 heights"),
    (CPS3, "FSNROW 3 4\n", "", "FSNROW is missing"),
    (CPS3, "FSLIMI 100.0 130.0 200.0 210.0 -302.0 0.0", "FSLIMI 100.0 130.0", "line 3: expected FSLIMI xmin xmax"),
    (CPS3, "FSNROW 3 4", "FSCOLS 3 4", "line 4: expected a line that begins with FSASCI"),
    (ESRI, "nrows 3\n", "", "nrows is missing"),
    (ESRI, "dx 10\n", "dx wide\n", "line 5: \"wide\" is no number"),
    (ESRI, " -300\n", "\n", "ends at line 10 with 11 of 12 heights"),
    (XYZ, "130 205 -301", "130 205", "line 9: expected x, y and z, found \"130 205\""),
    (XYZ, "130 205 -301", "130 two -301", "line 9: \"two\" is no number"),
    (CSV, "h;205;130;-301", "h;205;13x;-301", "line 9: \"13x\" is no number"),
    (CSV, "Easting", "Longitude", "line 1: no column is \"x\"; there are Name, Northing, Longitude, Depth"),
    (CSV, "h;205;130;-301", "h;205", "line 9: expected as many cells as the header has names"),
    (TSURF, "END\n", "", "ends at line 16, and END is missing"),
    (TSURF, "TRGL 3 2 1", "TRGL 3 2 7", "line 16: there is no vertex 7"),
    (TSURF, "VRTX 2 110 205 7", "VRTX 2 110 205", "line 11: expected VRTX, its number, x, y and z"),
    (TSURF, "ATOM 3 0", "ATOM 3 8", "line 14: there is no vertex 8"),
    (TSURF, "TRGL 0 1 2", "TRGL 0 1.5 2", "line 15: \"1.5\" is no number"),
    (TSURF, "TSurf", "PLine", "line 1: expected a GOCAD TSurf, found \"GOCAD PLine 1\""),
];

#[test]
fn every_broken_file_is_refused_with_the_line_and_what_is_there() {
    let mut wrong = Vec::new();
    for (text, find, replace, words) in BROKEN {
        assert!(text.contains(find), "{find:?}");
        let broken = text.replacen(find, replace, 1);
        match read(broken.as_bytes(), &Reading::default()) {
            Ok(_) => wrong.push(format!("{replace:?}: accepted")),
            Err(error) if !error.to_string().contains(words) || error.remedy().is_empty() => {
                wrong.push(format!("{replace:?}: {error}; expected {words}"));
            }
            Err(_) => {}
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_file_that_is_cut_anywhere_is_read_or_refused_and_never_taken_for_whole() {
    for text in [IRAP, ZMAP, CPS3, ESRI, TSURF] {
        let whole = heights(text).samples().count();
        // The last digits of the last height may be missing: no program can know.
        let last = text.trim_end().rfind([' ', '\n']).unwrap();
        for at in (0..last).filter(|at| text.is_char_boundary(*at)) {
            assert!(
                read(&text.as_bytes()[..at], &Reading::default()).is_err(),
                "{}",
                &text[..at]
            );
        }
        assert_eq!(heights(text).samples().count(), whole);
    }
    for text in [XYZ, CSV] {
        for at in 0..text.len() {
            if let Ok(heights) = read(&text.as_bytes()[..at], &Reading::default()) {
                assert!(heights.samples().count() <= 12);
            }
        }
    }
}

#[test]
fn what_is_no_file_of_heights_is_named() {
    for (bytes, words) in [
        (&b""[..], "empty"),
        (b"# nothing\n\n! at all\n", "empty"),
        (b"II*\0\x08\0\0\0", "GeoTIFF"),
        (b"\0\0\0 \0\0\x03\xfc\0\0", "binary IRAP"),
        (b"PK\x03\x04rest", "spreadsheet"),
        (b"abc\0def", "binary file"),
        (b"<?xml version=\"1.0\"?>\n<kml/>\n", "begins no format"),
        (b"name = \"model\"\n[domain]\n", "begins no format"),
        (b"100 200\n300 400\n", "begins no format"),
    ] {
        let error = read(bytes, &Reading::default()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        assert!(!error.remedy().is_empty());
    }
    let forced = Reading {
        format: Some(Format::Zmap),
        ..Reading::default()
    };
    assert!(read(IRAP.as_bytes(), &forced).is_err());
    let nulls = Reading {
        nulls: vec![0.0],
        ..Reading::default()
    };
    let nothing = read(b"1 2 0\n3 4 0\n5 6 0\n", &nulls).unwrap_err();
    assert_eq!(nothing, DataError::Nothing { nulls: 3 });
}

#[test]
fn a_header_that_promises_more_than_the_file_can_hold_takes_no_memory() {
    let vast = IRAP
        .replace("-996 3", "-996 4000000000")
        .replace("\n4 0.0", "\n4000000000 0.0");
    let error = read(vast.as_bytes(), &Reading::default()).unwrap_err();
    assert!(
        matches!(error, DataError::Short { found: 12, .. }),
        "{error}"
    );
}
