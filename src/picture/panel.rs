use super::points::Points;
use super::scale::{Scale, range};
use std::ops::Range;
use svg::node::element::path::Data;
use svg::node::element::{Circle, Group, Line, Path, Rectangle, Text};

/// Default colours of curves, distinguishable by colour-blind readers too.
const COLOURS: [&str; 6] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];
/// Space around the frame of a panel in pixels: left, right, above, below.
const MARGIN: (f64, f64, f64, f64) = (80.0, 20.0, 34.0, 52.0);
/// Height in pixels of a panel with free scales.
const FREE_HEIGHT: f64 = 150.0;
/// Greatest height in pixels of a panel's frame with equal scales.
const EQUAL_HEIGHT: f64 = 760.0;

/// Height of a row of the legend in pixels.
const ROW: f64 = 18.0;
/// Space beside a name in the legend for a sample and gaps, in pixels: least, greatest.
const NAME_ROOM: (f64, f64) = (16.0, 44.0);

/// Curve of a panel.
#[derive(Debug, Clone)]
pub struct Curve {
    name: String,
    points: Vec<(f64, f64)>,
    colour: Option<String>,
    width: f64,
    dashes: Option<&'static str>,
}

impl Curve {
    /// Creates a curve through the given points; a point that is not finite interrupts it.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Curve::thinned(name, points.into())
    }

    /// Creates a curve through points that were thinned while they were collected.
    pub fn thinned(name: impl Into<String>, points: Points) -> Self {
        Curve {
            name: name.into(),
            points: points.kept(),
            colour: None,
            width: 1.2,
            dashes: None,
        }
    }

    /// Sets the colour, in SVG notation.
    #[must_use]
    pub fn colour(mut self, colour: impl Into<String>) -> Self {
        self.colour = Some(colour.into());
        self
    }

    /// Sets the line width in pixels.
    #[must_use]
    pub fn width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Makes the line dashed.
    #[must_use]
    pub fn dashed(mut self) -> Self {
        self.dashes = Some("4 3");
        self
    }

    fn data(&self, x: Scale, y: Scale) -> Data {
        let mut data = Data::new();
        let mut pen_down = false;
        for &(px, py) in &self.points {
            if !(px.is_finite() && py.is_finite()) {
                pen_down = false;
                continue;
            }
            let at = (hundredths(x.pixel(px)), hundredths(y.pixel(py)));
            data = if pen_down {
                data.line_to(at)
            } else {
                data.move_to(at)
            };
            pen_down = true;
        }
        data
    }
}

fn text(words: &str, x: f64, y: f64) -> Text {
    Text::new(words)
        .set("x", hundredths(x))
        .set("y", hundredths(y))
        .set("font-size", 12)
        .set("fill", "#333")
}

/// Returns the width of a curve's name in the legend, in pixels.
fn name_width(curve: &Curve) -> f64 {
    6.8 * curve.name.chars().count() as f64
}

fn hundredths(pixel: f64) -> f32 {
    ((pixel * 100.0).round() / 100.0) as f32
}

/// Frame with axes, grid, legend and curves.
#[derive(Debug, Clone)]
pub struct Panel {
    title: String,
    x_label: String,
    y_label: String,
    equal: bool,
    /// True if grid and numbers are left out.
    bare: bool,
    curves: Vec<Curve>,
    marks: Vec<((f64, f64), String)>,
}

impl Panel {
    /// Creates a panel without curves; labels name the quantity and its unit.
    pub fn new(
        title: impl Into<String>,
        x_label: impl Into<String>,
        y_label: impl Into<String>,
    ) -> Self {
        Panel {
            title: title.into(),
            x_label: x_label.into(),
            y_label: y_label.into(),
            equal: false,
            bare: false,
            curves: Vec::new(),
            marks: Vec::new(),
        }
    }

    /// Makes a unit in x as long as a unit in y.
    #[must_use]
    pub fn equal_scales(mut self) -> Self {
        self.equal = true;
        self
    }

    /// Removes the scales of both axes: no grid, no numbers.
    #[must_use]
    pub fn without_scales(mut self) -> Self {
        self.bare = true;
        self
    }

