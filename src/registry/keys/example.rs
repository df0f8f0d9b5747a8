//! Example of a value for an error.

use super::super::Pair;
use super::super::entry::Entry;
use super::super::reader::Kind;
use super::{changed, elaborate, kind, kinds, leaf, names, read};
use toml::{Table, Value};

/// Lists, of which each name's keys take some.
const LISTS: [&str; 3] = ["[]", "[0]", "[0, 0]"];

/// Returns the name that a pair gives to its key, with the keys of this name: values with which the
/// circuit elaborates. `None` if none of those that are tried do.
pub(super) fn of_name(entry: &Entry, table: &Table, pair: &Pair) -> Option<String> {
    let Pair { key, value: name } = pair;
    let with = |inside: &str| Pair::new(key, format!("{{{name}={inside}}}"));
    let bare = changed(entry, table.clone(), &with("{}"));
    let path = format!("{key}.{name}");
    let mut kinds = kinds(entry, &bare).into_iter();
    let (_, of) = kinds.find(|(key, _)| *key == path)?;
    let mut examples = LISTS.into_iter().filter_map(|list| {
        let tried = Tried {
            entry,
            own: table,
            table: &bare,
            list,
        };
        let pair = with(&tried.value(&path, of)?);
        let made = read(entry, &changed(entry, table.clone(), &pair)).ok()?;
        elaborate(&made).ok()?;
        Some(format!("the name with its keys, '{pair}' for instance"))
    });
    examples.next()
}

/// Values that are tried for the keys of a table.
struct Tried<'a> {
    entry: &'a Entry,
    /// Keys of the circuit.
    own: &'a Table,
    /// Keys with the other name.
    table: &'a Table,
    list: &'static str,
}

impl Tried<'_> {
    /// Returns the size of the circuit that is called like a key, or 1.
    fn size(&self, path: &str) -> i64 {
        let last = path.rsplit('.').next();
        let mut names = names(self.entry, self.own).into_iter();
        let like = names.find(|name| name.rsplit('.').next() == last);
        let size = like.and_then(|name| leaf(self.own, &name).and_then(Value::as_integer));
        size.unwrap_or(1)
    }

    /// Returns the value of a key of this kind, as TOML.
    fn value(&self, path: &str, of: Kind) -> Option<String> {
        Some(match of {
            Kind::Size | Kind::Whole | Kind::Signed => self.size(path).to_string(),
            Kind::Flag => "false".to_owned(),
            Kind::Name(names) => format!("\"{}\"", names.first()?),
            Kind::List => self.list.to_owned(),
            Kind::Table(_, fields) => {
                let fields = fields.iter().map(|field| {
                    let path = format!("{path}.{field}");
                    let of = kind(self.entry, self.table, &path)?;
                    Some(format!("{field}={}", self.value(&path, of)?))
                });
                format!("{{{}}}", fields.collect::<Option<Vec<_>>>()?.join(", "))
            }
        })
    }
}
