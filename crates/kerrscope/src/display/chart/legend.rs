//! The strip below a picture that says what its colours mean.

use super::bar::Bar;
use super::canvas::Canvas;
use super::ticks::{self, Tick};
use super::{Chart, Scale, Seen, text};
use crate::display::NO_VALUE;

/// The strip itself, lines around colours, and words.
const GROUND: [f64; 3] = [0.06; 3];
const FRAME: [f64; 3] = [0.5; 3];
const INK: [f64; 3] = [0.88; 3];

/// In ems: the height of a line of words, how far below its top they stand, and from the left end of a box to
/// its words.
const LINE: f32 = 1.45;
const BASELINE: f32 = 1.05;
const BESIDE_BOX: f32 = 1.3;

/// The length of the shortest bar in pixels.
const SHORTEST: i32 = 7;

/// Most ticks along a bar.
const MOST_TICKS: usize = 11;

/// The legend of a chart over a range, `width` pixels wide; of no rows if nothing fits.
pub(super) fn draw(chart: &Chart, range: Option<[f64; 2]>, seen: Seen, width: i32) -> Canvas {
    let mut legend = Legend::new(width);
    let no_value = seen.no_value.then(|| Item { name: "no value".to_owned(), color: NO_VALUE });
    let heading = chart.heading();
    if let Scale::Categories(names) = &chart.scale {
        legend.heading(&heading, None);
        let boxes =
            names.iter().map(|(value, name)| Item { name: name.clone(), color: chart.color(range, *value) });
        legend.items(&boxes.chain(no_value).collect::<Vec<_>>());
    } else {
        let left = legend.heading(&heading, no_value);
        if let Some(range) = range {
            legend.bar(chart, range, seen.beyond);
        }
        legend.items(left.as_slice());
    }
    legend.finish()
}

/// What a colour means.
struct Item {
    name: String,
    color: [f64; 3],
}

/// A legend as far as it is drawn. Lengths are in pixels, and grow with the size of an em.
struct Legend {
    canvas: Canvas,
    em: f32,
    /// Empty columns at either side.
    margin: i32,
}

impl Legend {
    fn new(width: i32) -> Self {
        // Wide pictures are looked at as a whole, from farther away: letters grow, but not as fast.
        let em = (16.0 * (width as f32 / 960.0).powf(0.7)).round().max(11.0);
        let margin = (0.75 * em).min(width as f32 / 12.0) as i32;
        Self { canvas: Canvas::new(width), em, margin }
    }

    fn ems(&self, count: f32) -> i32 {
        (count * self.em).round() as i32
    }

    /// The thickness of lines.
    fn line(&self) -> i32 {
        self.ems(1.0 / 16.0).max(1)
    }

    fn right(&self) -> i32 {
        self.canvas.width - self.margin
    }

    /// Adds rows, the first time with space above them; returns where they begin.
    fn grow(&mut self, ems: f32) -> i32 {
        if self.canvas.height == 0 {
            self.canvas.grow(self.ems(0.5), GROUND);
        }
        let top = self.canvas.height;
        self.canvas.grow(self.ems(ems), GROUND);
        top
    }

    fn finish(mut self) -> Canvas {
        if self.canvas.height > 0 {
            self.canvas.grow(self.ems(0.5), GROUND);
        }
        self.canvas
    }

    fn width(&self, item: &Item) -> i32 {
        self.ems(BESIDE_BOX) + text::width(&item.name, self.em)
    }

    /// Words as they fit into some pixels, with an ellipsis for their end if need be; none where two or three
    /// letters would be left.
    fn fitted(&self, words: &str, room: i32) -> Option<String> {
        if room < self.ems(3.0) {
            return None;
        }
        if text::width(words, self.em) <= room {
            return Some(words.to_owned());
        }
        let cuts = words.char_indices().map(|(place, _)| place).filter(|place| *place > 0);
        let mut shorter = cuts.map(|place| format!("{}…", words[..place].trim_end()));
        shorter.rfind(|words| text::width(words, self.em) <= room)
    }

    /// Where things of given widths, none longer than a line, stand if they follow one another in lines:
    /// the line and the left end of each.
    fn flow(&self, widths: impl Iterator<Item = i32>, gap: i32) -> Vec<(i32, i32)> {
        let (mut line, mut left) = (0, self.margin);
        let place = |width: i32| {
            if left > self.margin && left + width > self.right() {
                (line, left) = (line + 1, self.margin);
            }
            let place = (line, left);
            left += width + gap;
            place
        };
        widths.map(place).collect()
    }

