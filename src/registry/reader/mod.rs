//! Reads a circuit from a table of its keys, and tells what each key takes.

mod kind;
mod misread;

pub(super) use kind::Kind;
pub(super) use misread::Misread;

use crate::settings::unread;
use serde::de::value::StrDeserializer;
use serde::de::{self, DeserializeSeed, Deserializer, Expected, Unexpected, Visitor};
use std::cell::RefCell;
use toml::{Table, Value};

/// Kinds of the keys that were read, in the order of reading; a name with keys inside stands before them.
pub(super) type Kinds = RefCell<Vec<(String, Kind)>>;

/// Reads the value of a key. Made for circuits: each type calls only the function of its own kind, and
/// all circuits share this one reader, which keeps the catalogue cheap to build.
pub(super) struct Reader<'a> {
    value: &'a Value,
    /// Dotted key; empty for the table of all.
    key: String,
    kinds: &'a Kinds,
}

/// The value of a circuit of type `T` by its table.
///
/// # Errors
/// The first key that is unknown, or whose value it does not take.
pub(super) fn read<T: de::DeserializeOwned>(table: &Table, kinds: &Kinds) -> Result<T, Misread> {
    let value = Value::Table(table.clone());
    T::deserialize(Reader {
        value: &value,
        key: String::new(),
        kinds,
    })
}

