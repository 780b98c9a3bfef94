//! The summary as one page for a browser, which needs nothing else: plots and script are in it.

use std::fmt::Write as _;

use base64::prelude::{BASE64_STANDARD, Engine as _};

use super::columns::Row;
use super::explorer;
use super::plots::Plot;
use super::whole::{Summary, TORNADO};

const STYLE: &str = "body{font:15px/1.45 sans-serif;color:#333;max-width:1100px;margin:2em auto;padding:0 1em}\
h1{font-size:1.5em}h2{font-size:1.15em;margin-top:2em}\
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:13px}\
th,td{padding:.25em .6em;border-bottom:1px solid #ddd;text-align:right;white-space:nowrap}\
th:first-child,td:first-child{text-align:left}th{background:#f3f3f0}\
.sortable th{cursor:pointer}.sortable th[aria-sort=ascending]:after{content:' ▲'}\
.sortable th[aria-sort=descending]:after{content:' ▼'}\
.scroll{overflow:auto;max-height:70vh}.scroll th{position:sticky;top:0}\
.warning{background:#fff3d6;padding:.5em .8em;border-left:4px solid #d98b2b}figure{margin:1em 0}svg,img{max-width:100%;height:auto}";

/// Sorts a table by the column whose head is clicked: by number where all are numbers, empty cells last.
const SCRIPT: &str = "document.querySelectorAll('table.sortable').forEach(function(table){\
var heads=table.tHead.rows[0].cells,body=table.tBodies[0];\
Array.from(heads).forEach(function(head,at){head.tabIndex=0;function sort(){\
var up=head.getAttribute('aria-sort')!=='ascending';\
Array.from(heads).forEach(function(h){h.removeAttribute('aria-sort')});\
head.setAttribute('aria-sort',up?'ascending':'descending');\
var text=function(row){return row.cells[at].dataset.value||row.cells[at].textContent.trim()};\
var rows=Array.from(body.rows);\
rows.sort(function(a,b){var x=text(a),y=text(b);\
if(x===''||y==='')return (x==='')-(y==='');\
var d=Number(x)-Number(y);if(isNaN(d))d=x<y?-1:x>y?1:0;return up?d:-d});\
rows.forEach(function(row){body.appendChild(row)})}\
head.addEventListener('click',sort);\
head.addEventListener('keydown',function(e){if(e.key==='Enter')sort()})})});";

/// Most realisations that the page shows one by one: a browser sorts and plots no more of them without waiting.
const MOST: usize = 1000;

/// A text as it stands in HTML.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}

/// A number as it is read: four digits at least, thousands apart.
fn shown(value: f64) -> String {
    let size = value.abs();
    if (1000.0..1e15).contains(&size) {
        let digits = format!("{size:.0}");
        let mut out = String::new();
        for (at, digit) in digits.chars().enumerate() {
            if at > 0 && (digits.len() - at).is_multiple_of(3) {
                out.push('\u{202f}');
            }
            out.push(digit);
        }
        return if value < 0.0 {
            format!("−{out}")
        } else {
            out
        };
    }
    if value == value.trunc() {
        return format!("{value}");
    }
    let decimals = if size >= 100.0 {
        1
    } else if size >= 1.0 {
        3
    } else {
        5
    };
    let text = format!("{value:.decimals$}");
    if size < 1e-3 {
        format!("{value:.3e}")
    } else {
        text
    }
}

/// A row of cells; numbers carry their digits for sorting.
fn row(out: &mut String, cell: &str, cells: impl IntoIterator<Item = Cell>) {
    out.push_str("<tr>");
    for one in cells {
        // Writing to a text cannot fail.
        let _ = match one {
            Cell::Text(text) => write!(out, "<{cell}>{}</{cell}>", escaped(&text)),
            Cell::Number(value) => {
                let text = shown(value);
                write!(out, "<{cell} data-value=\"{value}\">{text}</{cell}>")
            }
            Cell::Empty => write!(out, "<{cell}></{cell}>"),
        };
    }
    out.push_str("</tr>\n");
}

enum Cell {
    Text(String),
    Number(f64),
    Empty,
}

impl Cell {
    fn text(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

/// A picture of many realisations that is to be on the page.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The name of its file, without ending.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// The PNG file.
    pub png: Vec<u8>,
}

/// The page.
pub fn page(summary: &Summary, plots: &[Plot], sheets: &[Sheet]) -> String {
    let title = escaped(&summary.model);
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}: ensemble</title>\n\
         <style>{STYLE}</style></head><body>\n<h1>{title}: ensemble</h1>\n"
    );
    heading(&mut out, summary);
    for plot in plots {
        let _ = writeln!(
            out,
            "<figure aria-label=\"{}\">{}</figure>",
            escaped(&plot.caption),
            plot.svg
        );
    }
    let rows: Vec<&Row> = summary.table.some(MOST).collect();
    out.push_str(&explorer::html(summary, &rows));
    for sheet in sheets {
        let _ = writeln!(
            out,
            "<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"></figure>",
            escaped(&sheet.caption),
            BASE64_STANDARD.encode(&sheet.png)
        );
    }
    spreads(&mut out, summary);
    strongest(&mut out, summary);
    unmade(&mut out, summary);
    realisations(&mut out, summary);
    let _ = writeln!(out, "<script>{SCRIPT}</script></body></html>");
    out
}

