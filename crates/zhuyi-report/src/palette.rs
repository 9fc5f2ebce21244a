//! Colours that people with any kind of colour vision can tell apart.
//!
//! Source: M. Okabe and K. Ito, *Color Universal Design*, 2008, of which the yellow is left out: too light for lines.

use plotters::style::RGBColor;

/// For what there is without anything.
pub const BLACK: RGBColor = RGBColor(0, 0, 0);
/// Vermilion.
pub const VERMILION: RGBColor = RGBColor(213, 94, 0);
/// Blue.
pub const BLUE: RGBColor = RGBColor(0, 114, 178);
/// Bluish green.
pub const GREEN: RGBColor = RGBColor(0, 158, 115);
/// For what is not a line of data.
pub const GREY: RGBColor = RGBColor(120, 120, 120);

/// In the order of the lines of a figure.
pub const LINES: [RGBColor; 4] = [BLACK, VERMILION, BLUE, GREEN];
