//! Text tables of a summary, column by column.

use std::fmt::{self, Write};

/// A table of rows. Each column has a head, a least width and a way to show a row.
pub struct Table<R> {
    rows: Vec<R>,
    /// The heads, then a line for each row.
    lines: Vec<Vec<String>>,
}

impl<R> Table<R> {
    /// Creates a table without columns.
    pub fn of(rows: impl IntoIterator<Item = R>) -> Self {
        let rows: Vec<R> = rows.into_iter().collect();
        Table {
            lines: vec![Vec::new(); 1 + rows.len()],
            rows,
        }
    }

    /// Appends a column, its cells to the right.
    pub fn col<C: ToString>(self, head: &str, least: usize, cell: impl Fn(&R) -> C) -> Self {
        let width = least.max(head.chars().count());
        self.append(head, cell, |text| format!("{text:>width$}"))
    }

    /// Appends a column, its cells to the left.
    pub fn left<C: ToString>(self, head: &str, least: usize, cell: impl Fn(&R) -> C) -> Self {
        let width = least.max(head.chars().count());
        self.append(head, cell, |text| format!("{text:<width$}"))
    }

    fn append<C: ToString>(
        mut self,
        head: &str,
        cell: impl Fn(&R) -> C,
        pad: impl Fn(&str) -> String,
    ) -> Self {
        let cells = self.rows.iter().map(|row| pad(&cell(row).to_string()));
        let column = std::iter::once(pad(head)).chain(cells);
        for (line, cell) in self.lines.iter_mut().zip(column) {
            line.push(cell);
        }
        self
    }

    /// Writes the heads and the rows, a line each.
    pub fn write(&self, text: &mut String) -> fmt::Result {
        let mut lines = self.lines.iter();
        lines.try_for_each(|cells| writeln!(text, "{}", cells.join("  ").trim_end()))
    }

    /// Writes the table and an empty line.
    pub fn write_apart(&self, text: &mut String) -> fmt::Result {
        self.write(text)?;
        writeln!(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::rows::fixed;

    struct Point {
        name: &'static str,
        mm: f64,
        line: usize,
    }

    fn text<R>(table: &Table<R>) -> String {
        let mut text = String::new();
        table.write(&mut text).unwrap();
        text
    }

    #[test]
    fn cells_stand_under_their_heads() {
        let points = [("a", 1.25, 7), ("longer", -12.5, 1200)];
        let points = points.map(|(name, mm, line)| Point { name, mm, line });
        let mut table = Table::of(&points)
            .left("point", 6, |point| point.name)
            .col("mm", 7, |point| fixed(point.mm, 3))
            .col("line of input", 0, |point| point.line);
        for times in [1, 2] {
            let head = format!("x{times}");
            table = table.col(&head, 0, |point| point.name.repeat(times));
        }
        assert_eq!(
            text(&table),
            "point        mm  line of input  x1  x2\n\
             a         1.250              7   a  aa\n\
             longer  -12.500           1200  longer  longerlonger\n"
        );
    }

    #[test]
    fn a_table_without_rows_is_its_heads_and_no_line_ends_in_spaces() {
        let none = Table::of([0; 0]).left("point", 9, |k| *k);
        assert_eq!(text(&none), "point\n");
        let one = Table::of([1]).left("point", 9, |k| *k).col("", 9, |_| "");
        assert_eq!(text(&one), "point\n1\n");
        let unnamed = Table::of([1]).col("", 0, |_| "").col("k", 3, |k| *k);
        assert_eq!(text(&unnamed), "    k\n    1\n");
    }
}
