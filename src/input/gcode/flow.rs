//! Block structure of O-words in a program.

use std::collections::HashMap;

use super::block::line_start;
use super::expression::{Scanner, Values};
use super::problem::Problem;
use super::text::{clean, line_at};

/// Keyword of an O-word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keyword {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
    /// Number of a program: no other keyword follows.
    Program,
}

use Keyword as K;

/// Longer keywords before their prefixes.
const KEYWORDS: [(&str, Keyword); 15] = [
    ("SUB", K::Sub),
    ("ENDSUB", K::EndSub),
    ("CALL", K::Call),
    ("RETURN", K::Return),
    ("IF", K::If),
    ("ELSEIF", K::ElseIf),
    ("ELSE", K::Else),
    ("ENDIF", K::EndIf),
    ("WHILE", K::While),
    ("ENDWHILE", K::EndWhile),
    ("DO", K::Do),
    ("REPEAT", K::Repeat),
    ("ENDREPEAT", K::EndRepeat),
    ("BREAK", K::Break),
    ("CONTINUE", K::Continue),
];

impl Keyword {
    pub(super) fn name(self) -> &'static str {
        let found = KEYWORDS.iter().find(|(_, keyword)| *keyword == self);
        found.map_or("", |(name, _)| name)
    }

    fn opens(self) -> bool {
        matches!(self, K::Sub | K::If | K::While | K::Do | K::Repeat)
    }

    /// True if a block that `self` opens continues or ends with another keyword.
    fn goes_on_with(self, next: Keyword) -> bool {
        match self {
            K::Sub => next == K::EndSub,
            K::If => matches!(next, K::ElseIf | K::Else | K::EndIf),
            K::While => next == K::EndWhile,
            K::Do => next == K::While,
            K::Repeat => next == K::EndRepeat,
            _ => false,
        }
    }

    fn loops(self) -> bool {
        matches!(self, K::While | K::Do | K::Repeat)
    }
}

/// Parses the O-word at the beginning of a cleaned line, if there is one: its label, its keyword,
/// and the rest of the line.
///
/// A label may be computed if values are given.
///
/// # Errors
///
/// Returns an error for an O without a number or a name.
pub(super) fn o_word<'a>(
    line: &'a [u8],
    values: Option<&dyn Values>,
) -> Result<Option<(String, Keyword, Scanner<'a>)>, Problem> {
    if !line.iter().any(|byte| matches!(byte, b'O' | b':')) {
        return Ok(None);
    }
    let mut scanner = Scanner::new(line);
    line_start(&mut scanner)?;
    if !matches!(scanner.next_word(), Some(b'O' | b':')) {
        return Ok(None);
    }
    scanner.bump();
    let label = match scanner.peek() {
        Some(b'<') => format!("<{}>", scanner.angled()?.to_ascii_lowercase()),
        Some(b'0'..=b'9') => {
            let digits = scanner.digits().trim_start_matches('0');
            if digits.is_empty() { "0" } else { digits }.to_owned()
        }
        Some(b'#' | b'[') if values.is_some() => computed(&mut scanner, values)?,
        _ => {
            let problem = "an O-word without a number or name as written";
            return Err(Problem::new("O", problem, "O100 or O<name>"));
        }
    };
    scanner.next_word();
    let rest = scanner.rest();
    // ELSE is a prefix of ELSEIF.
    let longest = KEYWORDS
        .iter()
        .filter(|(name, _)| rest.starts_with(name.as_bytes()))
        .max_by_key(|(name, _)| name.len());
    let keyword = match longest {
        Some(&(name, keyword)) => {
            scanner.take(name);
            keyword
        }
        None => K::Program,
    };
    Ok(Some((label, keyword, scanner)))
}

/// Computes a label from a parameter or an expression. Only calls may have one; other labels are
/// found before there are values.
fn computed(scanner: &mut Scanner<'_>, values: Option<&dyn Values>) -> Result<String, Problem> {
    let value = values.map_or(Ok(0.0), |values| scanner.value(values))?;
    scanner.next_word();
    if !scanner.rest().starts_with(b"CALL") {
        let problem = "an O-word without a number or name as written";
        return Err(Problem::new("O", problem, "O100 or O<name>; O#1 CALL"));
    }
    let whole = value.round();
    if (value - whole).abs() > 1.0e-4 || !(0.0..=1.0e9).contains(&whole) {
        let problem = format!("{value} is no number of a subroutine");
        return Err(Problem::new("O", problem, "a whole number"));
    }
    Ok(format!("{whole}"))
}