    /// The heading, and at the right of its last line an item if it fits there. Returns the item if not.
    fn heading(&mut self, heading: &str, item: Option<Item>) -> Option<Item> {
        let room = self.right() - self.margin;
        let words = heading.split(' ').filter(|word| !word.is_empty());
        let Some(words) = words.map(|word| self.fitted(word, room)).collect::<Option<Vec<_>>>() else {
            return item;
        };
        let width = |word: &String| text::width(word, self.em);
        let places = self.flow(words.iter().map(width), text::width(" ", self.em));
        let Some((last, left)) = places.last().copied() else { return item };
        let end = left + words.last().map_or(0, width);
        let top = self.grow(LINE * (last + 1) as f32);
        for (word, (line, left)) in words.iter().zip(&places) {
            self.write(word, *left, top, *line);
        }
        let item = item?;
        let left = self.right() - self.width(&item);
        if left < end + self.ems(1.5) {
            return Some(item);
        }
        self.item(&item, left, top, last);
        None
    }

    /// Items in lines of their own.
    fn items(&mut self, items: &[Item]) {
        let room = self.right() - self.margin - self.ems(BESIDE_BOX);
        let fitted = |item: &Item| Some(Item { name: self.fitted(&item.name, room)?, ..*item });
        let items: Vec<Item> = items.iter().filter_map(fitted).collect();
        let places = self.flow(items.iter().map(|item| self.width(item)), self.ems(1.2));
        let Some((last, _)) = places.last() else { return };
        let top = self.grow(LINE * (last + 1) as f32);
        for (item, (line, left)) in items.iter().zip(places) {
            self.item(item, left, top, line);
        }
    }

    fn write(&mut self, text: &str, left: i32, top: i32, line: i32) {
        let baseline = top + self.ems(LINE * line as f32 + BASELINE);
        text::write(&mut self.canvas, text, [left, baseline], self.em, INK);
    }

    fn item(&mut self, item: &Item, left: i32, top: i32, line: i32) {
        let (side, edge) = (self.ems(0.85), self.line());
        // Boxes stand in the middle of the capital letters, which are 0.71 em high.
        let middle = top + self.ems(LINE * line as f32 + BASELINE - 0.355);
        let box_top = middle - side / 2;
        self.canvas.fill([left, box_top, side, side], FRAME);
        self.canvas.fill([left + edge, box_top + edge, side - 2 * edge, side - 2 * edge], item.color);
        self.write(&item.name, left + self.ems(BESIDE_BOX), top, line);
    }

    /// A bar with its ticks.
    fn bar(&mut self, chart: &Chart, range: [f64; 2], beyond: [bool; 2]) {
        let edge = self.line();
        let tips = beyond.map(|beyond| if beyond { self.ems(0.7) } else { 0 });
        let outer = [self.margin + edge, self.right() - edge];
        let height = self.ems(0.9);
        let mut bar = Bar { scale: &chart.scale, range, outer, tips, middle: 0.0, half: 0.5 * height as f32 };
        let [first, last] = bar.ends();
        if last - first < SHORTEST {
            return;
        }
        self.grow(0.2);
        let top = self.grow(0.9) + edge;
        self.canvas.grow(2 * edge, GROUND);
        bar.middle = top as f32 + bar.half;
        for x in 0..self.canvas.width {
            if let Some(ends) = bar.column(x, edge as f32) {
                self.canvas.column(x, ends, FRAME);
            }
            if let Some(ends) = bar.column(x, 0.0) {
                self.canvas.column(x, ends, chart.colormap.color(bar.place(x)));
            }
        }
        self.ticks(&bar);
    }

    /// Ticks below a bar: as many as have room, the more room the better.
    fn ticks(&mut self, bar: &Bar) {
        let mut tries = (2..=MOST_TICKS).rev().map(|most| (most, 1.0)).chain([(3, 0.4), (2, 0.4), (1, 0.0)]);
        let Some(labels) = tries.find_map(|(most, gap)| self.labels(bar, most, gap)) else { return };
        let top = self.grow(0.25 + LINE);
        if *bar.scale == Scale::Logarithmic {
            let [first, last] = bar.ends();
            let decade = f64::from(last - first) / (bar.range[1] / bar.range[0]).log10();
            for value in ticks::between(bar.range, decade > f64::from(3.0 * self.em)) {
                self.mark(bar.along(value), top, 0.15);
            }
        }
        for (tick, left) in labels {
            self.mark(bar.along(tick.value), top, 0.3);
            self.write(&tick.label, left, top + self.ems(0.25), 0);
        }
    }

