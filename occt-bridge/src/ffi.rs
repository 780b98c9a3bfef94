//! The only file that names C++: one line per shim function, and the flat tables they exchange.
//!
//! Every function returns `Result`, because in OpenCASCADE anything can throw. Indices are `u32`; an index and a flag share one
//! number where a table says `2 * index + reversed`. Tables of lists are `starts` (one more than lists) and values.
#![allow(
    unsafe_code,
    unreachable_pub,
    missing_docs,
    elided_lifetimes_in_paths,
    clippy::needless_lifetimes,
    clippy::too_many_arguments,
    reason = "what cxx needs and generates"
)]

use crate::monitor::Monitor;

#[cxx::bridge(namespace = "clinothem::occt")]
pub(crate) mod bridge {
    /// Degree 0 is a line from the first to the second pole.
    struct CurveData {
        degree: u32,
        knots: Vec<f64>,
        poles: Vec<f64>,
        weights: Vec<f64>,
    }

    /// Degree 0 is a plane: poles are origin, normal, x axis.
    struct SurfaceData {
        degree_u: u32,
        degree_v: u32,
        knots_u: Vec<f64>,
        knots_v: Vec<f64>,
        poles: Vec<f64>,
        weights: Vec<f64>,
    }

    struct EdgeData {
        curve: usize,
        first: f64,
        last: f64,
        start: usize,
        end: usize,
    }

    /// Degree 0 is a line: poles are its origin and direction.
    struct PcurveData {
        has: bool,
        degree: u32,
        knots: Vec<f64>,
        poles: Vec<f64>,
        weights: Vec<f64>,
    }

    struct EdgeUseData {
        edge: usize,
        reversed: bool,
        pcurve: PcurveData,
    }

    /// `loops` counts the uses of each loop.
    struct FaceData {
        surface: usize,
        reversed: bool,
        loops: Vec<u32>,
        uses: Vec<EdgeUseData>,
    }

    struct TopologyData {
        tolerance: f64,
        vertices: Vec<f64>,
        curves: Vec<CurveData>,
        surfaces: Vec<SurfaceData>,
        edges: Vec<EdgeData>,
        faces: Vec<FaceData>,
    }

    #[derive(Default)]
    struct PartitionTables {
        cell_starts: Vec<u32>,
        cell_faces: Vec<u32>,
        inside_starts: Vec<u32>,
        inside: Vec<u32>,
        face_starts: Vec<u32>,
        face_edges: Vec<u32>,
        origin_starts: Vec<u32>,
        /// argument, face, 1 if of the same orientation
        origins: Vec<u32>,
        alerts: Vec<String>,
        crossing_faces: usize,
        crossing_arguments: Vec<u32>,
        internal_faces: usize,
        unoriented_faces: usize,
    }

    #[derive(Default)]
    struct MergeData {
        shells_of_solids: Vec<u32>,
        faces_of_shells: Vec<u32>,
        uses: Vec<u32>,
        faces: Vec<u32>,
    }

    struct VertexRow {
        point: [f64; 3],
        tolerance: f64,
    }

    /// Degree 0 is a line: of two poles in space, of origin and direction on a surface.
    struct CurveRow {
        degree: u32,
        poles: u32,
        rational: bool,
    }

    /// Degree 0 is a plane: poles are origin, normal, x axis.
    struct SurfaceRow {
        degree_u: u32,
        degree_v: u32,
        poles_u: u32,
        poles_v: u32,
        rational: bool,
    }

    /// `on` counts its rows in the table of that name.
    struct EdgeRow {
        degenerate: bool,
        curve: u32,
        first: f64,
        last: f64,
        start: u32,
        end: u32,
        tolerance: f64,
        on: u32,
    }

    struct OnRow {
        surface: u32,
        forward: u32,
        seam: bool,
        reversed: u32,
    }

    struct FaceRow {
        surface: u32,
        tolerance: f64,
        loops: u32,
    }

