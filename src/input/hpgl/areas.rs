//! Areas, their edges and fills: EA, ER, EW, RA, RR, WG, PM, EP, FP, FT, AC, PT, PW, WU.

use super::curve::Arc;
use super::fill::{self, Fill, Hatching, Inside, Lines};
use super::lexer::Mnemonic;
use super::paper::By;
use super::polygon::Polygon;
use super::scale::UNITS_PER_MM;
use super::{PenWidth, Plotter};
use crate::input::Fault;

/// Narrowest pen: least distance of a fill's lines, in plotter units.
const NARROWEST_UNITS: f64 = 0.05 * UNITS_PER_MM;

impl Plotter<'_> {
    /// Draws a rectangle from the pen to the opposite corner. The pen stays where it is.
    pub(super) fn rectangle(
        &mut self,
        by: By<'_>,
        relative: bool,
        filled: bool,
    ) -> Result<(), Fault> {
        let numbers = self.parameters(&[2])?;
        let &[x, y] = numbers.as_slice() else {
            return Ok(());
        };
        let [x1, y1] = self.at;
        let [x2, y2] = if relative { [x1 + x, y1 + y] } else { [x, y] };
        let corners = [[x1, y1], [x2, y1], [x2, y2], [x1, y2]];
        self.polygon = Polygon::of(corners.map(|corner| self.scale.to_plotter(corner)));
        self.edge_or_fill(by, filled)
    }

    /// Draws a sector about the pen, which stays where it is; a full circle has no radii.
    pub(super) fn wedge(&mut self, by: By<'_>, filled: bool) -> Result<(), Fault> {
        let numbers = self.parameters(&[3, 4])?;
        let &[radius, start_deg, sweep_deg, ..] = numbers.as_slice() else {
            return Ok(());
        };
        let chord = numbers.get(3).copied();
        let chord_deg = self.tolerance.chord_deg(chord, radius.abs());
        let arc = Arc::around(self.at, radius, start_deg, sweep_deg.clamp(-360.0, 360.0));
        let centre = (arc.sweep_deg.abs() < 360.0).then_some(self.at);
        let points = centre.into_iter().chain([arc.start]);
        let points = points.chain(arc.chords(chord_deg));
        self.polygon = Polygon::of(points.map(|point| self.scale.to_plotter(point)));
        self.edge_or_fill(by, filled)
    }

    fn edge_or_fill(&mut self, by: By<'_>, filled: bool) -> Result<(), Fault> {
        if filled {
            self.fill(by, Inside::EvenOdd)
        } else {
            self.edge_polygon(by)
        }
    }

    pub(super) fn polygon_mode(&mut self) -> Result<(), Fault> {
        let numbers = self.parameters(&[0, 1])?;
        match (numbers.first().copied().unwrap_or(0.0), self.recording) {
            (0.0, None) => {
                self.polygon = Polygon::default();
                self.polygon.add(self.here(), false);
                self.recording = Some((self.at, self.down));
            }
            (1.0, Some(_)) => self.polygon.close(self.down),
            (2.0, Some((at, down))) => {
                self.polygon.close(self.down);
                self.recording = None;
                (self.at, self.down) = (at, down);
                self.mark();
            }
            // Ends a polygon that has not begun: an empty polygon.
            (1.0 | 2.0, None) => {}
            (0.0, Some(_)) => {
                let problem = "polygon mode within polygon mode";
                return Err(self.lexer.fault(problem, "PM1 or PM2 before the next PM0"));
            }
            (kind, _) => {
                let problem = format!("{kind} is no polygon mode");
                return Err(self.lexer.fault(problem, "0, 1 or 2"));
            }
        }
        Ok(())
    }

    /// Draws the edges in the polygon buffer; the pen returns.
    pub(super) fn edge_polygon(&mut self, by: By<'_>) -> Result<(), Fault> {
        let paper = &mut self.paper;
        for part in self.polygon.parts() {
            let mut from = None;
            for corner in part {
                if let Some(from) = from.filter(|_| corner.drawn) {
                    paper.travel(by, from)?;
                    paper.line(by, corner.at)?;
                }
                from = Some(corner.at);
            }
        }
        let here = self.here();
        self.paper.travel(by, here)
    }

    pub(super) fn fill_polygon(&mut self, by: By<'_>) -> Result<(), Fault> {
        let inside = match *self.parameters(&[0, 1])? {
            [] | [0.0] => Inside::EvenOdd,
            [1.0, ..] => Inside::Winding,
            [method, ..] => {
                let allowed = "0 (even and odd) or 1 (winding)";
                return Err(self
                    .lexer
                    .fault(format!("{method} is no method of filling"), allowed));
            }
        };
        self.fill(by, inside)
    }

    /// Fills the polygon buffer; the pen returns.
    fn fill(&mut self, by: By<'_>, inside: Inside) -> Result<(), Fault> {
        let even = Lines::Even {
            most: self.pen_width.units.max(NARROWEST_UNITS),
        };
        let (hatching, ways, to_and_fro) = match self.fill {
            Fill::Solid => (None, 1, true),
            Fill::OneWay => (None, 1, false),
            Fill::Hatched(hatching) => (Some(hatching), 1, true),
            Fill::CrossHatched(hatching) => (Some(hatching), 2, true),
            Fill::Pattern(kind) => {
                let field = by.field;
                let text = || {
                    format!("{field}: fillings of type {kind} are not drawn, the areas stay empty")
                };
                self.note(&format!("FT{kind}"), by.line, text);
                return Ok(());
            }
        };
        let lines = match hatching {
            None => even,
            Some(hatching) => Lines::Anchored {
                anchor: self.anchor,
                spacing: match hatching.spacing {
                    Some(spacing) => (spacing * self.scale.unit_x()).abs(),
                    None => self.corners.diagonal() / 100.0,
                }
                .max(NARROWEST_UNITS),
            },
        };
        let outlines = self.polygon.outlines();
        for way in 0..ways {
            let angle = hatching.map_or(0.0, |hatching| hatching.angle_deg) + 90.0 * f64::from(way);
            let most = self.paper.left();
            match fill::lines(&outlines, lines, angle, inside, to_and_fro, most) {
                Some(filled) => {
                    for line in filled {
                        self.paper.stroke(by, line)?;
                    }
                }
                None => self.paper.count(by, most + 1)?,
            }
        }
        let here = self.here();
        self.paper.travel(by, here)
    }

    pub(super) fn fill_type(&mut self) -> Result<(), Fault> {
        let numbers = self.parameters(&[0, 1, 2, 3])?;
        let hatching = || {
            let spacing = numbers.get(1).copied().filter(|&spacing| spacing != 0.0);
            Hatching {
                spacing,
                angle_deg: numbers.get(2).copied().unwrap_or(0.0),
            }
        };
        self.fill = match numbers.first().copied() {
            None | Some(1.0) => Fill::Solid,
            Some(2.0) => Fill::OneWay,
            Some(3.0) => Fill::Hatched(hatching()),
            Some(4.0) => Fill::CrossHatched(hatching()),
            Some(kind) if kind.fract() == 0.0 && (5.0..100.0).contains(&kind) => {
                Fill::Pattern(kind as u32)
            }
            Some(kind) => {
                let problem = format!("{kind} is no type of filling");
                return Err(self
                    .lexer
                    .fault(problem, "1 to 4, or the types of patterns"));
            }
        };
        Ok(())
    }

    pub(super) fn anchor_corner(&mut self) -> Result<(), Fault> {
        self.anchor = match *self.parameters(&[0, 2])? {
            [x, y] => self.scale.to_plotter([x, y]),
            _ => [0.0; 2],
        };
        Ok(())
    }

    /// Sets the width of the pen in millimetres, for fills (PT).
    pub(super) fn pen_thickness(&mut self) -> Result<(), Fault> {
        let width = match *self.parameters(&[0, 1])? {
            [width] => width,
            _ => 0.3,
        };
        self.set_width(width * UNITS_PER_MM)
    }

    /// Sets the width of the pen, in the unit chosen by WU, whatever its number.
    pub(super) fn pen_width(&mut self) -> Result<(), Fault> {
        let relative = self.pen_width.relative;
        let width = self.parameters(&[0, 1, 2])?.first().copied();
        match width {
            Some(percent) if relative => self.set_width(percent / 100.0 * self.corners.diagonal()),
            Some(mm) => self.set_width(mm * UNITS_PER_MM),
            None => self.set_width(0.35 * UNITS_PER_MM),
        }
    }

    fn set_width(&mut self, units: f64) -> Result<(), Fault> {
        if units < 0.0 {
            return Err(self.lexer.fault("a pen of negative width", "0 or more"));
        }
        self.pen_width.units = units;
        Ok(())
    }

    pub(super) fn width_unit(&mut self) -> Result<(), Fault> {
        let relative = self.parameters(&[0, 1])?.first() == Some(&1.0);
        self.pen_width = PenWidth {
            relative,
            ..PenWidth::default()
        };
        Ok(())
    }

    /// Handles an instruction that polygon mode does not accept.
    pub(super) fn out_of_place(&mut self, mnemonic: Mnemonic, line: usize) -> Result<(), Fault> {
        if !self.lenient {
            let allowed = "AA, AR, AT, BR, BZ, CI, PA, PD, PE, PR, PU or RT up to PM2";
            return Err(self.lexer.fault("stands in polygon mode", allowed));
        }
        let text = || format!("{mnemonic}: stands in polygon mode, skipped");
        self.note(&format!("PM {mnemonic}"), line, text);
        self.skip_arguments(mnemonic)
    }
}