    /// A short line downwards.
    fn mark(&mut self, x: i32, top: i32, ems: f32) {
        let edge = self.line();
        self.canvas.fill([x - edge / 2, top, edge, self.ems(ems)], FRAME);
    }

    /// Up to `most` ticks, and two if that allows for it, with the left ends of their labels; none if these
    /// come nearer to each other than `gap` ems.
    fn labels(&self, bar: &Bar, most: usize, gap: f32) -> Option<Vec<(Tick, i32)>> {
        // Labels may reach halfway into the margins.
        let [mut free, end] = [self.margin / 2, self.canvas.width - self.margin / 2];
        let place = |tick: Tick| {
            let width = text::width(&tick.label, self.em);
            let left = (bar.along(tick.value) - width / 2).max(self.margin / 2).min(end - width);
            let fits = left >= free;
            free = left + width + self.ems(gap);
            fits.then_some((tick, left))
        };
        let ticks = bar.scale.ticks(bar.range, most);
        ticks.into_iter().map(place).collect::<Option<Vec<_>>>().filter(|labels| labels.len() >= most.min(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn labels_do_not_touch() {
        let scales = [
            (Scale::Linear, [0.3, 1.3]),
            (Scale::Linear, [-12345.0, 98765.0]),
            (Scale::Linear, [-2e-7, 3e-7]),
            (Scale::Logarithmic, [1e-11, 1e-7]),
            (Scale::Logarithmic, [1e-3, 1e3]),
            (Scale::Cyclic { period: TAU }, [-PI, PI]),
        ];
        for width in (64..=4000).step_by(31).chain([16384]) {
            let legend = Legend::new(width);
            for (scale, range) in &scales {
                let outer = [legend.margin, legend.right()];
                let bar = Bar { scale, range: *range, outer, tips: [0, 0], middle: 0.0, half: 0.0 };
                let labels = |most| legend.labels(&bar, most, 0.4);
                let found = (1..=MOST_TICKS).rev().find_map(labels).expect("one label fits");
                for (k, (tick, left)) in found.iter().enumerate() {
                    let right = left + text::width(&tick.label, legend.em);
                    let limit = found.get(k + 1).map_or(width, |(_, next)| next - legend.ems(0.4));
                    assert!(*left >= 0 && right <= limit, "{width} {scale:?} {found:?}");
                    // The mark stands above its label, at the ends too.
                    let at = bar.along(tick.value);
                    assert!((left - 1..=right + 1).contains(&at), "{width} {scale:?} {at} {found:?}");
                }
                assert!(found.len() > 3 || width < 400, "{width} {scale:?} {found:?}");
            }
        }
    }

    #[test]
    fn one_label_is_not_enough_where_two_are_allowed() {
        let legend = Legend::new(64);
        let scale = &Scale::Linear;
        let bar = Bar { scale, range: [0.9, 1.1], outer: [4, 60], tips: [0, 0], middle: 0.0, half: 0.0 };
        // With at most two, only 1.0 is a multiple of a round number.
        assert_eq!(scale.ticks(bar.range, 2).len(), 1);
        assert_eq!(legend.labels(&bar, 2, 0.0), None);
        assert_eq!(legend.labels(&bar, 1, 0.0).map_or(0, |labels| labels.len()), 1);
        assert_eq!(legend.labels(&bar, 3, 0.0).map_or(0, |labels| labels.len()), 3);
    }

    #[test]
    fn words_stand_in_lines() {
        let legend = Legend::new(960);
        assert_eq!((legend.em, legend.margin, legend.right()), (16.0, 12, 948));
        let places = legend.flow([500, 400, 100, 900].into_iter(), 20);
        assert_eq!(places, [(0, 12), (0, 532), (1, 12), (2, 12)]);
    }

    #[test]
    fn long_words_are_cut_short_and_others_are_not() {
        let legend = Legend::new(320);
        let word = "Geschwindigkeit";
        let whole = text::width(word, legend.em);
        assert_eq!(legend.fitted(word, whole).as_deref(), Some(word));
        let short = legend.fitted(word, whole - 1).expect("most of it fits");
        assert!(short.starts_with("Geschw") && short.ends_with('…'), "{short}");
        assert!(text::width(&short, legend.em) < whole);
        assert_eq!(legend.fitted(word, legend.ems(3.0) - 1), None);
    }
}
