//! What of the image of an order is seen past the images of lower orders, along each line.

use super::lines::{Lines, Point};
use super::order::HOLE;

/// Parameters that edges move with: those of the hole, and the inner and the outer radius.
pub const MOVES: usize = HOLE + 2;

/// An edge on a line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bound {
    /// ρ, M.
    pub rho: f64,
    /// dρ/dp at a fixed ψ.
    pub moves: [f64; MOVES],
}

impl Bound {
    /// Some of four.
    pub fn mixed(four: [&Self; 4], shares: [f64; 4]) -> Self {
        let mut bound = Self::default();
        for (one, share) in four.into_iter().zip(shares) {
            bound.rho += share * one.rho;
            for (moved, own) in bound.moves.iter_mut().zip(one.moves) {
                *moved += share * own;
            }
        }
        bound
    }
}

/// How the x of the edges changes with the parameters that edges move with.
#[derive(Clone, Copy, Debug)]
pub struct Rates {
    /// Of the inner and of the outer edge; none where the outer one is beyond the picture.
    pub edges: [Option<[f64; MOVES]>; 2],
}

/// The edges of the image of an order on a line, the inner one first.
pub fn edges(lines: &Lines, line: usize, rates: &Rates) -> [Bound; 2] {
    let bound = |t: f64, rates: &Option<[f64; MOVES]>| {
        let Point { rho, slope, drift, .. } = lines.at(line, t);
        let mut bound = Bound { rho, moves: [0.0; MOVES] };
        if let Some(rates) = rates {
            bound.moves[..HOLE].copy_from_slice(&drift);
            for (moved, rate) in bound.moves.iter_mut().zip(rates) {
                *moved += rate / slope[0];
            }
        }
        bound
    };
    [bound(0.0, &rates.edges[0]), bound(1.0, &rates.edges[1])]
}

/// What is left of an image on a line past those before it: as many stretches as there are of these and one, in order, of
/// no length where nothing is left.
pub fn left(own: [Bound; 2], mut before: Vec<[Bound; 2]>) -> Vec<[Bound; 2]> {
    before.sort_by(|a, b| a[0].rho.total_cmp(&b[0].rho));
    let mut stretches = Vec::new();
    let mut from = own[0];
    for [inner, outer] in before {
        stretches.push(stretch(from, if inner.rho < own[1].rho { inner } else { own[1] }));
        if outer.rho > from.rho {
            from = if outer.rho < own[1].rho { outer } else { own[1] };
        }
    }
    stretches.push(stretch(from, own[1]));
    stretches
}

fn stretch(from: Bound, to: Bound) -> [Bound; 2] {
    if to.rho > from.rho { [from, to] } else { [from, from] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bound(rho: f64) -> Bound {
        Bound { rho, ..Bound::default() }
    }

    #[test]
    fn what_is_left() {
        let lengths = |own: [f64; 2], before: &[[f64; 2]]| -> Vec<[f64; 2]> {
            let before = before.iter().map(|pair| pair.map(bound)).collect();
            left(own.map(bound), before).iter().map(|pair| pair.map(|b| b.rho)).collect()
        };
        assert_eq!(lengths([2.0, 5.0], &[]), [[2.0, 5.0]]);
        assert_eq!(lengths([2.0, 5.0], &[[3.0, 9.0]]), [[2.0, 3.0], [5.0, 5.0]]);
        assert_eq!(lengths([2.0, 5.0], &[[3.0, 4.0]]), [[2.0, 3.0], [4.0, 5.0]]);
        assert_eq!(lengths([2.0, 5.0], &[[1.0, 4.0]]), [[2.0, 2.0], [4.0, 5.0]]);
        assert_eq!(lengths([2.0, 5.0], &[[1.0, 9.0]]), [[2.0, 2.0], [5.0, 5.0]]);
        let two = lengths([2.0, 9.0], &[[6.0, 7.0], [3.0, 4.0]]);
        assert_eq!(two, [[2.0, 3.0], [4.0, 6.0], [7.0, 9.0]]);
    }
}
