//! Products, their tree, layers and colours.
//!
//! The entities are those that the kernel writes, which every reader takes: one PRODUCT per node, placed in its parent by a
//! `NEXT_ASSEMBLY_USAGE_OCCURRENCE`; its solids, or its faces if it has none, are on layers and coloured themselves. Each
//! representation has a context of its own, as the placement of one in another demands; all have the same units.

use std::collections::HashMap;

use super::Protocol;
use super::document::{Content, Node};
use super::geometry::Geometry;
use super::part21::{Draft, Id, List, Quoted};
use super::topology::Topology;
use crate::assembly::kernel::BoundaryShape;

/// The shapes of a product.
#[derive(Default)]
pub(super) struct Items {
    /// What its representation lists.
    roots: Vec<Id>,
    /// What has colours and layers.
    styled: Vec<Id>,
    /// Whether any is a solid.
    has_solid: bool,
}

impl Items {
    /// Writes a shape with a topology of its own.
    pub(super) fn add<'a>(
        &mut self,
        to: &mut Draft<'a>,
        geometry: &mut Geometry<'a>,
        shape: &BoundaryShape,
    ) {
        match shape {
            BoundaryShape::Solid(shells) => {
                let faces = shells.iter().flatten().map(|(face, _)| *face);
                let solid = Topology::new(geometry, faces).solid(to, shells);
                self.roots.extend(solid);
                self.styled.extend(solid);
                self.has_solid = true;
            }
            BoundaryShape::Faces(shell) => {
                let faces = shell.iter().map(|(face, _)| *face);
                let faces = Topology::new(geometry, faces).faces(to, shell);
                let shell = to.add(format_args!("OPEN_SHELL('',{})", List(&faces)));
                self.roots
                    .push(to.add(format_args!("SHELL_BASED_SURFACE_MODEL('',({shell}))")));
                self.styled.extend(faces);
            }
        }
    }
}

/// A product that has been written.
struct Product {
    definition: Id,
    representation: Id,
    context: Id,
}

/// What all products of a file have in common.
struct Common {
    product_context: Id,
    definition_context: Id,
    uncertainty: Id,
    units: [Id; 3],
    /// Origin, axis and x axis of the placement below.
    axes: [Id; 3],
    placement: Id,
}

impl Common {
    fn write(to: &mut Draft<'_>, protocol: Protocol) -> Self {
        let (application, status, year) = match protocol {
            Protocol::Ap214 => (
                "core data for automotive mechanical design processes",
                "automotive_design",
                2000,
            ),
            Protocol::Ap242 => (
                "Managed model based 3d engineering",
                "ap242_managed_model_based_3d_engineering",
                2013,
            ),
        };
        let application = to.add(format_args!("APPLICATION_CONTEXT('{application}')"));
        to.add(format_args!(
            "APPLICATION_PROTOCOL_DEFINITION('international standard','{status}',{year},{application})"
        ));
        let metre = to.add(format_args!(
            "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))"
        ));
        let axes = [
            "CARTESIAN_POINT('',(0.,0.,0.))",
            "DIRECTION('',(0.,0.,1.))",
            "DIRECTION('',(1.,0.,0.))",
        ]
        .map(|axis| to.add(format_args!("{axis}")));
        Self {
            product_context: to.add(format_args!(
                "PRODUCT_CONTEXT('',{application},'mechanical')"
            )),
            definition_context: to.add(format_args!(
                "PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"
            )),
            uncertainty: to.add(format_args!(
                "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),{metre},'distance_accuracy_value','confusion accuracy')"
            )),
            units: [
                metre,
                to.add(format_args!(
                    "(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))"
                )),
                to.add(format_args!(
                    "(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())"
                )),
            ],
            axes,
            placement: placement(to, &axes),
        }
    }
}

fn placement(to: &mut Draft<'_>, [origin, axis, x]: &[Id; 3]) -> Id {
    to.add(format_args!("AXIS2_PLACEMENT_3D('',{origin},{axis},{x})"))
}

/// Writes the products of a file.
pub(super) struct Products<'a, 'd> {
    to: &'d mut Draft<'a>,
    common: Common,
    /// How often a name was given.
    names: HashMap<String, usize>,
    occurrences: usize,
    /// In the order of their first use.
    layers: Vec<(String, Vec<Id>)>,
    /// Colours with what has them, by product and its context.
    colored: Vec<([u8; 3], Vec<Id>, Id)>,
}

impl<'a, 'd> Products<'a, 'd> {
    pub(super) fn new(to: &'d mut Draft<'a>, protocol: Protocol) -> Self {
        let common = Common::write(to, protocol);
        Self {
            to,
            common,
            names: HashMap::new(),
            occurrences: 0,
            layers: Vec::new(),
            colored: Vec::new(),
        }
    }

    /// A product with all below it.
    pub(super) fn tree(&mut self, node: &Node, geometry: &mut Geometry<'a>) {
        self.node(node, geometry);
    }

