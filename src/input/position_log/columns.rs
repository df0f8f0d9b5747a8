//! Selection of the columns with the times and the counts.

use super::{Log, whole};
use crate::input::Fault;

/// Selection of a log's columns.
///
/// A column is given by its name, or by its number from 1. By default, times are in the column
/// `time` and counts in the column `counts`. If there is no such column, the contents decide.
/// Times rise from line to line, or at least do not fall. Counts are whole numbers, written
/// without a point if there are any such. Neither is an index (a column that rises by one from
/// line to line, or one without a name among named ones) if there is another column. The first
/// suitable pair is taken, with the counts on the right of the times; they may be on the left only
/// if one of the two is given or has its usual name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    /// Column of times.
    pub time: Option<String>,
    /// Column of counts.
    pub counts: Option<String>,
    /// Seconds per unit of time; by default the log determines the unit.
    pub time_unit_s: Option<f64>,
}

/// Column of a log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Index, from 0.
    pub index: usize,
    /// Name in faults: its name, or else its content and its number from 1.
    pub name: String,
    /// True if it was requested, or the log names it `time` or `counts`.
    pub named: bool,
}

/// Number of columns that are considered without being requested.
const MOST_LOOKED_THROUGH: usize = 256;

/// Properties of a column over all lines.
#[derive(Debug, Clone, Copy)]
struct Column {
    first: Option<f64>,
    last: Option<f64>,
    /// True if all are finite numbers.
    numeric: bool,
    /// True if all are whole numbers in range.
    whole: bool,
    /// True if all are written without a point.
    plain: bool,
    falls: bool,
    /// True if a number is equal to the one before.
    stands: bool,
    /// True if every number is one above the one before.
    by_ones: bool,
}

impl Column {
    const EMPTY: Self = Column {
        first: None,
        last: None,
        numeric: true,
        whole: true,
        plain: true,
        falls: false,
        stands: false,
        by_ones: true,
    };

    fn add(&mut self, field: Option<&&str>) {
        let number = field.and_then(|field| field.parse::<f64>().ok());
        let Some(number) = number.filter(|number| number.is_finite()) else {
            (self.numeric, self.whole, self.plain) = (false, false, false);
            return;
        };
        self.whole &= field.is_some_and(|field| whole(field).is_some());
        self.plain &= field.is_some_and(|field| field.parse::<i64>().is_ok());
        self.first.get_or_insert(number);
        if let Some(last) = self.last.replace(number) {
            self.falls |= number < last;
            self.stands |= number == last;
            self.by_ones &= number == last + 1.0;
        }
    }
}

impl Column {
    /// True if the column may be times: a coarse clock may repeat some.
    fn rises(&self) -> bool {
        self.numeric && !self.falls && self.first < self.last
    }
}

/// Properties of a log's columns.
pub(super) struct Survey {
    /// Line of the first record.
    line: usize,
    /// Names of the columns, if the first record has them.
    header: Option<Vec<String>>,
    columns: Vec<Column>,
}

impl Survey {
    /// Begins with the first record, which has names if none of its fields is a number.
    pub(super) fn begin(line: usize, fields: &[&str]) -> Self {
        let named = fields.iter().all(|field| field.parse::<f64>().is_err());
        let mut survey = Survey {
            line,
            header: named.then(|| fields.iter().map(|&field| field.to_owned()).collect()),
            columns: vec![Column::EMPTY; fields.len()],
        };
        if !named {
            survey.add(fields);
        }
        survey
    }

    /// Adds another record.
    pub(super) fn add(&mut self, fields: &[&str]) {
        for (index, column) in self.columns.iter_mut().enumerate() {
            column.add(fields.get(index));
        }
    }

    /// True if a line has the names.
    pub(super) fn is_header(&self, line: usize) -> bool {
        self.header.is_some() && line == self.line
    }

    /// Returns the line of the first record.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// Returns the name of a column.
    pub(super) fn name(&self, index: usize) -> Option<&str> {
        let name = self.header.as_ref()?.get(index)?;
        Some(name.as_str()).filter(|name| !name.is_empty())
    }

    fn place(&self, index: usize, what: &str, named: bool) -> Place {
        let name = match self.name(index) {
            Some(name) => name.to_owned(),
            None => format!("{what} (column {})", index + 1),
        };
        Place { index, name, named }
    }

    /// True for a column that programs put beside the data.
    fn is_index(&self, index: usize) -> bool {
        let by_ones = self.columns.get(index).is_some_and(|column| column.by_ones);
        by_ones || self.is_nameless(index)
    }

    fn is_nameless(&self, index: usize) -> bool {
        self.header.is_some() && self.name(index).is_none()
    }

    fn names(&self) -> String {
        let numbers = || format!("the numbers of columns, 1 to {}", self.columns.len());
        match &self.header {
            Some(names) => names.join(", "),
            None => numbers(),
        }
    }
}