fn heading(out: &mut String, summary: &Summary) {
    for one in &summary.scenarios {
        let name = one
            .name
            .as_ref()
            .map_or(String::new(), |name| format!("{}: ", escaped(name)));
        let _ = write!(
            out,
            "<p>{name}{} of {} realisations were made.",
            one.made, one.of
        );
        if let (Some(spread), Some((nearest, value))) = (one.spread(&summary.result), &one.nearest)
        {
            let _ = write!(
                out,
                " {}: P90 {}, P50 {}, P10 {}; nearest to the P50 is realisation {} with {}.",
                escaped(&summary.result),
                shown(spread.low_p90),
                shown(spread.mid_p50),
                shown(spread.high_p10),
                escaped(nearest),
                shown(*value)
            );
        }
        out.push_str("</p>\n");
    }
    out.push_str(
        "<p>P90 is what 90 % of the realisations exceed. The P50s of two quantities belong to no one realisation.</p>\n",
    );
    for warning in summary.warnings() {
        let _ = writeln!(out, "<p class=\"warning\">{}</p>", escaped(&warning));
    }
}

fn begin_table(out: &mut String, title: &str, heads: &[&str]) {
    let _ = write!(
        out,
        "<h2>{title}</h2>\n<div class=\"scroll\"><table class=\"sortable\"><thead>"
    );
    row(out, "th", heads.iter().map(|head| Cell::text(head)));
    out.push_str("</thead><tbody>\n");
}

fn end_table(out: &mut String) {
    out.push_str("</tbody></table></div>\n");
}

fn spreads(out: &mut String, summary: &Summary) {
    let heads = [
        "measure",
        "scenario",
        "n",
        "min",
        "low (P90)",
        "mid (P50)",
        "high (P10)",
        "max",
        "mean",
        "standard deviation",
    ];
    begin_table(out, "Measures", &heads);
    let names = summary.table.measures().map(|(_, name)| name.to_owned());
    for measure in names {
        for one in &summary.scenarios {
            let Some(s) = one.spread(&measure) else {
                continue;
            };
            let numbers = [
                s.n as f64, s.min, s.low_p90, s.mid_p50, s.high_p10, s.max, s.mean,
            ];
            let names = [
                Cell::text(&measure),
                Cell::text(one.name.as_deref().unwrap_or_default()),
            ];
            let cells = names.into_iter().chain(numbers.map(Cell::Number));
            let deviation = s.deviation.map_or(Cell::Empty, Cell::Number);
            row(out, "td", cells.chain(std::iter::once(deviation)));
        }
    }
    end_table(out);
}

fn strongest(out: &mut String, summary: &Summary) {
    let title = format!("What decides {}", escaped(&summary.result));
    begin_table(
        out,
        &title,
        &["parameter", "scenario", "rank correlation", "n"],
    );
    for one in &summary.scenarios {
        for correlation in one.correlations.iter().take(TORNADO) {
            let cells = [
                Cell::text(&correlation.parameter),
                Cell::text(one.name.as_deref().unwrap_or_default()),
                Cell::Number(correlation.rank_correlation),
                Cell::Number(correlation.n as f64),
            ];
            row(out, "td", cells);
        }
    }
    end_table(out);
}

fn unmade(out: &mut String, summary: &Summary) {
    if summary.unmade.is_empty() {
        return;
    }
    begin_table(
        out,
        "Not made",
        &["realisation", "seed", "outcome", "words"],
    );
    for one in &summary.unmade {
        let cells = [
            &one.realisation,
            &one.seed.to_string(),
            &one.outcome,
            &one.words,
        ];
        row(out, "td", cells.map(|text| Cell::text(text)));
    }
    end_table(out);
}

fn realisations(out: &mut String, summary: &Summary) {
    let measures: Vec<(usize, &str)> = summary.table.measures().collect();
    let mut heads = vec!["realisation", "seed"];
    heads.extend(measures.iter().map(|(_, name)| *name));
    begin_table(out, "Realisations", &heads);
    for one in summary.table.some(MOST) {
        let names = [Cell::text(&one.name), Cell::Text(one.seed.to_string())];
        let numbers = measures
            .iter()
            .map(|(at, _)| one.values[*at].map_or(Cell::Empty, Cell::Number));
        row(out, "td", names.into_iter().chain(numbers));
    }
    end_table(out);
    let all = summary.table.rows.len();
    if all > MOST {
        let _ = writeln!(
            out,
            "<p>{MOST} of {all}, at equal steps; <code>realisations.csv</code> has all of them.</p>"
        );
    }
    out.push_str("<p>What was drawn stands in <code>realisations.csv</code>.</p>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_with_the_digits_that_matter() {
        for (value, text) in [
            (0.0, "0"),
            (12.0, "12"),
            (1_234_567.8, "1\u{202f}234\u{202f}568"),
            (-1234.5, "−1\u{202f}234"),
            (123.456, "123.5"),
            (1.234_56, "1.235"),
            (0.234_567, "0.23457"),
            (0.000_012_345, "1.234e-5"),
        ] {
            assert_eq!(shown(value), text);
        }
    }

    #[test]
    fn texts_cannot_break_out_of_the_page() {
        assert_eq!(escaped("<b> & \"c\""), "&lt;b&gt; &amp; &quot;c&quot;");
    }
}
