//! Example of a value for an error.

use super::super::Pair;
use super::super::entry::Entry;
use super::super::reader::Kind;
use super::{changed, elaborate, kind, kinds, read};
use toml::Table;

/// Sizes and lists, of which each name's keys take some.
const SIZES: [i64; 2] = [1, 14];
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
    let all = SIZES.iter().flat_map(|size| LISTS.map(|list| (size, list)));
    let mut examples = all.filter_map(|(size, list)| {
        let tried = Tried {
            entry,
            table: &bare,
            size: *size,
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
    table: &'a Table,
    size: i64,
    list: &'static str,
}

impl Tried<'_> {
    /// Returns the value of a key of this kind, as TOML.
    fn value(&self, path: &str, of: Kind) -> Option<String> {
        Some(match of {
            Kind::Size | Kind::Whole | Kind::Signed => self.size.to_string(),
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
