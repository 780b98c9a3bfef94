//! Layers and colours.

use std::collections::HashMap;

use super::draft::Draft;
use super::part21::{Id, List, Quoted};

/// What is on layers, and what has colours.
#[derive(Default)]
pub(super) struct Presentation {
    /// In the order of their first use.
    layers: Vec<(String, Vec<Id>)>,
    colored: Vec<Colored>,
}

/// Items of one product.
struct Colored {
    color: [u8; 3],
    items: Vec<Id>,
    /// That of the product's representation.
    context: Id,
}

impl Presentation {
    pub(super) fn add(
        &mut self,
        items: Vec<Id>,
        layer: Option<&str>,
        color: Option<[u8; 3]>,
        context: Id,
    ) {
        if let Some(layer) = layer {
            match self.layers.iter_mut().find(|(name, _)| name == layer) {
                Some((_, on)) => on.extend(&items),
                None => self.layers.push((layer.to_owned(), items.clone())),
            }
        }
        self.colored.extend(color.map(|color| Colored {
            color,
            items,
            context,
        }));
    }

    pub(super) fn write(&self, to: &mut Draft<'_>) {
        for (name, on) in &self.layers {
            to.add(format_args!(
                "PRESENTATION_LAYER_ASSIGNMENT({},'visible',{})",
                Quoted(name),
                List(on)
            ));
        }
        let mut styles: HashMap<[u8; 3], Id> = HashMap::new();
        for colored in &self.colored {
            let color = colored.color;
            let style = *styles.entry(color).or_insert_with(|| style(to, color));
            let styled: Vec<Id> = colored
                .items
                .iter()
                .map(|item| to.add(format_args!("STYLED_ITEM('color',({style}),{item})")))
                .collect();
            to.add(format_args!(
                "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{},{})",
                List(&styled),
                colored.context
            ));
        }
    }
}

/// How everything of a colour looks: surfaces and curves.
fn style(to: &mut Draft<'_>, color: [u8; 3]) -> Id {
    let rgb = to.write(|text| {
        text.push("COLOUR_RGB(''");
        for part in color {
            text.push(",");
            text.real(f64::from(part) / 255.0);
        }
        text.push(")");
    });
    let filling = to.add(format_args!("FILL_AREA_STYLE_COLOUR('',{rgb})"));
    let filling = to.add(format_args!("FILL_AREA_STYLE('',({filling}))"));
    let filling = to.add(format_args!("SURFACE_STYLE_FILL_AREA({filling})"));
    let side = to.add(format_args!("SURFACE_SIDE_STYLE('',({filling}))"));
    let surface = to.add(format_args!("SURFACE_STYLE_USAGE(.BOTH.,{side})"));
    let font = to.add(format_args!(
        "DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous')"
    ));
    let curve = to.add(format_args!(
        "CURVE_STYLE('',{font},POSITIVE_LENGTH_MEASURE(0.1),{rgb})"
    ));
    to.add(format_args!(
        "PRESENTATION_STYLE_ASSIGNMENT(({surface},{curve}))"
    ))
}
