//! References between features: what goes with what, and what is made by what was made of others, wherever those stand in the list.
//!
//! A feature has at most one *host*, each instance of which has its own instances: the parent that they lie in, or the channel
//! that they go along. Besides, it may refer to others by name. What it is made by is made before it, so features have ranks:
//! one more than the highest rank of host and referents. References that go round in a circle are defects of the model file.

use std::collections::BTreeMap;

/// What a feature goes with: each instance of that has instances of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Host {
    /// The feature of this index, in which it lies.
    In(usize),
    /// The feature of this index, along which it goes as a companion.
    Along(usize),
}

impl Host {
    /// The index of the feature.
    pub fn feature(self) -> usize {
        match self {
            Self::In(feature) | Self::Along(feature) => feature,
        }
    }
}

/// A reference to what is made of another feature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reference {
    /// Index of the feature.
    pub feature: usize,
    /// Numbers of instances that the file gives, each with the index of the feature: that one, or one of its hosts.
    pub numbers: Vec<(usize, usize)>,
    /// What follows the name of the instance in that of one of its volumes (`-3`, `-3/distal`); empty if the whole is meant.
    pub part: String,
}

/// How it is known which instance of a feature is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Number {
    /// It is this one.
    Given(usize),
    /// It is the one that what refers to it goes with, too: an ancestor of both.
    Shared,
    /// It has the number of what refers to it.
    Own,
}

/// The hosts of features and the numbers of their instances: what tells which instances are meant.
pub(crate) struct Hosts<'a> {
    /// By feature, the feature of its host.
    pub(crate) host: &'a dyn Fn(usize) -> Option<usize>,
    /// By feature, how many are made in each instance of the host.
    pub(crate) count: &'a dyn Fn(usize) -> usize,
}

impl Hosts<'_> {
    /// A feature and all that it goes with, the outermost first.
    fn chain(&self, feature: usize) -> Vec<usize> {
        let mut chain = vec![feature];
        let mut at = feature;
        while let Some(host) = (self.host)(at) {
            chain.push(host);
            at = host;
        }
        chain.reverse();
        chain
    }

    /// How the numbers of a referent and of all that it goes with are known to a feature, or the feature of which it is not
    /// known which instance is meant.
    fn numbers(&self, own: usize, reference: &Reference) -> Result<Vec<(usize, Number)>, usize> {
        let shared = self.chain(own);
        let shared = &shared[..shared.len() - 1];
        let number = |feature: usize| {
            let given = reference.numbers.iter().find(|given| given.0 == feature);
            let number = if let Some((_, given)) = given {
                Number::Given(*given)
            } else if shared.contains(&feature) {
                Number::Shared
            } else if (self.count)(feature) == 1 {
                Number::Given(1)
            } else if feature == reference.feature && (self.count)(feature) == (self.count)(own) {
                Number::Own
            } else {
                return Err(feature);
            };
            Ok((feature, number))
        };
        self.chain(reference.feature)
            .into_iter()
            .map(number)
            .collect()
    }

    /// The feature of which it is not known which instance a reference means, if there is one.
    pub(crate) fn ambiguous(&self, own: usize, reference: &Reference) -> Option<usize> {
        self.numbers(own, reference).err()
    }

    /// The numbers of the instance that is meant, the outermost host's first. The way of what refers to it has the features and
    /// numbers of its hosts and its own.
    pub(crate) fn instance(
        &self,
        way: &[(usize, usize)],
        reference: &Reference,
    ) -> Option<Vec<usize>> {
        let (own, own_number) = *way.last()?;
        let of_way = |feature: usize| way.iter().find(|one| one.0 == feature).map(|one| one.1);
        self.numbers(own, reference)
            .ok()?
            .into_iter()
            .map(|(feature, number)| match number {
                Number::Given(number) => Some(number),
                Number::Shared => of_way(feature),
                Number::Own => Some(own_number),
            })
            .collect()
    }
}

/// By feature, what it waits for: the features that are made before it.
pub(crate) type Waits = Vec<Vec<usize>>;