    /// No row owns memory, so that a table is one block: `numbers` holds knots, poles and weights of the curves, then of the
    /// surfaces, then of the pcurves; `loops` counts the uses of each loop.
    struct AssembledData {
        vertices: Vec<VertexRow>,
        curves: Vec<CurveRow>,
        surfaces: Vec<SurfaceRow>,
        pcurves: Vec<CurveRow>,
        numbers: Vec<f64>,
        edges: Vec<EdgeRow>,
        on: Vec<OnRow>,
        faces: Vec<FaceRow>,
        loops: Vec<u32>,
        uses: Vec<u32>,
        solids: MergeData,
    }

    struct BoundaryEdgeRow {
        degenerate: bool,
        curve: u32,
        from: f64,
        to: f64,
        start: u32,
        end: u32,
    }

    /// A degenerate edge, and any on a plane, has no pcurve.
    struct BoundaryUseRow {
        edge: u32,
        has_pcurve: bool,
        pcurve: u32,
    }

    struct BoundaryFaceRow {
        surface: u32,
        loops: u32,
    }

    /// The way back: what `AssembledData` says, of shapes. Of a shape that is no solid, no shells are counted; its faces follow as
    /// one.
    #[derive(Default)]
    struct BoundaryRows {
        vertices: Vec<f64>,
        curves: Vec<CurveRow>,
        pcurves: Vec<CurveRow>,
        surfaces: Vec<SurfaceRow>,
        edges: Vec<BoundaryEdgeRow>,
        faces: Vec<BoundaryFaceRow>,
        loops: Vec<u32>,
        uses: Vec<BoundaryUseRow>,
        shells_of_shapes: Vec<u32>,
        faces_of_shells: Vec<u32>,
        uses_of_faces: Vec<u32>,
    }

    struct BoxData {
        min: [f64; 3],
        max: [f64; 3],
    }

    #[derive(Default, Clone)]
    struct FaceIntegralData {
        area: f64,
        flux: f64,
        area_error: f64,
        flux_error: f64,
        tolerance: f64,
    }

    #[derive(Clone)]
    struct FaceSampleData {
        face: usize,
        point: [f64; 3],
        normal: [f64; 3],
    }

    struct DefectData {
        solid: usize,
        what: String,
    }

    struct ReadPartData {
        name: String,
        path: String,
        has_color: bool,
        color: [u8; 3],
        layer: String,
    }

    #[derive(Default)]
    struct BodyRead {
        unit: String,
        volume: f64,
        faces: usize,
        tolerance: f64,
    }

    extern "Rust" {
        type Monitor<'a>;
        fn is_cancelled(&self) -> bool;
        fn report(&self, fraction: f64);
    }

