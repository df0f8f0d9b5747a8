//! Pictures of a run as SVG: panels with axes, grid and curves.
//!
//! ```
//! use motion_rtl::picture::{Curve, Panel, Picture};
//!
//! let path = vec![(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)];
//! let panel = Panel::new("path", "x in mm", "y in mm")
//!     .equal_scales()
//!     .curve(Curve::new("commanded", path));
//! let svg = Picture::new("a corner").panel(panel).render();
//! assert!(svg.starts_with("<svg"));
//! ```

mod panel;
mod points;
mod scale;

pub use panel::{Curve, Panel};
pub use points::Points;

use svg::Document;
use svg::node::element::{Rectangle, Text};

/// Width of a picture in pixels.
const WIDTH: f64 = 1000.0;
/// Space above the first panel in pixels.
const HEAD: f64 = 46.0;
const FONT: &str = "Helvetica, Arial, sans-serif";

/// Panels below each other under one title.
#[derive(Debug, Clone)]
pub struct Picture {
    title: String,
    panels: Vec<Panel>,
}

impl Picture {
    /// Creates a picture without panels.
    pub fn new(title: impl Into<String>) -> Self {
        Picture {
            title: title.into(),
            panels: Vec::new(),
        }
    }

    /// Adds a panel below the others.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// Returns the picture as SVG text; equal pictures give the same bytes.
    pub fn render(&self) -> String {
        let mut top = HEAD;
        let mut groups = Vec::new();
        for panel in &self.panels {
            let (group, height) = panel.draw(WIDTH, top);
            groups.push(group);
            top += height;
        }
        let title = Text::new(self.title.as_str())
            .set("x", 20)
            .set("y", 30)
            .set("font-size", 18)
            .set("font-weight", "bold");
        let paper = Rectangle::new()
            .set("width", "100%")
            .set("height", "100%")
            .set("fill", "white");
        groups
            .into_iter()
            .fold(
                Document::new()
                    .set("viewBox", (0, 0, WIDTH, top))
                    .set("width", WIDTH)
                    .set("height", top)
                    .set("font-family", FONT)
                    .add(paper)
                    .add(title),
                Document::add,
            )
            .to_string()
    }
}