/// Line with an O-word.
#[derive(Debug)]
pub(super) struct Place {
    pub(super) keyword: Keyword,
    /// Line, from 1.
    pub(super) line: usize,
    /// Offset of the line.
    pub(super) start: usize,
    /// Offset of the next line.
    pub(super) next: usize,
    /// Continuation of its block: the next branch of an IF, the end of others.
    pub(super) onward: Option<usize>,
    /// First line of its block, or of the loop it leaves.
    pub(super) head: Option<usize>,
    /// Last line of its block.
    pub(super) end: Option<usize>,
}

/// All lines with O-words, in order.
#[derive(Debug, Default)]
pub(super) struct Index {
    pub(super) places: Vec<Place>,
    subs: HashMap<String, usize>,
    programs: HashMap<String, usize>,
}

impl Index {
    /// Indexes a text. Unreadable lines are skipped: they are refused when they are executed.
    pub(super) fn of(text: &[u8]) -> Self {
        let mut index = Index::default();
        let mut open: Vec<(usize, String)> = Vec::new();
        let (mut start, mut line, mut cleaned) = (0, 0, Vec::new());
        while let Some((bytes, next)) = line_at(text, start) {
            line += 1;
            let first = bytes.trim_ascii_start().first();
            if matches!(first, Some(b'o' | b'O' | b':' | b'n' | b'N' | b'/'))
                && clean(bytes, &mut cleaned).is_ok()
                && let Ok(Some((label, keyword, _))) = o_word(&cleaned, None)
            {
                index.add(&mut open, label, keyword, (line, start, next));
            }
            start = next;
        }
        index
    }

    fn add(
        &mut self,
        open: &mut Vec<(usize, String)>,
        label: String,
        keyword: Keyword,
        (line, start, next): (usize, usize, usize),
    ) {
        let here = self.places.len();
        let mut place = Place {
            keyword,
            line,
            start,
            next,
            onward: None,
            head: None,
            end: None,
        };
        let keyword_of = |places: &[Place], at: usize| places.get(at).map(|place| place.keyword);
        let continued = open.iter().rposition(|(at, of)| {
            *of == label
                && keyword_of(&self.places, *at).is_some_and(|head| head.goes_on_with(keyword))
        });
        if let Some(depth) = continued {
            let head = open.get(depth).map_or(here, |(head, _)| *head);
            let ends = !matches!(keyword, K::ElseIf | K::Else);
            place.head = Some(head);
            // Every branch of the block refers to the next one, and to the end.
            let mut at = Some(head);
            while let Some(branch) = at.and_then(|at| self.places.get_mut(at)) {
                at = branch.onward;
                branch.onward.get_or_insert(here);
                if ends {
                    branch.end = Some(here);
                }
            }
            if ends {
                place.end = Some(here);
                open.truncate(depth);
            } else {
                open.truncate(depth + 1);
            }
        } else if keyword.opens() {
            place.head = Some(here);
            if keyword == K::Sub {
                self.subs.entry(label.clone()).or_insert(here);
            }
            open.push((here, label));
        } else if keyword == K::Program {
            self.programs.entry(label).or_insert(here);
        } else if matches!(keyword, K::Break | K::Continue) {
            let found = open.iter().rfind(|(at, of)| {
                *of == label && keyword_of(&self.places, *at).is_some_and(Keyword::loops)
            });
            place.head = found.map(|(at, _)| *at);
        }
        self.places.push(place);
    }

    /// Returns the O-word in the line at an offset.
    pub(super) fn at(&self, start: usize) -> Option<usize> {
        self.places
            .binary_search_by_key(&start, |place| place.start)
            .ok()
    }

    /// True if there is a SUB.
    pub(super) fn has_subs(&self) -> bool {
        !self.subs.is_empty()
    }

    /// Returns the SUB of a label.
    pub(super) fn sub(&self, label: &str) -> Option<usize> {
        self.subs.get(label).copied()
    }

    /// Returns the program of a number.
    pub(super) fn program(&self, label: &str) -> Option<usize> {
        self.programs.get(label).copied()
    }
}
