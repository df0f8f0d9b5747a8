/// Declares a struct of signals and its two walks.
///
/// Every field is a leaf (`L::Bit`, `L::U<N>`, `L::I<N>`, a memory), a nested struct of signals
/// or an array of these; it may carry how it is meant to be looked at (`as Hex`, `as Analog`,
/// `as States(NAMES)`, `as Elements(NAMES)`) and a power-on value (`= 1`; 0 where none is given).
/// A circuit that is a parameter (`type C: Circuit`) stands before the widths.
/// In a `Reg` or `Net` a `pub` field is a port out; `pub(crate)` lets the proofs of a surrounding
/// circuit look at it without making it a port.
///
/// ```
/// use motion_rtl::{logic::Logic, signals};
///
/// signals! {
///     /// Flip-flops.
///     pub struct Reg<L, const W: usize> {
///         /// Ticks since the last reset.
///         pub count: L::U<W> as Analog = 1,
///         /// High after the first tick.
///         running: L::Bit,
///     }
/// }
/// ```
#[macro_export]
macro_rules! signals {
    (
        $(#[doc = $about:literal])*
        $vis:vis struct $name:ident<L $(, type $part:ident : $bound:path)* $(, const $width:ident : usize)* $(,)?> {
            $(
                $(#[doc = $doc:literal])*
                $public:vis $field:ident : $type:ty
                    $(as $format:ident $(($names:expr))?)? $(= $power_on:expr)?
            ),* $(,)?
        }
    ) => {
        $(#[doc = $about])*
        #[derive(Debug, Clone)]
        $vis struct $name<L: $crate::logic::Logic $(, $part: $bound)* $(, const $width: usize)*> {
            $( $(#[doc = $doc])* $public $field: $type, )*
        }

        impl<L: $crate::logic::Logic $(, $part: $bound + Clone + ::std::fmt::Debug)* $(, const $width: usize)*> $crate::kernel::Signals<L>
            for $name<L $(, $part)* $(, $width)*>
        {
            fn visit<Visitor: $crate::kernel::Visit<L>>(
                &self,
                field: &'static $crate::kernel::Field,
                visitor: &mut Visitor,
            ) {
                visitor.enter(field);
                $(
                    $crate::kernel::Signals::<L>::visit(
                        &self.$field,
                        $crate::signals!(@field $public $field, [$($doc)*], [$($format $(($names))?)?], [$($power_on)?]),
                        visitor,
                    );
                )*
                visitor.leave();
            }

            fn make<Maker: $crate::kernel::Make<L>>(
                field: &'static $crate::kernel::Field,
                maker: &mut Maker,
            ) -> Self {
                maker.enter(field);
                let made = $name {
                    $(
                        $field: $crate::kernel::Signals::<L>::make(
                            $crate::signals!(@field $public $field, [$($doc)*], [$($format $(($names))?)?], [$($power_on)?]),
                            maker,
                        ),
                    )*
                };
                maker.leave();
                made
            }
        }
    };
    (@field $public:vis $field:ident, [$($doc:literal)*], [$($format:ident $(($names:expr))?)?], [$($power_on:expr)?]) => {
        const {
            &$crate::kernel::Field {
                name: stringify!($field),
                doc: concat!($($doc, "\n"),*),
                format: {
                    let format = $crate::kernel::Format::Decimal;
                    $( let _ = format; let format = $crate::kernel::Format::$format $(($names))?; )?
                    format
                },
                // Exactly `pub`: `pub(crate)` shows a signal to proofs, and makes it no port.
                public: stringify!($public).len() == 3,
                power_on: {
                    let value = 0i128;
                    $( let _ = value; let value = $power_on as i128; )?
                    value
                },
                role: None,
            }
        }
    };
}
