//! What is known of surfaces from literals that a program has kept on the way.

use crate::surface::OctantSides;

/// Literals that operators above and before have kept: on which side of their surfaces whatever comes later is.
#[derive(Debug, Default)]
pub(super) struct Known {
    surfaces: Vec<u32>,
    literals: Vec<KnownLiteral>,
}

#[derive(Clone, Copy, Debug)]
struct KnownLiteral {
    negated: bool,
    /// On which side of its surface its later siblings are.
    inside: bool,
    /// The boxes in which it is kept.
    boxes: u8,
}

impl Known {
    /// So many of the latest are looked at.
    const LATEST: usize = 64;

    pub fn clear(&mut self) {
        self.truncate(0);
    }

    pub fn len(&self) -> usize {
        self.surfaces.len()
    }

    pub fn truncate(&mut self, len: usize) {
        self.surfaces.truncate(len);
        self.literals.truncate(len);
    }

    /// An operand of an operator is kept in some boxes: true for its later siblings in an `And`, false in an `Or`.
    pub fn learn(&mut self, surface: u32, negated: bool, is_and: bool, boxes: u8) {
        self.surfaces.push(surface);
        self.literals.push(KnownLiteral { negated, inside: is_and != negated, boxes });
    }

    /// An operator ends whose literals are known from `start` on. In the boxes in which it has but one operand left, a
    /// literal takes its place in the operator above.
    pub fn go_up(&mut self, start: usize, is_and: bool, alone: u8) {
        let mut end = start;
        for i in start..self.len() {
            let KnownLiteral { negated, boxes, .. } = self.literals[i];
            if boxes & alone != 0 {
                self.surfaces[end] = self.surfaces[i];
                self.literals[end] = KnownLiteral { negated, inside: is_and != negated, boxes: boxes & alone };
                end += 1;
            }
        }
        self.truncate(end);
    }

    /// Puts the boxes that cross a surface on the side that is known, if it is.
    #[inline(always)]
    pub fn decide(&self, surface: u32, sides: &mut OctantSides) {
        let start = self.len().saturating_sub(Self::LATEST);
        let latest = &self.surfaces[start..];
        if !latest.iter().fold(false, |found, &known| found | (known == surface)) {
            return;
        }
        let crossed = !(sides.inside | sides.outside);
        for (&known, literal) in latest.iter().zip(&self.literals[start..]) {
            if known == surface {
                *(if literal.inside { &mut sides.inside } else { &mut sides.outside }) |= crossed & literal.boxes;
            }
        }
    }
}
