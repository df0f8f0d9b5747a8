use super::*;

#[test]
fn literals_are_of_vhdl() {
    for (text, expected) in [
        ("", "\"\""),
        ("width=8", "\"width=8\""),
        (
            "a=1\nb=\"2\"",
            "\"a=1\"\n            & LF & \"b=\"\"2\"\"\"",
        ),
    ] {
        assert_eq!(literal(text), expected);
    }
    let long = literal(&"x".repeat(PART + 1));
    let expected = format!("\"{}\"\n            & \"x\"", "x".repeat(PART));
    assert_eq!(long, expected);
}

#[test]
fn ports_have_names_that_the_checker_does_not_use() {
    let scope = Scope::of_ports(&USED, ["waves", "next", "Clk", "count"].into_iter());
    let names = ["waves", "next", "Clk", "count"].map(|name| scope.own(name));
    assert_eq!(names, ["waves_2", "next_s", "clk_2", "count"]);
}
