//! What the check of a metric finds.

use super::super::{BuiltIn, Coordinate, Ellis, Geometry, Minkowski, Signature, catalogue, check};
use crate::scalar::Scalar;

#[test]
fn what_is_built_in_is_good() {
    for entry in catalogue() {
        let (good, vacuum, flat, negative) = match BuiltIn::named(entry.name, &[]).unwrap() {
            BuiltIn::Surface(g) => summary(&g),
            BuiltIn::Space(g) => summary(&g),
            BuiltIn::Spacetime(g) => summary(&g),
        };
        assert!(good, "{}", entry.name);
        let round = entry.name.contains("sphere") || entry.name.contains("stereographic");
        assert_eq!(vacuum, !(round || entry.name == "ellis"), "{}", entry.name);
        // A stereographic chart's far away is its pole, where the sphere is as round as anywhere.
        assert_eq!(flat.unwrap_or(true), !entry.name.contains("stereographic"), "{}", entry.name);
        let time = !(round || ["polar", "spherical"].contains(&entry.name));
        assert_eq!(negative, usize::from(time), "{}", entry.name);
    }
}

fn summary<G: Geometry<N>, const N: usize>(geometry: &G) -> (bool, bool, Option<bool>, usize) {
    let found = check(geometry, 60, 3);
    (found.is_good(), found.is_vacuum(), found.is_asymptotically_flat(), found.signatures[0].0.negative)
}

/// Everything that can be wrong.
struct Wrong;

impl Geometry<4> for Wrong {
    fn name(&self) -> &'static str {
        "wrong"
    }
    fn coordinates(&self) -> [Coordinate; 4] {
        Minkowski.coordinates()
    }
    fn metric<S: Scalar>(&self, x: &[S; 4]) -> [[S; 4]; 4] {
        let mut g = Minkowski.metric(x);
        g[0][1] = x[1] * 0.1;
        g[2][2] = x[2];
        g
    }
}

#[test]
fn what_is_wrong_is_found() {
    let found = check(&Wrong, 100, 1);
    assert!(!found.is_symmetric() && !found.has_good_signature() && !found.is_good());
    let met: Vec<Signature> = found.signatures.iter().map(|(s, _)| *s).collect();
    assert!(met.contains(&Signature { negative: 2, positive: 2 }), "{met:?}");
    assert_eq!(found.cyclic, [true, false, false, true]);
}

#[test]
fn matter_is_found_where_it_is() {
    let found = check(&Ellis { throat: 2.0 }, 200, 5);
    assert!(found.is_good() && !found.is_vacuum());
    // |R^l_l| = 2b²/(l² + b²)² is at most 2/b².
    assert!(found.matter > 0.3 && found.matter <= 0.5 && found.matter_at[1].abs() < 1.0, "{found:?}");
    assert_eq!(found, check(&Ellis { throat: 2.0 }, 200, 5), "the same seed finds the same");
}
