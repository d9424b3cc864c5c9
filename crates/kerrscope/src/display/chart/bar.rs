//! The bar of a legend: its shape, and where values stand in it.

use super::scale::Scale;

/// A bar whose ends may be pointed. Lengths are in pixels.
pub(super) struct Bar<'a> {
    pub scale: &'a Scale,
    /// The values at the ends, or where the points begin.
    pub range: [f64; 2],
    /// The columns where it begins and ends, with its points.
    pub outer: [i32; 2],
    /// The lengths of the points; 0 for an end that is cut straight.
    pub tips: [i32; 2],
    pub middle: f32,
    pub half: f32,
}

impl Bar<'_> {
    /// The columns of the ends of the range.
    pub fn ends(&self) -> [i32; 2] {
        [self.outer[0] + self.tips[0], self.outer[1] - self.tips[1] - 1]
    }

    /// The column in which a value stands.
    pub fn along(&self, value: f64) -> i32 {
        let t = match self.scale {
            // The far end of a circle is its near end too.
            Scale::Cyclic { period } => Some((value - self.range[0]) / period),
            scale => scale.position(self.range, value),
        };
        let [first, last] = self.ends();
        first + (t.unwrap_or(0.0) * f64::from(last - first)).round() as i32
    }

    /// The place along the colour map, from 0 to 1, that a column shows.
    pub fn place(&self, x: i32) -> f64 {
        let [first, last] = self.ends();
        f64::from(x.clamp(first, last) - first) / f64::from(last - first)
    }

    /// Top and bottom of a column of pixels in this bar, grown by `edge` to all sides.
    pub fn column(&self, x: i32, edge: f32) -> Option<[f32; 2]> {
        let x = x as f32 + 0.5;
        let inwards = [x - self.outer[0] as f32, self.outer[1] as f32 - x];
        let halves: [f32; 2] = std::array::from_fn(|side| {
            let (tip, along) = (self.tips[side] as f32, inwards[side]);
            let most = self.half + edge;
            if tip == 0.0 {
                return if along > -edge { most } else { 0.0 };
            }
            // A slope moved outwards at right angles moves up by this times as much.
            let slope = self.half / tip;
            (slope * along + edge * slope.hypot(1.0)).min(most)
        });
        let half = halves[0].min(halves[1]);
        (half > 0.0).then_some([self.middle - half, self.middle + half])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_where_their_colours_are() {
        let bar = Bar {
            scale: &Scale::Linear,
            range: [1.0, 3.0],
            outer: [10, 121],
            tips: [0, 10],
            middle: 5.0,
            half: 4.0,
        };
        assert_eq!(bar.ends(), [10, 110]);
        assert_eq!([0.0, 1.0, 2.5, 3.0, 9.0].map(|value| bar.along(value)), [10, 10, 85, 110, 110]);
        assert_eq!([10, 85, 110, 115].map(|x| bar.place(x)), [0.0, 0.75, 1.0, 1.0]);
        // Cut straight at the left, at the right half as high in the middle of the point.
        assert_eq!([9, 10, 110].map(|x| bar.column(x, 0.0)), [None, Some([1.0, 9.0]), Some([1.0, 9.0])]);
        let [above, below] = [115, 116].map(|x| bar.column(x, 0.0).map(|[top, bottom]| bottom - top));
        assert!(
            above.is_some_and(|h| (h - 4.4).abs() < 1e-5) && below.is_some_and(|h| (h - 3.6).abs() < 1e-5)
        );
        assert_eq!(bar.column(121, 0.0), None);
        // The edge lies around it.
        assert_eq!(bar.column(9, 1.0), Some([0.0, 10.0]));
        assert!(bar.column(121, 1.0).is_some());
    }
}
