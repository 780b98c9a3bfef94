//! The comparison as a plot: what grids say, against what the surfaces say, by the size of cells.

use std::error::Error;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::cells::Connectivity;

/// Width and height (px).
pub(crate) const SIZE: (u32, u32) = (1350, 480);
const FONT: &str = "sans-serif";
const INK: RGBColor = RGBColor(0x33, 0x33, 0x33);
const GRID: RGBColor = RGBColor(0xd9, 0x8b, 0x2b);

/// What one realisation is: exactly, and on grids of falling cell size.
pub(crate) struct Compared {
    pub(crate) seed: u64,
    pub(crate) exact: Connectivity,
    pub(crate) grids: Vec<Connectivity>,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// What is asked of a realisation's grid and of its surfaces.
type Measure = fn(&Connectivity, &Connectivity) -> f64;

/// Three panels side by side: sandbodies, Γ and net-to-gross.
pub(crate) fn svg(all: &[Compared], sizes: &[f64]) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    {
        let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let panels = area.split_evenly((1, 3));
        let measures: [(&str, &str, Measure); 3] = [
            (
                "Sandbodies",
                "on the grid ÷ exact (powers of 2)",
                |grid, exact| (grid.bodies as f64 / exact.bodies as f64).log2(),
            ),
            ("Connectivity Γ", "on the grid − exact", |grid, exact| {
                grid.gamma - exact.gamma
            }),
            ("Net-to-gross", "on the grid ÷ exact", |grid, exact| {
                grid.net_to_gross / exact.net_to_gross
            }),
        ];
        for (at, (panel, (title, axis, measure))) in panels.iter().zip(measures).enumerate() {
            let agreed = if at == 2 { 1.0 } else { 0.0 };
            draw(panel, all, sizes, (title, axis, measure), agreed)?;
        }
        area.present()?;
    }
    Ok(svg)
}

fn draw(
    panel: &Area<'_>,
    all: &[Compared],
    sizes: &[f64],
    (title, axis, measure): (&str, &str, Measure),
    agreed: f64,
) -> Result<(), Box<dyn Error>> {
    let lines: Vec<Vec<f64>> = all
        .iter()
        .map(|one| {
            let each = one.grids.iter();
            each.map(|grid| measure(grid, &one.exact)).collect()
        })
        .collect();
    let reach = lines
        .iter()
        .flatten()
        .fold(0.05_f64, |most, value| most.max((value - agreed).abs()));
    let last = sizes.len() as f64 - 1.0;
    let mut chart = ChartBuilder::on(panel)
        .caption(title, (FONT, 20).into_font().color(&INK))
        .margin(12)
        .margin_right(24)
        .x_label_area_size(48)
        .y_label_area_size(70)
        .build_cartesian_2d(
            -0.2..last + 0.2,
            agreed - reach * 1.08..agreed + reach * 1.08,
        )?;
    chart
        .configure_mesh()
        .x_labels(sizes.len())
        .x_desc("cells' width (m)")
        .y_desc(axis)
        .x_label_formatter(&|at| label(*at, sizes))
        .label_style((FONT, 13))
        .light_line_style(WHITE)
        .draw()?;
    let exact = [(-0.2, agreed), (last + 0.2, agreed)];
    chart.draw_series(LineSeries::new(exact, INK.stroke_width(2)))?;
    let points = |line: &[f64]| -> Vec<(f64, f64)> {
        let numbered = line.iter().enumerate();
        numbered.map(|(at, value)| (at as f64, *value)).collect()
    };
    for line in &lines {
        chart.draw_series(LineSeries::new(points(line), GRID.mix(0.3)))?;
    }
    let mean: Vec<f64> = (0..sizes.len())
        .map(|at| lines.iter().map(|line| line[at]).sum::<f64>() / lines.len() as f64)
        .collect();
    chart.draw_series(LineSeries::new(points(&mean), GRID.stroke_width(3)))?;
    let dots = points(&mean).into_iter();
    chart.draw_series(dots.map(|at| Circle::new(at, 4, GRID.filled())))?;
    Ok(())
}

/// The size of the cells at a whole number of halvings; nothing between them.
fn label(at: f64, sizes: &[f64]) -> String {
    let mut named = sizes.iter().enumerate();
    let found = named.find(|(number, _)| (at - *number as f64).abs() < 1e-6);
    found.map_or_else(String::new, |(_, size)| size.to_string())
}