    /// Adds a dot with a text to its right. It does not widen the panel.
    #[must_use]
    pub fn mark(mut self, at: (f64, f64), words: impl Into<String>) -> Self {
        self.marks.push((at, words.into()));
        self
    }

    /// Adds a curve on top of the others.
    #[must_use]
    pub fn curve(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// Draws the panel from `top` down; also returns its height.
    pub(super) fn draw(&self, width: f64, top: f64) -> (Group, f64) {
        let (left, right, above, below) = MARGIN;
        let legend = self.legend_rows(width, left);
        let above = above + ROW * (legend.len().max(1) - 1) as f64;
        let (mut across, mut down) = (width - left - right, FREE_HEIGHT);
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let margin_x = if self.equal { 0.04 } else { 0.0 };
        let (x_least, x_most) = range(points().map(|point| point.0), margin_x);
        let (y_least, y_most) = range(points().map(|point| point.1), 0.06);
        if self.equal {
            let scale = (across / (x_most - x_least)).min(EQUAL_HEIGHT / (y_most - y_least));
            across = scale * (x_most - x_least);
            down = scale * (y_most - y_least);
        }
        let x = Scale::new(x_least, x_most, left, across);
        let y = Scale::new(y_least, y_most, top + above + down, -down);
        let mut group = self.frame(x, y, across, down, [top, top + above]);
        for (curve, colour) in self.curves.iter().zip(self.colours()) {
            let mut path = Path::new()
                .set("d", curve.data(x, y))
                .set("fill", "none")
                .set("stroke", colour)
                .set("stroke-width", curve.width)
                .set("stroke-linejoin", "round");
            if let Some(dashes) = curve.dashes {
                path = path.set("stroke-dasharray", dashes);
            }
            group = group.add(path);
        }
        for ((px, py), words) in &self.marks {
            let (px, py) = (x.pixel(*px), y.pixel(*py));
            let dot = Circle::new()
                .set("cx", hundredths(px))
                .set("cy", hundredths(py))
                .set("r", 3)
                .set("fill", "#333");
            // Keeps the text inside the frame.
            let dy = match py - top - above < 18.0 {
                true => 16.0,
                false => -6.0,
            };
            let words = match px + 7.0 * (words.chars().count() as f64 + 1.0) > left + across {
                true => text(words, px - 7.0, py + dy).set("text-anchor", "end"),
                false => text(words, px + 7.0, py + dy),
            };
            group = group.add(dot).add(words);
        }
        for (row, names) in legend.into_iter().enumerate() {
            let top = top + ROW * row as f64;
            group = self.legend(group, names, left, across, top);
        }
        (group, above + down + below)
    }

    fn colours(&self) -> impl Iterator<Item = &str> {
        let mut free = COLOURS.iter().cycle();
        self.curves.iter().map(move |curve| match &curve.colour {
            Some(colour) => colour.as_str(),
            None => free.next().copied().unwrap_or("black"),
        })
    }

    /// Draws the title at `top`, the rest from `frame` on.
    fn frame(&self, x: Scale, y: Scale, across: f64, down: f64, [top, frame]: [f64; 2]) -> Group {
        let left = MARGIN.0;
        let line = |x1: f64, y1: f64, x2: f64, y2: f64| {
            Line::new()
                .set("x1", hundredths(x1))
                .set("y1", hundredths(y1))
                .set("x2", hundredths(x2))
                .set("y2", hundredths(y2))
                .set("stroke", "#e4e4e4")
        };
        let mut group = Group::new();
        let ticks = |scale: Scale, count: f64| match self.bare {
            true => Vec::new(),
            false => scale.ticks(count.max(2.0)),
        };
        for (tick, label) in ticks(x, across / 90.0) {
            let at = x.pixel(tick);
            let words = text(&label, at, frame + down + 16.0).set("text-anchor", "middle");
            group = group.add(line(at, frame, at, frame + down)).add(words);
        }
        for (tick, label) in ticks(y, down / if self.equal { 45.0 } else { 30.0 }) {
            let at = y.pixel(tick);
            let words = text(&label, left - 6.0, at + 4.0).set("text-anchor", "end");
            group = group.add(line(left, at, left + across, at)).add(words);
        }
        let border = Rectangle::new()
            .set("x", hundredths(left))
            .set("y", hundredths(frame))
            .set("width", hundredths(across))
            .set("height", hundredths(down))
            .set("fill", "none")
            .set("stroke", "#888");
        let x_label = text(&self.x_label, left + across / 2.0, frame + down + 34.0)
            .set("text-anchor", "middle");
        let (y_x, y_y) = (hundredths(22.0), hundredths(frame + down / 2.0));
        let y_label = text(&self.y_label, 22.0, frame + down / 2.0)
            .set("text-anchor", "middle")
            .set("transform", format!("rotate(-90 {y_x} {y_y})"));
        let title = text(&self.title, left, top + 14.0).set("font-weight", "bold");
        group.add(border).add(x_label).add(y_label).add(title)
    }

    /// Returns the start of the curves' names, to the right of the title.
    fn legend_begin(&self, left: f64) -> f64 {
        left + 7.5 * self.title.chars().count() as f64 + 30.0
    }

    /// Divides the names of the curves into rows.
    fn legend_rows(&self, width: f64, left: f64) -> Vec<Range<usize>> {
        let begin = self.legend_begin(left);
        let (mut rows, mut at) = (Vec::<Range<usize>>::new(), begin);
        for (index, curve) in self.curves.iter().enumerate() {
            at += NAME_ROOM.0 + name_width(curve);
            match rows.last_mut() {
                Some(row) if at <= width => row.end = index + 1,
                _ => {
                    at = begin + NAME_ROOM.0 + name_width(curve);
                    rows.push(index..index + 1);
                }
            }
        }
        rows
    }

    /// Draws the names of some curves, from left to right.
    fn legend(
        &self,
        mut group: Group,
        names: Range<usize>,
        left: f64,
        across: f64,
        top: f64,
    ) -> Group {
        let mut at = self.legend_begin(left);
        let curves = &self.curves[names.clone()];
        // Long lists of names are set closer.
        let widths: f64 = curves.iter().map(name_width).sum();
        let room = (left + across - at - widths) / curves.len().max(1) as f64;
        let room = room.clamp(NAME_ROOM.0, NAME_ROOM.1);
        let (sample_width, gap) = (room * 24.0 / 44.0, room * 20.0 / 44.0);
        let colours = self.colours().skip(names.start);
        for (curve, colour) in curves.iter().zip(colours) {
            let mut sample = Line::new()
                .set("x1", hundredths(at))
                .set("x2", hundredths(at + sample_width))
                .set("y1", hundredths(top + 10.0))
                .set("y2", hundredths(top + 10.0))
                .set("stroke", colour)
                .set("stroke-width", curve.width.max(1.5));
            if let Some(dashes) = curve.dashes {
                sample = sample.set("stroke-dasharray", dashes);
            }
            let name = Text::new(curve.name.as_str())
                .set("x", hundredths(at + sample_width + gap * 0.3))
                .set("y", hundredths(top + 14.0))
                .set("font-size", 12)
                .set("fill", "#333");
            group = group.add(sample).add(name);
            at += room + name_width(curve);
        }
        group
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_legend_too_long_for_a_row_goes_on_in_the_next() {
        let panel = |curves: usize| {
            let curve = |number| Curve::new(format!("curve number {number:02}"), vec![(0.0, 0.0)]);
            let panel = Panel::new("title", "x", "y");
            (0..curves).fold(panel, |panel, number| panel.curve(curve(number)))
        };
        let height = |curves| panel(curves).draw(1000.0, 0.0).1;
        // A name of 15 characters takes 118 pixels of the 852 from 147 on.
        let rows = |curves| panel(curves).legend_rows(1000.0, 80.0);
        assert_eq!(rows(0), []);
        assert_eq!(rows(7), std::slice::from_ref(&(0..7)));
        assert_eq!(rows(8), [0..7, 7..8]);
        assert_eq!(rows(15), [0..7, 7..14, 14..15]);
        assert_eq!(height(0), height(7));
        assert_eq!(height(15), height(7) + 2.0 * ROW);
    }
}
