//! Plots of a summary: the distribution of the result, how it is exceeded, what decides it, and the scenarios side by side.
//!
//! Drawn as SVG; the same drawings become PNG where files are wanted.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::whole::{OfScenario, Summary, TORNADO};
use crate::export::picture::{PictureError, rasterised};

/// Width and height of a plot (px).
const SIZE: (u32, u32) = (900, 540);
/// Pixels of a PNG to one of the drawing.
const FINENESS: f64 = 2.0;
const FONT: &str = "sans-serif";
/// Colours of scenarios, told apart in grey, too.
const COLORS: [RGBColor; 6] = [
    RGBColor(0x2b, 0x5c, 0x8a),
    RGBColor(0xd9, 0x8b, 0x2b),
    RGBColor(0x5b, 0x9a, 0x5b),
    RGBColor(0xa8, 0x3c, 0x3c),
    RGBColor(0x7a, 0x5a, 0x9e),
    RGBColor(0x55, 0x55, 0x55),
];
const INK: RGBColor = RGBColor(0x33, 0x33, 0x33);

/// A plot.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The name of its files, without ending.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// The drawing.
    pub svg: String,
}

/// Why a plot could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The drawing failed.
    #[error("the plot {name} could not be drawn: {message}")]
    Drawing {
        /// Its name.
        name: String,
        /// Why.
        message: String,
    },
    /// The drawing did not become pixels.
    #[error(transparent)]
    Picture(#[from] PictureError),
}

impl Plot {
    /// The plot as PNG.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        Ok(rasterised(&self.svg, [SIZE.0, SIZE.1], FINENESS)?)
    }
}

/// All plots of a summary; none where nothing was made.
pub fn plots(summary: &Summary) -> Result<Vec<Plot>, PlotError> {
    let results = Results::of(summary);
    let mut plots = Vec::new();
    if results.of.iter().all(|(_, values)| values.is_empty()) {
        return Ok(plots);
    }
    let title = &results.title;
    plots.push(draw(
        "histogram",
        format!("Distribution of {title}"),
        |area| histogram(area, &results),
    )?);
    let caption = format!("Share of realisations that exceed a {title}");
    plots.push(draw("exceedance", caption, |area| {
        exceedance(area, &results)
    })?);
    for scenario in &summary.scenarios {
        if scenario.correlations.is_empty() {
            continue;
        }
        let (name, of) = match &scenario.name {
            Some(name) => (format!("tornado-{name}"), format!(", {name}")),
            None => ("tornado".to_owned(), String::new()),
        };
        let caption = format!("Rank correlation of parameters with {title}{of}");
        plots.push(draw(&name, caption, |area| tornado(area, scenario))?);
    }
    if summary.scenarios.len() > 1 {
        let caption = format!("{title} by scenario: P90, P50, P10");
        plots.push(draw("scenarios", caption, |area| {
            side_by_side(area, summary, &results)
        })?);
    }
    Ok(plots)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

fn draw(
    name: &str,
    caption: String,
    plot: impl FnOnce(&Area<'_>) -> Drawn,
) -> Result<Plot, PlotError> {
    let mut svg = String::new();
    let drawn = {
        let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        let title = (FONT, 20).into_font().color(&INK);
        let whole = area
            .fill(&WHITE)
            .and_then(|()| area.titled(&caption, title));
        match whole {
            Ok(rest) => plot(&rest).and_then(|()| Ok(area.present()?)),
            Err(error) => Err(error.into()),
        }
    };
    drawn.map_err(|error| PlotError::Drawing {
        name: name.to_owned(),
        message: error.to_string(),
    })?;
    Ok(Plot {
        name: name.to_owned(),
        caption,
        svg,
    })
}

/// The results of each scenario, in ascending order, in a unit that gives short numbers.
struct Results {
    title: String,
    axis: String,
    unit: f64,
    of: Vec<(String, Vec<f64>)>,
}

impl Results {
    fn of(summary: &Summary) -> Self {
        let at = summary.table.measure(&summary.result);
        let values = |scenario: &OfScenario| {
            let rows = summary.table.rows.iter();
            let mut values: Vec<f64> = rows
                .filter(|row| row.scenario == scenario.name)
                .filter_map(|row| row.values[at?])
                .collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let mut of: Vec<(String, Vec<f64>)> = summary
            .scenarios
            .iter()
            .map(|one| (one.name.clone().unwrap_or_default(), values(one)))
            .collect();
        let all = of.iter().flat_map(|(_, values)| values);
        let largest = all.fold(0.0_f64, |most, value| most.max(value.abs()));
        let (unit, power) = match largest {
            1e9.. => (1e9, "10⁹ "),
            1e6.. => (1e6, "10⁶ "),
            1e4.. => (1e3, "10³ "),
            _ => (1.0, ""),
        };
        for value in of.iter_mut().flat_map(|(_, values)| values) {
            *value /= unit;
        }
        let words = summary.result.replace('_', " ");
        let (title, axis) = match words.strip_suffix(" m3") {
            Some(words) => (words.to_owned(), format!("{words} ({power}m³)")),
            None if power.is_empty() => (words.clone(), words),
            None => (words.clone(), format!("{words} ({})", power.trim())),
        };
        Self {
            title,
            axis,
            unit,
            of,
        }
    }

    /// The least and the greatest, with room on both sides.
    fn range(&self) -> std::ops::Range<f64> {
        let all = self.of.iter().flat_map(|(_, values)| values);
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(*value), high.max(*value))
        });
        let room = ((high - low) * 0.04).max(high.abs() * 1e-3).max(1e-9);
        low - room..high + room
    }
}

