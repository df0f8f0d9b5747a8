/// Declares records of a circuit's signals: its input ports, flip-flops, nets and parts, or a
/// bundle that several circuits use. Widths are expressions over the circuit's fields.
///
/// | field | meaning |
/// |---|---|
/// | `Bit`, `U(width)`, `I(width)` | a word of 1 to 64 bits |
/// | `U(width, fraction)`, `I(width, fraction)` | the same; waves show the lowest `fraction` bits behind the binary point |
/// | `Ram(address_width, data_width)` | a memory; `= &c.image` gives its power-on contents |
/// | `Shift(stages, data_width)` | a shift register |
/// | `[U(c.width); c.count]`, `[U(c.widths[k]); k in c.count]` | an array, a `Vec` |
/// | `Gains(&c.widths)` | a bundle: a record that is declared for the type of `c.widths`; its signals stand in a scope of its name, `as Flat` without |
/// | `Part<Counter>(Counter { width: c.width })` | a circuit inside |
/// | `U(c.width) if c.counts()` | an optional field of any of these, an `Option` |
///
/// A record declared `for (A, B) as c;` belongs to both types; both need the fields that the
/// widths read.
///
/// A field may carry a display format (`as Hex`, `as Analog`, `as States(NAMES)`, `as
/// Elements(NAMES)`), a condition (`if c.counts()`) and a power-on value (`= 1`; 0 by default), in
/// this order. A condition is a field or a method of the circuit; any other stands in brackets
/// (`if (c.width > 8)`). In a `Reg` or `Net`, a `pub`
/// field is an output port. `pub(crate)` shows a field to proofs and tests without making it a
/// port.
///
/// ```
/// use motion_rtl::prelude::*;
///
/// /// Counts while it is enabled.
/// #[derive(Debug, Clone)]
/// pub struct Counter {
///     /// Width of the count in bits.
///     pub width: usize,
/// }
///
/// signals! { for Counter as c;
///     /// Ports in.
///     pub struct In {
///         /// Counts.
///         pub enable: Bit,
///     }
///     /// Flip-flops.
///     pub struct Reg {
///         /// Ticks that were enabled.
///         pub count: U(c.width) as Analog = 0,
///     }
/// }
///
/// impl Circuit for Counter {
///     const NAME: &'static str = "counter";
///     const ABOUT: &'static str = "counts while it is enabled";
///     records!(In, Reg, Nothing);
///
///     fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
///         (Nothing, Reg { count: i.enable.mux(q.count + 1, q.count) })
///     }
/// }
/// ```
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_signals {
    (
        for $circuits:tt as $c:ident;
        $(
            $(#[doc = $about:literal])*
            $vis:vis struct $name:ident $body:tt
        )+
    ) => {
        $(
            $crate::hdl_record! { [$(#[doc = $about])*] $vis $name $body }
            $crate::hdl_record_for! { $circuits [$c] $name $body }
        )+
    };
}

/// Expands one record of [`hdl_signals`].
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_record {
    (
        [$($about:tt)*] $vis:vis $name:ident { $(
            $(#[doc = $doc:literal])*
            $public:vis $field:ident : $kind:tt
                $(<$($part:ident)::+>)? $(($($arg:expr),* $(,)?))?
                $(as $format:ident $(($names:expr))?)?
                $(if $of:tt $(. $member:tt $(($($given:expr),*))?)*)? $(= $power_on:expr)?
        ),* $(,)? }
    ) => {
        $($about)*
        $vis struct $name<V: $crate::hdl::View = $crate::hdl::Wire> {
            $(
                $(#[doc = $doc])*
                $public $field: $crate::hdl_type!(V; $kind $(<$($part)::+>)? $(if $of)?),
            )*
        }

        impl<V: $crate::hdl::View> $crate::hdl::Walk<V> for $name<V> {
            const SITE: $crate::netlist::Site = $crate::netlist::Site {
                file: file!(),
                line: line!(),
                column: column!(),
            };

            fn visit(
                &self,
                field: &'static $crate::netlist::Field,
                sink: &mut dyn $crate::hdl::Sink,
            ) {
                sink.enter(field);
                $( $crate::hdl_visit!(
                    V; sink;
                    $crate::hdl_field!($public $field, [$($doc)*], [$($format $(($names))?)?]);
                    (&self.$field);
                    $kind $(<$($part)::+>)? $(if $of)?
                ); )*
                sink.leave();
            }

            fn words(&self, words: &mut ::std::vec::Vec<u64>) {
                let _ = &words;
                $( $crate::hdl_words!(
                    V; words; (&self.$field); $kind $(<$($part)::+>)? $(if $of)?
                ); )*
            }
        }

        impl<V: $crate::hdl::View> ::std::clone::Clone for $name<V>
        where
            $( $crate::hdl_type!(V; $kind $(<$($part)::+>)? $(if $of)?): ::std::clone::Clone, )*
        {
            fn clone(&self) -> Self {
                $name { $( $field: ::std::clone::Clone::clone(&self.$field), )* }
            }
        }

        impl<V: $crate::hdl::View> ::std::fmt::Debug for $name<V>
        where
            $( $crate::hdl_type!(V; $kind $(<$($part)::+>)? $(if $of)?): ::std::fmt::Debug, )*
        {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                let mut shown = f.debug_struct(stringify!($name));
                $( shown.field(stringify!($field), &self.$field); )*
                shown.finish()
            }
        }
    };
}

/// Implements one record of [`hdl_signals`] for the type it belongs to.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_record_for {
    (($($circuit:ident),+ $(,)?) $c:tt $name:ident $body:tt) => {
        $( $crate::hdl_record_for! { $circuit $c $name $body } )+
    };
    ($circuit:ident [$c:ident] $name:ident { $(
        $(#[doc = $doc:literal])*
        $public:vis $field:ident : $kind:tt
            $(<$($part:ident)::+>)? $(($($arg:expr),* $(,)?))?
            $(as $format:ident $(($names:expr))?)?
            $(if $of:tt $(. $member:tt $(($($given:expr),*))?)*)? $(= $power_on:expr)?
    ),* $(,)? }) => {
        impl<V: $crate::hdl::View> $crate::hdl::Record<$circuit, V> for $name<V> {
            fn make(
                $c: &$circuit,
                field: &'static $crate::netlist::Field,
                source: &mut dyn $crate::hdl::Source,
            ) -> Self {
                let _ = $c;
                source.enter(field);
                let made = $name {
                    $( $field: $crate::hdl_make!(
                        V; source;
                        $crate::hdl_field!($public $field, [$($doc)*], [$($format $(($names))?)?]);
                        [$($power_on)?];
                        $kind $(<$($part)::+>)? $(($($arg),*))?
                        $(if $of $(. $member $(($($given),*))?)*)?
                    ), )*
                };
                source.leave();
                made
            }
        }
    };
}

/// Expands to the type of a field in a view.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_type {
    ($v:ident; Bit) => { <$v as $crate::hdl::View>::Bit };
    ($v:ident; U) => { <$v as $crate::hdl::View>::U };
    ($v:ident; I) => { <$v as $crate::hdl::View>::I };
    ($v:ident; Ram) => { <$v as $crate::hdl::View>::Ram };
    ($v:ident; Shift) => { <$v as $crate::hdl::View>::Shift };
    ($v:ident; Part<$($part:ident)::+>) => { <$v as $crate::hdl::View>::Part<$($part)::+> };
    ($v:ident; [$kind:tt $(<$($part:ident)::+>)? $(($($arg:tt)*))? ; $($count:tt)+]) => {
        ::std::vec::Vec<$crate::hdl_type!($v; $kind $(<$($part)::+>)?)>
    };
    ($v:ident; $kind:tt $(<$($part:ident)::+>)? if $of:tt) => {
        ::std::option::Option<$crate::hdl_type!($v; $kind $(<$($part)::+>)?)>
    };
    ($v:ident; $bundle:ident) => { $bundle<$v> };
}

/// Expands to the construction of a field.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_make {
    ($v:ident; $source:ident; $field:expr; [$($power_on:expr)?]; Bit) => {
        <$v as $crate::hdl::View>::bit($source.word(
            $field,
            $crate::netlist::BIT,
            $crate::hdl_power_on!($($power_on)?),
        ))
    };
    ($v:ident; $source:ident; $field:expr; [$($power_on:expr)?]; U($width:expr)) => {{
        let shape = $crate::netlist::unsigned($width);
        let token = $source.word($field, shape, $crate::hdl_power_on!($($power_on)?));
        <$v as $crate::hdl::View>::u(token, shape.width)
    }};
    ($v:ident; $source:ident; $field:expr; [$($power_on:expr)?]; I($width:expr)) => {{
        let shape = $crate::netlist::signed($width);
        let token = $source.word($field, shape, $crate::hdl_power_on!($($power_on)?));
        <$v as $crate::hdl::View>::i(token, shape.width)
    }};
    (
        $v:ident; $source:ident; $field:expr; [$($power_on:expr)?];
        U($width:expr, $fraction:expr)
    ) => {{
        $source.fraction($fraction);
        $crate::hdl_make!($v; $source; $field; [$($power_on)?]; U($width))
    }};
    (
        $v:ident; $source:ident; $field:expr; [$($power_on:expr)?];
        I($width:expr, $fraction:expr)
    ) => {{
        $source.fraction($fraction);
        $crate::hdl_make!($v; $source; $field; [$($power_on)?]; I($width))
    }};
    ($v:ident; $source:ident; $field:expr; [$($contents:expr)?]; Ram($address:expr, $width:expr)) => {
        <$v as $crate::hdl::View>::ram($crate::hdl::ram(
            $source,
            $field,
            ($address, $width),
            &|| $crate::hdl_contents!($($contents)?),
        ))
    };
    ($v:ident; $source:ident; $field:expr; []; Shift($stages:expr, $width:expr)) => {
        <$v as $crate::hdl::View>::shift($crate::hdl::shift($source, $field, ($stages, $width)))
    };
    ($v:ident; $source:ident; $field:expr; []; Part<$($part:ident)::+>($circuit:expr)) => {
        <$v as $crate::hdl::View>::part::<$($part)::+>(&$circuit, $field, $source)
    };
    (
        $v:ident; $source:ident; $field:expr; [$($power_on:expr)?];
        [$kind:tt $(<$($part:ident)::+>)? $(($($arg:expr),* $(,)?))? ; $k:ident in $count:expr]
    ) => {
        {
            let mut each = ::std::vec::Vec::new();
            let count: usize = $count;
            for $k in 0..count {
                $source.element($k);
                each.push($crate::hdl_make!(
                    $v; $source; $field; [$($power_on)?];
                    $kind $(<$($part)::+>)? $(($($arg),*))?
                ));
            }
            each
        }
    };
    (
        $v:ident; $source:ident; $field:expr; [$($power_on:expr)?];
        [$kind:tt $(<$($part:ident)::+>)? $(($($arg:expr),* $(,)?))? ; $count:expr]
    ) => {
        {
            let mut each = ::std::vec::Vec::new();
            let count: usize = $count;
            for index in 0..count {
                $source.element(index);
                each.push($crate::hdl_make!(
                    $v; $source; $field; [$($power_on)?];
                    $kind $(<$($part)::+>)? $(($($arg),*))?
                ));
            }
            each
        }
    };
    (
        $v:ident; $source:ident; $field:expr; $power_on:tt;
        $kind:tt $(<$($part:ident)::+>)? $(($($arg:expr),* $(,)?))? if $($condition:tt)+
    ) => {{
        #[allow(unused_parens)]
        let exists: bool = $($condition)+;
        match exists {
            true => ::std::option::Option::Some($crate::hdl_make!(
                $v; $source; $field; $power_on; $kind $(<$($part)::+>)? $(($($arg),*))?
            )),
            false => ::std::option::Option::None,
        }
    }};
    ($v:ident; $source:ident; $field:expr; []; $bundle:ident($of:expr)) => {
        $crate::hdl::Record::<_, $v>::make($of, $field, $source)
    };
}

/// Expands to the visit of a field.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_visit {
    ($v:ident; $sink:ident; $field:expr; ($value:expr); Bit) => {
        $sink.word($field, <$v as $crate::hdl::View>::of_bit(*$value))
    };
    ($v:ident; $sink:ident; $field:expr; ($value:expr); U) => {
        $sink.word($field, <$v as $crate::hdl::View>::of_u(*$value))
    };
    ($v:ident; $sink:ident; $field:expr; ($value:expr); I) => {
        $sink.word($field, <$v as $crate::hdl::View>::of_i(*$value))
    };
    ($v:ident; $sink:ident; $field:expr; ($value:expr); Ram) => {
        $sink.memory($field, <$v as $crate::hdl::View>::of_ram($value))
    };
    ($v:ident; $sink:ident; $field:expr; ($value:expr); Shift) => {
        $sink.memory($field, <$v as $crate::hdl::View>::of_shift($value))
    };
    // A part shows its leaves where it is settled.
    ($v:ident; $sink:ident; $field:expr; ($value:expr); Part<$($part:ident)::+>) => {
        let _ = $value;
    };
    (
        $v:ident; $sink:ident; $field:expr; ($value:expr);
        [$kind:tt $(<$($part:ident)::+>)? $(($($arg:tt)*))? ; $($count:tt)+]
    ) => {
        for (index, value) in $value.iter().enumerate() {
            $sink.element(index);
            $crate::hdl_visit!($v; $sink; $field; (value); $kind $(<$($part)::+>)?);
        }
    };
    (
        $v:ident; $sink:ident; $field:expr; ($value:expr);
        $kind:tt $(<$($part:ident)::+>)? if $of:tt
    ) => {
        if let ::std::option::Option::Some(value) = $value {
            $crate::hdl_visit!($v; $sink; $field; (value); $kind $(<$($part)::+>)?);
        }
    };
    ($v:ident; $sink:ident; $field:expr; ($value:expr); $bundle:ident) => {
        $crate::hdl::Walk::<$v>::visit($value, $field, $sink)
    };
}

/// Expands to the words of a field, one after the other.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_words {
    ($v:ident; $words:ident; ($value:expr); Bit) => {
        $words.push(<$v as $crate::hdl::View>::of_bit(*$value))
    };
    ($v:ident; $words:ident; ($value:expr); U) => {
        $words.push(<$v as $crate::hdl::View>::of_u(*$value))
    };
    ($v:ident; $words:ident; ($value:expr); I) => {
        $words.push(<$v as $crate::hdl::View>::of_i(*$value))
    };
    ($v:ident; $words:ident; ($value:expr); Ram) => {
        let _ = $value;
    };
    ($v:ident; $words:ident; ($value:expr); Shift) => {
        let _ = $value;
    };
    ($v:ident; $words:ident; ($value:expr); Part<$($part:ident)::+>) => {
        let _ = $value;
    };
    (
        $v:ident; $words:ident; ($value:expr);
        [$kind:tt $(<$($part:ident)::+>)? $(($($arg:tt)*))? ; $($count:tt)+]
    ) => {
        for value in $value {
            $crate::hdl_words!($v; $words; (value); $kind $(<$($part)::+>)?);
        }
    };
    (
        $v:ident; $words:ident; ($value:expr); $kind:tt $(<$($part:ident)::+>)? if $of:tt
    ) => {
        if let ::std::option::Option::Some(value) = $value {
            $crate::hdl_words!($v; $words; (value); $kind $(<$($part)::+>)?);
        }
    };
    ($v:ident; $words:ident; ($value:expr); $bundle:ident) => {
        $crate::hdl::Walk::<$v>::words($value, $words)
    };
}

/// Expands to the description of a field without its value.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_field {
    ($public:vis $field:ident, [$($doc:literal)*], [Flat]) => {
        const { &$crate::netlist::Field::named("") }
    };
    ($public:vis $field:ident, [$($doc:literal)*], [$($format:ident $(($names:expr))?)?]) => {
        const {
            &$crate::netlist::Field {
                doc: concat!($($doc, "\n"),*),
                format: {
                    let format = $crate::netlist::Format::Decimal;
                    $( let _ = format; let format = $crate::netlist::Format::$format $(($names))?; )?
                    format
                },
                // Exactly `pub`: `pub(crate)` shows a signal to proofs without making it a port.
                public: stringify!($public).len() == 3,
                ..$crate::netlist::Field::named(stringify!($field))
            }
        }
    };
}