impl Columns {
    /// Returns the columns of times and counts.
    pub(super) fn choose(&self, log: &Log<'_>, survey: &Survey) -> Result<(Place, Place), Fault> {
        let line = survey.line;
        let all = 0..survey.columns.len();
        if all.len() < 2 {
            let allowed = "a column of times and one of counts, with a comma between them";
            return Err(log.fault(line, "file", "only one column", allowed));
        }
        let called = |name: &str| all.clone().find(|&index| survey.name(index) == Some(name));
        let find = |wanted: &Option<String>, usual: &str| {
            let Some(name) = wanted else {
                return Ok(called(usual));
            };
            let number = name.parse::<usize>().ok();
            let numbered = number.and_then(|number| number.checked_sub(1));
            let numbered = numbered.filter(|index| all.contains(index));
            let found = called(name).or(numbered);
            found.map(Some).ok_or_else(|| {
                let problem = "no such column";
                log.fault(line, name, problem, &survey.names())
            })
        };
        let counts = find(&self.counts, "counts")?;
        let time = find(&self.time, "time")?;
        if let (Some(index), true) = (time, time == counts) {
            let name = survey.place(index, "time", true).name;
            let problem = format!("{name} is both time and counts");
            return Err(log.fault(line, &name, problem, &survey.names()));
        }
        let (chosen_time, chosen_counts) = best(survey, time, counts);
        let index = chosen_counts;
        if counts.is_none() && survey.is_nameless(index) && survey.columns[index].by_ones {
            let problem = "has no name and rises by one from line to line: an index, not counts";
            let name = survey.place(index, "counts", false).name;
            let allowed = "a column of counts";
            return Err(log.fault(line, &name, problem, allowed));
        }
        Ok((
            survey.place(chosen_time, "time", time.is_some()),
            survey.place(chosen_counts, "counts", counts.is_some()),
        ))
    }
}

/// Returns the best pair of columns for times and counts, if they are not given, out of at least
/// two. If no pair is suitable, returns the first possible one: reading it reports the problem.
fn best(survey: &Survey, time: Option<usize>, counts: Option<usize>) -> (usize, usize) {
    let columns = &survey.columns[..survey.columns.len().min(MOST_LOOKED_THROUGH)];
    let unfit = |time_at: usize, counts_at: usize| {
        let fit_time = time.is_some() || columns[time_at].rises();
        let fit_counts = counts.is_some() || columns[counts_at].whole;
        !(fit_time && fit_counts)
    };
    let mut best = None;
    for time_at in time.map_or(0..columns.len(), |index| index..index + 1) {
        for counts_at in counts.map_or(0..columns.len(), |index| index..index + 1) {
            let given = time.is_some() || counts.is_some();
            if time_at == counts_at || (counts_at < time_at && !given) {
                continue;
            }
            let key = (
                unfit(time_at, counts_at),
                survey.is_index(counts_at),
                survey.is_index(time_at),
                columns[time_at].stands,
                !columns[counts_at].plain,
                counts_at < time_at,
                time_at,
                counts_at,
            );
            if best.is_none_or(|best| key < best) {
                best = Some(key);
            }
        }
    }
    best.map_or((0, 1), |(.., time_at, counts_at)| (time_at, counts_at))
}

#[cfg(test)]
mod tests {
    use super::super::{PositionLog, read};
    use super::*;

    fn with(time: &str, counts: &str) -> Columns {
        let name = |name: &str| (!name.is_empty()).then(|| name.to_owned());
        Columns {
            time: name(time),
            counts: name(counts),
            ..Columns::default()
        }
    }

    fn accept(text: &str, columns: &Columns) -> PositionLog {
        read("l.csv", text.as_bytes(), columns).unwrap_or_else(|fault| panic!("{text:?}: {fault}"))
    }

    fn refuse(text: &str, columns: &Columns) -> String {
        let fault = read("l.csv", text.as_bytes(), columns).unwrap_err();
        fault.to_string()
    }

    #[test]
    fn columns_are_found_by_name_or_number() {
        let text = "left, mode, time, counts\n1, 2, 30, 4\n5, 6, 35, 8\n";
        let read = |columns: &Columns| {
            let log = accept(text, columns);
            let counts: Vec<_> = log.samples.iter().map(|s| s.counts).collect();
            (log.seconds(), counts)
        };
        assert_eq!(read(&Columns::default()), (0.005, vec![4, 8]));
        assert_eq!(read(&with("", "left")), (0.005, vec![1, 5]));
        assert_eq!(read(&with("left", "mode")), (0.004, vec![2, 6]));
        assert_eq!(read(&with("3", "1")), (0.005, vec![1, 5]));
        let seconds = Columns {
            time_unit_s: Some(1.0),
            ..with("", "mode")
        };
        assert_eq!(read(&seconds), (5.0, vec![2, 6]));
        let plain = accept("1,2,3\n4,5,7\n", &with("2", "3"));
        assert_eq!((plain.time.index, plain.counts.index), (1, 2));
        assert_eq!(plain.counts.name, "counts (column 3)");
    }

