//! Words in Noto Sans, with smooth edges.

use super::canvas::Canvas;
use ab_glyph::{Font, FontRef, Glyph, ScaleFont, point};
use std::sync::LazyLock;

static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(notosans::REGULAR_TTF).expect("the font is a part of the program")
});

/// The size of raised characters, and how far they are raised, in parts of the size of others.
const RAISED: [f32; 2] = [0.7, 0.38];

/// The character to draw for a raised one. The font lacks some of these, so all are drawn small.
const fn lowered(c: char) -> Option<char> {
    Some(match c {
        '⁻' => '−',
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        _ => return None,
    })
}

/// The characters of a text with their places from its left end and baseline, and its width. `size` is that
/// of an em in pixels. A character that the font lacks shows as a box.
fn set(text: &str, size: f32) -> (Vec<Glyph>, f32) {
    let mut right = 0.0;
    let glyphs = text.chars().map(|c| {
        let (c, part, up) = lowered(c).map_or((c, 1.0, 0.0), |c| (c, RAISED[0], RAISED[1]));
        // The crate counts sizes from the lowest descender to the highest ascender.
        let em = FONT.units_per_em().unwrap_or(1000.0);
        let scaled = FONT.as_scaled(size * part * FONT.height_unscaled() / em);
        let id = scaled.glyph_id(c);
        let glyph = id.with_scale_and_position(scaled.scale, point(right, -up * size));
        right += scaled.h_advance(id);
        glyph
    });
    let glyphs = glyphs.collect();
    (glyphs, right)
}

/// The width of a text in whole pixels.
pub(super) fn width(text: &str, size: f32) -> i32 {
    set(text, size).1.ceil() as i32
}

/// Writes a text from a place on its baseline.
pub(super) fn write(canvas: &mut Canvas, text: &str, [left, baseline]: [i32; 2], size: f32, color: [f64; 3]) {
    for glyph in set(text, size).0 {
        let Some(outline) = FONT.outline_glyph(glyph) else { continue };
        let corner = outline.px_bounds().min;
        let (x, y) = (left + corner.x as i32, baseline + corner.y as i32);
        outline.draw(|dx, dy, share| canvas.cover(x + dx.cast_signed(), y + dy.cast_signed(), share, color));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_what_legends_say() {
        for c in "0123456789−.×/π≤≥θφΔαβ°²·()".chars() {
            let c = lowered(c).unwrap_or(c);
            assert_ne!(FONT.glyph_id(c).0, 0, "{c}");
        }
    }

    #[test]
    fn text_stays_within_its_width() {
        for (text, size) in [("redshift factor g", 16.0), ("10⁻⁹", 11.0), ("3π/2", 43.0), ("", 16.0)] {
            let width = width(text, size);
            let mut canvas = Canvas::new(200 + width);
            canvas.grow(3 * size as i32, [0.0; 3]);
            write(&mut canvas, text, [100, 2 * size as i32], size, [1.0; 3]);
            let inked: Vec<usize> = (0..canvas.pixels.len()).filter(|k| canvas.pixels[*k][0] > 0.0).collect();
            assert_eq!(inked.is_empty(), text.is_empty());
            for k in inked {
                let column = (k % canvas.width as usize).cast_signed() as i32 - 100;
                assert!((-1..=width).contains(&column), "{text} {column} {width}");
            }
        }
    }

    #[test]
    fn raised_figures_are_smaller() {
        let (plain, raised) = (set("10−5", 20.0), set("10⁻⁵", 20.0));
        assert!(raised.1 < plain.1);
        assert_eq!(raised.0[0].position.y, 0.0);
        assert!(raised.0[3].position.y < 0.0);
    }
}
