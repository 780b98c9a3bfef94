//! Values that kinds of features share: each with its table, its checks, what editors are told of it, and its draws.

pub(crate) mod bank;
pub(crate) mod bent;
pub(crate) mod conform;
pub(crate) mod distribution;
pub(crate) mod ends;
pub(crate) mod facies;
pub(crate) mod fault;
pub(crate) mod honours;
pub(crate) mod junction;
pub(crate) mod limits;
pub(crate) mod lobe;
pub(crate) mod nets;
pub(crate) mod profile;
pub(crate) mod property;
pub(crate) mod quantity;
pub(crate) mod section;
pub(crate) mod selector;
pub(crate) mod surface;
pub(crate) mod trajectory;
pub(crate) mod tuple;
pub(crate) mod unit;