    /// A product without a tree.
    pub(super) fn single(&mut self, name: &str, kind: &str, items: Vec<Id>) {
        self.product(name, "", kind, items);
    }

    fn node(&mut self, node: &Node, geometry: &mut Geometry<'a>) -> Product {
        let description = node.description.as_deref().unwrap_or_default();
        match &node.content {
            Content::Shapes(indices) => {
                let mut items = Items::default();
                for index in indices {
                    let shape = &geometry.boundary.shapes[*index];
                    items.add(self.to, geometry, shape);
                }
                let kind = if items.has_solid {
                    "ADVANCED_BREP_SHAPE_REPRESENTATION"
                } else {
                    "MANIFOLD_SURFACE_SHAPE_REPRESENTATION"
                };
                let product = self.product(&node.name, description, kind, items.roots);
                if let Some(layer) = &node.layer {
                    match self.layers.iter_mut().find(|(name, _)| name == layer) {
                        Some((_, on)) => on.extend(&items.styled),
                        None => self.layers.push((layer.clone(), items.styled.clone())),
                    }
                }
                if let Some(color) = node.color {
                    self.colored.push((color, items.styled, product.context));
                }
                product
            }
            Content::Nodes(nodes) => {
                let places: Vec<Id> = nodes
                    .iter()
                    .map(|_| placement(self.to, &self.common.axes))
                    .collect();
                let parent = self.product(
                    &node.name,
                    description,
                    "SHAPE_REPRESENTATION",
                    places.clone(),
                );
                for (child, place) in nodes.iter().zip(places) {
                    self.occurrences += 1;
                    let number = self.occurrences;
                    let placed = self.node(child, geometry);
                    self.place(number, child, &placed, &parent, place);
                }
                parent
            }
        }
    }

    /// Products have a name each; those that share one have identifiers that differ.
    fn product(
        &mut self,
        name: &str,
        description: &str,
        kind: &str,
        mut items: Vec<Id>,
    ) -> Product {
        let count = self.names.entry(name.to_owned()).or_default();
        *count += 1;
        let identifier = match count {
            1 => name.to_owned(),
            _ => format!("{name} #{count}"),
        };
        let Common {
            product_context,
            definition_context,
            uncertainty,
            units,
            placement,
            ..
        } = &self.common;
        let to = &mut *self.to;
        let product = to.add(format_args!(
            "PRODUCT({},{},{},({product_context}))",
            Quoted(&identifier),
            Quoted(name),
            Quoted(description)
        ));
        to.add(format_args!(
            "PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"
        ));
        let formation = to.add(format_args!(
            "PRODUCT_DEFINITION_FORMATION('','',{product})"
        ));
        let definition = to.add(format_args!(
            "PRODUCT_DEFINITION('design','',{formation},{definition_context})"
        ));
        let shape = to.add(format_args!("PRODUCT_DEFINITION_SHAPE('','',{definition})"));
        let context = to.add(format_args!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertainty}))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT({})\
             REPRESENTATION_CONTEXT('Context #1','3D Context with UNIT and UNCERTAINTY'))",
            List(units)
        ));
        items.insert(0, *placement);
        let representation = to.add(format_args!("{kind}('',{},{context})", List(&items)));
        to.add(format_args!(
            "SHAPE_DEFINITION_REPRESENTATION({shape},{representation})"
        ));
        Product {
            definition,
            representation,
            context,
        }
    }

    /// Puts a product where its parent is.
    fn place(&mut self, number: usize, node: &Node, child: &Product, parent: &Product, at: Id) {
        let to = &mut *self.to;
        let occurrence = to.add(format_args!(
            "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{number}',{},'',{},{},$)",
            Quoted(&node.name),
            parent.definition,
            child.definition
        ));
        let shape = to.add(format_args!(
            "PRODUCT_DEFINITION_SHAPE('Placement','Placement of an item',{occurrence})"
        ));
        let transformation = to.add(format_args!(
            "ITEM_DEFINED_TRANSFORMATION('','',{},{at})",
            self.common.placement
        ));
        let relation = to.add(format_args!(
            "(REPRESENTATION_RELATIONSHIP('','',{},{})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({transformation})\
             SHAPE_REPRESENTATION_RELATIONSHIP())",
            child.representation, parent.representation
        ));
        to.add(format_args!(
            "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{shape})"
        ));
    }

    /// Layers and colours.
    pub(super) fn finish(self) {
        let to = self.to;
        for (name, on) in &self.layers {
            to.add(format_args!(
                "PRESENTATION_LAYER_ASSIGNMENT({},'visible',{})",
                Quoted(name),
                List(on)
            ));
        }
        let mut styles: HashMap<[u8; 3], Id> = HashMap::new();
        for (color, items, context) in &self.colored {
            let style = *styles.entry(*color).or_insert_with(|| style(to, *color));
            let styled: Vec<Id> = items
                .iter()
                .map(|item| to.add(format_args!("STYLED_ITEM('color',({style}),{item})")))
                .collect();
            to.add(format_args!(
                "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{},{context})",
                List(&styled)
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
