//! What the rule says of regions wherever they are: which of them can matter to each other.

/// Regions as bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Few(Vec<u64>);

impl Few {
    fn none(count: usize) -> Self {
        Self(vec![0; count.div_ceil(64)])
    }

    fn add(&mut self, region: usize) {
        self.0[region / 64] |= 1 << (region % 64);
    }

    fn add_all(&mut self, others: &Self) {
        for (word, other) in self.0.iter_mut().zip(&others.0) {
            *word |= other;
        }
    }

    pub(super) fn has(&self, region: usize) -> bool {
        self.0[region / 64] >> (region % 64) & 1 == 1
    }

    fn count(&self) -> u32 {
        self.0.iter().map(|word| word.count_ones()).sum()
    }
}

/// The rule's answers, region by region.
#[derive(Debug)]
pub(super) struct Relations {
    /// With which other regions one may matter near some place.
    meets: Vec<Few>,
    /// Which regions make no difference outside of one, and which inside.
    hides: Vec<[Few; 2]>,
    /// Whether there are any.
    hides_any: Vec<[bool; 2]>,
    /// Regions, those that hide most others first.
    by_hiding: Vec<usize>,
}

impl Relations {
    /// Asks for all pairs: `meet` as [`super::Options::meet`], `hides` as [`super::Options::hides`].
    pub(super) fn new(
        count: usize,
        meet: &dyn Fn(usize, usize) -> bool,
        hides: &dyn Fn(usize, bool, usize) -> bool,
    ) -> Self {
        let few = |is_in: &dyn Fn(usize) -> bool| {
            let mut few = Few::none(count);
            for region in (0..count).filter(|region| is_in(*region)) {
                few.add(region);
            }
            few
        };
        let hidden = |region: usize, inside: bool| {
            few(&|other| other != region && hides(region, inside, other))
        };
        let meets = (0..count)
            .map(|one| few(&|other| one == other || meet(one, other)))
            .collect();
        let hides: Vec<[Few; 2]> = (0..count)
            .map(|region| [hidden(region, false), hidden(region, true)])
            .collect();
        let mut by_hiding: Vec<usize> = (0..count).collect();
        let counts = |region: usize| hides[region].each_ref().map(Few::count);
        by_hiding.sort_by_cached_key(|region| std::cmp::Reverse(counts(*region).into_iter().max()));
        let hides_any = (0..count)
            .map(|region| counts(region).map(|count| count > 0))
            .collect();
        Self {
            meets,
            hides,
            hides_any,
            by_hiding,
        }
    }

    /// Whether both regions may matter near some place.
    pub(super) fn meet(&self, one: usize, other: usize) -> bool {
        self.meets[one].has(other)
    }

    /// Whether some of these regions make no difference on that side of another one.
    pub(super) fn hides(&self, region: usize, inside: bool, others: &[usize]) -> bool {
        let hidden = &self.hides[region][usize::from(inside)];
        others.iter().any(|other| hidden.has(*other))
    }

    /// Asks on which side of regions a place is, of those that matter beside some of them; what others hide there is
    /// left out, and taken to be outside. `None` if one of them is hidden itself.
    pub(super) fn sides(
        &self,
        own: &[usize],
        mut inside: impl FnMut(usize) -> bool,
    ) -> Option<Vec<bool>> {
        let mut sides = vec![false; self.hides.len()];
        let mut hidden = Few::none(sides.len());
        for &region in &self.by_hiding {
            let matters = !own.contains(&region)
                && !hidden.has(region)
                && own.iter().any(|own| self.meet(*own, region));
            if !matters {
                continue;
            }
            sides[region] = inside(region);
            let side = usize::from(sides[region]);
            if !self.hides_any[region][side] {
                continue;
            }
            hidden.add_all(&self.hides[region][side]);
            if own.iter().any(|own| hidden.has(*own)) {
                return None;
            }
        }
        Some(sides)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    /// Regions 1 to 99, of which each inside hides all that come before it.
    fn layers() -> Relations {
        Relations::new(100, &|_, _| true, &|region, inside, other| {
            inside && 0 < other && other < region
        })
    }

    #[test]
    fn what_others_hide_is_not_asked_for() {
        let mut asked = Vec::new();
        let sides = layers().sides(&[99], |region| {
            asked.push(region);
            region <= 97
        });
        let mut expected = vec![false; 100];
        expected[97] = true;
        expected[0] = true;
        assert_eq!(sides.unwrap(), expected);
        assert_eq!(asked, [98, 97, 0]);
    }

    #[test]
    fn nothing_is_known_where_a_region_asked_for_is_hidden_itself() {
        assert_eq!(layers().sides(&[5, 70], |region| region == 6), None);
        assert!(layers().sides(&[5, 70], |region| region < 5).is_some());
        assert!(layers().hides(71, true, &[70, 80]) && !layers().hides(71, false, &[70, 80]));
    }
}