/// Expands to the power-on value of a register.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_power_on {
    () => {
        0
    };
    ($power_on:expr) => {
        ($power_on) as i128
    };
}

/// Names the records of a circuit: input ports, registers, nets and, if it has any, parts.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_records {
    ($in:ident, $reg:ident, $net:ident) => {
        $crate::hdl_records!($in, $reg, $net, Nothing);
    };
    ($in:ident, $reg:ident, $net:ident, $parts:ident) => {
        $crate::hdl_records!(@ In $in);
        $crate::hdl_records!(@ Reg $reg);
        $crate::hdl_records!(@ Net $net);
        $crate::hdl_records!(@ Parts $parts);
        $crate::hdl_made!();
    };
    (@ $role:ident Nothing) => {
        type $role<V: $crate::hdl::View> = $crate::hdl::Nothing;
    };
    (@ $role:ident $record:ident) => {
        type $role<V: $crate::hdl::View> = $record<V>;
    };
}

/// Declares a choice between circuits, one of which is inside another: an enum of the circuits,
/// and a record for the surrounding `Parts`. The scope has the name of the field, whichever
/// circuit is chosen.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_choice {
    (
        $(#[$about:meta])*
        $vis:vis enum $name:ident as $part:ident {
            $( $(#[doc = $doc:literal])* $variant:ident($circuit:ty) ),* $(,)?
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone)]
        $vis enum $name {
            $( $(#[doc = $doc])* $variant($circuit), )*
        }

        /// The chosen circuit.
        $vis enum $part<V: $crate::hdl::View = $crate::hdl::Wire> {
            $( $(#[doc = $doc])* $variant(<V as $crate::hdl::View>::Part<$circuit>), )*
        }

        impl<V: $crate::hdl::View> $crate::hdl::Record<$name, V> for $part<V> {
            fn make(
                of: &$name,
                field: &'static $crate::netlist::Field,
                source: &mut dyn $crate::hdl::Source,
            ) -> Self {
                match of {
                    $( $name::$variant(circuit) => {
                        $part::$variant(<V as $crate::hdl::View>::part(circuit, field, source))
                    } )*
                }
            }
        }

        impl<V: $crate::hdl::View> $crate::hdl::Walk<V> for $part<V> {
            const SITE: $crate::netlist::Site = $crate::netlist::Site {
                file: file!(),
                line: line!(),
                column: column!(),
            };

            // A part shows its leaves where it is settled.
            fn visit(&self, _: &'static $crate::netlist::Field, _: &mut dyn $crate::hdl::Sink) {}
            fn words(&self, _: &mut ::std::vec::Vec<u64>) {}
        }

        impl<V: $crate::hdl::View> ::std::fmt::Debug for $part<V> {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                f.write_str(match self {
                    $( $part::$variant(_) => stringify!($variant), )*
                })
            }
        }
    };
}

/// Expands to the power-on contents of a memory.
#[macro_export]
#[doc(hidden)]
macro_rules! hdl_contents {
    () => {
        $crate::hdl::Contents::default()
    };
    ($image:expr) => {
        $crate::hdl::Contents::of($image)
    };
}
