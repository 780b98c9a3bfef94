#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use super::*;

const DEV: &str = "# WELL TRACE FROM PETREL \r
# WELL NAME:              A-1 \r
# WELL HEAD X-COORDINATE: 456789.25000000 (m)\r
# WELL HEAD Y-COORDINATE: 6782714.50000000 (m)\r
# WELL DATUM (KB, Kelly bushing, from MSL): 25.00000000 (m)\r
# WELL TYPE:              OIL \r
# MD AND TVD ARE REFERENCED (=0) AT WELL DATUM AND INCREASE DOWNWARDS\r
#=======================================================================\r
      MD              X              Y             Z           TVD           DX           DY         AZIM_TN      INCL         DLS       AZIM_GN\r
#=======================================================================\r
 0.0000000000 456789.25 6782714.50 25.000000 0.0000000 0.00 0.00 0.00 0.00 0.00 359.5\r
 100.0000000 456789.25 6782714.50 -75.000000 100.0000000 0.00 0.00 1.00 2.00 0.00 0.5\r
";

const LAS: &str = "~VERSION INFORMATION
 VERS. 2.0 : CWLS LOG ASCII STANDARD
 WRAP. NO : ONE LINE PER DEPTH STEP
~WELL INFORMATION
 STRT.M 0.0 : START
 NULL. -999.25 : NULL
 EKB.M 21.5 : ELEVATION OF THE KELLY BUSHING
~CURVE INFORMATION
 DEPT.M : MEASURED DEPTH
 DEVI.DEG : DEVIATION
 HAZI.DEG : AZIMUTH: OF THE HOLE
~A DEPTH DEVI HAZI
 0 0 0
 30 1.5 90
 60 -999.25 90
 90 4.5 91
";

#[test]
fn a_petrel_trace_gives_its_head_its_datum_and_grid_azimuths() {
    let table = read(DEV.as_bytes(), &SurveyReading::default()).unwrap();
    assert_eq!(table.format, SurveyFormat::Dev);
    assert_eq!(table.head, Some([456_789.25, 6_782_714.5]));
    assert_eq!(table.datum, Some(25.0));
    assert_eq!(table.unit.as_deref(), Some("m"));
    let row = &table.rows[1];
    assert_eq!(row.line, 12);
    let value = |column| table.value(row, column).unwrap();
    assert_eq!(value(Column::Md), 100.0);
    assert_eq!(value(Column::Azimuth), 0.5);
    assert_eq!(value(Column::Inclination), 2.0);
    // Elevation is the datum less the depth below it.
    assert_eq!(value(Column::Z), 25.0 - value(Column::Tvd));
    assert!(!table.is_true_north);
}

#[test]
fn a_las_file_gives_its_curves_without_rows_of_nulls_wrapped_or_not() {
    let table = read(LAS.as_bytes(), &SurveyReading::default()).unwrap();
    assert_eq!((table.format, table.dropped), (SurveyFormat::Las, 1));
    assert_eq!(table.datum, Some(21.5));
    let all: Vec<_> = table.rows.iter().map(|row| row.values.clone()).collect();
    assert_eq!(all, [[0.0, 0.0, 0.0], [30.0, 1.5, 90.0], [90.0, 4.5, 91.0]]);
    let wrapped = LAS
        .replace("WRAP. NO", "WRAP. YES")
        .replace(" 30 1.5 90", "30\n1.5\n 90");
    assert_eq!(
        read(wrapped.as_bytes(), &SurveyReading::default())
            .unwrap()
            .rows
            .len(),
        3
    );
}

#[test]
fn tables_are_read_whatever_stands_between_their_cells() {
    for text in [
        "MD,Inc,Azi\n0,0,10\n30,1.5,20\n",
        "# by hand\nMD;Inc;Azi\r\n0;0;10\r\n30;1,5;20\r\n",
        "MD\tINC\tAZI\n0\t0\t10\n30\t1.5\t20",
        "md inc azi\n0 0 10\n30 1.5 20\n",
    ] {
        let table = read(text.as_bytes(), &SurveyReading::default()).unwrap();
        assert_eq!(
            table.columns,
            [Column::Md, Column::Inclination, Column::Azimuth],
            "{text}"
        );
        assert_eq!(table.rows[1].values, [30.0, 1.5, 20.0], "{text}");
    }
    let reading = SurveyReading {
        columns: vec![
            (Column::Md, "2".to_owned()),
            (Column::Azimuth, "TRUE".to_owned()),
        ],
        ..SurveyReading::default()
    };
    let table = read(b"INC,DH,TRUE\n1,2,3\n", &reading).unwrap();
    assert_eq!(table.rows[0].values, [2.0, 1.0, 3.0]);
}

#[test]
fn what_holds_no_survey_is_refused_with_its_line_and_cuts_anywhere_never_panic() {
    let said = |text: &str| read(text.as_bytes(), &SurveyReading::default());
    assert_eq!(said(""), Err(SurveyFileError::Empty));
    assert_eq!(
        read(&[0, 1, 2], &SurveyReading::default()),
        Err(SurveyFileError::Binary)
    );
    assert!(matches!(
        said("a,b\n1,2"),
        Err(SurveyFileError::NoColumns { line: 1, .. })
    ));
    assert!(matches!(
        said("md,inc,azi\n0,0,0\n1,x,2"),
        Err(SurveyFileError::Number {
            line: 3,
            column: "inc_deg",
            ..
        })
    ));
    assert!(matches!(
        said("md,inc,azi\n0,0,0\n1,2"),
        Err(SurveyFileError::Row {
            line: 3,
            found: 2,
            needed: 3
        })
    ));
    assert!(matches!(
        said("md,inc,azi\n"),
        Err(SurveyFileError::NoRows { .. })
    ));
    assert!(matches!(
        said("# WELL TRACE\n0 1 2"),
        Err(SurveyFileError::Missing { .. })
    ));
    assert!(matches!(
        said("~V\nVERS. 2.0:\n"),
        Err(SurveyFileError::Missing { .. })
    ));
    for text in [DEV, LAS] {
        for end in 0..text.len() {
            drop(said(&text[..end]));
        }
    }
}