/// Bars of equal width, as many as 1 + log₂ n (Sturges), at least five.
fn histogram(area: &Area<'_>, results: &Results) -> Drawn {
    let range = results.range();
    let most = results.of.iter().map(|(_, values)| values.len()).max();
    let bins = most
        .and_then(usize::checked_ilog2)
        .map_or(1, |power| power as usize + 2)
        .max(5);
    let width = (range.end - range.start) / bins as f64;
    let counts = |values: &[f64]| -> Vec<usize> {
        let edge = |bin: usize| values.partition_point(|v| *v < range.start + width * bin as f64);
        (0..bins).map(|bin| edge(bin + 1) - edge(bin)).collect()
    };
    let counted: Vec<Vec<usize>> = results
        .of
        .iter()
        .map(|(_, values)| counts(values))
        .collect();
    let highest = counted.iter().flatten().copied().max().unwrap_or(1).max(1);
    let mut chart = ChartBuilder::on(area)
        .margin(14)
        .margin_right(28)
        .x_label_area_size(48)
        .y_label_area_size(64)
        .build_cartesian_2d(range.clone(), 0.0..highest as f64 * 1.08)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .x_desc(&results.axis)
        .y_desc("realisations")
        .y_label_formatter(&|count| whole(*count))
        .light_line_style(WHITE)
        .label_style((FONT, 14))
        .draw()?;
    // Scenarios share each bin side by side.
    let share = width / counted.len() as f64;
    for (at, counts) in counted.iter().enumerate() {
        let color = COLORS[at % COLORS.len()];
        let bars = counts.iter().enumerate().map(|(bin, count)| {
            let left = range.start + width * bin as f64 + share * at as f64;
            let corners = [
                (left + share * 0.04, 0.0),
                (left + share * 0.96, *count as f64),
            ];
            Rectangle::new(corners, color.mix(0.85).filled())
        });
        let series = chart.draw_series(bars)?;
        if !results.of[at].0.is_empty() {
            series.label(&results.of[at].0).legend(move |(x, y)| {
                Rectangle::new([(x, y - 5), (x + 14, y + 5)], color.filled())
            });
        }
    }
    legend(&mut chart, results)
}

/// A count as a label; none between two counts.
fn whole(count: f64) -> String {
    if (count - count.round()).abs() < 1e-6 {
        format!("{count:.0}")
    } else {
        String::new()
    }
}

type Chart<'a, 'b> = ChartContext<
    'a,
    SVGBackend<'b>,
    Cartesian2d<plotters::coord::types::RangedCoordf64, plotters::coord::types::RangedCoordf64>,
>;

fn legend<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>, results: &Results) -> Drawn {
    if results.of.len() > 1 {
        chart
            .configure_series_labels()
            .label_font((FONT, 14))
            .background_style(WHITE.mix(0.85))
            .border_style(INK.mix(0.4))
            .draw()?;
    }
    Ok(())
}

/// Steps down from 1 at each result; lines at P90, P50 and P10.
fn exceedance(area: &Area<'_>, results: &Results) -> Drawn {
    let range = results.range();
    let mut chart = ChartBuilder::on(area)
        .margin(14)
        .margin_right(28)
        .x_label_area_size(48)
        .y_label_area_size(64)
        .build_cartesian_2d(range.clone(), 0.0..1.0)?;
    chart
        .configure_mesh()
        .x_desc(&results.axis)
        .y_desc("probability of exceedance")
        .label_style((FONT, 14))
        .light_line_style(WHITE)
        .draw()?;
    for (level, word) in [(0.9, "P90"), (0.5, "P50"), (0.1, "P10")] {
        let line = [(range.start, level), (range.end, level)];
        chart.draw_series(LineSeries::new(line, INK.mix(0.45)))?;
        let place = (
            range.start + (range.end - range.start) * 0.005,
            level + 0.035,
        );
        let word = Text::new(word, place, (FONT, 13).into_font().color(&INK));
        chart.draw_series(std::iter::once(word))?;
    }
    for (at, (name, values)) in results.of.iter().enumerate() {
        let n = values.len() as f64;
        let mut steps = vec![(range.start, 1.0)];
        for (i, value) in values.iter().enumerate() {
            steps.push((*value, 1.0 - i as f64 / n));
            steps.push((*value, 1.0 - (i + 1) as f64 / n));
        }
        let color = COLORS[at % COLORS.len()];
        let series = chart.draw_series(LineSeries::new(steps, color.stroke_width(2)))?;
        if !name.is_empty() {
            series.label(name).legend(move |(x, y)| {
                PathElement::new([(x, y), (x + 14, y)], color.stroke_width(2))
            });
        }
    }
    legend(&mut chart, results)
}

