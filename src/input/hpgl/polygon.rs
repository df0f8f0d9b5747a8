//! The polygon buffer (PM).

/// Corner in plotter units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub(super) at: [f64; 2],
    /// True if the pen was down on the way to it.
    pub(super) drawn: bool,
}

/// Contents of the polygon buffer: a polygon of several parts.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Polygon {
    parts: Vec<Vec<Corner>>,
    /// True if corners are added to the last part; otherwise the next one begins a new part.
    open: bool,
}

impl Polygon {
    /// Creates a polygon of one part with drawn edges.
    pub(super) fn of(corners: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut polygon = Polygon::default();
        for at in corners {
            polygon.add(at, true);
        }
        polygon.close(true);
        polygon
    }

    /// Adds a corner. The way to the first corner of a part is never drawn.
    pub(super) fn add(&mut self, at: [f64; 2], drawn: bool) {
        match self.parts.last_mut() {
            Some(part) if self.open => part.push(Corner { at, drawn }),
            _ => {
                self.open = true;
                self.parts.push(vec![Corner { at, drawn: false }]);
            }
        }
    }

    /// Ends a part, with the edge from its end to its start.
    pub(super) fn close(&mut self, drawn: bool) {
        if !std::mem::take(&mut self.open) {
            return;
        }
        let Some(part) = self.parts.last_mut() else {
            return;
        };
        match part.as_slice() {
            // Only a starting point: not a part.
            [] | [_] => drop(self.parts.pop()),
            [first, .., last] if first.at == last.at => {}
            [first, ..] => part.push(Corner {
                at: first.at,
                drawn,
            }),
        }
    }

    pub(super) fn parts(&self) -> &[Vec<Corner>] {
        &self.parts
    }

    /// Returns the corners of the parts, for fills.
    pub(super) fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        let outline = |part: &Vec<Corner>| part.iter().map(|corner| corner.at).collect();
        self.parts.iter().map(outline).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_closed_and_places_to_start_from_are_none() {
        let mut polygon = Polygon::default();
        polygon.close(true);
        polygon.add([9.0, 9.0], true);
        polygon.close(true);
        for (at, drawn) in [([0.0, 0.0], true), ([1.0, 0.0], true), ([1.0, 1.0], false)] {
            polygon.add(at, drawn);
        }
        polygon.close(true);
        polygon.add([5.0, 5.0], true);
        polygon.add([6.0, 5.0], true);
        polygon.add([5.0, 5.0], true);
        polygon.close(false);
        polygon.close(false);
        let shown: Vec<Vec<_>> = polygon
            .parts()
            .iter()
            .map(|part| {
                part.iter()
                    .map(|corner| (corner.at[0], corner.drawn))
                    .collect()
            })
            .collect();
        assert_eq!(
            shown,
            [
                vec![(0.0, false), (1.0, true), (1.0, false), (0.0, true)],
                vec![(5.0, false), (6.0, true), (5.0, true)],
            ]
        );
    }
}