/// Ranks of features, each one more than the highest of what it waits for. Of what goes round in a circle the ranks are
/// whatever is found first; [`circle`] finds it.
pub(crate) fn ranks(waits: &Waits) -> Vec<usize> {
    let mut ranks: Vec<Option<usize>> = vec![None; waits.len()];
    let mut on_the_way = vec![false; waits.len()];
    for start in 0..waits.len() {
        let mut open = vec![start];
        while let Some(&at) = open.last() {
            on_the_way[at] = true;
            let unknown = |other: &&usize| ranks[**other].is_none() && !on_the_way[**other];
            if let Some(next) = waits[at].iter().find(unknown) {
                open.push(*next);
                continue;
            }
            let highest = waits[at].iter().filter_map(|other| ranks[*other]).max();
            ranks[at] = Some(highest.map_or(0, |highest| highest + 1));
            open.pop();
        }
    }
    ranks.into_iter().map(Option::unwrap_or_default).collect()
}

/// A circle of features that wait for each other, in the order of waiting; the first one is its least.
pub(crate) fn circle(waits: &Waits) -> Option<Vec<usize>> {
    // Of what leads to no circle, nothing is looked at twice.
    let mut clear = vec![false; waits.len()];
    for start in 0..waits.len() {
        let mut way: Vec<(usize, usize)> = vec![(start, 0)];
        while let Some((at, next)) = way.last_mut() {
            let Some(&other) = waits[*at].get(*next) else {
                clear[*at] = true;
                way.pop();
                continue;
            };
            *next += 1;
            if clear[other] {
                continue;
            }
            if let Some(begin) = way.iter().position(|one| one.0 == other) {
                let mut circle: Vec<usize> = way[begin..].iter().map(|one| one.0).collect();
                let least = circle.iter().enumerate().min_by_key(|one| one.1)?.0;
                circle.rotate_left(least);
                return Some(circle);
            }
            way.push((other, 0));
        }
    }
    None
}

/// By feature and the numbers of an instance and its hosts: something of that instance.
pub(crate) type ByInstance<T> = BTreeMap<(usize, Vec<usize>), T>;

#[cfg(test)]
mod tests {
    use super::*;

    fn reference(feature: usize, numbers: &[(usize, usize)]) -> Reference {
        Reference {
            feature,
            numbers: numbers.to_vec(),
            part: String::new(),
        }
    }

    /// 0: three belts; 1 and 2: two channels in each; 3: five channels; 4: one.
    fn instance(way: &[(usize, usize)], of: &Reference) -> Option<Vec<usize>> {
        let hosts = [None, Some(0), Some(0), None, None];
        let counts = [3, 2, 2, 5, 1];
        let hosts = Hosts {
            host: &|at| hosts[at],
            count: &|at| counts[at],
        };
        hosts.instance(way, of)
    }

    #[test]
    fn what_lies_in_the_same_is_meant_there() {
        assert_eq!(
            instance(&[(0, 2), (1, 1)], &reference(2, &[])),
            Some(vec![2, 1])
        );
        assert_eq!(
            instance(&[(0, 2), (1, 1)], &reference(2, &[(2, 2)])),
            Some(vec![2, 2])
        );
        assert_eq!(
            instance(&[(0, 2), (1, 1)], &reference(2, &[(0, 3)])),
            Some(vec![3, 1])
        );
        // Its own host.
        assert_eq!(
            instance(&[(0, 2), (1, 1)], &reference(0, &[])),
            Some(vec![2])
        );
    }

    #[test]
    fn one_serves_all_and_of_many_one_must_be_named() {
        assert_eq!(instance(&[(3, 4)], &reference(4, &[])), Some(vec![1]));
        assert_eq!(instance(&[(4, 1)], &reference(3, &[])), None);
        assert_eq!(instance(&[(4, 1)], &reference(3, &[(3, 5)])), Some(vec![5]));
        // Two in each of three belts.
        assert_eq!(instance(&[(4, 1)], &reference(1, &[(1, 2)])), None);
        assert_eq!(
            instance(&[(4, 1)], &reference(1, &[(0, 3), (1, 2)])),
            Some(vec![3, 2])
        );
    }

    #[test]
    fn ranks_are_above_all_that_is_waited_for() {
        let waits = vec![vec![1, 3], vec![], vec![0], vec![1]];
        assert_eq!(ranks(&waits), [2, 0, 3, 1]);
        assert_eq!(circle(&waits), None);
    }

    #[test]
    fn circles_are_found_wherever_they_begin() {
        assert_eq!(circle(&vec![vec![0]]), Some(vec![0]));
        let waits = vec![vec![1], vec![3], vec![1], vec![2], vec![]];
        assert_eq!(circle(&waits), Some(vec![1, 3, 2]));
        assert_eq!(ranks(&waits).len(), 5);
    }
}
