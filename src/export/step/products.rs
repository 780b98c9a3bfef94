//! Products and their tree.
//!
//! The entities are those that the kernel writes, which every reader takes: one PRODUCT per node, placed in its parent by a
//! `NEXT_ASSEMBLY_USAGE_OCCURRENCE`; its solids, its faces if it has none, or its curves are on layers and coloured themselves. Each
//! representation has a context of its own, as the placement of one in another demands; all have the same units.

use std::collections::HashMap;

use super::document::{Content, Document, Node, Protocol};
use super::draft::Draft;
use super::geometry::Geometry;
use super::part21::{Id, List, Quoted};
use super::presentation::Presentation;
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

/// Whole curves as a set of them, which is what every reader takes for wires.
fn curve_set<'a>(
    to: &mut Draft<'a>,
    geometry: &mut Geometry<'a>,
    name: &str,
    curves: &[usize],
) -> Items {
    let curves: Vec<Id> = curves
        .iter()
        .map(|curve| geometry.curve(to, *curve))
        .collect();
    let set = to.add(format_args!(
        "GEOMETRIC_CURVE_SET({},{})",
        Quoted(name),
        List(&curves)
    ));
    Items {
        roots: vec![set],
        styled: vec![set],
        has_solid: false,
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
    fn write(to: &mut Draft<'_>, document: &Document) -> Self {
        let application = application(to, document.protocol);
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
                "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{metre},'distance_accuracy_value','confusion accuracy')",
                one_digit(document.accuracy)
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

    /// A context for one representation.
    fn context(&self, to: &mut Draft<'_>) -> Id {
        to.add(format_args!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({}))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT({})\
             REPRESENTATION_CONTEXT('Context #1','3D Context with UNIT and UNCERTAINTY'))",
            self.uncertainty,
            List(&self.units)
        ))
    }
}

/// A number of one digit that is not smaller: `1.E-07`.
fn one_digit(value: f64) -> String {
    let exponent = value.log10().floor();
    // What is one digit already stays, whatever its logarithm is rounded to.
    let digit = (value / 10_f64.powf(exponent) - 1e-9).ceil();
    let (digit, exponent) = if digit < 10.0 {
        (digit, exponent)
    } else {
        (1.0, exponent + 1.0)
    };
    let sign = if exponent < 0.0 { '-' } else { '+' };
    format!("{digit}.E{sign}{:02}", exponent.abs())
}

/// The context of the application protocol.
fn application(to: &mut Draft<'_>, protocol: Protocol) -> Id {
    let (application, name, year) = match protocol {
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
        "APPLICATION_PROTOCOL_DEFINITION('international standard','{name}',{year},{application})"
    ));
    application
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
    presentation: Presentation,
}

impl<'a, 'd> Products<'a, 'd> {
    pub(super) fn new(to: &'d mut Draft<'a>, document: &Document) -> Self {
        let common = Common::write(to, document);
        Self {
            to,
            common,
            names: HashMap::new(),
            occurrences: 0,
            presentation: Presentation::default(),
        }
    }

    /// A product with all below it.
    pub(super) fn tree(&mut self, node: &Node, geometry: &mut Geometry<'a>) {
        self.node(node, geometry);
    }

    /// A product without a tree.
    pub(super) fn single(&mut self, node: &Node, kind: &str, items: Vec<Id>) {
        self.product(node, kind, items);
    }

    fn node(&mut self, node: &Node, geometry: &mut Geometry<'a>) -> Product {
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
                self.shown(node, kind, items)
            }
            Content::Curves(curves) => {
                let items = curve_set(self.to, geometry, node.shown(), curves);
                let kind = "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION";
                self.shown(node, kind, items)
            }
            Content::Nodes(nodes) => {
                let places: Vec<Id> = nodes
                    .iter()
                    .map(|_| placement(self.to, &self.common.axes))
                    .collect();
                let parent = self.product(node, "SHAPE_REPRESENTATION", places.clone());
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

    /// A product with its layer and its colour.
    fn shown(&mut self, node: &Node, kind: &str, items: Items) -> Product {
        let product = self.product(node, kind, items.roots);
        let layer = node.layer.as_deref();
        self.presentation
            .add(items.styled, layer, node.color, product.context);
        product
    }

    /// Products have a name each, which is their identifier, and a label, which programs show; identifiers of those that share a
    /// name differ.
    fn product(&mut self, node: &Node, kind: &str, mut items: Vec<Id>) -> Product {
        let name = node.name.as_str();
        let count = self.names.entry(name.to_owned()).or_default();
        *count += 1;
        let identifier = match count {
            1 => name.to_owned(),
            _ => format!("{name} #{count}"),
        };
        let Common {
            product_context,
            definition_context,
            placement,
            ..
        } = &self.common;
        let to = &mut *self.to;
        let context = self.common.context(to);
        let product = to.add(format_args!(
            "PRODUCT({},{},{},({product_context}))",
            Quoted(&identifier),
            Quoted(node.shown()),
            Quoted(node.description.as_deref().unwrap_or_default())
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
            Quoted(node.shown()),
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
        self.presentation.write(self.to);
    }
}
