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
/// Orange.
pub const ORANGE: RGBColor = RGBColor(230, 159, 0);
/// Sky blue.
pub const LIGHT_BLUE: RGBColor = RGBColor(86, 180, 233);
/// Reddish purple.
pub const PURPLE: RGBColor = RGBColor(204, 121, 167);
/// For what is not a line of data.
pub const GREY: RGBColor = RGBColor(120, 120, 120);

/// In the order of the lines of a figure.
pub const LINES: [RGBColor; 4] = [BLACK, VERMILION, BLUE, GREEN];

/// From little to much, for maps: viridis in six steps, whose lightness falls evenly, so that they keep their order for any kind of
/// colour vision and without colour. Source: S. van der Walt, N. Smith, matplotlib, 2015.
pub const RAMP: [RGBColor; 6] = [
    RGBColor(253, 231, 37),
    RGBColor(122, 209, 81),
    RGBColor(34, 168, 132),
    RGBColor(42, 120, 142),
    RGBColor(65, 68, 135),
    RGBColor(68, 1, 84),
];
