//! A feed limited to a contour error, beside the vector at full feed.

use super::*;

const HALF: &str = "[[piece]]\nvia_mm = [4, 4, 0]\nto_mm = [8, 0, 0]\n";

#[test]
#[ignore = "takes long"]
fn a_tolerance_costs_time() {
    let bench = with(HALF);
    let limited = ["run", "--beside", "s.toml", "--out", "o", "--to", "1000"];
    let limited = [&limited[..], &["--set", "contour_tolerance_mm=0.02"]].concat();
    let full = bench.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert_eq!(full["settings"]["contour_tolerance_mm"], Value::Null);
    assert_eq!(list(&full, "corrections").len(), 4);
    let summary = bench.json(&limited);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["settings"]["contour_tolerance_mm"], 0.02);
    let rows = list(&summary, "corrections");
    let kinds = rows.iter().map(|row| {
        let waves = row["in_waves"] == true;
        (
            row["correction"].as_str().unwrap(),
            row["full_feed"] == true,
            waves,
        )
    });
    let expected = [
        ("none", false, false),
        ("steady", false, false),
        ("feedback", false, false),
        ("vector", false, true),
        ("vector", true, false),
    ];
    assert_eq!(kinds.collect::<Vec<_>>(), expected);

    // c of the note is 90 us², so that 222 mm/s² are allowed across the path.
    let speed = (0.02 / 90e-6 * 4.0f64).sqrt();
    let seconds = |speed: f64| TAU / 2.0 * 4.0 / speed + speed / 2000.0;
    close(number(&summary, "/segments/0/speed_mm_per_s"), speed, 1e-3);
    close(number(&summary, "/plan/seconds"), seconds(speed), 1e-3);
    for row in &rows[..4] {
        assert_eq!(row["planned_seconds"], summary["plan"]["seconds"]);
    }
    close(number(&rows[4], "/planned_seconds"), seconds(50.0), 1e-6);
    let none = number(&rows[0], "/model/contour_max_um");
    assert!(none > 19.5 && none <= 20.0, "{none}");
    // At full feed all is as without a tolerance.
    for part in ["model", "load", "axes", "periods"] {
        assert_eq!(rows[4][part], of(&full, "vector")[part], "{part}");
    }

    let svg = bench.read("o/s.svg");
    for name in ["vector, full feed", "planned", "planned, full feed"] {
        assert!(svg.contains(&format!("\n{name}\n")), "{name}");
    }
    let text = bench.succeed(&limited);
    let said = format!(
        "\nfeed limited to a contour error of 20 um without correction: {:.3} s, at full feed {:.3} s\n",
        number(&summary, "/plan/seconds"),
        seconds(50.0)
    );
    assert!(text.contains(&said), "{text}");
    let names = text.lines().filter(|line| line.starts_with("vector"));
    let names: Vec<_> = names.map(|line| &line[..18]).collect();
    assert!(
        names.starts_with(&["vector            ", "vector, full feed "]),
        "{text}"
    );
}
