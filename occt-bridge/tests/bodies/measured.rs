//! What tests ask of partitions and their solids.

use occt_bridge::{Cancel, FaceIntegral, Partition, PartitionOptions, Shape, Solids, partition};

pub(crate) fn cut(arguments: &[Shape]) -> Partition {
    partition(
        arguments,
        &PartitionOptions::default(),
        &Cancel::new(),
        &|_| (),
    )
    .unwrap()
}

/// The owners of cells: the youngest argument wins; cells outside argument 0 go.
pub(crate) fn youngest_in_first(partition: &Partition) -> Vec<Option<usize>> {
    partition
        .cells()
        .iter()
        .map(|c| c.inside.contains(&0).then(|| *c.inside.last().unwrap()))
        .collect()
}

/// Each solid's volume from its faces' flux.
pub(crate) fn volumes(solids: &Solids, integrals: &[FaceIntegral]) -> Vec<f64> {
    let of_face = |(face, reversed): &(usize, bool)| {
        let flux = integrals[*face].flux;
        if *reversed { -flux } else { flux }
    };
    let solids = solids.solids().iter();
    solids.map(|s| s.faces.iter().map(of_face).sum()).collect()
}

pub(crate) fn close(found: f64, exact: f64, relative: f64) {
    assert!(
        (found / exact - 1.0).abs() < relative,
        "{found} for {exact}: {:e}",
        found / exact - 1.0
    );
}
