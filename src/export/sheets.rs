//! The surfaces of a model as triangles: trimmed, as far as each parts two volumes inside the domain; or whole, as the bodies
//! have them.

use std::collections::BTreeMap;

use super::ExportError;
use super::mesh::{Triangulation, VolumeMesh, collect, failed};
use crate::assembly::boundary::tables;
use crate::assembly::{self, Assembly, kernel};
use crate::features::body::{Body, Role};
use crate::mesh::{self, Fineness, Mesh, Support, Tables, Used};
use crate::model::plan::AssemblyPlan;
use crate::model::realisation::Realisation;

/// Surfaces, each with its triangles.
pub struct Sheets {
    sources: Vec<Source>,
    all: Vec<Sheet>,
}

struct Source {
    tables: Tables,
    mesh: Mesh,
}

/// A surface: a sheet of a body, or all of them that are called the same.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Its volume's name and what it is called there: `channel-3/base`.
    pub name: String,
    /// The volume.
    pub volume: usize,
    source: usize,
    faces: Vec<Used>,
}

/// A face belongs to a sheet that is so near to it, as a share of the domain's diagonal: contacts decided by age are moved by less.
const NEAR: f64 = 1e-5;

impl Sheets {
    /// What of the surfaces parts two volumes.
    pub fn trimmed(
        assembly: &Assembly,
        plan: &AssemblyPlan,
        realisation: &Realisation,
        fineness: &Fineness,
    ) -> Result<Self, ExportError> {
        let triangles = Triangulation::new(assembly, fineness)?;
        // Faces of one sheet of a shell are of one sheet of its body.
        let mut roles: BTreeMap<(usize, usize), Option<Role>> = BTreeMap::new();
        let mut faces: BTreeMap<(usize, String), Vec<Used>> = BTreeMap::new();
        let near = NEAR * plan.low().distance(plan.high());
        for (face, origin) in assembly.shells_of_faces() {
            let Some((shell, of)) = origin else { continue };
            let Some(body) = plan.bodies.iter().find(|body| body.shell == shell) else {
                continue;
            };
            let used = triangles.face(face);
            let key = (body.volume, of);
            let role = if let Some(role) = roles.get(&key) {
                *role
            } else {
                let role = role(realisation, body.volume, &triangles, used, near)?;
                *roles.entry(key).or_insert(role)
            };
            let name = &realisation.volumes[body.volume].name;
            let name = match role {
                Some(role) if role.is_geological() => format!("{name}/{}", role.name()),
                Some(_) => continue,
                None => format!("{name}/cut"),
            };
            // Sheets look the way their surfaces do.
            faces
                .entry((body.volume, name))
                .or_default()
                .push((used.0, false));
        }
        let sheet = |((volume, name), faces)| Sheet {
            name,
            volume,
            source: 0,
            faces,
        };
        let all = faces.into_iter().map(sheet).collect();
        let (tables, mesh) = triangles.into_parts();
        Ok(Self {
            sources: vec![Source { tables, mesh }],
            all,
        })
    }

    /// The surfaces of all bodies as they are, which reach beyond the domain and beyond whatever they end at.
    pub fn whole(realisation: &Realisation, fineness: &Fineness) -> Result<Self, ExportError> {
        let mut sheets = Self {
            sources: Vec::new(),
            all: Vec::new(),
        };
        for instance in &realisation.instances {
            let name = &realisation.volumes[instance.volume].name;
            if let Body::Imported(imported) = &instance.body {
                // Its faces end where they should.
                let tables = imported.tables().clone();
                let mesh = mesh::triangulate(&tables, fineness)?;
                sheets.all.push(Sheet {
                    name: format!("{name}/{}", Role::Skin.name()),
                    volume: instance.volume,
                    source: sheets.sources.len(),
                    faces: imported.original().uses().collect(),
                });
                sheets.sources.push(Source { tables, mesh });
                continue;
            }
            for (role, surface) in surfaces(realisation, instance.volume)? {
                if !role.is_geological() {
                    continue;
                }
                let shape =
                    kernel::faces(&assembly::shapes::sheet(role, &surface)).map_err(failed)?;
                let boundary = kernel::boundary(&[shape]).map_err(failed)?;
                let tables = tables(&boundary).map_err(failed)?;
                let mesh = mesh::triangulate(&tables, fineness)?;
                let name = format!("{name}/{}", role.name());
                let same = sheets
                    .all
                    .iter()
                    .filter(|sheet| sheet.name.split('#').next() == Some(&name))
                    .count();
                sheets.all.push(Sheet {
                    name: if same == 0 {
                        name
                    } else {
                        format!("{name}#{}", same + 1)
                    },
                    volume: instance.volume,
                    source: sheets.sources.len(),
                    faces: (0..mesh.faces.len()).map(|face| (face, false)).collect(),
                });
                sheets.sources.push(Source { tables, mesh });
            }
        }
        Ok(sheets)
    }

    /// The surfaces, by volume and name.
    pub fn all(&self) -> &[Sheet] {
        &self.all
    }

    /// Leaves out what is not asked for.
    pub fn retain(&mut self, is_asked: impl Fn(&Sheet) -> bool) {
        self.all.retain(is_asked);
    }

    /// The triangles of a surface.
    pub fn mesh(&self, sheet: &Sheet) -> Result<VolumeMesh, ExportError> {
        collect(&self.sources[sheet.source].mesh, sheet.volume, &sheet.faces)
    }

    /// The faces of a surface, with what they lie on.
    pub(super) fn faces<'a>(
        &'a self,
        sheet: &'a Sheet,
    ) -> impl Iterator<Item = (&'a Support, &'a mesh::FaceMesh)> + 'a {
        let Source { tables, mesh } = &self.sources[sheet.source];
        sheet.faces.iter().map(|(face, _)| {
            let support = &tables.surfaces[tables.faces[*face].surface];
            (support, &mesh.faces[*face])
        })
    }

    /// Points of a surface's triangles.
    pub(super) fn points(&self, sheet: &Sheet) -> &[glam::DVec3] {
        &self.sources[sheet.source].mesh.points
    }
}

fn surfaces(
    realisation: &Realisation,
    volume: usize,
) -> Result<Vec<(Role, crate::nurbs::Surface)>, ExportError> {
    let instance = realisation
        .instances
        .iter()
        .find(|instance| instance.volume == volume);
    let sheets = instance.map(|instance| instance.body.sheets()).transpose();
    let sheets = sheets.map_err(|source| ExportError::Surface {
        volume: realisation.volumes[volume].name.clone(),
        source,
    })?;
    Ok(sheets.unwrap_or_default())
}

/// Which sheet of a volume's body a face lies on; none if it is what cuts the body off.
fn role(
    realisation: &Realisation,
    volume: usize,
    triangles: &Triangulation,
    (face, _): Used,
    near: f64,
) -> Result<Option<Role>, ExportError> {
    let own = &triangles.mesh().faces[face];
    let Some(triangle) = own.triangles.first() else {
        return Ok(None);
    };
    let uv = triangle
        .iter()
        .map(|corner| glam::DVec2::from_array(own.corners[*corner].uv))
        .sum::<glam::DVec2>()
        / 3.0;
    let support = &triangles.tables().surfaces[triangles.tables().faces[face].surface];
    let point = support.point(uv);
    let mut nearest: Option<(Role, f64)> = None;
    for (role, surface) in surfaces(realisation, volume)? {
        let distance = surface.closest(point, 0.1 * near).distance;
        if distance <= near && nearest.is_none_or(|(_, least)| distance < least) {
            nearest = Some((role, distance));
        }
    }
    Ok(nearest.map(|(role, _)| role))
}