impl<'a> Reader<'a> {
    fn below(&self, name: &str, value: &'a Value) -> Reader<'a> {
        let key = match self.key.as_str() {
            "" => name.to_owned(),
            key => format!("{key}.{name}"),
        };
        Reader {
            value,
            key,
            kinds: self.kinds,
        }
    }

    fn is(&self, kind: Kind) {
        self.kinds.borrow_mut().push((self.key.clone(), kind));
    }

    /// Names the key of an error that comes from its value.
    fn named<T>(key: &str, read: Result<T, Misread>) -> Result<T, Misread> {
        read.map_err(|mut error| {
            if error.key.is_empty() {
                error.key = key.to_owned();
            }
            error
        })
    }

    fn not<T>(&self, kind: Kind) -> Result<T, Misread> {
        let given = match self.value {
            Value::String(text) => Unexpected::Str(text),
            Value::Integer(number) => Unexpected::Signed(*number),
            Value::Float(number) => Unexpected::Float(*number),
            Value::Boolean(flag) => Unexpected::Bool(*flag),
            Value::Datetime(_) => Unexpected::Other("datetime"),
            Value::Array(_) => Unexpected::Seq,
            Value::Table(_) => Unexpected::Map,
        };
        let unread = self.value.as_str().and_then(unread);
        let misread = match (kind, unread) {
            (Kind::Name(_), _) => Misread::new(format!("is {}", self.value), kind.to_string()),
            (_, Some(problem)) => Misread::new(problem, kind.most()),
            (_, None) => Misread::new(format!("invalid type: {given}"), kind.to_string()),
        };
        Self::named(&self.key, Err(misread))
    }

    fn whole<'de, V: Visitor<'de>>(self, visitor: V, kind: Kind) -> Result<V::Value, Misread> {
        self.is(kind);
        match self.value {
            Value::Integer(number) => {
                let read = match u64::try_from(*number) {
                    Ok(number) => visitor.visit_u64(number),
                    Err(_) => visitor.visit_i64(*number),
                };
                let read = read.map_err(|mut error: Misread| {
                    error.allowed = kind.to_string();
                    error
                });
                Self::named(&self.key, read)
            }
            _ => self.not(kind),
        }
    }

    fn fields<'de, V: Visitor<'de>>(
        self,
        of: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misread> {
        let kind = Kind::Table(of, fields);
        self.is(kind);
        match self.value {
            Value::Table(table) => {
                let entries = Entries {
                    entries: table.iter(),
                    entry: None,
                    reader: &self,
                };
                Self::named(&self.key, visitor.visit_map(entries))
            }
            _ => self.not(kind),
        }
    }
}

/// Kinds of values that no circuit has.
macro_rules! no_kind {
    ($($name:ident $(($extra:ty))?)*) => { $(
        fn $name<V: Visitor<'de>>(self, $(_: $extra,)? _: V) -> Result<V::Value, Misread> {
            Self::named(&self.key, Err(de::Error::custom("no kind of a circuit's key")))
        }
    )* };
}

impl<'de> Deserializer<'de> for Reader<'_> {
    type Error = Misread;

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        self.is(Kind::Flag);
        match self.value {
            Value::Boolean(flag) => visitor.visit_bool(*flag),
            _ => self.not(Kind::Flag),
        }
    }

    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        self.whole(visitor, Kind::Whole)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        // `usize` comes here too; all sizes have that type.
        let kind = match (&visitor as &dyn Expected).to_string().as_str() {
            "usize" => Kind::Size,
            _ => Kind::Whole,
        };
        self.whole(visitor, kind)
    }

    fn deserialize_i64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        self.whole(visitor, Kind::Signed)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Misread> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        self.is(Kind::List);
        match self.value {
            Value::Array(values) => {
                let elements = Elements {
                    values: values.iter().enumerate(),
                    reader: &self,
                };
                Self::named(&self.key, visitor.visit_seq(elements))
            }
            _ => self.not(Kind::List),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Misread> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        of: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misread> {
        self.fields(of, fields, visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        of: &'static str,
        names: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misread> {
        let kind = Kind::Name(names);
        self.is(kind);
        let (name, inside) = match self.value {
            Value::String(name) => (name, None),
            Value::Table(table) if table.len() == 1 => match table.iter().next() {
                Some((name, inside)) => (name, Some(self.below(name, inside))),
                None => return self.not(kind),
            },
            _ => return self.not(kind),
        };
        let variant = Variant { of, name, inside };
        Self::named(&self.key, visitor.visit_enum(variant))
    }

    no_kind! {
        deserialize_any deserialize_i8 deserialize_i16 deserialize_i32 deserialize_u8 deserialize_u16
        deserialize_f32 deserialize_f64 deserialize_char deserialize_str deserialize_string
        deserialize_bytes deserialize_byte_buf deserialize_unit deserialize_unit_struct(&'static str)
        deserialize_map deserialize_identifier deserialize_ignored_any
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Misread> {
        self.deserialize_seq(visitor)
    }
}

/// Keys and values of a table.
struct Entries<'a, 'r> {
    entries: toml::map::Iter<'a, String, Value>,
    entry: Option<(&'a str, &'a Value)>,
    reader: &'r Reader<'a>,
}

impl<'de> de::MapAccess<'de> for Entries<'_, '_> {
    type Error = Misread;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Misread> {
        self.entry = self
            .entries
            .next()
            .map(|(key, value)| (key.as_str(), value));
        let Some((key, _)) = self.entry else {
            return Ok(None);
        };
        seed.deserialize(StrDeserializer::new(key)).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Misread> {
        let (key, value) = self
            .entry
            .ok_or_else(|| de::Error::custom("a value before its key"))?;
        let reader = self.reader.below(key, value);
        let key = reader.key.clone();
        Reader::named(&key, seed.deserialize(reader))
    }
}

/// Elements of a list.
struct Elements<'a, 'r> {
    values: std::iter::Enumerate<std::slice::Iter<'a, Value>>,
    reader: &'r Reader<'a>,
}

impl<'de> de::SeqAccess<'de> for Elements<'_, '_> {
    type Error = Misread;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Misread> {
        let Some((number, value)) = self.values.next() else {
            return Ok(None);
        };
        let reader = Reader {
            value,
            key: format!("{}[{number}]", self.reader.key),
            kinds: self.reader.kinds,
        };
        let key = reader.key.clone();
        Reader::named(&key, seed.deserialize(reader)).map(Some)
    }
}

/// A name, with what stands inside it.
struct Variant<'a> {
    /// Name of the enum.
    of: &'static str,
    name: &'a str,
    inside: Option<Reader<'a>>,
}

impl<'a> Variant<'a> {
    fn inside(self) -> Result<Reader<'a>, Misread> {
        self.inside.ok_or_else(|| Misread {
            bare: true,
            ..de::Error::custom(format!("`{}` without its keys", self.name))
        })
    }
}

impl<'de, 'a> de::EnumAccess<'de> for Variant<'a> {
    type Error = Misread;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Misread> {
        Ok((seed.deserialize(StrDeserializer::new(self.name))?, self))
    }
}

impl<'de> de::VariantAccess<'de> for Variant<'_> {
    type Error = Misread;

    fn unit_variant(self) -> Result<(), Misread> {
        match self.inside {
            None => Ok(()),
            Some(reader) => Reader::named(
                &reader.key,
                Err(Misread::new(
                    "has no keys".to_owned(),
                    format!("the name `{}`", self.name),
                )),
            ),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Misread> {
        seed.deserialize(self.inside()?)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Misread> {
        self.inside()?.deserialize_seq(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misread> {
        let of = self.of;
        self.inside()?.fields(of, fields, visitor)
    }
}
