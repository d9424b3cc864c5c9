//! Vectors and second-rank tensors of a four-dimensional spacetime, as plain arrays.
//!
//! Index 0 is time. Three-vectors are the spatial parts in Cartesian-like coordinates.

use crate::scalar::Scalar;

/// A spatial vector or covector.
pub type Vec3<S> = [S; 3];
/// A vector or covector (t, x, y, z).
pub type Vec4<S> = [S; 4];
/// A tensor with two indices.
pub type Tensor<S> = [[S; 4]; 4];

/// The array of f(0), f(1), …: as `std::array::from_fn`, but inlined, since what is not is compiled without
/// the vector instructions of the function around it. The closure has to be `#[inline(always)]` too.
#[inline(always)]
pub fn each<T: Copy, const N: usize>(f: impl Fn(usize) -> T) -> [T; N] {
    let mut all = [f(0); N];
    for i in 1..N {
        all[i] = f(i);
    }
    all
}

/// a·b with the Euclidean product.
#[inline(always)]
pub fn dot<S: Scalar>(a: &Vec3<S>, b: &Vec3<S>) -> S {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// a × b.
#[inline(always)]
pub fn cross<S: Scalar>(a: &Vec3<S>, b: &Vec3<S>) -> Vec3<S> {
    [
        a[1].mul_add(b[2], -(a[2] * b[1])),
        a[2].mul_add(b[0], -(a[0] * b[2])),
        a[0].mul_add(b[1], -(a[1] * b[0])),
    ]
}

/// T_{μν} vᵛ.
#[inline(always)]
pub fn contract<S: Scalar>(tensor: &Tensor<S>, vector: &Vec4<S>) -> Vec4<S> {
    each(
        #[inline(always)]
        |m| pair(&tensor[m], vector),
    )
}

/// A covector applied to a vector.
#[inline(always)]
pub fn pair<S: Scalar>(covector: &Vec4<S>, vector: &Vec4<S>) -> S {
    let first = covector[0].mul_add(vector[0], covector[1] * vector[1]);
    covector[2].mul_add(vector[2], covector[3].mul_add(vector[3], first))
}

/// T_{μν} aᵘ bᵛ.
#[inline(always)]
pub fn product<S: Scalar>(tensor: &Tensor<S>, a: &Vec4<S>, b: &Vec4<S>) -> S {
    pair(&contract(tensor, b), a)
}

/// The determinant of two columns of two rows.
#[inline(always)]
fn minor<S: Scalar>(rows: &[Vec4<S>; 2], a: usize, b: usize) -> S {
    rows[0][a] * rows[1][b] - rows[0][b] * rows[1][a]
}

/// The inverse of a symmetric tensor, by 2×2 minors (Laplace's expansion).
///
/// The relative error is that of rounding times the tensor's condition number.
#[inline(always)]
pub fn inverse<S: Scalar>(m: &Tensor<S>) -> Tensor<S> {
    let (top, low) = ([m[0], m[1]], [m[2], m[3]]);
    let (s0, s1, s2) = (minor(&top, 0, 1), minor(&top, 0, 2), minor(&top, 0, 3));
    let (s3, s4, s5) = (minor(&top, 1, 2), minor(&top, 1, 3), minor(&top, 2, 3));
    let (c5, c4, c3) = (minor(&low, 2, 3), minor(&low, 1, 3), minor(&low, 1, 2));
    let (c2, c1, c0) = (minor(&low, 0, 3), minor(&low, 0, 2), minor(&low, 0, 1));
    let d = (s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0).recip();
    let e00 = (m[1][1] * c5 - m[1][2] * c4 + m[1][3] * c3) * d;
    let e01 = (-(m[0][1] * c5) + m[0][2] * c4 - m[0][3] * c3) * d;
    let e02 = (m[3][1] * s5 - m[3][2] * s4 + m[3][3] * s3) * d;
    let e03 = (-(m[2][1] * s5) + m[2][2] * s4 - m[2][3] * s3) * d;
    let e11 = (m[0][0] * c5 - m[0][2] * c2 + m[0][3] * c1) * d;
    let e12 = (-(m[3][0] * s5) + m[3][2] * s2 - m[3][3] * s1) * d;
    let e13 = (m[2][0] * s5 - m[2][2] * s2 + m[2][3] * s1) * d;
    let e22 = (m[3][0] * s4 - m[3][1] * s2 + m[3][3] * s0) * d;
    let e23 = (-(m[2][0] * s4) + m[2][1] * s2 - m[2][3] * s0) * d;
    let e33 = (m[2][0] * s3 - m[2][1] * s1 + m[2][2] * s0) * d;
    [[e00, e01, e02, e03], [e01, e11, e12, e13], [e02, e12, e22, e23], [e03, e13, e23, e33]]
}