/// A bar for each of the strongest parameters, the strongest on top.
fn tornado(area: &Area<'_>, scenario: &OfScenario) -> Drawn {
    let shown: Vec<_> = scenario.correlations.iter().take(TORNADO).collect();
    let rows = shown.len() as f64;
    // Names are as long as they are: a letter is about 7 px wide.
    let longest = shown.iter().map(|one| one.parameter.chars().count()).max();
    let names = u32::try_from(longest.unwrap_or(0)).unwrap_or(0) * 7 + 20;
    let mut chart = ChartBuilder::on(area)
        .margin(14)
        .margin_right(28)
        .margin_left(names.min(SIZE.0 / 2))
        .x_label_area_size(48)
        .build_cartesian_2d(-1.0..1.0, 0.0..rows)?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .disable_y_axis()
        .x_desc("rank correlation")
        .label_style((FONT, 14))
        .light_line_style(WHITE)
        .draw()?;
    let height = |at: usize| rows - 1.0 - at as f64;
    let bars = shown.iter().enumerate().map(|(at, one)| {
        let color = COLORS[usize::from(one.rank_correlation < 0.0)];
        let corners = [
            (0.0, height(at) + 0.12),
            (one.rank_correlation, height(at) + 0.88),
        ];
        Rectangle::new(corners, color.mix(0.85).filled())
    });
    chart.draw_series(bars)?;
    let right = plotters::style::text_anchor::Pos::new(
        plotters::style::text_anchor::HPos::Right,
        plotters::style::text_anchor::VPos::Center,
    );
    let style = (FONT, 13).into_font().color(&INK).pos(right);
    for (at, one) in shown.iter().enumerate() {
        // Left of the plot, in the margin: there the chart's own coordinates end.
        let (x, y) = chart.backend_coord(&(-1.0, height(at) + 0.5));
        let (left, top) = area.get_base_pixel();
        area.draw_text(&one.parameter, &style, (x - left - 8, y - top))?;
    }
    let zero = LineSeries::new([(0.0, 0.0), (0.0, rows)], &INK);
    chart.draw_series(zero)?;
    Ok(())
}

/// From P90 to P10 a bar, with a mark at P50, for each scenario.
fn side_by_side(area: &Area<'_>, summary: &Summary, results: &Results) -> Drawn {
    let rows = summary.scenarios.len() as f64;
    let longest = results
        .of
        .iter()
        .map(|(name, _)| name.chars().count())
        .max();
    let names = u32::try_from(longest.unwrap_or(0)).unwrap_or(0) * 7 + 20;
    let mut chart = ChartBuilder::on(area)
        .margin(14)
        .margin_right(28)
        .margin_left(names.min(SIZE.0 / 2))
        .x_label_area_size(48)
        .build_cartesian_2d(results.range(), 0.0..rows)?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .disable_y_axis()
        .x_desc(&results.axis)
        .label_style((FONT, 14))
        .light_line_style(WHITE)
        .draw()?;
    let right = plotters::style::text_anchor::Pos::new(
        plotters::style::text_anchor::HPos::Right,
        plotters::style::text_anchor::VPos::Center,
    );
    let style = (FONT, 13).into_font().color(&INK).pos(right);
    for (at, scenario) in summary.scenarios.iter().enumerate() {
        let foot = rows - 1.0 - at as f64;
        let name = scenario.name.as_deref().unwrap_or_default();
        let (_, y) = chart.backend_coord(&(results.range().start, foot + 0.5));
        let (x, _) = chart.backend_coord(&(results.range().start, foot));
        let (left, top) = area.get_base_pixel();
        area.draw_text(name, &style, (x - left - 8, y - top))?;
        let Some(spread) = scenario.spread(&summary.result) else {
            continue;
        };
        let [low, middle, high] =
            [spread.low_p90, spread.mid_p50, spread.high_p10].map(|value| value / results.unit);
        let color = COLORS[at % COLORS.len()];
        let bar = Rectangle::new(
            [(low, foot + 0.25), (high, foot + 0.75)],
            color.mix(0.7).filled(),
        );
        chart.draw_series(std::iter::once(bar))?;
        let mark = [(middle, foot + 0.15), (middle, foot + 0.85)];
        chart.draw_series(LineSeries::new(mark, INK.stroke_width(2)))?;
    }
    Ok(())
}
