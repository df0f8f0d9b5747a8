//! Lookup of signals and scopes by the end of their path.

use super::names::{element, listed};
use super::wave::Wave;

/// Name that ends more than one path.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Ambiguous {
    pub name: String,
    pub paths: Vec<String>,
}

impl Ambiguous {
    /// Returns the problem, and the allowed names.
    pub fn message(&self, what: &str) -> (String, String) {
        let Ambiguous { name, paths } = self;
        (
            format!("{} {what}s are called {name}", paths.len()),
            format!(
                "more of its path, so that it is one of {}",
                listed(&paths[..])
            ),
        )
    }
}

impl Wave {
    /// Returns the variable with this path, or the only one whose path ends with it. Aliases count
    /// as one.
    pub fn by_end(&self, name: &str) -> Result<Option<usize>, Ambiguous> {
        if let Some(exact) = self.find(name) {
            return Ok(Some(exact));
        }
        let ending = format!(".{}", element(name));
        // Only a word of a memory has another form.
        let word = ending.ends_with(']');
        let ends = |path: &str| match word {
            true => element(path).ends_with(&ending),
            false => path.ends_with(&ending),
        };
        let mut found: Vec<usize> = Vec::new();
        for (index, variable) in self.variables.iter().enumerate() {
            let alias = |&other: &usize| self.variables[other].signal == variable.signal;
            if ends(&variable.path) && !found.iter().any(alias) {
                found.push(index);
            }
        }
        match found[..] {
            [] => Ok(None),
            [one] => Ok(Some(one)),
            _ => Err(Ambiguous {
                name: name.to_owned(),
                paths: found
                    .iter()
                    .map(|&index| self.variables[index].path.clone())
                    .collect(),
            }),
        }
    }

    /// Returns the scope with this path, or the only one whose path ends with it.
    pub fn scope_by_end(&self, name: &str) -> Result<Option<String>, Ambiguous> {
        if self.has_scope(name) {
            return Ok(Some(name.to_owned()));
        }
        let ending = format!(".{name}");
        let mut found: Vec<String> = Vec::new();
        for variable in &self.variables {
            for (place, _) in variable.path.match_indices(&ending) {
                let (scope, rest) = variable.path.split_at(place + ending.len());
                if rest.starts_with(['.', '[']) && !found.iter().any(|one| one == scope) {
                    found.push(scope.to_owned());
                }
            }
        }
        match found.len() {
            0 | 1 => Ok(found.pop()),
            _ => Err(Ambiguous {
                name: name.to_owned(),
                paths: found,
            }),
        }
    }
}
