//! Flat shapes as modelled: a tree of outlines, maps and boolean operations.
//!
//! Sweeping a boolean combination is the same as combining what is swept. So trees stay trees, and their curves stay what
//! they are, until something asks for their boundary.

use super::{Affine2, Bounds2, Outline, PlaneError, combine};
use crate::Tolerance;
use octrace::BoolOp;
use std::sync::Arc;

/// A flat shape, cheap to clone.
#[derive(Clone, Debug)]
pub enum Flat {
    /// A region by its boundary.
    Outline(Arc<Outline>),
    /// A shape moved by an invertible map.
    Moved(Affine2, Arc<Flat>),
    /// Shapes combined, in this order; without a point for none.
    Combined(BoolOp, Arc<[Flat]>),
}

impl From<Outline> for Flat {
    fn from(outline: Outline) -> Self {
        Self::Outline(Arc::new(outline))
    }
}

impl Drop for Flat {
    /// Takes deep trees apart without recursion.
    fn drop(&mut self) {
        fn take(shape: &mut Flat, into: &mut Vec<Flat>) {
            let nothing = || Flat::Outline(Arc::default());
            match shape {
                Flat::Outline(_) => {}
                Flat::Moved(_, below) => {
                    if let Some(below) = Arc::get_mut(below).filter(|below| !matches!(below, Flat::Outline(_))) {
                        into.push(std::mem::replace(below, nothing()));
                    }
                }
                Flat::Combined(_, below) => {
                    let deep = Arc::get_mut(below).into_iter().flatten().filter(|b| !matches!(b, Flat::Outline(_)));
                    into.extend(deep.map(|below| std::mem::replace(below, nothing())));
                }
            }
        }
        let mut pending = Vec::new();
        take(self, &mut pending);
        while let Some(mut shape) = pending.pop() {
            take(&mut shape, &mut pending);
        }
    }
}

impl Flat {
    /// The shape without a point.
    pub fn empty() -> Self {
        Outline::EMPTY.into()
    }

    /// The shapes combined by `op`, in this order; empty for none.
    pub fn combined(op: BoolOp, shapes: impl IntoIterator<Item = Flat>) -> Self {
        let mut shapes: Vec<Flat> = shapes.into_iter().collect();
        match shapes.len() {
            0 => Self::empty(),
            1 => shapes.remove(0),
            _ => Self::Combined(op, shapes.into()),
        }
    }

    /// The shape moved by `map`; empty where the map flattens it.
    pub fn moved(self, map: Affine2) -> Self {
        if map == Affine2::IDENTITY {
            return self;
        }
        if map.inverse().is_none() {
            return Self::empty();
        }
        Self::Moved(map, Arc::new(self))
    }

    /// Computes something from the outlines up: `leaf` gets an outline and the map that moves it to its place, `combine` an
    /// operation and what came of its operands, in order. Works however deep the tree is.
    ///
    /// # Errors
    /// The first that one of the two returns.
    pub fn fold<T, E>(
        &self,
        mut leaf: impl FnMut(&Arc<Outline>, &Affine2) -> Result<T, E>,
        mut combine: impl FnMut(BoolOp, Vec<T>) -> Result<T, E>,
    ) -> Result<T, E> {
        enum Step<'a> {
            Visit(&'a Flat, Affine2),
            Combine(BoolOp, usize),
        }
        let mut steps = vec![Step::Visit(self, Affine2::IDENTITY)];
        let mut done: Vec<T> = Vec::new();
        while let Some(step) = steps.pop() {
            match step {
                Step::Visit(Self::Outline(outline), map) => done.push(leaf(outline, &map)?),
                Step::Visit(Self::Moved(next, shape), map) => steps.push(Step::Visit(shape, map * *next)),
                Step::Visit(Self::Combined(op, shapes), map) => {
                    steps.push(Step::Combine(*op, shapes.len()));
                    steps.extend(shapes.iter().rev().map(|shape| Step::Visit(shape, map)));
                }
                Step::Combine(op, count) => {
                    let operands = done.split_off(done.len() - count);
                    done.push(combine(op, operands)?);
                }
            }
        }
        Ok(done.pop().expect("every visit leaves one result"))
    }