    #[test]
    fn columns_are_found_by_what_they_have() {
        for (text, time, counts) in [
            // Two columns: times first, unless a name decides otherwise.
            ("1,2\n3,4\n", 0, 1),
            ("0,0\n1,12\n2,30\n", 0, 1),
            ("0,0\n5,1\n10,2\n", 0, 1),
            ("a,b\n1,2\n3,4\n", 0, 1),
            ("b,time\n1,2\n3,4\n", 1, 0),
            ("counts,t\n1,2\n3,4\n", 1, 0),
            // An index beside them, with or without a name.
            (",time,left\n0,7170,0\n1,7175,12\n", 1, 2),
            ("n,time,left\n0,7170,0\n1,7175,12\n", 1, 2),
            ("n,t,left\n0,7170,0\n1,7175,12\n2,7180,11\n", 1, 2),
            (",t,left\n0,7170,0\n1,7175,12\n2,7180,11\n", 1, 2),
            ("0,7170,0\n1,7175,12\n2,7180,11\n", 1, 2),
            ("7170,0,0\n7175,1,12\n7180,2,11\n", 0, 2),
            ("time,n,left\n7170,1,0\n7175,2,12\n", 0, 2),
            // Counts on the right of the times.
            ("left,time,right\n1,7170,3\n5,7175,9\n", 1, 2),
            ("left,time,\n1,7170,3\n5,7175,4\n", 1, 0),
            // Fractions and words are no counts, nor are numbers out of range.
            ("time,mm,left\n1,0.5,3\n2,0.25,4\n", 0, 2),
            ("time,mode,left\n1,on,3\n2,off,4\n", 0, 2),
            ("time,big,left\n1,9999999999,3\n2,1,4\n", 0, 2),
            ("time,gaps,left\n1,,3\n2,1,4\n", 0, 2),
            ("time,mm,left\n1,1.0,3\n2,2.0,9\n", 0, 2),
        ] {
            let log = accept(text, &Columns::default());
            assert_eq!(
                (log.time.index, log.counts.index),
                (time, counts),
                "{text:?}"
            );
        }
        let log = accept("n,time,left\n0,70,0\n1,75,12\n", &Columns::default());
        assert_eq!((log.time.named, log.counts.named), (true, false));
        // Names decide, whatever the column contains.
        let log = accept("counts,time,left\n0,70,0\n1,75,12\n", &Columns::default());
        assert_eq!((log.time.index, log.counts.index), (1, 0));
        let log = accept("n,time,left\n0,70,0\n1,75,12\n", &with("", "n"));
        assert_eq!(log.counts.index, 0);
    }

    #[test]
    fn columns_that_cannot_be_are_refused_by_name() {
        let text = "time,a,b\n1,2,3\n";
        for (text, columns, fault) in [
            (
                text,
                with("", "c"),
                "l.csv:1: c: no such column; allowed: time, a, b",
            ),
            (
                text,
                with("", "4"),
                "l.csv:1: 4: no such column; allowed: time, a, b",
            ),
            (
                text,
                with("", "time"),
                "l.csv:1: time: time is both time and counts; allowed: time, a, b",
            ),
            (
                "1,2\n",
                with("when", ""),
                "l.csv:1: when: no such column; allowed: the numbers of columns, 1 to 2",
            ),
            (
                "1,2\n",
                with("0", ""),
                "l.csv:1: 0: no such column; allowed: the numbers of columns, 1 to 2",
            ),
            (
                ",time\n0,70\n1,75\n",
                Columns::default(),
                "l.csv:1: counts (column 1): has no name and rises by one from line to line: an \
                 index, not counts; allowed: a column of counts",
            ),
            (
                "time,mm\n1,2\n2,2.5\n",
                Columns::default(),
                "l.csv:3: mm: is '2.5'; allowed: a whole number, -2147483648 to 2147483648",
            ),
            (
                "time,mm,left\n1,2.5,1\n2,3.5,2\n",
                with("", "mm"),
                "l.csv:2: mm: is '2.5'; allowed: a whole number, -2147483648 to 2147483648",
            ),
            (
                "t,mm\n1,2\n2,3.5\n",
                Columns::default(),
                "l.csv:3: mm: is '3.5'; allowed: a whole number, -2147483648 to 2147483648",
            ),
            (
                "t,mm,mode\n1,2.5,on\n2,3.5,off\n",
                Columns::default(),
                "l.csv:2: mm: is '2.5'; allowed: a whole number, -2147483648 to 2147483648",
            ),
            (
                "0,5\n9,10\n8,15\n",
                Columns::default(),
                "l.csv:3: time (column 1): 8 falls below line 2; allowed: times that do not fall",
            ),
            (
                "left,right\n1,2\n1,2\n",
                Columns::default(),
                "l.csv: file: 1 sample in it; allowed: a log of 2 samples or more",
            ),
        ] {
            assert_eq!(refuse(text, &columns), fault, "{text:?}");
        }
    }
}
