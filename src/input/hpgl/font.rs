//! Letters of labels: Hershey's single-stroke Roman font.

use std::sync::OnceLock;

use vector_text_core::Renderer;
use vector_text_hershey::{HersheyFont, HersheyRenderer};

/// Strokes of a character, in widths and heights of a capital letter, from the left end of the
/// base line.
pub(super) type Glyph = Vec<Vec<[f64; 2]>>;

/// Width and height of a capital letter of the font, in font units.
const CAPITAL: [f64; 2] = [16.0, 21.0];

/// Base line in font units, which count downwards.
const BASE_LINE: f64 = 9.0;

/// Greatest width of a character: it has a cell of one and a half widths.
const WIDEST: f64 = 1.3;

/// First and last character of the font, besides the space.
const CHARACTERS: std::ops::RangeInclusive<u8> = b'!'..=b'~';

/// Returns the strokes of an ASCII character; empty for a space, `None` for a character that the
/// font does not have.
pub(super) fn glyph(character: u8) -> Option<&'static Glyph> {
    static GLYPHS: OnceLock<Vec<Glyph>> = OnceLock::new();
    static SPACE: Glyph = Vec::new();
    if character == b' ' {
        return Some(&SPACE);
    }
    let place = usize::from(character.checked_sub(*CHARACTERS.start())?);
    GLYPHS
        .get_or_init(|| CHARACTERS.map(draw).collect())
        .get(place)
}

/// Returns the strokes of a character, centred in its cell as on a plotter.
fn draw(character: u8) -> Glyph {
    if character == b'_' {
        // The font has no underscore.
        return vec![vec![[0.0, -0.2], [1.0, -0.2]]];
    }
    let text = char::from(character).to_string();
    let points = HersheyRenderer::render_text(&text, HersheyFont::Romans);
    let across = || points.iter().map(|point| f64::from(point.x));
    let left = across().fold(f64::INFINITY, f64::min);
    let right = across().fold(f64::NEG_INFINITY, f64::max);
    let scale = (1.0 / CAPITAL[0]).min(WIDEST / (right - left).max(1.0));
    let middle = (left + right) / 2.0;
    let mut strokes = Glyph::new();
    for point in &points {
        let x = 0.5 + (f64::from(point.x) - middle) * scale;
        let y = (BASE_LINE - f64::from(point.y)) / CAPITAL[1];
        match strokes.last_mut() {
            Some(stroke) if point.pen => stroke.push([x, y]),
            _ => strokes.push(vec![[x, y]]),
        }
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_has_strokes_within_its_cell() {
        for character in CHARACTERS {
            let strokes = glyph(character).unwrap();
            let shown = char::from(character);
            assert!(!strokes.is_empty(), "{shown}");
            for [x, y] in strokes.iter().flatten() {
                assert!((-0.2..=1.2).contains(x), "{shown}: {x}");
                assert!((-0.5..=1.2).contains(y), "{shown}: {y}");
            }
        }
        assert!(glyph(b' ').unwrap().is_empty());
        assert!(glyph(0x7f).is_none() && glyph(0xe4).is_none() && glyph(3).is_none());
    }

    #[test]
    fn a_capital_letter_stands_on_the_base_line_and_fills_the_size() {
        let points: Vec<_> = glyph(b'H').unwrap().iter().flatten().collect();
        let least = |axis: usize| points.iter().map(|p| p[axis]).fold(9.0, f64::min);
        let most = |axis: usize| points.iter().map(|p| p[axis]).fold(-9.0, f64::max);
        assert_eq!((least(1), most(1)), (0.0, 1.0));
        assert!((least(0) + most(0) - 1.0).abs() < 1e-9, "in the middle");
        // H has two uprights and a bar.
        assert_eq!(glyph(b'H').unwrap().len(), 3);
    }
}
