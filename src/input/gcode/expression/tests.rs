use super::*;
use proptest::prelude::*;

/// Parameters: `#1` is 2.5, `#2` is -3, `#<_a>` is 7, `#<b>` has no value.
struct Known;

impl Values for Known {
    fn value(&self, name: &Name) -> Result<Option<f64>, Problem> {
        Ok(match name {
            Name::Number(1) => Some(2.5),
            Name::Number(2) => Some(-3.0),
            Name::Text(text) if text == "_A" => Some(7.0),
            _ => None,
        })
    }
}

fn value(text: &str) -> Result<f64, String> {
    let mut cleaned = Vec::new();
    let read = super::super::text::clean(text.as_bytes(), &mut cleaned);
    let mut scanner = Scanner::new(&cleaned);
    let value = read.and_then(|()| scanner.value(&Known));
    match value {
        Ok(value) if scanner.rest().is_empty() => Ok(value),
        Ok(_) => Err(format!("rest {}", scanner.rest_text())),
        Err(it) => Err(format!("{}: {}", it.field, it.problem)),
    }
}

#[test]
fn each_operator_and_function() {
    for (text, expected) in [
        ("- 1 . 5", -1.5),
        ("[2 ** 3]", 8.0),
        ("[-2 ** 2]", 4.0),
        ("[2 ** 3 ** 2]", 64.0),
        ("[2 + 3 * 4 ** 2 / 8]", 8.0),
        ("[7 mod 4]", 3.0),
        ("[-7 MOD 4]", 1.0),
        ("[-7 MOD -4]", 1.0),
        ("[8 - 3 - 2]", 3.0),
        ("[8 / 4 / 2]", 1.0),
        ("[2 - - 3]", 5.0),
        ("[1 EQ 1.00005]", 1.0),
        ("[1 EQ 1.0002]", 0.0),
        ("[1 NE 1.00005]", 0.0),
        ("[1 NE 2]", 1.0),
        ("[2 GT 1]", 1.0),
        ("[1 GT 1]", 0.0),
        ("[1 GE 1]", 1.0),
        ("[1 LT 1]", 0.0),
        ("[1 LE 1]", 1.0),
        ("[1 AND 0]", 0.0),
        ("[1 OR 0]", 1.0),
        ("[1 XOR 1]", 0.0),
        ("[1 + 1 GT 1 AND 2 LT 3]", 1.0),
        ("ABS[-2]", 2.0),
        ("ACOS[0]", 90.0),
        ("ASIN[1]", 90.0),
        ("ATAN[1]/[-1]", 135.0),
        ("COS[60]", 0.5),
        ("EXP[0]", 1.0),
        ("FIX[-2.5]", -3.0),
        ("FUP[-2.5]", -2.0),
        ("LN[EXP[2]]", 2.0),
        ("ROUND[-2.5]", -3.0),
        ("SIN[30]", 0.5),
        ("SQRT[9]", 3.0),
        ("TAN[45]", 1.0),
        ("#1", 2.5),
        ("-#2", 3.0),
        ("##<_a>", f64::NAN),
        ("#[1+1]", -3.0),
        ("#<_ A >", 7.0),
        ("EXISTS[#<b>]", 0.0),
        ("EXISTS[#<_a>]", 1.0),
        ("EXISTS[#99999]", 0.0),
        ("[1(a)+(b)1]", 2.0),
    ] {
        match value(text) {
            Ok(value) => assert!((value - expected).abs() < 1e-12, "{text}: {value}"),
            Err(_) => assert!(expected.is_nan(), "{text}: {:?}", value(text)),
        }
    }
}

#[test]
fn what_has_no_value_is_refused() {
    for (text, problem) in [
        ("[1", "[: no closing ]"),
        ("[1 2 X]", "expression: no operator at 'X]'"),
        ("[1/0]", "/: has no value here"),
        ("[5 MOD 0]", "MOD: has no value here"),
        ("[-8 ** 0.5]", "**: has no value here"),
        ("SQRT[-1]", "SQRT: has no value here"),
        ("LN[0]", "LN: has no value here"),
        ("ACOS[2]", "ACOS: has no value here"),
        ("ATAN[1]", "ATAN: without its second part"),
        ("SINH[1]", "SINH: not a function"),
        ("#<b>", "#<b>: has no value"),
        ("#0", "#: 0 is not the number of a parameter"),
        ("#1.5", "#: 1.5 is not the number of a parameter"),
        ("#<b", "<: a name that is not closed"),
        ("1.2.3", "number: 1.2.3 is not a number"),
        ("[]", "expression: no value at ']'"),
    ] {
        assert_eq!(value(text), Err(problem.to_owned()), "{text}");
    }
    let deep = |depth: usize| value(&format!("{}1{}", "[".repeat(depth), "]".repeat(depth)));
    assert_eq!(deep(DEEPEST), Ok(1.0));
    assert!(deep(DEEPEST + 1).is_err() && deep(100_000).is_err());
    assert!(value(&"-".repeat(100_000)).is_err());
}

/// Expression as text, with its value.
#[derive(Debug, Clone)]
struct Both {
    text: String,
    value: f64,
}

fn both() -> impl Strategy<Value = Both> {
    let number = (-1000.0..1000.0_f64).prop_map(|value| {
        let text = format!("{value:.3}");
        let value = text.parse().unwrap();
        Both { text, value }
    });
    number.prop_recursive(6, 40, 2, |inner| {
        let binary = (inner.clone(), 0..6_usize, inner.clone()).prop_map(|(a, kind, b)| {
            let (x, y) = (a.value, b.value);
            let (name, value) = [
                ("+", x + y),
                ("-", x - y),
                ("*", x * y),
                ("GT", f64::from(u8::from(x > y))),
                ("AND", f64::from(u8::from(x != 0.0 && y != 0.0))),
                ("XOR", f64::from(u8::from((x != 0.0) != (y != 0.0)))),
            ][kind];
            let text = format!("[{} {name} {}]", a.text, b.text);
            Both { text, value }
        });
        let unary = (inner, 0..5_usize).prop_map(|(a, kind)| {
            let x = a.value;
            let (name, value) = [
                ("ABS", x.abs()),
                ("SIN", x.to_radians().sin()),
                ("FIX", x.floor()),
                ("ROUND", x.round()),
                ("FUP", x.ceil()),
            ][kind];
            let text = format!("{name}[{}]", a.text);
            Both { text, value }
        });
        prop_oneof![binary, unary]
    })
}

proptest! {
    #[test]
    fn expressions_have_the_value_they_have(both in both()) {
        if both.value.is_finite() {
            prop_assert_eq!(value(&both.text), Ok(both.value));
        }
    }

    #[test]
    fn precedence_is_that_of_brackets(a in 1..9, b in 1..9, c in 1..9, d in 1..9) {
        let [w, x, y, z] = [a, b, c, d].map(f64::from);
        let flat = value(&format!("[{a} + {b} * {c} ** {d} - {a} MOD {b} GE {d} OR {c} LT {d}]"));
        let sum = w + x * y.powf(z) - w.rem_euclid(x);
        prop_assert_eq!(flat, Ok(f64::from(u8::from(sum >= z || y < z))));
    }

    #[test]
    fn numbers_come_back(number in -1.0e9..1.0e9_f64) {
        prop_assert_eq!(value(&number.to_string()), Ok(number));
    }

    #[test]
    fn nothing_panics(text in "[-+*/#<>A-Z0-9.\\[\\] ]{0,40}") {
        let _ = value(&text);
    }
}
