//! Rust source, read as far as its paths need.

/// Tokens of a source file: names, and single characters of everything else that is code.
pub struct Code(Vec<(usize, Token)>);

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Name(String),
    Sign(char),
}

/// Module that a path names.
#[derive(Debug, PartialEq)]
pub struct Named {
    /// Line of the name, from 1.
    pub line: usize,
    /// Module of the crate that the path stands in.
    pub from: String,
    /// Name at the root of the crate.
    pub to: String,
}

/// Returns the path of the module that a file is: `src/a/mod.rs` is `a`, `src/a/b.rs` is `a::b`.
pub fn module_of(file: &str) -> Vec<String> {
    let inside = file.trim_start_matches("src/").trim_end_matches(".rs");
    let names = inside.trim_end_matches("/mod").split('/');
    names.map(str::to_owned).collect()
}

/// Returns the length of a string or character at the start of a text, if there is one.
fn literal(text: &str) -> Option<usize> {
    let quoted = |from: usize, mark: char| {
        let mut escaped = false;
        let end = text[from..].find(|c: char| {
            let ends = c == mark && !escaped;
            escaped = c == '\\' && !escaped;
            ends
        });
        end.map_or(text.len(), |end| from + end + 1)
    };
    let raw = text.strip_prefix('b').unwrap_or(text);
    if let Some(hashes) = raw.strip_prefix('r') {
        let count = hashes.len() - hashes.trim_start_matches('#').len();
        if hashes[count..].starts_with('"') {
            let end = format!("\"{}", "#".repeat(count));
            let from = text.len() - hashes.len() + count + 1;
            return Some(
                text[from..]
                    .find(&end)
                    .map_or(text.len(), |at| from + at + end.len()),
            );
        }
    }
    let from = text.len() - raw.len() + 1;
    if raw.starts_with('"') {
        return Some(quoted(from, '"'));
    }
    // A quote that is no character begins a lifetime.
    let mut chars = raw.strip_prefix('\'')?.chars();
    match (chars.next()?, chars.next()?) {
        ('\\', _) | (_, '\'') => Some(quoted(from, '\'')),
        _ => None,
    }
}

/// Returns the length of a comment at the start of a text, if there is one.
fn comment(text: &str) -> Option<usize> {
    if text.starts_with("//") {
        return Some(text.find('\n').unwrap_or(text.len()));
    }
    text.strip_prefix("/*")?;
    let (mut depth, mut at) = (0, 0);
    while at < text.len() {
        let rest = &text[at..];
        if rest.starts_with("/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if rest.starts_with("*/") {
            (depth, at) = (depth - 1, at + 2);
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
        if depth == 0 {
            break;
        }
    }
    Some(at)
}

impl Code {
    /// Reads a source file.
    pub fn of(text: &str) -> Self {
        let (mut tokens, mut line, mut rest) = (Vec::new(), 1, text);
        let is_name = |c: char| c.is_alphanumeric() || c == '_';
        while let Some(first) = rest.chars().next() {
            let length = match comment(rest).or_else(|| literal(rest)) {
                Some(length) => length,
                None if is_name(first) => {
                    let length = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
                    tokens.push((line, Token::Name(rest[..length].to_owned())));
                    length
                }
                None => {
                    if !first.is_whitespace() {
                        tokens.push((line, Token::Sign(first)));
                    }
                    first.len_utf8()
                }
            };
            line += rest[..length].matches('\n').count();
            rest = &rest[length..];
        }
        Code(tokens)
    }

    fn name(&self, at: usize) -> Option<&str> {
        match self.0.get(at) {
            Some((_, Token::Name(name))) => Some(name),
            _ => None,
        }
    }

    fn is(&self, at: usize, signs: &str) -> bool {
        let mut signs = signs.chars().enumerate();
        signs.all(|(k, sign)| matches!(self.0.get(at + k), Some((_, Token::Sign(c))) if *c == sign))
    }

    /// Returns the names of the macros that the file puts at the root of the crate.
    pub fn exported_macros(&self) -> Vec<String> {
        let mut macros = Vec::new();
        let mut exported = false;
        for at in 0..self.0.len() {
            exported |= self.name(at) == Some("macro_export");
            if self.name(at) == Some("macro_rules") && std::mem::take(&mut exported) {
                macros.extend(self.name(at + 2).map(str::to_owned));
            }
        }
        macros
    }

    /// Returns what paths of the file, a module `file`, name at the root of the crate.
    pub fn paths(&self, file: &[String]) -> Vec<Named> {
        let mut paths = Vec::new();
        // Modules within the file that are open, and the braces around each.
        let (mut inner, mut depth): (Vec<usize>, usize) = (Vec::new(), 0);
        let mut at = 0;
        while at < self.0.len() {
            if self.name(at) == Some("mod") && self.is(at + 2, "{") {
                inner.push(depth);
                (depth, at) = (depth + 1, at + 3);
                continue;
            }
            depth += usize::from(self.is(at, "{"));
            if self.is(at, "}") {
                depth = depth.saturating_sub(1);
                inner.pop_if(|around| *around == depth);
            }
            let mut left = file.len() + inner.len();
            let mut end = at;
            while self.name(end) == Some("super") && self.is(end + 1, "::") {
                (left, end) = (left.saturating_sub(1), end + 3);
            }
            if self.name(end) == Some("crate") && self.is(end + 1, "::") {
                (left, end) = (0, end + 3);
            }
            if end == at {
                at += 1;
                continue;
            }
            if left == 0 {
                let named = self.firsts(end);
                paths.extend(named.into_iter().map(|at| Named {
                    line: self.0[at].0,
                    from: file[0].clone(),
                    to: self.name(at).unwrap_or_default().to_owned(),
                }));
            }
            at = end;
        }
        paths
    }

    /// Returns the first names of what stands at the end of a path: a name, or a list in braces.
    fn firsts(&self, at: usize) -> Vec<usize> {
        if !self.is(at, "{") {
            return self.name(at).map(|_| at).into_iter().collect();
        }
        let (mut firsts, mut depth, mut at) = (Vec::new(), 0, at);
        loop {
            let opens = self.is(at, "{");
            depth += usize::from(opens);
            if (opens || self.is(at, ",")) && depth == 1 && self.name(at + 1).is_some() {
                firsts.push(at + 1);
            }
            depth -= usize::from(self.is(at, "}"));
            at += 1;
            if depth == 0 || at >= self.0.len() {
                return firsts;
            }
        }
    }
}
