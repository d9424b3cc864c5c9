//! What the colours of a chart mean, for those that draw a legend of their own.

use super::{Chart, Scale};
use crate::display::NO_VALUE;

/// Colours along a bar.
const STOPS: usize = 17;

/// Marks along a bar, at most.
const MARKS: usize = 6;

/// What colours mean. They are red, green and blue as displays take them, from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// What the numbers are, with their unit.
    pub heading: String,
    /// Colours at equal steps along a bar; none for categories.
    pub bar: Vec<[f64; 3]>,
    /// Round numbers, and their places along the bar, from 0 to 1.
    pub marks: Vec<(f64, String)>,
    /// Colours that mean one thing each: categories, and "no value" where it occurs.
    pub boxes: Vec<([f64; 3], String)>,
}

impl Chart {
    /// The title, and the unit in brackets.
    pub(super) fn heading(&self) -> String {
        if self.unit.is_empty() { self.title.clone() } else { format!("{} ({})", self.title, self.unit) }
    }

    /// What the colours mean in which the chart draws these values.
    ///
    /// ```
    /// use kerrscope::display::chart::{Chart, Scale};
    /// let key = Chart::new("depth", "M", Scale::Linear).key(&[0.0, 4.0, f32::NAN]);
    /// assert_eq!(key.heading, "depth (M)");
    /// let marks: Vec<_> = key.marks.iter().map(|(place, label)| (*place, label.as_str())).collect();
    /// assert_eq!(marks, [(0.0, "0"), (0.25, "1"), (0.5, "2"), (0.75, "3"), (1.0, "4")]);
    /// assert_eq!(key.boxes[0].1, "no value");
    /// ```
    pub fn key(&self, values: &[f32]) -> Key {
        let range = self.range.or_else(|| self.scale.value_range(values));
        let mut boxes = Vec::new();
        if let Scale::Categories(names) = &self.scale {
            boxes.extend(names.iter().map(|(value, name)| (self.color(range, *value), name.clone())));
        }
        if self.look(range, values).no_value {
            boxes.push((NO_VALUE, "no value".to_owned()));
        }
        let mut key = Key { heading: self.heading(), bar: Vec::new(), marks: Vec::new(), boxes };
        if let (Some(range), false) = (range, matches!(self.scale, Scale::Categories(_))) {
            key.bar = (0..STOPS).map(|k| self.colormap.color(k as f64 / (STOPS - 1) as f64)).collect();
            let ticks = self.scale.ticks(range, MARKS).into_iter();
            // Along a circle the last value is the first again; its place is the end.
            let place = |value: f64| {
                let cyclic = matches!(self.scale, Scale::Cyclic { .. });
                if cyclic {
                    Some((value - range[0]) / (range[1] - range[0]))
                } else {
                    self.scale.position(range, value)
                }
            };
            key.marks = ticks.filter_map(|tick| Some((place(tick.value)?, tick.label))).collect();
        }
        key
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn bars_and_boxes() {
        let categories = Scale::Categories(vec![(0.0, "sky".to_owned()), (1.0, "hole".to_owned())]);
        let key = Chart::new("fate", "", categories).key(&[0.0, 1.0]);
        assert!(key.bar.is_empty() && key.marks.is_empty());
        assert_eq!(key.boxes.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>(), ["sky", "hole"]);
        let key = Chart::new("azimuth", "rad", Scale::Cyclic { period: TAU }).key(&[0.1, 6.0]);
        assert_eq!(key.bar.len(), STOPS);
        assert_eq!(key.marks.first(), Some(&(0.0, "0".to_owned())));
        assert_eq!(key.marks.last(), Some(&(1.0, "2π".to_owned())));
        let nothing = Chart::new("g", "", Scale::Linear).key(&[f32::NAN]);
        assert!(nothing.bar.is_empty() && nothing.boxes.len() == 1);
    }
}
