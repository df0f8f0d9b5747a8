//! Keys as data: name, type, unit, range and meaning of each setting.

use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use std::fmt::{self, Display};
use std::marker::PhantomData;
use std::path::PathBuf;

/// A key of a scenario or of one of its tables.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Name in TOML.
    pub name: &'static str,
    /// Lines of documentation, one after the other.
    pub about: &'static str,
    /// True if a table must have the key.
    pub required: bool,
    /// Type of the value.
    pub shape: Shape,
    /// Least and greatest value that are accepted.
    pub range: Option<fn() -> [String; 2]>,
    /// Least and greatest value that are accepted with any other settings, where these narrow them.
    pub widest: Option<fn() -> [String; 2]>,
    /// Other restrictions.
    pub allowed: Option<&'static str>,
}

/// Type of a value.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// True or false.
    Flag,
    /// Whole number.
    Whole {
        /// Least number that the type holds.
        least: i64,
        /// Greatest number that the type holds.
        most: i64,
    },
    /// Number with a fraction.
    Number,
    /// String.
    Text,
    /// Path of a file or a directory.
    Path,
    /// One of some names.
    Choice(fn() -> &'static [&'static str]),
    /// List of values, of a fixed length or of any.
    List(&'static Shape, Option<usize>),
    /// One number for all axes, or a list with one for each.
    PerAxis,
    /// Three coordinates, or four with a fourth axis.
    Point,
    /// Table with keys of its own.
    Table(&'static [&'static [Key]], fn() -> Defaults),
}

/// Values of the keys of a table where they are not given; a key without one is left out.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
#[serde(transparent)]
pub struct Defaults(pub(crate) toml::Table);

/// A type that settings have.
pub trait Value: Sized {
    /// Its type as data.
    const SHAPE: Shape;

    /// Reads a value.
    ///
    /// # Errors
    /// The value has another type, or is out of the type's range.
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error>;
}

macro_rules! values {
    ($($type:ty: $shape:expr),* $(,)?) => {$(
        impl Value for $type {
            const SHAPE: Shape = $shape;

            fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                Self::deserialize(from)
            }
        }
    )*};
}

values! {
    bool: Shape::Flag,
    u32: Shape::Whole { least: 0, most: u32::MAX as i64 },
    // TOML has no greater numbers.
    u64: Shape::Whole { least: 0, most: i64::MAX },
    usize: Shape::Whole { least: 0, most: i64::MAX },
    i64: Shape::Whole { least: i64::MIN, most: i64::MAX },
    f64: Shape::Number,
    String: Shape::Text,
    PathBuf: Shape::Path,
}

/// Makes enums values of settings; their names are those that serde reads.
macro_rules! choices {
    ($($type:ty),* $(,)?) => {$(
        impl $crate::settings::Value for $type {
            const SHAPE: $crate::settings::Shape =
                $crate::settings::Shape::Choice($crate::settings::names::<$type>);

            fn read<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                serde::Deserialize::deserialize(from)
            }
        }
    )*};
}
pub(crate) use choices;

impl<T: Value> Value for Option<T> {
    const SHAPE: Shape = T::SHAPE;

    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_option(Optional(PhantomData))
    }
}

impl<T: Value> Value for Vec<T> {
    const SHAPE: Shape = Shape::List(&T::SHAPE, None);

    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(Elements(PhantomData))
    }
}

/// A longer list is refused: an array by itself would drop what is behind its last element.
impl<T: Value, const N: usize> Value for [T; N] {
    const SHAPE: Shape = Shape::List(&T::SHAPE, Some(N));

    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(Exactly(PhantomData))
    }
}

/// Reads a [`Value`] where serde asks for a type that reads itself.
pub(super) struct Read<T>(pub(super) T);

impl<'de, T: Value> Deserialize<'de> for Read<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        T::read(from).map(Read)
    }
}

struct Optional<T>(PhantomData<T>);

impl<'de, T: Value> Visitor<'de> for Optional<T> {
    type Value = Option<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a value")
    }

    fn visit_none<E>(self) -> Result<Option<T>, E> {
        Ok(None)
    }

    fn visit_unit<E>(self) -> Result<Option<T>, E> {
        Ok(None)
    }

    fn visit_some<D: Deserializer<'de>>(self, from: D) -> Result<Option<T>, D::Error> {
        T::read(from).map(Some)
    }
}

struct Elements<T>(PhantomData<T>);

impl<'de, T: Value> Visitor<'de> for Elements<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a sequence")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
        let mut values = Vec::new();
        while let Some(Read(value)) = list.next_element()? {
            values.push(value);
        }
        Ok(values)
    }
}

struct Exactly<T, const N: usize>(PhantomData<T>);

impl<'de, T: Value, const N: usize> Visitor<'de> for Exactly<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of length {N}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<[T; N], A::Error> {
        let values = Elements(PhantomData).visit_seq(list)?;
        let given = values.len();
        let values = values.try_into();
        values.map_err(|_| de::Error::invalid_length(given, &self))
    }
}

/// Returns the names that an enum has in text.
pub(crate) fn names<T: for<'de> Deserialize<'de>>() -> &'static [&'static str] {
    T::deserialize(Ask).err().map_or(&[], |Names(names)| names)
}

/// A deserializer that learns which names an enum takes, and has no value for it.
struct Ask;

/// The names, as the error with which [`Ask`] ends.
#[derive(Debug)]
struct Names(&'static [&'static str]);

impl Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0.join(", "))
    }
}

impl std::error::Error for Names {}

impl de::Error for Names {
    fn custom<T: Display>(_: T) -> Self {
        Names(&[])
    }
}

impl<'de> Deserializer<'de> for Ask {
    type Error = Names;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Names> {
        Err(Names(&[]))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        names: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Names> {
        Err(Names(names))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}
