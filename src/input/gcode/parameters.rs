//! Parameters that a program sets, by number and by name.

use std::collections::HashMap;

use super::expression::Name;
use super::problem::Problem;

/// Greatest number of a parameter.
const LARGEST: u32 = 5602;

/// Number of parameters that are local to a call: `#1` to `#30`.
pub(super) const LOCALS: usize = 30;

/// Parameters of reference points and offsets, which the machine maintains.
const OFFSETS: std::ops::RangeInclusive<u32> = 5161..=5390;

/// Parameters of the program and of its active calls.
#[derive(Debug)]
pub(super) struct Parameters {
    globals: HashMap<u32, f64>,
    named: HashMap<String, f64>,
    /// Scopes; the last one is current.
    scopes: Vec<Scope>,
}

/// Parameters local to a call.
#[derive(Debug, Default)]
struct Scope {
    numbers: [f64; LOCALS],
    named: HashMap<String, f64>,
}

impl Parameters {
    pub(super) fn new() -> Self {
        Self {
            globals: HashMap::new(),
            named: ["_VALUE", "_VALUE_RETURNED"]
                .map(|name| (name.to_owned(), 0.0))
                .into(),
            scopes: vec![Scope::default()],
        }
    }

    /// Enters a call with its arguments.
    pub(super) fn enter(&mut self, arguments: &[f64]) {
        let mut scope = Scope::default();
        for (place, value) in scope.numbers.iter_mut().zip(arguments) {
            *place = *value;
        }
        self.scopes.push(scope);
    }

    pub(super) fn leave(&mut self) {
        self.scopes.pop();
    }

    /// Returns the value of a parameter; a number that was never set is 0.
    pub(super) fn get(&self, name: &Name) -> Result<Option<f64>, Problem> {
        let scope = self.scopes.last();
        match name {
            Name::Number(number @ 1..=30) => {
                let value = scope.and_then(|scope| scope.numbers.get(*number as usize - 1));
                Ok(value.copied())
            }
            Name::Number(number) if *number <= LARGEST => {
                Ok(Some(self.globals.get(number).copied().unwrap_or(0.0)))
            }
            Name::Number(_) => {
                let allowed = format!("1 to {LARGEST}");
                Err(Problem::new(name.to_string(), "no such parameter", allowed))
            }
            Name::Text(text) if text.starts_with('_') => Ok(self.named.get(text).copied()),
            Name::Text(text) => Ok(scope.and_then(|scope| scope.named.get(text)).copied()),
        }
    }

    pub(super) fn set(&mut self, name: Name, value: f64) -> Result<(), Problem> {
        let scope = self.scopes.last_mut();
        match name {
            Name::Number(number @ 1..=30) => {
                let place = scope.and_then(|scope| scope.numbers.get_mut(number as usize - 1));
                if let Some(place) = place {
                    *place = value;
                }
            }
            Name::Number(number) if OFFSETS.contains(&number) => {
                let (problem, allowed) = ("sets an offset", "G10, G28.1, G30.1 or G92");
                return Err(Problem::new(name.to_string(), problem, allowed));
            }
            Name::Number(number) if number <= LARGEST => {
                self.globals.insert(number, value);
            }
            Name::Number(_) => {
                let allowed = format!("1 to {LARGEST}");
                return Err(Problem::new(name.to_string(), "no such parameter", allowed));
            }
            Name::Text(text) if text.starts_with('_') => {
                self.named.insert(text, value);
            }
            Name::Text(text) => {
                if let Some(scope) = scope {
                    scope.named.insert(text, value);
                }
            }
        }
        Ok(())
    }
}
