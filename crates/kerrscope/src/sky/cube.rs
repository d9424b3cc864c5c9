//! Directions as places on the faces of a cube: no corner of the sky is far from square, and no
//! angle has to be computed.

/// A face from 0 to 5, and a place on it, both coordinates from −1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) face: usize,
    pub(super) at: [f64; 2],
}

/// Where the ray along a direction leaves the cube. Face 2k has the axis k upwards of it, face
/// 2k + 1 downwards.
pub(super) fn place(n: [f64; 3]) -> Place {
    let size = n.map(f64::abs);
    let axis = if size[0] >= size[1] && size[0] >= size[2] {
        0
    } else if size[1] >= size[2] {
        1
    } else {
        2
    };
    let at = [n[(axis + 1) % 3] / size[axis], n[(axis + 2) % 3] / size[axis]];
    Place { face: 2 * axis + usize::from(n[axis] < 0.0), at }
}

/// A direction's components on a face: along its normal and its two axes.
pub(super) fn components(face: usize, n: [f64; 3]) -> [f64; 3] {
    let axis = face / 2;
    let outwards = if face.is_multiple_of(2) { n[axis] } else { -n[axis] };
    [outwards, n[(axis + 1) % 3], n[(axis + 2) % 3]]
}

/// The unit vector towards a place.
pub(super) fn direction(place: Place) -> [f64; 3] {
    let [a, b] = place.at;
    let length = (1.0 + a * a + b * b).sqrt();
    let axis = place.face / 2;
    let mut n = [0.0; 3];
    n[axis] = if place.face.is_multiple_of(2) { 1.0 } else { -1.0 } / length;
    n[(axis + 1) % 3] = a / length;
    n[(axis + 2) % 3] = b / length;
    n
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_directions_undo_each_other() {
        for face in 0..6 {
            for at in [[0.0, 0.0], [0.3, -0.8], [-0.99, 0.1]] {
                let n = direction(Place { face, at });
                let back = place(n);
                assert_eq!(back.face, face);
                assert!((0..2).all(|k| (back.at[k] - at[k]).abs() < 1e-15));
                let [c, a, b] = components(face, n);
                assert!(c > 0.0 && (a / c - at[0]).abs() < 1e-15 && (b / c - at[1]).abs() < 1e-15);
            }
        }
    }
}