    unsafe extern "C++" {
        include!("occt-bridge/shim/failure.hpp");
        include!("occt-bridge/shim/shape.hpp");
        include!("occt-bridge/shim/topology.hpp");
        include!("occt-bridge/shim/partition.hpp");
        include!("occt-bridge/shim/assembled.hpp");
        include!("occt-bridge/shim/measure.hpp");
        include!("occt-bridge/shim/check.hpp");
        include!("occt-bridge/shim/step.hpp");
        include!("occt-bridge/shim/brep.hpp");
        include!("occt-bridge/shim/boundary.hpp");
        include!("occt-bridge/shim/body.hpp");

        type ShapeHandle;
        type ShapeList;
        type PartitionHandle;
        type SolidsHandle;
        type ClassifierHandle;
        type ReadParts;

        fn kernel_version() -> Result<String>;
        fn use_threads(count: usize) -> Result<()>;
        fn kind_of(shape: &ShapeHandle) -> Result<String>;
        fn count_of(shape: &ShapeHandle, kind: u8) -> Result<usize>;
        fn new_list() -> Result<UniquePtr<ShapeList>>;
        fn push(self: Pin<&mut ShapeList>, shape: &ShapeHandle) -> Result<()>;
        fn compound_of(list: &ShapeList) -> Result<UniquePtr<ShapeHandle>>;

        fn build_solid(data: &TopologyData) -> Result<UniquePtr<ShapeHandle>>;
        fn build_faces(data: &TopologyData) -> Result<UniquePtr<ShapeHandle>>;

        fn run_partition(
            arguments: &ShapeList,
            parallel: bool,
            fuzzy: f64,
            monitor: &Monitor<'_>,
        ) -> Result<UniquePtr<PartitionHandle>>;
        fn adopt(arguments: &ShapeList) -> Result<UniquePtr<PartitionHandle>>;
        fn tables_of(partition: &PartitionHandle) -> Result<PartitionTables>;
        fn build_solids(
            partition: &PartitionHandle,
            data: &MergeData,
        ) -> Result<UniquePtr<SolidsHandle>>;
        fn build_assembled(data: &AssembledData) -> Result<UniquePtr<SolidsHandle>>;
        fn solid_of(solids: &SolidsHandle, index: usize) -> Result<UniquePtr<ShapeHandle>>;
        fn face_of(solids: &SolidsHandle, index: usize) -> Result<UniquePtr<ShapeHandle>>;
        fn compound_of_solids(solids: &SolidsHandle) -> Result<UniquePtr<ShapeHandle>>;
        fn edges_of(solids: &SolidsHandle) -> Result<usize>;

        fn shape_volume(shape: &ShapeHandle, eps: f64) -> Result<f64>;
        fn shape_area(shape: &ShapeHandle, eps: f64) -> Result<f64>;
        fn shape_bounds(shape: &ShapeHandle) -> Result<[f64; 6]>;
        fn solid_boxes(solids: &SolidsHandle, parallel: bool) -> Result<Vec<BoxData>>;
        fn integrate_faces(
            solids: &SolidsHandle,
            eps: f64,
            reference: [f64; 3],
            parallel: bool,
        ) -> Result<Vec<FaceIntegralData>>;
        fn sample_faces(
            solids: &SolidsHandle,
            per_face: usize,
            parallel: bool,
        ) -> Result<Vec<FaceSampleData>>;
        fn new_classifier(shape: &ShapeHandle) -> Result<UniquePtr<ClassifierHandle>>;
        fn classify(
            self: Pin<&mut ClassifierHandle>,
            point: [f64; 3],
            tolerance: f64,
        ) -> Result<u8>;

        fn find_defects(solids: &SolidsHandle, parallel: bool) -> Result<Vec<DefectData>>;

        fn read_parts(
            path: &str,
            unit: &str,
            tables: &mut Vec<ReadPartData>,
        ) -> Result<UniquePtr<ReadParts>>;
        fn shape(self: &ReadParts, index: usize) -> Result<UniquePtr<ShapeHandle>>;

        fn read_body(
            bytes: &[u8],
            step: bool,
            unit: f64,
            told: &mut BodyRead,
        ) -> Result<UniquePtr<ShapeHandle>>;
        fn placed_shape(
            shape: &ShapeHandle,
            scale: f64,
            turn: f64,
            at: [f64; 3],
        ) -> Result<UniquePtr<ShapeHandle>>;

        fn boundary_of(
            list: &ShapeList,
            rows: &mut BoundaryRows,
        ) -> Result<UniquePtr<CxxVector<f64>>>;

        fn write_brep_file(shape: &ShapeHandle, path: &str) -> Result<()>;
        fn read_brep_file(path: &str) -> Result<UniquePtr<ShapeHandle>>;
        fn solids_to_bytes(solids: &SolidsHandle) -> Result<Vec<u8>>;
        fn solids_from_bytes(bytes: &[u8]) -> Result<UniquePtr<SolidsHandle>>;
        fn shape_to_bytes(shape: &ShapeHandle) -> Result<Vec<u8>>;
        fn shape_from_bytes(bytes: &[u8]) -> Result<UniquePtr<ShapeHandle>>;
    }
}

// SAFETY: a handle owns its C++ object, whose reference counts are atomic, and no handle is tied to the thread that made it. What
// two handles share (geometry, topology) is never written by this crate: operations that write work on a copy of the topology.
unsafe impl Send for bridge::ShapeHandle {}
// SAFETY: as above.
unsafe impl Send for bridge::PartitionHandle {}
// SAFETY: as above.
unsafe impl Send for bridge::SolidsHandle {}
// SAFETY: as above; a classifier also owns its caches.
unsafe impl Send for bridge::ClassifierHandle {}
// SAFETY: the functions that take `&` read only.
unsafe impl Sync for bridge::ShapeHandle {}
// SAFETY: as above.
unsafe impl Sync for bridge::PartitionHandle {}
// SAFETY: as above.
unsafe impl Sync for bridge::SolidsHandle {}
