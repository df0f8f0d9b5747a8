//! Structs of settings that read themselves, written once: type, default, range and meaning of each
//! field.

use super::key::{Defaults, Key, Read, Value};
use super::renamed::renamed;
use super::{Place, SettingError, within};
use crate::nearest::{self, nearest};
use serde::de::{self, DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use std::fmt::{self, Display};
use std::marker::PhantomData;
use std::ops::RangeInclusive;

/// Names of axes for errors.
const AXIS_NAMES: [&str; 4] = ["x", "y", "z", "w"];

/// A struct of settings, as the macro `settings!` makes it.
pub trait Table: Sized {
    /// Its keys: its own, then those of each group.
    const KEYS: &'static [&'static [Key]];

    /// Returns the settings without any key given; a required key has an arbitrary value.
    fn initial() -> Self;

    /// Reads the value of one of its keys.
    ///
    /// # Errors
    /// The value has another type.
    fn set<'de, A: MapAccess<'de>>(&mut self, key: &str, from: &mut A) -> Result<(), A::Error>;
}

/// Makes structs of settings.
///
/// A field has a type that is a [`Value`], a default, and then what holds of it: `in` a range that
/// [`ranges`] checks, `within` a range that other settings narrow and that [`ranges`] leaves to the
/// job, or a text. `as` gives the key another name. `[required]`: a table must have it. The fields
/// of `flat` are structs of settings of which the keys stand beside the others; those of `beside`
/// have no keys. `default` is what [`Default`] gives, if it is not the defaults of the keys.
///
/// [`ranges`]: crate::scenario::Run::ranges
macro_rules! settings {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident {
            $(
                $(#[doc = $doc:literal])+
                pub $field:ident $(as $key:literal)? $([$required:ident])? : $type:ty = $default:expr
                    $(, in $range:expr)? $(, within $widest:expr)? $(, $allowed:literal)?;
            )*
        }
        $(flat {
            $(
                $(#[doc = $group_doc:literal])+
                pub $group:ident: $group_type:ty = $group_default:expr;
            )*
        })?
        $(beside {
            $(
                $(#[doc = $beside_doc:literal])+
                pub $beside:ident: $beside_type:ty = $beside_default:expr;
            )*
        })?
        $(default $whole:block)?
    ) => {
        $(#[$attribute])*
        #[derive(Debug, Clone, PartialEq, serde::Serialize)]
        pub struct $name {
            $($(#[doc = $doc])+ $(#[serde(rename = $key)])? pub $field: $type,)*
            $($($(#[doc = $group_doc])+ #[serde(flatten)] pub $group: $group_type,)*)?
            $($($(#[doc = $beside_doc])+ #[serde(skip)] pub $beside: $beside_type,)*)?
        }

        impl Default for $name {
            fn default() -> Self {
                $crate::settings::optional!(
                    <$name as $crate::settings::Table>::initial() $(, $whole)?
                )
            }
        }

        impl $name {
            /// Checks every range that depends on no other setting.
            ///
            /// # Errors
            /// Names the first field outside its range, its value and the range.
            pub fn ranges(&self) -> Result<(), $crate::settings::SettingError> {
                $(
                    let _key = $crate::settings::optional!(stringify!($field) $(, $key)?);
                    $($crate::settings::Within::check(&self.$field, _key, &$range)?;)?
                )*
                $($(self.$group.ranges()?;)*)?
                Ok(())
            }
        }

        impl $crate::settings::Table for $name {
            const KEYS: &'static [&'static [$crate::settings::Key]] = &[
                &[$($crate::settings::Key {
                    name: $crate::settings::optional!(stringify!($field) $(, $key)?),
                    about: concat!($($doc),+),
                    required: $crate::settings::optional!(false $(, { stringify!($required); true })?),
                    shape: <$type as $crate::settings::Value>::SHAPE,
                    range: $crate::settings::optional!(None $(, Some(|| {
                        let range = $range;
                        [range.start().to_string(), range.end().to_string()]
                    }))?),
                    widest: $crate::settings::optional!(None $(, Some(|| {
                        let range = $widest;
                        [range.start().to_string(), range.end().to_string()]
                    }))?),
                    allowed: $crate::settings::optional!(None $(, Some($allowed))?),
                }),*],
                $($(&$crate::settings::beside::<
                    { <$group_type as $crate::settings::Table>::KEYS[0].len() },
                >(<$group_type as $crate::settings::Table>::KEYS[0]),)*)?
            ];

            fn initial() -> Self {
                $name {
                    $($field: $default,)*
                    $($($group: $group_default,)*)?
                    $($($beside: $beside_default,)*)?
                }
            }

            fn set<'de, A: serde::de::MapAccess<'de>>(
                &mut self,
                key: &str,
                from: &mut A,
            ) -> Result<(), A::Error> {
                $(if key == $crate::settings::optional!(stringify!($field) $(, $key)?) {
                    self.$field = $crate::settings::next(from)?;
                    return Ok(());
                })*
                $($(if $crate::settings::has::<$group_type>(key) {
                    return self.$group.set(key, from);
                })*)?
                Ok(())
            }
        }

        impl $crate::settings::Value for $name {
            const SHAPE: $crate::settings::Shape = $crate::settings::Shape::Table(
                <$name as $crate::settings::Table>::KEYS,
                $crate::settings::defaults::<$name>,
            );

            fn read<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                $crate::settings::read_table(from)
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                $crate::settings::read_table(from)
            }
        }
    };
}
pub(crate) use settings;

/// The last of one or two expressions.
macro_rules! optional {
    ($without:expr) => {
        $without
    };
    ($without:expr, $with:expr) => {
        $with
    };
}
pub(crate) use optional;

/// A value, or values, that a range is for.
pub trait Within<T> {
    /// Checks that all are in the range.
    ///
    /// # Errors
    /// Names the setting, the first value outside, and the range.
    fn check(&self, field: &'static str, allowed: &RangeInclusive<T>) -> Result<(), SettingError>;
}

impl<T: PartialOrd + Display + Copy> Within<T> for T {
    fn check(&self, field: &'static str, allowed: &RangeInclusive<T>) -> Result<(), SettingError> {
        within(field, *self, allowed)
    }
}

impl<T: PartialOrd + Display + Copy> Within<T> for Option<T> {
    fn check(&self, field: &'static str, allowed: &RangeInclusive<T>) -> Result<(), SettingError> {
        self.map_or(Ok(()), |value| within(field, value, allowed))
    }
}

impl<T: PartialOrd + Display + Copy, const N: usize> Within<T> for Option<[T; N]> {
    fn check(&self, field: &'static str, allowed: &RangeInclusive<T>) -> Result<(), SettingError> {
        self.map_or(Ok(()), |values| values.check(field, allowed))
    }
}

impl<T: PartialOrd + Display + Copy, const N: usize> Within<T> for [T; N] {
    fn check(&self, field: &'static str, allowed: &RangeInclusive<T>) -> Result<(), SettingError> {
        self.iter().zip(AXIS_NAMES).try_for_each(|(value, axis)| {
            within(field, *value, allowed).map_err(|error| error.at(Place::Element(axis)))
        })
    }
}

/// The keys of a group, none of which is required: a group has defaults.
pub(crate) const fn beside<const N: usize>(keys: &[Key]) -> [Key; N] {
    let mut all = [keys[0]; N];
    let mut index = 0;
    while index < N {
        all[index] = Key {
            required: false,
            ..keys[index]
        };
        index += 1;
    }
    all
}

/// True if a struct has a key.
pub(crate) fn has<T: Table>(key: &str) -> bool {
    T::KEYS.iter().copied().flatten().any(|own| own.name == key)
}

/// Returns the defaults of a struct.
pub(crate) fn defaults<T: Table + serde::Serialize>() -> Defaults {
    Defaults(toml::Table::try_from(T::initial()).unwrap_or_default())
}

/// Reads the next value of a map.
pub(crate) fn next<'de, T: Value, A: MapAccess<'de>>(from: &mut A) -> Result<T, A::Error> {
    from.next_value().map(|Read(value)| value)
}

/// Reads a struct of settings that is a table of its own.
pub(crate) fn read_table<'de, T: Table, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
    from.deserialize_map(Keys(PhantomData))
}

struct Keys<T>(PhantomData<T>);

impl<'de, T: Table> Visitor<'de> for Keys<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a table of keys and values")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<T, A::Error> {
        let mut table = T::initial();
        let keys: Vec<_> = T::KEYS.iter().copied().flatten().collect();
        let names = || keys.iter().map(|key| key.name);
        let unknown = |key: &str| {
            let allowed: Vec<_> = names().map(|name| format!("`{name}`")).collect();
            let allowed = format!("one of {}", allowed.join(", "));
            unknown(key, names(), "unknown key", &allowed)
        };
        read_keys(&mut map, &keys, &unknown, |key, map| table.set(key, map))?;
        Ok(table)
    }
}

/// Tells that a key is unknown, as `problem; allowed: …`: another name of the same setting, or else
/// the nearest name and what is allowed.
pub(crate) fn unknown<'a>(
    key: &str,
    names: impl Iterator<Item = &'a str> + Clone,
    problem: &str,
    others: &str,
) -> String {
    if let Some(new) = renamed(key).filter(|new| names.clone().any(|name| name == new.name)) {
        let (name, unit, factor) = (new.name, new.unit, new.factor);
        return format!(
            "the key is called {name}, in {unit}: {factor} times the number{ALLOWED}{name}"
        );
    }
    // A letter or two stand in too many names.
    let part = || {
        names
            .clone()
            .find(|name| key.len() > 2 && name.contains(key))
    };
    // What is as long as that is no key, and comparing it takes long.
    let near = match key.len() {
        ..=LONGEST_KEY => nearest(key, names.clone()).or_else(part),
        _ => None,
    };
    format!("{problem}{}{ALLOWED}{others}", nearest::meant(near))
}

/// Longest key, in bytes, for which the nearest name is looked for.
const LONGEST_KEY: usize = 100;

/// Separator of problem and allowed values in an error of a key reader.
pub(crate) const ALLOWED: &str = "; allowed: ";

/// Reads keys and has `set` read their values. `unknown` tells what is wrong with another key.
pub(crate) fn read_keys<'de, A: MapAccess<'de>>(
    map: &mut A,
    keys: &[&'static Key],
    unknown: &dyn Fn(&str) -> String,
    mut set: impl FnMut(&'static str, &mut A) -> Result<(), A::Error>,
) -> Result<(), A::Error> {
    let mut given = Vec::new();
    while let Some(name) = map.next_key_seed(Name { keys, unknown })? {
        set(name, map)?;
        given.push(name);
    }
    let missing = keys
        .iter()
        .find(|key| key.required && !given.contains(&key.name));
    missing.map_or(Ok(()), |key| Err(A::Error::missing_field(key.name)))
}

/// The name of a key, one of those that there are.
struct Name<'a> {
    keys: &'a [&'static Key],
    unknown: &'a dyn Fn(&str) -> String,
}

impl<'de> DeserializeSeed<'de> for Name<'_> {
    type Value = &'static str;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<&'static str, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Name<'_> {
    type Value = &'static str;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a key")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<&'static str, E> {
        let key = self.keys.iter().find(|key| key.name == name);
        key.map_or_else(|| Err(E::custom((self.unknown)(name))), |key| Ok(key.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::rows;

    settings! {
        /// A group.
        pub struct Group {
            /// Depth.
            pub depth_mm [required]: f64 = 3.0, in 0.0..=5.0;
        }
    }

    settings! {
        /// A struct with fields of every sort.
        pub struct Every {
            /// Count of things,
            /// on two lines.
            pub count as "number" [required]: u32 = 0, in 2..=9, "even";
            /// Sizes of both axes.
            pub size_mm: [f64; 2] = [1.0, 2.0], in 0.5..=8.0;
            /// Name.
            pub name: Option<String> = None;
        }
        flat {
            /// Group.
            pub group: Group = Group { depth_mm: 4.0 };
        }
        beside {
            /// Notes.
            pub notes: Vec<u8> = vec![7];
        }
        default {
            Every { count: 6, ..Table::initial() }
        }
    }

    fn read(text: &str) -> Result<Every, String> {
        toml::from_str(text).map_err(|error: toml::de::Error| error.message().to_owned())
    }

    #[test]
    fn fields_groups_and_what_has_no_key_are_read() {
        let every = read("number = 4\nsize_mm = [5, 6]\ndepth_mm = 1.5\nname = 'a'").unwrap();
        assert_eq!((every.count, every.size_mm), (4, [5.0, 6.0]));
        assert_eq!(
            (every.group.depth_mm, every.name.as_deref()),
            (1.5, Some("a"))
        );
        assert_eq!(every.notes, [7]);
        let least = read("number = 4").unwrap();
        let expected = Every {
            count: 4,
            ..Every::default()
        };
        assert_eq!((least, Every::default().count), (expected, 6));
        // The written text reads back as the same settings.
        let text = toml::to_string(&every).unwrap();
        assert_eq!(read(&text), Ok(every), "{text}");
    }

    #[test]
    fn what_cannot_be_read_is_said() {
        let refusal = |text: &str| read(text).unwrap_err();
        assert_eq!(refusal(""), "missing field `number`");
        assert_eq!(
            refusal("number = 4\ndepth = 1"),
            "unknown key; did you mean depth_mm?; allowed: one of `number`, `size_mm`, `name`, \
             `depth_mm`"
        );
        assert!(refusal("number = 4\ncount = 4").starts_with("unknown key; allowed: "));
        assert!(refusal("number = 4\nnotes = [1]").starts_with("unknown key; allowed: "));
        for list in ["[1]", "[1, 2, 3]"] {
            let text = format!("number = 4\nsize_mm = {list}");
            assert!(
                refusal(&text).ends_with("expected an array of length 2"),
                "{list}"
            );
        }
    }

    #[test]
    fn ranges_are_checked_by_their_keys() {
        let check = |change: fn(&mut Every)| {
            let mut every = Every::default();
            change(&mut every);
            every.ranges().map_err(|error| error.to_string())
        };
        assert_eq!(check(|_| ()), Ok(()));
        let refusal = |change| check(change).unwrap_err();
        assert_eq!(
            refusal(|every| every.count = 1),
            "number: is 1; allowed: 2 to 9"
        );
        assert_eq!(
            refusal(|every| every.count = 10),
            "number: is 10; allowed: 2 to 9"
        );
        let size = refusal(|every| every.size_mm[1] = f64::NAN);
        assert_eq!(size, "size_mm: is NaN for y; allowed: 0.5 to 8");
        let depth = refusal(|every| every.group.depth_mm = -0.1);
        assert_eq!(depth, "depth_mm: is -0.1; allowed: 0 to 5");
    }

    #[test]
    fn keys_are_listed_with_what_holds_of_them() {
        let keys: Vec<_> = Every::KEYS.iter().copied().flatten().collect();
        let rows = rows(&keys, &defaults::<Every>());
        let texts = rows.iter().map(|row| {
            [
                &row.key,
                &row.kind,
                row.unit,
                &row.default,
                &row.range,
                &row.about,
            ]
            .join("|")
        });
        assert_eq!(
            texts.collect::<Vec<_>>(),
            [
                "number|whole number||required|2 to 9; even|Count of things, on two lines.",
                "size_mm|list of 2 numbers|mm|[1.0, 2.0]|0.5 to 8|Sizes of both axes.",
                "name|text||none||Name.",
                "depth_mm|number|mm|4.0|0 to 5|Depth.",
            ]
        );
    }
}