    /// The boundary of the tree.
    ///
    /// # Errors
    /// See [`combine`](super::combine()).
    pub fn outline(&self, tolerance: Tolerance) -> Result<Arc<Outline>, PlaneError> {
        let leaf = |outline: &Arc<Outline>, map: &Affine2| {
            Ok(if *map == Affine2::IDENTITY { outline.clone() } else { Arc::new(outline.moved(map, tolerance)) })
        };
        self.fold(leaf, |op, outlines: Vec<Arc<Outline>>| {
            if let [one] = &outlines[..] {
                return Ok(one.clone());
            }
            let outlines: Vec<&Outline> = outlines.iter().map(Arc::as_ref).collect();
            combine(op, &outlines).map(Arc::new)
        })
    }

    /// A rectangle around the shape: the smallest one where the tree only unites. `None` where there is nothing to be found.
    pub fn bounds(&self) -> Option<Bounds2> {
        let combine = |op, bounds: Vec<Option<Bounds2>>| {
            let mut all = bounds.iter().copied();
            Ok(match op {
                BoolOp::Union => all.flatten().reduce(Bounds2::union),
                BoolOp::Difference => all.next().flatten(),
                BoolOp::Intersection => all.reduce(|a, b| a.zip(b).and_then(|(a, b)| a.intersection(b))).flatten(),
            })
        };
        let found: Result<_, std::convert::Infallible> = self.fold(|o, map| Ok(o.bounds_moved(map)), combine);
        found.unwrap_or(None)
    }

    /// Whether it is known, without combining anything, that there is nothing.
    pub fn is_empty(&self) -> bool {
        self.bounds().is_none()
    }

    /// Whether the tree only unites, so that [`Flat::bounds`] is exact.
    pub(crate) fn only_unites(&self) -> bool {
        let combine = |op, below: Vec<bool>| Ok(op == BoolOp::Union && below.into_iter().all(|b| b));
        let found: Result<bool, std::convert::Infallible> = self.fold(|_, _| Ok(true), combine);
        found.unwrap_or(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::Vec2;

    fn square(x: f64, size: f64) -> Flat {
        Outline::rectangle(Vec2::new(x, 0.0), Vec2::new(x + size, size)).into()
    }

    fn area(shape: &Flat) -> f64 {
        shape.outline(Tolerance::default()).expect("simple").area()
    }

    #[test]
    fn maps_reach_the_outlines_in_order() {
        let double = Affine2::scale(Vec2::new(2.0, 2.0));
        let shape = square(0.0, 1.0).moved(Affine2::translation(Vec2::new(3.0, 0.0))).moved(double);
        let bounds = shape.bounds().expect("it is not empty");
        assert_eq!((bounds.min, bounds.max), (Vec2::new(6.0, 0.0), Vec2::new(8.0, 2.0)));
        assert_eq!(area(&shape), 4.0);
        assert!(shape.moved(Affine2::scale(Vec2::new(1.0, 0.0))).is_empty());
    }

    #[test]
    fn operands_stay_in_order() {
        let cut = Flat::combined(BoolOp::Difference, [square(0.0, 4.0), square(0.0, 1.0), square(2.0, 1.0)]);
        assert_eq!(area(&cut), 14.0);
        assert!(!cut.only_unites());
        let mut seen = Vec::new();
        let note = |outline: &Arc<Outline>, _: &Affine2| {
            seen.push(outline.area());
            Ok::<_, PlaneError>(())
        };
        cut.fold(note, |_, _| Ok(())).expect("nothing fails");
        assert_eq!(seen, [16.0, 1.0, 1.0]);
        let common = Flat::combined(BoolOp::Intersection, [square(0.0, 4.0), square(3.0, 2.0), cut]);
        assert_eq!(area(&common), 2.0);
        assert!(Flat::combined(BoolOp::Intersection, [square(0.0, 1.0), square(1.0, 1.0)]).is_empty());
        assert!(Flat::combined(BoolOp::Union, []).is_empty());
    }

    #[test]
    fn trees_may_be_deep() {
        let mut shape = square(0.0, 1.0);
        for _ in 0..200_000 {
            shape =
                Flat::combined(BoolOp::Union, [shape.moved(Affine2::translation(Vec2::new(1.0, 0.0))), Flat::empty()]);
        }
        assert_eq!(shape.bounds().map(|b| b.min.x), Some(200_000.0));
        assert_eq!(area(&shape), 1.0);
    }
}
